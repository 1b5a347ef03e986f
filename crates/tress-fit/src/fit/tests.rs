use glam::DVec3;
use tress_geometry::polyline::Defect;
use tress_geometry::{Column, Strands, UpAxis};

use super::*;
use crate::Elements;

fn coil(n: usize, offset: DVec3) -> Vec<DVec3> {
    let angles = (0..n).map(|i| 1.1 * i as f64);
    angles.map(|a| offset + DVec3::new(a.cos(), a.sin(), 0.2 * a)).collect()
}

fn mixed() -> Groom {
    let mut strands = Strands::default();
    strands.push(coil(30, DVec3::ZERO)).unwrap();
    strands.push([]).unwrap();
    strands.push([DVec3::ONE]).unwrap();
    strands.push(coil(12, DVec3::X)).unwrap();
    strands.push([DVec3::NAN, DVec3::ONE]).unwrap();
    let n = strands.points().len();
    let mut groom = Groom::new(strands).in_space(Some(0.01), Some(UpAxis::Z));
    let ramp = (0..n).map(|i| i as f64).collect();
    groom.insert_point_attribute("ramp", Column::scalar(ramp)).unwrap();
    groom.insert_strand_attribute("id", Column::Int(vec![5, 6, 7, 8, 9])).unwrap();
    groom
}

#[test]
fn no_strand_is_lost_and_reasons_are_counted() {
    let fitted = fit(&mixed(), &FitOptions::default()).expect("valid options");
    assert_eq!((fitted.helices.len(), fitted.report.strands), (5, 5));
    assert_eq!(fitted.helices.kept().strands, [1, 2, 4]);
    let reasons = [Defect::Empty, Defect::SinglePoint, Defect::NotFinite];
    assert_eq!(fitted.report.kept, reasons.map(|defect| (KeptReason::Defect(defect), 1)));
    assert_eq!((fitted.helices.unit, fitted.helices.up), (Some(0.01), Some(UpAxis::Z)));
}

#[test]
fn attributes_go_along() {
    let fitted = fit(&mixed(), &FitOptions::default()).expect("valid options");
    let helices = &fitted.helices;
    assert_eq!(helices.strand_attributes().get("id"), mixed().strand_attributes().get("id"));
    let Some(Column::Float { values, .. }) = helices.joint_attributes().get("ramp") else {
        panic!("the ramp is gone");
    };
    // One element a segment: joints are points.
    let first = &values[helices.joint_range(0)];
    assert!(first.iter().enumerate().all(|(i, v)| (v - i as f64).abs() < 1e-9), "{first:?}");
    assert!((values[helices.joint_range(3)][0] - 31.0).abs() < 1e-9);
}

#[test]
fn threads_do_not_change_the_result() {
    let mut strands = Strands::default();
    for i in 0..200 {
        strands.push(coil(20 + i % 7, DVec3::X * i as f64)).unwrap();
    }
    let groom = Groom::new(strands);
    let options = FitOptions { elements: Elements::Count(12), ..FitOptions::default() };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| fit(&groom, &options)).expect("valid options")
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn nothing_is_fitted_to_nothing() {
    let fitted = fit(&Groom::new(Strands::default()), &FitOptions::default()).expect("valid");
    assert!(fitted.helices.is_empty());
    assert_eq!(fitted.report, FitReport::default());
}
