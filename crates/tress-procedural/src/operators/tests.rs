//! Limits and identities of single operators.

use super::*;

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
    let mut frames = vec![[DVec3::ZERO; 2]; 40];
    normals(&guide, &mut frames);
    let setting = Setting { convention, guide: &guide, normals: &frames, numbers };
    let mut out = strand(40);
    operator.apply(&mut out, &setting, &mut Scratch::new(40));
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
    let setting =
        Setting { convention: Convention::Paper, guide: &line, normals: &[], numbers: [0.3, 0.0] };
    let mut out = line.clone();
    Bend { angle_degrees, start: 0.5 }.apply(&mut out, &setting, &mut Scratch::new(50));
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
    let mut frames = vec![[DVec3::ZERO; 2]; 200];
    normals(&line, &mut frames);
    let setting = Setting {
        convention: Convention::Paper,
        guide: &line,
        normals: &frames,
        numbers: [0.5, 0.0],
    };
    let curl = Curl { radius: 0.1, frequency: 1.0, random_frequency: 0.5, start: 0.0 };
    let mut out = line.clone();
    curl.apply(&mut out, &setting, &mut Scratch::new(200));
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
    let mut out = coil.clone();
    Straighten { amount: 1.0, span: 1.0 }.apply(&mut out, &mut Scratch::new(400));
    let length: f64 = segments(&coil).iter().sum();
    assert!(0.99 * length < out[0].distance(out[399]));
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

#[test]
fn strands_of_no_length_stay_finite() {
    let guide = vec![DVec3::ONE; 8];
    let mut frames = vec![[DVec3::ZERO; 2]; 8];
    normals(&guide, &mut frames);
    let operators = [
        Operator::Scale(Scale { random: 0.3 }),
        Operator::Clump(Clump { profile: 2.0 }),
        Operator::Bend(Bend { angle_degrees: 40.0, start: 0.4 }),
        Operator::Curl(Curl { radius: 0.2, frequency: 1.0, random_frequency: 0.2, start: 0.3 }),
        Operator::Frizz(Frizz { frequency: 3.0, amplitude: 0.2 }),
        Operator::Straighten(Straighten { amount: 0.5, span: 0.5 }),
    ];
    for operator in operators {
        let setting = Setting {
            convention: Convention::Paper,
            guide: &guide,
            normals: &frames,
            numbers: [0.2, 0.3],
        };
        let mut out = vec![DVec3::ZERO; 8];
        operator.apply(&mut out, &setting, &mut Scratch::new(8));
        assert!(out.iter().all(|x| x.is_finite()), "{}", operator.name());
        let mut gradient = vec![DVec3::ONE; 8];
        let mut by_guide = vec![DVec3::ZERO; 8];
        let mut by_parameters = [0.0; 4];
        let mut sums =
            Sums { guide: &mut by_guide, parameters: &mut by_parameters, numbers: [0.0; 2] };
        let strand = vec![DVec3::ZERO; 8];
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
}
