use glam::{DMat3, DVec3};
use proptest::prelude::*;
use pulp::Scalar;
use tress_geometry::{ChainScratch, Element, Frame, SuperHelix, jacobian};

use super::*;
use crate::lanes::vectors;

/// A chain of one lane at rest, with points at the arc lengths.
fn chain(elements: &[Element], at: &[(usize, f64)]) -> Chain<Scalar> {
    let simd = Scalar::new();
    let mut chain = Chain::new(simd);
    let softness = vectors(simd, |_| DVec3::ONE);
    chain.axes = LaneMat3([DVec3::X, DVec3::Y, DVec3::Z].map(|e| vectors(simd, |_| e)));
    chain.elements.extend(elements.iter().map(|e| LaneElement {
        rest: vectors(simd, |_| e.curvature),
        length: Lane::splat(simd, e.length),
        softness,
    }));
    for (k, &(element, local)) in at.iter().enumerate() {
        let point = Point::new(Lane::splat(simd, element as f64), Lane::splat(simd, local));
        chain.points.push(point);
        chain.holds.push((element, k));
    }
    chain
}

fn elements() -> impl Strategy<Value = Vec<Element>> {
    let magnitude = prop_oneof![Just(0.0), Just(1e-9), Just(1.0), Just(20.0)];
    let element = (prop::array::uniform3(-1.0..1.0), magnitude, any::<bool>(), 0.01..0.5).prop_map(
        |(q, magnitude, twist_only, length)| {
            let q = DVec3::from_array(q) * magnitude;
            Element { curvature: if twist_only { q * DVec3::X } else { q }, length }
        },
    );
    prop::collection::vec(element, 1..7)
}

fn first(v: LaneVec3<Scalar>) -> DVec3 {
    v.to_array()[0]
}

fn first_matrix(m: &LaneMat3<Scalar>) -> DMat3 {
    DMat3::from_cols(first(m.0[0]), first(m.0[1]), first(m.0[2]))
}

proptest! {
    #[test]
    fn sums_along_the_strand_are_products_of_jacobians(
        elements in elements(),
        picks in prop::array::uniform3((0..100_usize, 0.0..1.0)),
        change in prop::array::uniform3(-0.3..0.3),
    ) {
        let n = elements.len();
        let mut at = picks.map(|(e, s)| (e % n, s * elements[e % n].length));
        at.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        let mut lanes = chain(&elements, &at);
        let y: Vec<_> = (0..n).map(|j| DVec3::from_array(change) * (j as f64 - 1.0)).collect();
        let in_lanes: Vec<_> = y.iter().map(|&y| vectors(Scalar::new(), |_| y)).collect();
        lanes.walk(&in_lanes);

        let moved: Vec<_> = elements.iter().zip(&y)
            .map(|(e, &y)| Element { curvature: e.curvature + y, ..*e }).collect();
        let strand = SuperHelix { root: Frame::IDENTITY, elements: &moved };
        let begins = |i: usize| moved[..i].iter().map(|e| e.length).sum::<f64>();
        let s = at.map(|(i, local)| begins(i) + local);
        let mut blocks = vec![DMat3::ZERO; 3 * n];
        let mut scratch = ChainScratch::default();
        jacobian(&strand, &s, &mut scratch, &mut blocks);
        let positions: Vec<_> = scratch.positions().collect();
        let rho = [DVec3::X, DVec3::new(0.5, -1.0, 2.0), DVec3::ONE];
        for k in 0..3 {
            prop_assert!(first(lanes.points[k].position).distance(positions[k]) < 1e-13);
            let row = &blocks[k * n..(k + 1) * n];
            let drift: DVec3 = row.iter().zip(&y).map(|(j, &y)| *j * y).sum();
            prop_assert!(first(lanes.points[k].drift).distance(drift) < 1e-12);
            for l in k..3 {
                let other = &blocks[l * n..(l + 1) * n];
                let product: DMat3 =
                    row.iter().zip(other).fold(DMat3::ZERO, |sum, (a, b)| sum + *a * b.transpose());
                let ours = first_matrix(&lanes.gram(k, l));
                let error = (ours - product).to_cols_array().map(f64::abs);
                prop_assert!(error.iter().all(|e| *e < 1e-12), "{k} {l}: {ours} {product}");
            }
        }
        let mut pulled = vec![DVec3::ZERO; n];
        let loads = rho.map(|r| vectors(Scalar::new(), |_| r));
        lanes.pull(&loads, |j, g| pulled[j] = first(g));
        for j in 0..n {
            let expected: DVec3 = (0..3).map(|k| blocks[k * n + j].transpose() * rho[k]).sum();
            prop_assert!(pulled[j].distance(expected) < 1e-12, "{} {expected}", pulled[j]);
        }
    }
}
