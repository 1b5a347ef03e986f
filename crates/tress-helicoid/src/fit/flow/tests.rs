use super::*;

fn with(k: &Helicoid, j: usize, change: f64) -> Helicoid {
    let mut k = *k;
    *[&mut k.kt, &mut k.kn, &mut k.kb, &mut k.alpha][j] += change;
    k
}

/// What is at a stop in the middle of a step, and at the end.
fn along(k: &Helicoid, stop: f64, length: f64) -> (Along<4>, End<4>) {
    let mut seen = None;
    let end =
        walk::<4>(k, length, FINE, [stop].into_iter(), |along| seen = Some(along)).expect("clear");
    (seen.expect("the stop is on the way"), end)
}

const SPIRAL: Helicoid = Helicoid::new(2.0, -0.3, 0.8, 0.7);

#[test]
fn derivatives_are_those_of_the_line_and_its_frame() {
    let (stop, length) = (0.733, 1.4);
    let (middle, end) = along(&SPIRAL, stop, length);
    let turning = end.turning(&SPIRAL);
    let e = 1e-4;
    for (j, &turning) in turning.iter().enumerate() {
        let (up, down) = (with(&SPIRAL, j, e), with(&SPIRAL, j, -e));
        let ((a, a_end), (b, b_end)) = (along(&up, stop, length), along(&down, stop, length));
        for (up, down, known) in [
            (a.position, b.position, middle.by_k[j]),
            (a_end.position, b_end.position, end.by_k[j]),
        ] {
            let slope = (up - down) / (2.0 * e);
            assert!(slope.distance(known) < 2e-4, "parameter {j}: {slope} {known}");
        }
        let turned = (up.frame(a_end.theta) - down.frame(b_end.theta)) * (0.5 / e);
        let spin = turned * SPIRAL.frame(end.theta).transpose();
        let vector = DVec3::new(spin.y_axis.z, spin.z_axis.x, spin.x_axis.y);
        assert!(vector.distance(turning) < 2e-4, "parameter {j}: {vector} {turning}");
    }
}

#[test]
fn stops_agree_with_the_controlled_tracing() {
    use crate::{PHelicoid, Piece, Tracing};
    use tress_geometry::Frame;
    for k in [SPIRAL, Helicoid::new(3.0, 0.2, -0.5, 0.9), Helicoid::new(0.01, -0.4, 0.0, 0.0)] {
        let pieces = [Piece { k, length: 2.0 }];
        let hair = PHelicoid { root: Frame::IDENTITY, pieces: &pieces };
        let stops: Vec<f64> = (0..=23).map(|i| f64::from(i) * 2.0 / 23.0).collect();
        let frames = hair.frames_at(&stops, Tracing::Controlled(1e-11)).expect("clear");
        let mut seen = Vec::new();
        let end = walk::<0>(&k, 2.0, FINE, stops.iter().copied(), |along| seen.push(along));
        for (along, frame) in seen.iter().zip(&frames) {
            assert!(along.position.distance(frame.position) < 1e-4, "{k:?}");
            assert!(along.direction.distance(frame.tangent()) < 1e-3, "{k:?}");
        }
        assert_eq!(seen.len(), stops.len());
        let end = k.frame(end.expect("clear").theta);
        assert!(end.x_axis.distance(frames[23].tangent()) < 1e-4);
    }
}

#[test]
fn a_singular_line_ends_it() {
    let nowhere = || std::iter::empty();
    let sink = Helicoid::new(0.0, -1.0, 0.0, 0.0);
    assert!(walk::<4>(&sink, 1.0, ROUGH, nowhere(), |_| ()).is_none());
    assert!(walk::<4>(&sink, 0.9, ROUGH, nowhere(), |_| ()).is_some());
    let wild = Helicoid::new(f64::INFINITY, 0.0, 0.0, 0.0);
    assert!(walk::<0>(&wild, 1.0, ROUGH, nowhere(), |_| ()).is_none());
}

#[test]
fn without_length_all_is_at_the_root() {
    let mut seen = 0;
    let end = walk::<4>(&SPIRAL, 0.0, ROUGH, [0.0, 0.0].into_iter(), |along| {
        assert_eq!((along.position, along.direction), (DVec3::ZERO, DVec3::X));
        seen += 1;
    });
    assert_eq!((end.map(|end| end.theta), seen), (Some(0.0), 2));
}
