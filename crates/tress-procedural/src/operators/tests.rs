//! Limits and identities of single operators.

use super::*;
use crate::EvenStrands;

/// A coil-like strand that goes nowhere near an axis.
fn strand(n: usize) -> Vec<DVec3> {
    let point = |i: usize| {
        let s = i as f64 / (n - 1) as f64;
        DVec3::new(0.3 + s + 0.2 * (5.0 * s).sin(), 0.2 * s * s - 2.0 * s, 0.4 * (3.0 * s).cos())
    };
    (0..n).map(point).collect()
}

fn applied(operator: &Operator, convention: Convention, numbers: [f64; 2]) -> Vec<DVec3> {
    let guide: Vec<DVec3> = strand(40).iter().map(|x| 1.1 * *x + 0.1).collect();
    moved(operator, convention, numbers, &guide, &strand(40))
}

/// A strand that `operator` moved.
fn moved(
    operator: &Operator,
    convention: Convention,
    numbers: [f64; 2],
    guide: &[DVec3],
    strand: &[DVec3],
) -> Vec<DVec3> {
    let guides = EvenStrands::new(guide.len(), guide.to_vec()).expect("one strand");
    let guides = Guides::new(&guides, std::slice::from_ref(operator));
    let setting = Setting { convention, guide, rows: guides.rows(0), numbers };
    let mut scratch = Scratch::new(strand.len());
    scratch.load(strand);
    operator.apply(&setting, &mut scratch);
    let mut out = strand.to_vec();
    scratch.store(&mut out);
    out
}

fn segments(points: &[DVec3]) -> Vec<f64> {
    points.windows(2).map(|ends| ends[0].distance(ends[1])).collect()
}

fn worst(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |worst, (a, b)| f64::max(worst, (a - b).abs()))
}

/// Every operator at parameters that change nothing.
#[test]
fn operators_of_no_strength_leave_strands_as_they_are() {
    let idle = [
        Operator::Scale(Scale::default()),
        Operator::Clump(Clump::default()),
        Operator::Bend(Bend::default()),
        Operator::Curl(Curl { frequency: 2.0, ..Curl::default() }),
        Operator::Frizz(Frizz { frequency: 2.0, ..Frizz::default() }),
        Operator::Straighten(Straighten::default()),
    ];
    for operator in idle {
        for convention in [Convention::Paper, Convention::PublishedProgram] {
            let out = applied(&operator, convention, [0.4, 0.7]);
            let moved = out.iter().zip(strand(40)).map(|(a, b)| a.distance(b));
            assert!(moved.fold(0.0, f64::max) < 1e-14, "{}", operator.name());
        }
    }
}

#[test]
fn bending_and_straightening_keep_the_length_of_every_segment() {
    let bend = Operator::Bend(Bend { angle_degrees: 130.0, start: 0.3 });
    let straighten = Operator::Straighten(Straighten { amount: 0.8, span: 0.5 });
    for operator in [bend, straighten] {
        let out = applied(&operator, Convention::Paper, [-0.6, 0.0]);
        assert!(worst(&segments(&out), &segments(&strand(40))) < 1e-14);
        assert!(1e-2 < out[20].distance(strand(40)[20]), "{} does something", operator.name());
        assert_eq!(out[0], strand(40)[0]);
    }
}

#[test]
fn a_bend_turns_the_tip_by_its_angle() {
    let angle_degrees = 75.0;
    let line: Vec<DVec3> = (0..50).map(|i| DVec3::Z * f64::from(i)).collect();
    let bend = Operator::Bend(Bend { angle_degrees, start: 0.5 });
    let out = moved(&bend, Convention::Paper, [0.3, 0.0], &line, &line);
    let tip = (out[49] - out[48]).normalize();
    assert!((tip.dot(DVec3::Z).acos().to_degrees() - angle_degrees).abs() < 1e-9);
}

#[test]
fn scale_and_clump_are_as_printed() {
    let scaled = applied(&Operator::Scale(Scale { random: 0.5 }), Convention::Paper, [0.4, 0.0]);
    let lengths: Vec<f64> = segments(&strand(40)).iter().map(|length| 1.2 * length).collect();
    assert!(worst(&segments(&scaled), &lengths) < 1e-14);

    let clumped = applied(&Operator::Clump(Clump { profile: 1.5 }), Convention::Paper, [0.0; 2]);
    let tip = strand(40)[39];
    let kept = (clumped[39] - (1.1 * tip + 0.1)).length() / (tip - (1.1 * tip + 0.1)).length();
    assert!((kept - (-1.5_f64).exp()).abs() < 1e-14);
    assert_eq!(clumped[0], strand(40)[0]);
}

#[test]
fn a_curl_winds_at_its_radius_and_frequency() {
    let line: Vec<DVec3> = (0..200).map(|i| DVec3::Y * (0.01 * f64::from(i))).collect();
    let curl =
        Operator::Curl(Curl { radius: 0.1, frequency: 1.0, random_frequency: 0.5, start: 0.0 });
    let out = moved(&curl, Convention::Paper, [0.5, 0.0], &line, &line);
    let aside: Vec<DVec3> = out.iter().zip(&line).map(|(x, on_line)| *x - *on_line).collect();
    assert!((aside[199].length() - 0.122).abs() < 1e-4, "the start's sigmoid is nearly 1 there");
    // 3.75 turns a unit of length: a quarter turn every 0.0667.
    let turned: f64 = aside[1..].windows(2).map(|pair| pair[0].angle_between(pair[1])).sum::<f64>();
    let expected = 3.75 * 0.01 * 198.0 * std::f64::consts::TAU;
    assert!((turned / expected - 1.0).abs() < 1e-9, "{turned} against {expected}");
}

#[test]
fn straightening_a_coil_wholly_leaves_a_line() {
    let coil: Vec<DVec3> = (0..400)
        .map(|i| f64::from(i) * 0.1)
        .map(|s| DVec3::new(0.3 * s.cos(), 0.3 * s.sin(), 0.1 * s))
        .collect();
    let straighten = Operator::Straighten(Straighten { amount: 1.0, span: 1.0 });
    let out = moved(&straighten, Convention::Paper, [0.0; 2], &coil, &coil);
    let length: f64 = segments(&coil).iter().sum();
    assert!(0.99 * length < out[0].distance(out[399]));
    // Its ends too follow the axis, where the surroundings are two turns or so.
    let straighten = Operator::Straighten(Straighten { amount: 1.0, span: 0.32 });
    let out = moved(&straighten, Convention::Paper, [0.0; 2], &coil, &coil);
    for j in [0, 200, 398] {
        assert!((out[j + 1] - out[j]).angle_between(DVec3::Z) < 0.2, "segment {j}");
    }
}

#[test]
fn the_conventions_differ_where_they_are_said_to() {
    let operators = [
        (Operator::Scale(Scale { random: 0.3 }), false),
        (Operator::Clump(Clump { profile: 2.0 }), true),
        (Operator::Bend(Bend { angle_degrees: 40.0, start: 0.4 }), true),
        (
            Operator::Curl(Curl { radius: 0.2, frequency: 1.0, random_frequency: 0.2, start: 0.3 }),
            true,
        ),
        (Operator::Frizz(Frizz { frequency: 3.0, amplitude: 0.2 }), true),
    ];
    for (operator, differs) in operators {
        let [paper, program] = [Convention::Paper, Convention::PublishedProgram]
            .map(|convention| applied(&operator, convention, [0.3, 0.6]));
        assert_eq!(paper != program, differs, "{}", operator.name());
    }
}

/// A strand up the y axis with points at these heights.
fn upright(heights: &[f64]) -> Vec<DVec3> {
    heights.iter().map(|s| *s * DVec3::Y).collect()
}

/// What the formulas of both conventions come to by hand, on strands with uneven points: arc
/// lengths and indices of points say different things there.
#[test]
fn clumps_are_as_each_convention_has_them() {
    let strand = upright(&[0.0, 1.0, 2.0, 4.0]);
    let guide: Vec<DVec3> = strand.iter().map(|x| *x + DVec3::X).collect();
    // 1 - exp(-2 v).
    let tip = 0.8646647167633873;
    let cases = [
        // v = 1/4, 1/2.
        (Convention::Paper, [0.0, 0.3934693402873666, 0.6321205588285577, tip]),
        // v = 1/3, 2/3.
        (Convention::PublishedProgram, [0.0, 0.486582880967408, 0.7364028618842733, tip]),
    ];
    for (convention, weights) in cases {
        let clump = Operator::Clump(Clump { profile: 2.0 });
        let out = moved(&clump, convention, [0.0; 2], &guide, &strand);
        let aside: Vec<f64> = out.iter().map(|x| x.x).collect();
        assert!(worst(&aside, &weights) < 1e-14, "{convention:?}: {aside:?}");
    }
}

#[test]
fn bends_begin_as_each_convention_has_them() {
    let strand = upright(&[0.0, 1.0, 4.0]);
    // 90 degrees times z_0 / (z_0 + 3 z_1), at v = 1/4 and 1.
    for (convention, first) in
        [(Convention::Paper, 2.23420437162204), (Convention::PublishedProgram, 0.536379446050143)]
    {
        let bend = Operator::Bend(Bend { angle_degrees: 90.0, start: 0.5 });
        let out = moved(&bend, convention, [0.3, 0.0], &strand, &strand);
        let turned = |j: usize| (out[j + 1] - out[j]).angle_between(DVec3::Y).to_degrees();
        assert!((turned(0) - first).abs() < 1e-9, "{convention:?}: {}", turned(0));
        assert!((turned(1) - 90.0).abs() < 1e-9);
    }
}

#[test]
fn curls_begin_as_each_convention_has_them() {
    let strand = upright(&[0.0, 1.0, 2.0, 4.0]);
    // 0.2 (0.43 + 0.79 v) z at v = 1/4, 1/2, 1.
    let cases = [
        (Convention::Paper, [0.009520201592666064, 0.0825, 0.24236694437447454]),
        (
            Convention::PublishedProgram,
            [0.014959966713775752, 0.10270578964830601, 0.24300688639732135],
        ),
    ];
    for (convention, radii) in cases {
        let curl = Curl { radius: 0.2, frequency: 1.0 / 12.0, random_frequency: 0.0, start: 0.5 };
        let out = moved(&Operator::Curl(curl), convention, [0.0; 2], &strand, &strand);
        let aside: Vec<DVec3> = out.iter().zip(&strand).map(|(x, on_axis)| *x - *on_axis).collect();
        let found: Vec<f64> = aside[1..].iter().map(|x| x.length()).collect();
        assert!(worst(&found, &radii) < 1e-14, "{convention:?}: {found:?}");
        // A quarter turn a unit, from the binormal (-z) over the normal (x) and on.
        let ways = [DVec3::X, DVec3::Z, DVec3::NEG_Z];
        assert!(aside[1..].iter().zip(ways).all(|(x, way)| x.angle_between(way) < 1e-7));
        assert_eq!(out[0], DVec3::ZERO);
    }
}

#[test]
fn noise_has_the_octaves_of_each_convention() {
    use crate::noise::perlin;
    let strand = upright(&[0.0, 0.5, 2.0]);
    // The noise goes by arc length, or by half and whole of the length.
    let cases = [
        (Convention::Paper, [0.5, 2.0], [2.0 / 3.0, 2.0 / 9.0]),
        (Convention::PublishedProgram, [1.0, 2.0], [1.0 / 1.5, 0.5 / 1.5]),
    ];
    for (convention, places, [first, second]) in cases {
        let frizz = Operator::Frizz(Frizz { frequency: 0.7, amplitude: 0.4 });
        let out = moved(&frizz, convention, [0.25, 0.0], &strand, &strand);
        for (j, s) in places.into_iter().enumerate() {
            let chi = 0.7 * s + 2.5;
            for (axis, offset) in [0.0, 85.37, 170.73].into_iter().enumerate() {
                let x = chi + offset;
                let expected = 0.2 * (first * perlin(x) + second * perlin(2.0 * x));
                let off = (out[j + 1] - strand[j + 1]).to_array()[axis];
                assert!((off - expected).abs() < 1e-13, "{convention:?}, point {j}, axis {axis}");
            }
        }
        assert_eq!(out[0], DVec3::ZERO);
    }
}

#[test]
fn strands_of_no_length_stay_finite() {
    let guide = vec![DVec3::ONE; 8];
    let strand = vec![DVec3::ZERO; 8];
    let operators = [
        Operator::Scale(Scale { random: 0.3 }),
        Operator::Clump(Clump { profile: 2.0 }),
        Operator::Bend(Bend { angle_degrees: 40.0, start: 0.4 }),
        Operator::Curl(Curl { radius: 0.2, frequency: 1.0, random_frequency: 0.2, start: 0.3 }),
        Operator::Frizz(Frizz { frequency: 3.0, amplitude: 0.2 }),
        Operator::Straighten(Straighten { amount: 0.5, span: 0.5 }),
    ];
    for operator in operators {
        let numbers = [0.2, 0.3];
        let out = moved(&operator, Convention::Paper, numbers, &guide, &strand);
        assert!(out.iter().all(|x| x.is_finite()), "{}", operator.name());
        let mut gradient = vec![DVec3::ONE; 8];
        let mut by_guide = vec![DVec3::ZERO; 8];
        let mut by_parameters = [0.0; 4];
        let mut sums =
            Sums { guide: &mut by_guide, parameters: &mut by_parameters, numbers: [0.0; 2] };
        let alone = EvenStrands::new(8, guide.clone()).expect("one strand");
        let guides = Guides::new(&alone, std::slice::from_ref(&operator));
        let (convention, rows) = (Convention::Paper, guides.rows(0));
        let setting = Setting { convention, guide: &guide, rows, numbers };
        operator.pull_back(&strand, &setting, &mut gradient, &mut sums, &mut Scratch::new(8));
        assert!(gradient.iter().all(|g| g.is_finite()), "{}", operator.name());
        assert!(by_parameters.iter().all(|g| g.is_finite()), "{}", operator.name());
    }
}

#[test]
fn parameters_out_of_range_are_named() {
    let curl = Operator::Curl(Curl { start: 1.5, ..Curl::default() });
    let error = curl.check(2).expect_err("the start is beyond the tip");
    assert_eq!(error.to_string(), "curl 2: start is 1.5, expected 0 to 1");
    let clump = Operator::Clump(Clump { profile: f64::NAN });
    assert!(clump.check(0).is_err());
    let skip = Operator::Skip(Skip { probability: 2.0, ..Skip::default() });
    let error = skip.check(1).expect_err("no probability");
    assert_eq!(error.to_string(), "skip 1: probability is 2, expected 0 to 1");
}
