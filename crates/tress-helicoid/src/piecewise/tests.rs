use proptest::prelude::*;

use super::*;

/// Clear of singular lines over their whole length.
fn piece() -> impl Strategy<Value = Piece> {
    (-2.0..2.0_f64, -0.3..1.0_f64, -1.0..1.0_f64, -2.0..2.0_f64, 0.1..1.0_f64).prop_map(
        |(kt, kn, kb, alpha, length)| Piece { k: Helicoid::new(kt, kn, kb, alpha), length },
    )
}

fn root() -> Frame {
    Frame::along(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.3, -1.0, 0.5)).expect("a direction")
}

const FINE: Tracing = Tracing::Controlled(1e-10);

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn pieces_meet_with_one_frame(pieces in prop::collection::vec(piece(), 2..5)) {
        let hair = PHelicoid { root: root(), pieces: &pieces };
        let joints = hair.joints(FINE).expect("clear");
        let mut s = 0.0;
        for (piece, joint) in pieces.iter().zip(&joints[1..]).take(pieces.len() - 1) {
            s += piece.length;
            let e = 1e-7;
            let around = hair.frames_at(&[s - e, s, s + e], FINE).expect("clear");
            let before = around[1].position - around[0].position;
            let after = around[2].position - around[1].position;
            prop_assert!(before.normalize().distance(after.normalize()) < 1e-5, "a corner");
            prop_assert!(joint.position.distance(around[1].position) < 1e-8);
            prop_assert!(joint.tangent().distance(before.normalize()) < 1e-5);
            for (a, b) in [(0, 1), (1, 2)] {
                let turned = around[a].axes.transpose() * around[b].axes - DMat3::IDENTITY;
                prop_assert!(turned.to_cols_array().iter().all(|entry| entry.abs() < 1e-5));
            }
        }
    }

    #[test]
    fn a_moved_root_moves_the_hair(pieces in prop::collection::vec(piece(), 1..4)) {
        let at_home = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
        let moved = PHelicoid { root: root(), pieces: &pieces };
        let (a, b) = (at_home.tip(FINE).expect("clear"), moved.tip(FINE).expect("clear"));
        prop_assert!((root().position + root().axes * a.position).distance(b.position) < 1e-9);
    }

    #[test]
    fn scaled_parameters_make_a_scaled_hair(pieces in prop::collection::vec(piece(), 1..4)) {
        let c = 3.0;
        let scaled: Vec<Piece> = pieces.iter().map(|p| Piece {
            k: Helicoid::new(p.k.kt / c, p.k.kn / c, p.k.kb / c, p.k.alpha),
            length: p.length * c,
        }).collect();
        let tip = |pieces: &[Piece]| {
            PHelicoid { root: Frame::IDENTITY, pieces }.tip(FINE).expect("clear").position
        };
        prop_assert!((c * tip(&pieces)).distance(tip(&scaled)) < 1e-8);
    }

    #[test]
    fn mirroring_all_pieces_changes_nothing(pieces in prop::collection::vec(piece(), 1..4)) {
        let mut turned = pieces.clone();
        let mut frame = root();
        let was_negative = positive_tangential(&mut frame, &mut turned);
        prop_assert_eq!(was_negative, pieces[0].k.kt < 0.0);
        prop_assert!(0.0 <= turned[0].k.kt);
        let tip = PHelicoid { root: root(), pieces: &pieces }.tip(FINE).expect("clear");
        let same = PHelicoid { root: frame, pieces: &turned }.tip(FINE).expect("clear");
        prop_assert!(tip.position.distance(same.position) < 1e-9);
        prop_assert!(tip.tangent().distance(same.tangent()) < 1e-9);
    }
}

#[test]
fn a_half_turn_about_the_normal_as_printed_is_another_hair() {
    let pieces = [Piece { k: Helicoid::new(1.0, 0.2, 0.5, 0.7), length: 1.5 }];
    let tip = PHelicoid { root: Frame::IDENTITY, pieces: &pieces }.tip(FINE).expect("clear");
    let mirrored = [Piece { k: pieces[0].k.mirrored(), ..pieces[0] }];
    let axes = DMat3::from_axis_angle(DVec3::Y, std::f64::consts::PI);
    let printed = PHelicoid { root: Frame { axes, ..Frame::IDENTITY }, pieces: &mirrored };
    assert!(1.0 < printed.tip(FINE).expect("clear").position.distance(tip.position));
}

#[test]
fn streamline_from_the_root_is_the_hair_and_others_pass_beside_it() {
    let pieces = [
        Piece { k: Helicoid::new(0.5, -0.1, 0.0, 0.3), length: 1.0 },
        Piece { k: Helicoid::new(-0.7, 0.1, 0.2, 0.0), length: 1.0 },
    ];
    let hair = PHelicoid { root: root(), pieces: &pieces };
    let stops = [0.0, 0.4, 0.8, 1.2, 1.6, 2.0];
    let line = |offset| {
        let mut positions = [DVec3::NAN; 6];
        hair.streamline(offset, &stops, FINE, &mut positions).expect("clear");
        positions
    };
    let guide = line(DVec3::ZERO);
    let beside = line(DVec3::new(0.0, 0.05, 0.02));
    assert!((guide[0].distance(beside[0]) - 0.05_f64.hypot(0.02)).abs() < 1e-12);
    assert!(guide.iter().zip(&beside).all(|(a, b)| (0.01..0.2).contains(&a.distance(*b))));
    assert!(hair.tip(FINE).expect("clear").position.distance(guide[5]) < 1e-9);
}

#[test]
fn hairs_without_pieces_or_length_are_their_root() {
    let none = PHelicoid { root: root(), pieces: &[] };
    assert_eq!(none.tip(FINE), Ok(root()));
    assert_eq!(none.frames_at(&[0.0, 1.0], FINE), Ok(vec![root(); 2]));
    let short = [Piece { k: Helicoid::new(9.0, 9.0, 9.0, 9.0), length: 0.0 }];
    let tip = PHelicoid { root: root(), pieces: &short }.tip(FINE).expect("nothing to walk");
    assert_eq!(tip.position, root().position);
    let mut positions = [DVec3::NAN; 3];
    none.sample_evenly(FINE, &mut positions).expect("nothing to walk");
    assert_eq!(positions, [root().position; 3]);
}

#[test]
fn broken_pieces_are_named() {
    let good = Piece { k: Helicoid::default(), length: 1.0 };
    for bad in [
        Piece { length: -1.0, ..good },
        Piece { length: f64::INFINITY, ..good },
        Piece { k: Helicoid::new(0.0, 0.0, f64::NAN, 0.0), ..good },
    ] {
        let pieces = [good, bad];
        let hair = PHelicoid { root: root(), pieces: &pieces };
        assert_eq!(hair.tip(FINE), Err(TraceError::NotFinite { piece: 1 }));
        assert_eq!(hair.joints(FINE), Err(TraceError::NotFinite { piece: 1 }));
    }
    for tracing in [Tracing::Euler(0), Tracing::Controlled(f64::NAN)] {
        let hair = PHelicoid { root: root(), pieces: &[good] };
        assert_eq!(hair.tip(tracing), Err(TraceError::Tracing));
    }
}
