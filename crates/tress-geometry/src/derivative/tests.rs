use proptest::prelude::*;

use super::*;
use crate::Element;

/// Chains with straight, twisted, tiny and tight elements, and points on them.
fn case() -> impl Strategy<Value = (Vec<Element>, Vec<f64>)> {
    let magnitude = prop_oneof![Just(0.0), Just(1e-9), Just(1.0), Just(20.0)];
    let element = (prop::array::uniform3(-1.0..1.0), magnitude, any::<bool>(), 0.01..0.5).prop_map(
        |(q, magnitude, twist_only, length)| {
            let q = DVec3::from_array(q) * magnitude;
            Element { curvature: if twist_only { q * DVec3::X } else { q }, length }
        },
    );
    (prop::collection::vec(element, 1..8), prop::collection::vec(0.0..1.0, 1..4)).prop_map(
        |(elements, mut at)| {
            let length: f64 = elements.iter().map(|e| e.length).sum();
            at.sort_by(f64::total_cmp);
            (elements, at.into_iter().map(|a| a * length).collect())
        },
    )
}

proptest! {
    #[test]
    fn jacobian_agrees_with_differences((elements, s) in case()) {
        let n = elements.len();
        let at = |elements: &[Element]| -> Vec<DVec3> {
            let strand = SuperHelix { root: Frame::IDENTITY, elements };
            strand.frames_at(s.iter().copied()).map(|frame| frame.position).collect()
        };
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let mut blocks = vec![DMat3::ZERO; n * s.len()];
        jacobian(&strand, &s, &mut ChainScratch::default(), &mut blocks);
        for j in 0..n {
            for axis in 0..3 {
                let h = 1e-5 * (1.0 + elements[j].curvature.length());
                let mut moved = elements.clone();
                moved[j].curvature[axis] += h;
                let up = at(&moved);
                moved[j].curvature[axis] -= 2.0 * h;
                let down = at(&moved);
                for k in 0..s.len() {
                    let by = (up[k] - down[k]) / (2.0 * h);
                    prop_assert!(by.distance(blocks[k * n + j].col(axis)) < 1e-7);
                }
            }
        }
    }

    #[test]
    fn adjoint_is_the_transposed_jacobian(
        (elements, s) in case(),
        r in prop::array::uniform3(-1.0..1.0),
    ) {
        let r = DVec3::from_array(r);
        let n = elements.len();
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
        let mut scratch = ChainScratch::default();
        let mut blocks = vec![DMat3::ZERO; n * s.len()];
        jacobian(&strand, &s, &mut scratch, &mut blocks);
        let mut gradient = vec![DVec3::ZERO; n];
        let residual = |k: usize, position: DVec3| r * (k as f64 + 1.0) + position;
        adjoint(&strand, &s, residual, &mut scratch, &mut gradient);
        let positions: Vec<_> = scratch.positions().collect();
        for j in 0..n {
            let expected: DVec3 = (0..s.len())
                .map(|k| blocks[k * n + j].transpose() * residual(k, positions[k]))
                .sum();
            prop_assert!(gradient[j].distance(expected) < 1e-12 * (1.0 + expected.length()));
        }
    }
}

#[test]
fn a_strand_without_elements_has_no_derivatives() {
    let strand = SuperHelix { root: Frame::IDENTITY, elements: &[] };
    let mut scratch = ChainScratch::default();
    jacobian(&strand, &[0.0, 1.0], &mut scratch, &mut []);
    adjoint(&strand, &[0.0], |_, _| DVec3::ONE, &mut scratch, &mut []);
    assert_eq!(scratch.positions().collect::<Vec<_>>(), [DVec3::ZERO]);
}
