use tress_geometry::Frame;

use super::*;
use crate::{Helicoid, Piece};

fn guide(kt: f64, kn: f64) -> [Piece; 2] {
    [Piece { k: Helicoid::new(kt, kn, 0.2, 0.3), length: 1.0 }; 2]
}

fn options() -> WispOptions {
    WispOptions { hairs: 40, radius: 0.1, points: 12, ..WispOptions::default() }
}

fn spread(strands: &Strands<DVec3>, i: usize) -> f64 {
    let guide = strands.strand(0)[i];
    strands.iter().map(|hair| hair[i].distance(guide)).fold(0.0, f64::max)
}

fn made(pieces: &[Piece], options: &WispOptions) -> Strands<DVec3> {
    let hair = PHelicoid { root: Frame::IDENTITY, pieces };
    wisp(&hair, options, Tracing::default(), &mut hair_rng(5, 0)).expect("clear")
}

#[test]
fn roots_fill_a_disc_across_the_tangent() {
    let strands = made(&guide(1.0, 0.0), &WispOptions { hairs: 400, ..options() });
    let roots: Vec<DVec3> = strands.iter().map(|hair| hair[0]).collect();
    assert!(roots.iter().all(|root| root.x == 0.0 && root.length() <= 0.1));
    // Half of a disc's area lies within 0.707 of its radius.
    let inner = roots.iter().filter(|root| root.length() < 0.0707).count();
    assert!((170..230).contains(&inner), "{inner} of 400 are in the inner half");
}

#[test]
fn kn_fans_out_and_draws_together() {
    let straight = |kn| [Piece { k: Helicoid::new(0.0, kn, 0.0, 0.0), length: 1.5 }];
    let (wide, narrow) = (made(&straight(0.6), &options()), made(&straight(-0.3), &options()));
    assert!(1.3 * spread(&wide, 0) < spread(&wide, 11));
    // It draws together in the plane of E_T and E_N; across it nothing changes without kB.
    let wide_in_plane = |i: usize| narrow.iter().map(|hair| hair[i].y.abs()).fold(0.0, f64::max);
    assert!((wide_in_plane(11) / wide_in_plane(0) - 0.55).abs() < 0.02);
}

#[test]
fn a_profile_scales_the_distance_and_ends_in_a_point() {
    let pointed = WispOptions { profile: vec![1.0, 2.0, 0.0], ..options() };
    let (free, held) = (made(&guide(1.0, 0.0), &options()), made(&guide(1.0, 0.0), &pointed));
    assert!((spread(&held, 0) - spread(&free, 0)).abs() < 1e-12);
    assert!(spread(&held, 11) < 1e-12);
    assert!((1.8..2.0).contains(&(spread(&held, 5) / spread(&free, 5))));
}

#[test]
fn disorder_turns_hairs_and_leaves_the_guide() {
    let wild = WispOptions { fanning: 0.3, frizz: 0.05, ..options() };
    let (calm, wild) = (made(&guide(1.0, 0.0), &options()), made(&guide(1.0, 0.0), &wild));
    assert_eq!(calm.strand(0), wild.strand(0));
    assert!(2.0 * spread(&calm, 11) < spread(&wild, 11));
}

#[test]
fn waves_reach_their_amplitude() {
    let waviness = Waviness { amplitude: 0.2, frequency: 9.0, fade_in: 0.0 };
    let (plain, wavy) = (
        made(&guide(1.0, 0.0), &options()),
        made(&guide(1.0, 0.0), &WispOptions { waviness, ..options() }),
    );
    for (p, q) in plain.strand(0).iter().zip(wavy.strand(0)) {
        assert!((p.distance(*q) - 0.2).abs() < 1e-12);
    }
}

#[test]
fn singular_neighbours_move_to_the_guide() {
    // The guide turns clear of a singular line on which some neighbours begin.
    let pieces = [Piece { k: Helicoid::new(10.0, 0.0, 0.0, 0.0), length: 1.0 }];
    let strands = made(&pieces, &WispOptions { radius: 0.2, hairs: 200, ..options() });
    assert!(strands.points().iter().all(|point| point.is_finite()));
}

#[test]
fn wisps_of_a_groom_know_their_guide_and_depend_on_the_seed_alone() {
    let pieces = Strands::from_counts([2, 0, 2], [guide(1.0, 0.1), guide(0.5, 0.0)].concat());
    let hairs = HelicoidGroom::new(vec![Frame::IDENTITY; 3], pieces.expect("counts sum to 4"));
    let hairs = hairs.expect("parts match");
    let on = |threads, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| wisps(&hairs, &options(), Tracing::default(), seed).expect("clear"))
    };
    let groom = on(1, 7);
    assert_eq!(groom, on(4, 7));
    assert_ne!(groom, on(1, 8));
    assert_eq!(groom.strands().len(), 80);
    let groups = groom.strand_attributes().get(names::GROUP).expect("groups").first_components();
    assert_eq!(groups.filter(|group| (1.5..2.5).contains(group)).count(), 40);
}

#[test]
fn options_out_of_range_are_refused() {
    let good = options();
    for bad in [
        WispOptions { radius: f64::NAN, ..good.clone() },
        WispOptions { fanning: -0.1, ..good.clone() },
        WispOptions { profile: vec![1.0, f64::INFINITY], ..good.clone() },
        WispOptions { points: 1, ..good },
    ] {
        let hair = PHelicoid { root: Frame::IDENTITY, pieces: &guide(1.0, 0.0) };
        assert!(wisp(&hair, &bad, Tracing::default(), &mut hair_rng(0, 0)).is_err(), "{bad:?}");
    }
}
