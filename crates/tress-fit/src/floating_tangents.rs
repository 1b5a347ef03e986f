//! Floating tangents: turns the next tangent as little as possible until neighbours are
//! co-helical, while the points stay.
//!
//! `(t1 - t0) . D = 0` says that both tangents make the same angle with the chord `D`, so `t1` has
//! to lie on the cone about `D` that `t0` lies on. The point of the cone nearest to the tangent
//! wanted has the wanted tangent's direction about `D`.

use glam::DVec3;

/// The tangent at the far end of `chord`, nearest to `wanted`, that is co-helical with `t0`.
///
/// `t0` and `wanted` are unit vectors. A chord of no length asks for nothing; a `wanted` tangent
/// along the chord, to which all of the cone is equally near, gives `t0` turned half about it.
///
/// ```
/// use glam::DVec3;
/// use tress_fit::float_tangent;
///
/// let (t0, chord) = (DVec3::new(0.6, 0.8, 0.0), DVec3::X);
/// let t1 = float_tangent(t0, chord, DVec3::Z);
/// assert!(t1.distance(DVec3::new(0.6, 0.0, 0.8)) < 1e-15);
/// ```
#[must_use]
pub fn float_tangent(t0: DVec3, chord: DVec3, wanted: DVec3) -> DVec3 {
    let Some(axis) = chord.try_normalize() else { return wanted };
    let along = t0.dot(axis);
    let start = t0 - along * axis;
    let radius = start.length();
    let across = wanted - wanted.dot(axis) * axis;
    let direction = if across.length_squared() < 1e-24 { -start } else { across };
    let t1 = along * axis + radius * direction.normalize_or_zero();
    t1.normalize_or(wanted)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn unit() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0_f64)
            .prop_map(DVec3::from)
            .prop_filter("a direction", |v| 0.1 < v.length())
            .prop_map(DVec3::normalize)
    }

    proptest! {
        #[test]
        fn the_result_is_on_the_cone_and_nearest(t0 in unit(), chord in unit(), wanted in unit()) {
            let t1 = float_tangent(t0, chord, wanted);
            prop_assert!((t1.length() - 1.0).abs() < 1e-14);
            prop_assert!((t1 - t0).dot(chord).abs() < 1e-14);
            for angle in [-1e-3, 1e-3] {
                let beside = glam::DQuat::from_axis_angle(chord, angle) * t1;
                prop_assert!(t1.distance(wanted) <= beside.distance(wanted) + 1e-14);
            }
        }
    }

    #[test]
    fn degenerate_chords_and_tangents_stay_finite() {
        assert_eq!(float_tangent(DVec3::X, DVec3::ZERO, DVec3::Y), DVec3::Y);
        assert_eq!(float_tangent(DVec3::X, DVec3::X, DVec3::X), DVec3::X);
        assert_eq!(float_tangent(DVec3::X, DVec3::X, DVec3::NEG_X), DVec3::X);
        assert_eq!(float_tangent(DVec3::Y, DVec3::X, DVec3::X), DVec3::NEG_Y);
    }
}
