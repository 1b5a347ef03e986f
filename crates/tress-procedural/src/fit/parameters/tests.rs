//! Parameters come back when guides are known, from starts that are far off.

use super::*;
use crate::synthetic::known;
use crate::{Curl, Frizz};

fn quick() -> ParameterOptions {
    ParameterOptions { strands: 600, slices: 24, ..ParameterOptions::default() }
}

/// The groom to be found: the known one's guides, other numbers, parameters far off.
fn begun(style: usize) -> (ProceduralGroom, EvenStrands, Vec<Operator>) {
    let known = known(style, 0.05).expect("a known groom");
    let targets = known.groom.build().expect("a sound groom");
    let mut groom = known.groom.clone();
    groom.chain = known.start;
    groom.seed = 77;
    groom.numbers.clear();
    groom.draw_missing();
    (groom, targets, known.groom.chain.operators)
}

#[test]
fn scale_clump_and_frizz_are_found() {
    let (mut groom, targets, truth) = begun(4);
    let sound: Vec<usize> = (0..targets.len()).collect();
    let mut losses = Vec::new();
    let mut watch = |loss, _: &[Operator]| losses.push(loss);
    let last =
        fit_parameters(&mut groom, &targets, &sound, &quick(), &mut watch).expect("finite losses");
    assert!(last < 0.05 * losses[0], "{last} from {}", losses[0]);
    for (found, truth) in groom.chain.operators.iter().zip(&truth) {
        for (found, truth) in found.values().into_iter().zip(truth.values()) {
            assert!((found / truth - 1.0).abs() < 0.15, "{found} against {truth}");
        }
    }
}

#[test]
fn a_curl_is_found_from_a_fifth_of_its_frequency() {
    let (mut groom, targets, truth) = begun(5);
    let sound: Vec<usize> = (0..targets.len()).collect();
    let options = ParameterOptions { strands: 400, rounds: 1, ..quick() };
    fit_parameters(&mut groom, &targets, &sound, &options, &mut |_, _| {}).expect("finite losses");
    let (found, truth) = (groom.chain.operators[2].values(), truth[2].values());
    assert!((found[0] / truth[0] - 1.0).abs() < 0.1, "radius {}", found[0]);
    assert!((found[1] / truth[1] - 1.0).abs() < 0.05, "frequency {}", found[1]);
    assert!((found[3] - truth[3]).abs() < 0.1, "start {}", found[3]);
}

/// The groom of waves is far from its valley where waves are as tight as its frizz and frizz as
/// wide as its waves: no look at one parameter or pair leaves that, only another start.
#[test]
fn waves_are_found_from_where_frizz_has_taken_their_place() {
    let (mut groom, targets, truth) = begun(0);
    let [_, _, Operator::Curl(curl), Operator::Frizz(frizz)] = &mut groom.chain.operators[..]
    else {
        panic!("scale, clump, curl, frizz");
    };
    *curl = Curl { radius: 0.113, frequency: 0.389, random_frequency: 0.01, start: 0.99 };
    *frizz = Frizz { frequency: 0.27, amplitude: 1.1 };
    let sound: Vec<usize> = (0..targets.len()).collect();
    let options = ParameterOptions { strands: 400, rounds: 1, ..quick() };
    fit_parameters(&mut groom, &targets, &sound, &options, &mut |_, _| {}).expect("finite losses");
    let (found, truth) = (groom.chain.operators[2].values(), truth[2].values());
    assert!((found[0] / truth[0] - 1.0).abs() < 0.1, "radius {}", found[0]);
    assert!((found[1] / truth[1] - 1.0).abs() < 0.05, "frequency {}", found[1]);
}

#[test]
fn a_loss_that_is_not_a_number_leaves_the_last_good_parameters() {
    let (mut groom, mut targets, _) = begun(4);
    targets.strand_mut(0)[50].x = f64::NAN;
    let before = groom.chain.clone();
    let sound: Vec<usize> = (0..targets.len()).collect();
    let error = fit_parameters(&mut groom, &targets, &sound, &quick(), &mut |_, _| {});
    assert!(matches!(error, Err(StageError::Loss(_))), "{error:?}");
    assert_eq!(groom.chain, before);
}

#[test]
fn targets_of_another_groom_are_refused() {
    let (mut groom, targets, _) = begun(4);
    let fewer = targets.select(&[0, 1]);
    let error = fit_parameters(&mut groom, &fewer, &[0], &quick(), &mut |_, _| {});
    assert!(matches!(error, Err(StageError::Targets { given: 2, .. })));
}
