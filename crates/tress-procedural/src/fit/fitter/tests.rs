//! A fit of a small groom: stopping changes nothing, and wrong input is refused.

use glam::DVec3;
use tress_geometry::Strands;

use super::*;
use crate::fit::{GuideOptions, NumberOptions, ParameterOptions};
use crate::{Curl, Frizz, Operator};

/// Curls from three guides.
fn target() -> Groom {
    let point = |i: u32, j: u32| {
        let s = 0.1 * f64::from(j);
        DVec3::new(f64::from(i), 0.02 * s * s, 0.0) + DVec3::NEG_Z * s
    };
    let guides = (0..3).flat_map(|i| (0..40).map(move |j| point(i, j))).collect();
    let guides = EvenStrands::new(40, guides).expect("whole strands");
    let positions =
        (0..120).map(|i| DVec3::new(0.025 * f64::from(i) - 0.5, 0.0, 0.01 * f64::from(i % 7)));
    let roots = Roots { positions: positions.collect(), uv: None };
    let mut groom = ProceduralGroom::new(guides, roots).expect("sound guides");
    groom.chain = chain(0.2, 0.5);
    groom.draw_missing();
    groom.widths = vec![0.03, 0.01];
    groom.build_groom().expect("a sound groom")
}

fn chain(radius: f64, frequency: f64) -> Chain {
    let operators = vec![
        Operator::Curl(Curl { radius, frequency, ..Curl::default() }),
        Operator::Frizz(Frizz { frequency: 1.0, amplitude: 0.02 }),
    ];
    Chain { operators, ..Chain::default() }
}

fn options() -> StageOptions {
    StageOptions {
        guides: 6,
        guide: GuideOptions { steps: 5, ..GuideOptions::default() },
        parameters: ParameterOptions { rounds: 1, searches: 4, steps: 2, ..Default::default() },
        numbers: NumberOptions { steps: 3, ..NumberOptions::default() },
        ..StageOptions::default()
    }
}

#[test]
fn a_fit_that_was_stopped_ends_where_one_that_was_not_does() {
    let begun = || Fitter::new(&target(), chain(0.4, 0.2), options()).expect("a sound target");
    let mut whole = begun();
    while whole.advance(&mut |_| {}).expect("finite losses") != Stage::Done {}
    let folder = tempfile::tempdir().expect("a folder");
    let mut part = begun();
    while part.stage() != Stage::Done {
        part.advance(&mut |progress| assert!(progress.done <= 1.0)).expect("finite losses");
        part.save(folder.path()).expect("a writable folder");
        part = Fitter::resume(folder.path(), &target(), chain(0.4, 0.2), options())
            .expect("what was saved");
    }
    assert_eq!(part.groom(), whole.groom());
    let widths = &whole.groom().expect("a groom").widths;
    for (width, expected) in widths.iter().zip([0.03, 0.025, 0.02, 0.015, 0.01]) {
        assert!((width - expected).abs() < 1e-9, "{widths:?}");
    }
    assert_eq!(widths.len(), 5);
    assert_eq!(part.history(), whole.history());
}

#[test]
fn a_checkpoint_of_another_target_or_of_other_options_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut fitter = Fitter::new(&target(), chain(0.4, 0.2), options()).expect("a sound target");
    fitter.advance(&mut |_| {}).expect("guides");
    fitter.save(folder.path()).expect("a writable folder");
    let mut moved = target();
    moved.positions_mut()[7].x += 1e-9;
    let error = Fitter::resume(folder.path(), &moved, chain(0.4, 0.2), options()).unwrap_err();
    assert_eq!(error.to_string(), "the checkpoint is of another target");
    let error = Fitter::resume(folder.path(), &target(), chain(0.4, 0.3), options()).unwrap_err();
    assert!(matches!(error, FitterError::Other(_)));
    let nowhere = folder.path().join("nowhere");
    let error = Fitter::resume(&nowhere, &target(), chain(0.4, 0.2), options()).unwrap_err();
    assert!(matches!(error, FitterError::Checkpoint { .. }));
}

#[test]
fn a_head_that_comes_after_guides_were_found_is_refused() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let head = |size: f64| {
        let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        Mesh::new(corners.map(|x| x * size - 9.0).to_vec(), triangles).expect("corners")
    };
    let folder = tempfile::tempdir().expect("a folder");
    let mut fitter = Fitter::new(&target(), chain(0.4, 0.2), options()).expect("a sound target");
    fitter.set_head(head(1.0)).expect("no guides yet");
    fitter.advance(&mut |_| {}).expect("guides");
    fitter.save(folder.path()).expect("a writable folder");
    let resumed = || Fitter::resume(folder.path(), &target(), chain(0.4, 0.2), options());
    resumed().expect("a checkpoint").set_head(head(1.0)).expect("the same head");
    let error = resumed().expect("a checkpoint").set_head(head(1.1)).unwrap_err();
    assert_eq!(error.to_string(), "the checkpoint is of another head");
}

#[test]
fn operators_that_cannot_be_fitted_are_refused_at_once() {
    let mut chain = chain(0.4, 0.2);
    chain.operators.push(Operator::Skip(crate::Skip::default()));
    let error = Fitter::new(&target(), chain, options()).unwrap_err();
    assert!(matches!(error, FitterError::Operator { operator: "skip", index: 2 }), "{error}");
}

#[test]
fn fewer_strands_than_guides_are_refused() {
    let many = StageOptions { guides: 500, ..options() };
    let error = Fitter::new(&target(), chain(0.4, 0.2), many).unwrap_err();
    let expected = "500 guides cannot be found for 120 strands: at least 1, at most one each";
    assert_eq!(error.to_string(), expected);
    let none = Groom::new(Strands::default());
    assert!(matches!(Fitter::new(&none, chain(0.4, 0.2), options()), Err(FitterError::Initial(_))));
}

#[test]
fn parameters_to_begin_with_are_checked() {
    let error = Fitter::new(&target(), chain(-1.0, 0.2), options()).unwrap_err();
    assert_eq!(error.to_string(), "curl 0: radius is -1, expected 0 to inf");
}

#[test]
fn strands_with_defects_are_left_out() {
    let mut groom = target();
    groom.positions_mut()[85].y = f64::NAN;
    let fitter = Fitter::new(&groom, chain(0.4, 0.2), options()).expect("119 sound strands");
    assert_eq!((fitter.kept().len(), fitter.kept()[2]), (119, 3));
}
