use super::*;

/// Traced pieces in a root that is not the identity, so many points.
fn traced(pieces: &[Piece], n: usize) -> Vec<DVec3> {
    let root = Frame::along(DVec3::new(3.0, -2.0, 1.0), DVec3::new(1.0, 0.5, -0.2));
    let root = root.expect("a direction");
    let mut points = vec![DVec3::ZERO; n];
    let hair = PHelicoid { root, pieces };
    hair.sample_evenly(Tracing::Controlled(1e-10), &mut points).expect("clear");
    points
}

fn again(fit: &StrandFit, n: usize) -> Vec<DVec3> {
    let mut points = vec![DVec3::ZERO; n];
    let hair = PHelicoid { root: fit.root, pieces: &fit.pieces };
    hair.sample_evenly(Tracing::Controlled(1e-10), &mut points).expect("clear");
    points
}

fn greatest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// Known parameters on a grid: bends of up to two turns, both hands.
fn known() -> Vec<Piece> {
    let mut pieces = Vec::new();
    for kt in [-1.5, -0.4, 0.1, 0.7, 2.0] {
        for (kn, kb, alpha) in
            [(0.0, 0.0, 0.0), (0.2, 0.0, 0.3), (-0.1, 0.3, 0.5), (0.1, -0.2, -0.8), (0.0, 0.1, 1.5)]
        {
            pieces.push(Piece { k: Helicoid::new(kt, kn, kb, alpha), length: 4.0 });
        }
    }
    pieces
}

#[test]
fn traced_helicoids_are_recovered() {
    let one = FitOptions { pieces: Pieces::UpTo(1), ..FitOptions::default() };
    for piece in known() {
        let points = traced(&[piece], 60);
        let fit = fit_strand(&points, &one).expect("a strand");
        let apart = greatest(&points, &again(&fit, 60));
        assert!(apart < 1e-4 * 4.0, "{piece:?}: {apart}, as {:?}", fit.pieces);
    }
}

#[test]
fn chains_of_pieces_are_followed_within_the_tolerance() {
    let piece = |kt, kb, alpha| Piece { k: Helicoid::new(kt, 0.05, kb, alpha), length: 2.0 };
    let pieces = [piece(1.0, 0.2, 0.5), piece(-0.8, 0.0, 1.0), piece(1.4, 0.1, -0.3)];
    let points = traced(&pieces, 61);
    for method in [Method::Newton, Method::Simplex] {
        let options = FitOptions { method, ..FitOptions::default() };
        let fit = fit_strand(&points, &options).expect("a strand");
        let bound = if method == Method::Newton { 0.01 } else { 0.03 };
        assert!(fit.frechet <= bound * 6.0, "{method:?}: {}", fit.frechet);
        assert!(1 < fit.pieces.len(), "{method:?}: {} pieces", fit.pieces.len());
        assert!(fit.rms <= fit.frechet);
    }
}

#[test]
fn pieces_of_a_fit_meet_with_one_tangent() {
    let wave: Vec<DVec3> = (0..40)
        .map(f64::from)
        .map(|i| DVec3::new(0.1 * i, (0.3 * i).sin(), 0.5 * (0.2 * i).cos()))
        .collect();
    for method in [Method::Newton, Method::Simplex] {
        let options = FitOptions { method, ..FitOptions::default() };
        let fit = fit_strand(&wave, &options).expect("a strand");
        let hair = PHelicoid { root: fit.root, pieces: &fit.pieces };
        let mut s = 0.0;
        for piece in &fit.pieces[..fit.pieces.len() - 1] {
            s += piece.length;
            let around = hair.frames_at(&[s - 1e-7, s + 1e-7], Tracing::Controlled(1e-10));
            let around = around.expect("clear");
            let corner = around[0].tangent().angle_between(around[1].tangent());
            assert!(corner < 1e-4, "{method:?} turns by {corner} at {s}");
        }
    }
}

#[test]
fn equal_pieces_are_equal_and_as_many() {
    let points = traced(&[Piece { k: Helicoid::new(1.0, 0.1, 0.2, 0.6), length: 6.0 }], 40);
    for n in [1, 3, 4, 60] {
        let options = FitOptions { pieces: Pieces::Equal(n), ..FitOptions::default() };
        let fit = fit_strand(&points, &options).expect("a strand");
        assert_eq!(fit.pieces.len(), n);
        for piece in &fit.pieces {
            assert!((piece.length * n as f64 / 6.0 - 1.0).abs() < 0.1, "{}", piece.length);
        }
        assert!(fit.frechet < 0.02 * 6.0, "{n}: {}", fit.frechet);
    }
}

#[test]
fn a_moved_turned_and_scaled_strand_has_a_moved_turned_and_scaled_fit() {
    let points = traced(&known()[11..12], 30);
    let turn = glam::DQuat::from_scaled_axis(DVec3::new(0.4, -1.0, 2.0));
    let moved: Vec<DVec3> = points.iter().map(|&p| 7.0 * (turn * p) + DVec3::ONE).collect();
    let a = fit_strand(&points, &FitOptions::default()).expect("a strand");
    let b = fit_strand(&moved, &FitOptions::default()).expect("a strand");
    assert_eq!(a.pieces.len(), b.pieces.len());
    for (p, q) in a.pieces.iter().zip(&b.pieces) {
        assert!((p.k.kt - 7.0 * q.k.kt).abs() < 1e-5 && (p.k.alpha - q.k.alpha).abs() < 1e-4);
        assert!((7.0 * p.length - q.length).abs() < 1e-5);
    }
}

#[test]
fn strands_of_few_points_are_fitted_with_what_they_tell() {
    for method in [Method::Newton, Method::Simplex] {
        let options = FitOptions { method, ..FitOptions::default() };
        let two = [DVec3::ZERO, DVec3::new(2.0, 1.0, 0.0)];
        let fit = fit_strand(&two, &options).expect("a direction");
        assert!(fit.frechet < 1e-3, "{method:?}: {}", fit.frechet);
        let three = [DVec3::ZERO, DVec3::X, DVec3::new(2.0, 0.5, 0.1)];
        let fit = fit_strand(&three, &options).expect("a bend");
        assert!(fit.frechet < 0.03, "{method:?}: {}", fit.frechet);
        assert!(fit.pieces.iter().all(|piece| piece.k.is_finite()));
    }
}

#[test]
fn what_is_no_strand_is_kept_and_counted() {
    let mut strands = Strands::default();
    let arc = traced(&known()[3..4], 12);
    strands.push(arc.iter().copied()).expect("few points");
    strands.push([]).expect("few points");
    strands.push([DVec3::ONE]).expect("few points");
    strands.push([DVec3::ONE; 5]).expect("few points");
    strands.push([DVec3::ONE, DVec3::NAN]).expect("few points");
    let doubled: Vec<DVec3> = arc.iter().flat_map(|&p| [p, p]).collect();
    strands.push(doubled).expect("few points");
    let groom = Groom::new(strands);
    let fitted = fit(&groom, &FitOptions::default()).expect("good options");
    let kept: Vec<_> = fitted.report.kept.iter().map(|&(i, defect)| (i, defect)).collect();
    let why = [Defect::Empty, Defect::SinglePoint, Defect::ZeroLength, Defect::NotFinite];
    assert_eq!(kept, (1..5).zip(why).collect::<Vec<_>>());
    assert_eq!(fitted.hairs.len(), 6);
    assert_eq!(fitted.hairs.hair(0).pieces, fitted.hairs.hair(5).pieces);
    let back = crate::sample(&fitted.hairs, 12, Tracing::default()).expect("clear");
    assert_eq!(back.strands().strand(3), [DVec3::ONE; 5]);
}

#[test]
fn wild_strands_come_out_finite() {
    let zigzag: Vec<DVec3> =
        (0..20).map(|i| DVec3::new(0.0, f64::from(i % 2), 1e-3 * f64::from(i))).collect();
    let back = [DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::X, DVec3::ZERO];
    let spike = [DVec3::ZERO, DVec3::X, 1e6 * DVec3::Y, 1e-9 * DVec3::Z, DVec3::ONE];
    for strand in [&zigzag[..], &back, &spike] {
        for method in [Method::Newton, Method::Simplex] {
            let options = FitOptions { method, ..FitOptions::default() };
            let fit = fit_strand(strand, &options).expect("points in different places");
            assert!(fit.frechet.is_finite() && fit.rms.is_finite());
            assert!(fit.pieces.iter().all(|p| p.k.is_finite() && p.length.is_finite()));
        }
    }
}

#[test]
fn threads_do_not_change_the_result() {
    let mut strands = Strands::default();
    for piece in known() {
        strands.push(traced(&[piece], 20)).expect("few points");
    }
    let groom = Groom::new(strands);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| fit(&groom, &FitOptions::default()).expect("good options"))
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn options_out_of_range_are_refused() {
    let good = FitOptions::default();
    for options in [
        FitOptions { tolerance: 0.0, ..good },
        FitOptions { tolerance: f64::NAN, ..good },
        FitOptions { threshold: 0.0, ..good },
        FitOptions { shortest: 2.0, ..good },
        FitOptions { regularization: -1.0, ..good },
        FitOptions { pieces: Pieces::UpTo(0), ..good },
    ] {
        assert!(fit(&Groom::new(Strands::default()), &options).is_err(), "{options:?}");
    }
}
