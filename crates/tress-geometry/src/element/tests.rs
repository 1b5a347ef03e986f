use proptest::prelude::*;

use super::*;

/// Curvatures of every size that hair has, and of sizes that only rounding has.
fn curvature() -> impl Strategy<Value = DVec3> {
    (prop::array::uniform3(-1.0..1.0_f64), -14.0..2.0_f64, any::<[bool; 3]>()).prop_map(
        |(direction, magnitude, zero)| {
            let q = DVec3::from_array(direction) * 10_f64.powf(magnitude);
            let keep = |zero: bool| f64::from(u8::from(!zero));
            q * DVec3::new(keep(zero[0]), keep(zero[1]), keep(zero[2]))
        },
    )
}

proptest! {
    #[test]
    fn walking_in_two_steps_is_walking_in_one(q in curvature(), a in 0.0..2.0, b in 0.0..2.0) {
        let element = Element { curvature: q, length: a + b };
        let half = element.frame_at(&Frame::IDENTITY, a);
        let rest = element.frame_at(&half, b);
        let whole = element.advance(&Frame::IDENTITY);
        let bound = 1e-14 * (1.0 + q.length() * (a + b)) * (1.0 + a + b);
        prop_assert!(whole.position.distance(rest.position) < bound);
        prop_assert!((whole.axes - rest.axes).to_cols_array().iter().all(|e| e.abs() < bound));
    }

    #[test]
    fn frames_stay_orthonormal(q in curvature(), s in 0.0..2.0) {
        let frame = Element { curvature: q, length: s }.advance(&Frame::IDENTITY);
        prop_assert!(frame.orthonormality_error() < 1e-14);
    }

    #[test]
    fn derivatives_agree_with_differences(q in curvature(), s in 0.01..2.0) {
        let (turning, moving) = Element { curvature: q, length: s }.derivatives(s);
        for j in 0..3 {
            // Rounding errs by 1e-16 |q| s / h, truncation by h^2 s^4 / 6.
            let h = 1e-5;
            let step = DVec3::AXES[j] * h;
            let at = |q| Element { curvature: q, length: s };
            let (up, down) = (at(q + step), at(q - step));
            let by = (up.displacement(s) - down.displacement(s)) / (2.0 * h);
            prop_assert!(by.distance(moving.col(j)) < 1e-7);
            // The world vector of dR R^T is the derivative of the rotation.
            let change = (up.rotation(s) - down.rotation(s)) * (0.5 / h)
                * at(q).rotation(s).transpose();
            let vector = DVec3::new(change.y_axis.z, change.z_axis.x, change.x_axis.y);
            prop_assert!(vector.distance(turning.col(j)) < 1e-7);
        }
    }
}

#[test]
fn many_turns_in_one_element_leave_the_frame_orthonormal() {
    // 25 turns, where the angle that is reduced has lost two digits.
    let q = DVec3::new(0.0, 0.0, -85.111_790_320_980_65);
    let element = Element { curvature: q, length: 1.870_639_991_443_196_1 };
    assert!(element.advance(&Frame::IDENTITY).orthonormality_error() < 1e-14);
}

#[test]
fn a_coil_has_the_radius_pitch_and_hand_it_was_made_with() {
    for (radius, pitch) in [(0.57, 0.3), (0.57, -0.3), (2.0, 0.0), (0.01, 5.0)] {
        let coil = Element { length: 1.0, ..Element::coil(radius, pitch) };
        assert!((coil.radius() - radius).abs() < 1e-14 * radius);
        assert!((coil.pitch() - pitch).abs() < 1e-14);
        assert!(pitch == 0.0 || coil.twist().signum() == pitch.signum());
    }
    let straight = Element::coil(0.0, 1.0);
    assert_eq!((straight.radius(), straight.pitch(), straight.turns()), (0.0, 0.0, 0.0));
}

#[test]
fn a_right_handed_coil_rises_along_its_axis_counter_clockwise() {
    let element = Element::coil(1.0, 2.0);
    let axis = element.curvature.normalize();
    // Seen against the axis, a point that moves counter-clockwise has (c x r') . axis > 0.
    let quarter = 0.25 * std::f64::consts::TAU / element.curvature.length();
    let center = DVec3::Y; // towards u lies the centre: k2 bends t towards u.
    let p = element.displacement(quarter);
    let t = element.rotation(quarter).x_axis;
    let arm = p - center;
    let arm = arm - axis * axis.dot(arm);
    assert!(0.0 < arm.cross(t).dot(axis) && 0.0 < t.dot(axis));
}
