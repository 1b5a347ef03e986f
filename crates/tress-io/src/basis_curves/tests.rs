use std::f64::consts::TAU;

use glam::DVec3;
use proptest::prelude::*;
use tress_geometry::curves::{catmull_rom_derivative, phantom_end};
use tress_geometry::{Groom, Strands};

use super::*;

const ALL: [CurveType; 4] = [
    CurveType::Linear,
    CurveType::Cubic(CubicBasis::Bezier),
    CurveType::Cubic(CubicBasis::BSpline),
    CurveType::Cubic(CubicBasis::CatmullRom),
];
const WRAPS: [Wrap; 3] = [Wrap::Nonperiodic, Wrap::Pinned, Wrap::Periodic];

fn flat(points: &[DVec3]) -> Column {
    let values = points.iter().flat_map(|point| point.to_array()).collect();
    Column::Float { components: 3, values }
}

fn evaluate(kind: CurveType, wrap: Wrap, points: &[DVec3]) -> Vec<DVec3> {
    let curves = BasisCurves::new(kind, wrap, vec![points.len()]);
    let Column::Float { values, .. } = curves.at_control_points(flat(points)) else {
        panic!("floats stay floats")
    };
    values.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// De Boor's algorithm for a cubic with knots at the whole numbers; `u` in `3..=points.len()`.
fn de_boor(points: &[DVec3], u: f64) -> DVec3 {
    // Knot k is k; the interval of u, where the end belongs to the last.
    let k = (3..points.len()).rev().find(|&k| k as f64 <= u).expect("u is not below 3");
    let mut d: Vec<DVec3> = (0..4).map(|j| points[j + k - 3]).collect();
    for r in 1..4 {
        for j in (r..4).rev() {
            let i = j + k - 3;
            let alpha = (u - i as f64) / (4 - r) as f64;
            d[j] = d[j - 1].lerp(d[j], alpha);
        }
    }
    d[3]
}

fn de_casteljau(points: &[DVec3], t: f64) -> DVec3 {
    let mut level = points.to_vec();
    while 1 < level.len() {
        level = level.windows(2).map(|pair| pair[0].lerp(pair[1], t)).collect();
    }
    level[0]
}

fn near(a: &[DVec3], b: &[DVec3]) -> bool {
    let scale = 1.0 + b.iter().map(|point| point.length()).fold(0.0, f64::max);
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.distance(*b) < 1e-13 * scale)
}

fn control_points(least: usize) -> impl Strategy<Value = Vec<DVec3>> {
    let point = prop::array::uniform3(-10.0..10.0).prop_map(DVec3::from_array);
    // Repeated points now and then.
    let repeats = (point, 1..3_usize).prop_map(|(point, n)| vec![point; n]);
    prop::collection::vec(repeats, least..12).prop_map(|points| points.concat())
}

/// A uniform B-spline over all of `points`, at every quarter of a segment.
fn b_spline(points: &[DVec3]) -> Vec<DVec3> {
    let n = (points.len() - 3) * SAMPLES_PER_CONTROL_POINT;
    let u = |i: usize| 3.0 + i as f64 / SAMPLES_PER_CONTROL_POINT as f64;
    (0..=n).map(|i| de_boor(points, u(i))).collect()
}

proptest! {
    #[test]
    fn b_splines_are_what_de_boor_says(points in control_points(4)) {
        let kind = CurveType::Cubic(CubicBasis::BSpline);
        prop_assert!(near(&evaluate(kind, Wrap::Nonperiodic, &points), &b_spline(&points)));

        let mut pinned = points.clone();
        pinned.insert(0, phantom_end(points[0], points[1]));
        pinned.push(phantom_end(points[points.len() - 1], points[points.len() - 2]));
        let curve = evaluate(kind, Wrap::Pinned, &points);
        prop_assert!(near(&curve, &b_spline(&pinned)));
        prop_assert!(near(&curve[..1], &points[..1]), "a pinned curve begins at its first point");

        let closed: Vec<_> = points.iter().chain(&points[..3]).copied().collect();
        prop_assert!(near(&evaluate(kind, Wrap::Periodic, &points), &b_spline(&closed)));
    }

    #[test]
    fn bezier_curves_are_what_de_casteljau_says(points in control_points(6)) {
        let kind = CurveType::Cubic(CubicBasis::Bezier);
        let samples = 3 * SAMPLES_PER_CONTROL_POINT;
        let curve = |points: &[DVec3]| -> Vec<DVec3> {
            let segments = points.windows(4).step_by(3);
            let inner = segments.flat_map(|segment| {
                (0..samples).map(|i| de_casteljau(segment, i as f64 / samples as f64))
            });
            inner.chain(points.last().copied()).collect()
        };
        let open = &points[..(points.len() - 1) / 3 * 3 + 1];
        for wrap in [Wrap::Nonperiodic, Wrap::Pinned] {
            prop_assert!(near(&evaluate(kind, wrap, open), &curve(open)));
        }
        let closed = &points[..points.len() / 3 * 3];
        let around: Vec<_> = closed.iter().chain(&closed[..1]).copied().collect();
        prop_assert!(near(&evaluate(kind, Wrap::Periodic, closed), &curve(&around)));
    }

    #[test]
    fn points_on_the_curve_are_kept_bit_for_bit(points in control_points(4)) {
        let n = points.len();
        let closed: Vec<_> = points.iter().chain(&points[..1]).copied().collect();
        for kind in [CurveType::Linear, CurveType::Cubic(CubicBasis::CatmullRom)] {
            prop_assert_eq!(&evaluate(kind, Wrap::Pinned, &points), &points);
            prop_assert_eq!(&evaluate(kind, Wrap::Periodic, &points), &closed);
        }
        prop_assert_eq!(&evaluate(CurveType::Linear, Wrap::Nonperiodic, &points), &points);
        let cubic = CurveType::Cubic(CubicBasis::CatmullRom);
        let phantomless = evaluate(cubic, Wrap::Nonperiodic, &points);
        prop_assert_eq!(&phantomless[..], &points[1..n - 1]);
    }
}

#[test]
fn short_curves_keep_their_points() {
    for n in 0..4 {
        let points: Vec<_> = (0..n).map(|i| DVec3::splat(f64::from(i))).collect();
        for basis in [CubicBasis::Bezier, CubicBasis::BSpline, CubicBasis::CatmullRom] {
            let kept = evaluate(CurveType::Cubic(basis), Wrap::Nonperiodic, &points);
            assert_eq!(kept, points, "{basis:?}");
        }
    }
    let five = vec![DVec3::X; 5];
    let bezier = CurveType::Cubic(CubicBasis::Bezier);
    assert_eq!(evaluate(bezier, Wrap::Nonperiodic, &five).len(), 5, "no whole segments");
}

#[test]
fn counts_columns_and_knots_agree_for_every_kind() {
    let counts = vec![0, 1, 2, 3, 4, 5, 6, 7, 9, 7];
    for kind in ALL {
        for wrap in WRAPS {
            let curves = BasisCurves::new(kind, wrap, counts.clone());
            let points: usize = curves.strand_counts().sum();
            let ids: Vec<i64> = (0..).take(curves.control_points()).collect();
            let picked = curves.at_control_points(Column::Int(ids));
            assert_eq!(picked.rows(), points, "{kind:?} {wrap:?}");
            let knots = vec![2.5; 2 * curves.knots()];
            let wide = curves.at_knots(Column::Float { components: 2, values: knots });
            let expected = Column::Float { components: 2, values: vec![2.5; 2 * points] };
            assert_eq!(wide, expected, "{kind:?} {wrap:?}");
        }
    }
}

#[test]
fn varying_values_are_linear_between_knots() {
    // Seven points make four segments with five knots.
    let curves =
        BasisCurves::new(CurveType::Cubic(CubicBasis::BSpline), Wrap::Nonperiodic, vec![7]);
    assert_eq!(curves.knots(), 5);
    let Column::Float { values, .. } =
        curves.at_knots(Column::scalar(vec![0.0, 1.0, 2.0, 3.0, 4.0]))
    else {
        panic!("floats stay floats")
    };
    let quarters: Vec<f64> = (0..=16).map(|i| f64::from(i) / 4.0).collect();
    assert_eq!(values, quarters);
    let labels = curves.at_knots(Column::Int(vec![0, 1, 2, 3, 4]));
    let Column::Int(labels) = labels else { panic!("whole numbers stay whole") };
    assert_eq!(labels[..5], [0, 0, 1, 1, 1]);
}

#[test]
fn infinity_stays_in_its_own_segments() {
    let mut points = vec![DVec3::ONE; 8];
    points[0].x = f64::INFINITY;
    let curve = evaluate(CurveType::Cubic(CubicBasis::BSpline), Wrap::Nonperiodic, &points);
    let finite = curve.iter().position(|point| point.is_finite());
    assert_eq!(finite, Some(SAMPLES_PER_CONTROL_POINT));
}

/// The promise of the module's head: a coil of 5 control points a turn, evaluated, and made smooth
/// again by a Catmull-Rom curve, is within 0.07 % of its radius of the B-spline itself.
#[test]
fn coils_survive_their_evaluation() {
    let coil: Vec<DVec3> = (0..40)
        .map(|i| TAU * f64::from(i) / 5.0)
        .map(|angle| DVec3::new(angle.cos(), angle.sin(), 0.05 * angle))
        .collect();
    let samples = evaluate(CurveType::Cubic(CubicBasis::BSpline), Wrap::Nonperiodic, &coil);
    let radius = samples[40].truncate().length();
    let worst = (4..samples.len() - 5)
        .flat_map(|i| [0.25, 0.5, 0.75].map(|t| (i, t)))
        .map(|(i, t)| {
            let (a, b) = (samples[i], samples[i + 1]);
            let (da, db) = (
                catmull_rom_derivative(&samples, i, 0.0),
                catmull_rom_derivative(&samples, i + 1, 0.0),
            );
            let smooth = a * (2.0 * t * t * t - 3.0 * t * t + 1.0)
                + da * (t * t * t - 2.0 * t * t + t)
                + b * (3.0 * t * t - 2.0 * t * t * t)
                + db * (t * t * t - t * t);
            let u = 3.0 + (i as f64 + t) / SAMPLES_PER_CONTROL_POINT as f64;
            smooth.distance(de_boor(&coil, u))
        })
        .fold(0.0, f64::max);
    assert!(worst < 7e-4 * radius, "{}", worst / radius);
}

fn part(strands: &[usize], point: Option<(&str, Column)>, strand: Option<(&str, Column)>) -> Groom {
    let points = vec![DVec3::ZERO; strands.iter().sum()];
    let counts = strands.iter().copied();
    let mut groom = Groom::new(Strands::from_counts(counts, points).expect("the counts' sum"));
    if let Some((name, column)) = point {
        groom.insert_point_attribute(name, column).expect("a row a point");
    }
    if let Some((name, column)) = strand {
        groom.insert_strand_attribute(name, column).expect("a row a strand");
    }
    groom
}

#[test]
fn parts_join_in_order_and_say_which_is_which() {
    let width = |values: &[f64]| Some(("width", Column::scalar(values.to_vec())));
    let id = |values: &[i64]| Some(("id", Column::Int(values.to_vec())));
    let parts = vec![
        part(&[1, 2], width(&[1.0, 2.0, 3.0]), id(&[7, 8])),
        part(&[], None, None),
        part(&[2], None, Some(("width", Column::scalar(vec![4.0])))),
    ];
    let joined = join(parts).expect("few points");
    assert_eq!(joined.strands().offsets(), [0, 1, 3, 5]);
    let widths = Column::scalar(vec![1.0, 2.0, 3.0, 4.0, 4.0]);
    assert_eq!(joined.point_attributes().get("width"), Some(&widths));
    assert_eq!(joined.strand_attributes().get("id"), None, "only one part has it");
    assert_eq!(joined.strand_attributes().get("group"), Some(&Column::Int(vec![0, 0, 1])));
}

#[test]
fn a_group_of_the_file_is_not_overwritten() {
    let group = |value: i64| Some(("group", Column::Int(vec![value])));
    let joined = join(vec![part(&[1], None, group(5)), part(&[1], None, group(6))]).expect("two");
    assert_eq!(joined.strand_attributes().get("group"), Some(&Column::Int(vec![5, 6])));
    assert_eq!(joined.strand_attributes().get("prim"), Some(&Column::Int(vec![0, 1])));
    let single = join(vec![part(&[1], None, None)]).expect("one");
    assert!(single.strand_attributes().is_empty());
}

#[test]
fn rows_that_fit_nothing_are_refused() {
    let curves = BasisCurves::new(CurveType::Linear, Wrap::Nonperiodic, vec![2, 3]);
    for (rows, declared, points, strands) in [
        (1, Rows::Constant, false, true),
        (1, Rows::Vertex, false, true),
        (2, Rows::Uniform, false, true),
        (5, Rows::Vertex, true, false),
        (5, Rows::Varying, true, false),
        (5, Rows::Uniform, false, false),
        (2, Rows::Vertex, false, false),
        (0, Rows::Vertex, false, false),
    ] {
        let mut groom = part(&[2, 3], None, None);
        let attached = attach(&mut groom, &curves, "x", Column::scalar(vec![1.0; rows]), declared);
        assert_eq!(attached.is_ok(), points || strands, "{rows} {declared:?}");
        assert_eq!(groom.point_attributes().get("x").is_some(), points);
        assert_eq!(groom.strand_attributes().get("x").is_some(), strands);
    }
}
