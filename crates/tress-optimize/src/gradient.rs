//! Energies and gradients of a whole groom, strands side by side in SIMD lanes.
//!
//! For those who bring their own optimiser: the same numbers as [`Objective`] gives strand by
//! strand, at a fraction of the time. Out along each strand with joints kept, back with the sums
//! `f` and `m` of forces and moments, as the adjoint of the geometry crate does it.

use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use tress_geometry::{Element, Frame, HelixGroom, OffsetsError, Strands};

use crate::lanes::{Lane, LaneMat3, LaneVec3, MAX_LANES, Motion, vectors};
use crate::{Control, Energy, Objective, SculptError, SculptOptions};

/// The energies of all strands of a groom.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame, HelixGroom, Strands};
/// use tress_optimize::{Control, GroomObjective, SculptOptions};
///
/// let elements = Strands::from_counts([1], vec![Element { length: 2.0, ..Element::default() }])?;
/// let groom = HelixGroom::new(vec![Frame::IDENTITY], elements)?;
/// let up = Strands::from_counts([1], vec![Control::new(2.0, DVec3::new(1.5, 1.0, 0.0))])?;
/// let objective = GroomObjective::new(&groom, &up, &SculptOptions::published(0.1))?;
/// let mut gradients = groom.elements().with_points(vec![DVec3::ZERO])?;
/// let energies = objective.evaluate(groom.elements(), &mut gradients);
/// assert_eq!(energies[0].total(), 1.25);
/// assert!(gradients.strand(0)[0].distance(DVec3::new(0.0, 0.0, -4.0)) < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct GroomObjective<'a> {
    rest: &'a HelixGroom,
    placed: Strands<Placed>,
    /// `c W_j`, by element.
    stiffness: Strands<DVec3>,
}

/// A control by the element that holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Placed {
    element: usize,
    local: f64,
    /// Relative to the root.
    anchor: DVec3,
    weight: f64,
}

/// Strands that a thread takes at a time.
const STRANDS_AT_A_TIME: usize = 64;

impl<'a> GroomObjective<'a> {
    /// The energies of a groom that is at rest as it stands. Strands without elements or controls
    /// have none.
    ///
    /// # Errors
    ///
    /// As [`sculpt`](crate::sculpt).
    pub fn new(
        rest: &'a HelixGroom,
        controls: &Strands<Control>,
        options: &SculptOptions,
    ) -> Result<Self, SculptError> {
        options.validate()?;
        if controls.len() != rest.len() {
            return Err(SculptError::Strands { controls: controls.len(), strands: rest.len() });
        }
        let (mut placed, mut stiffness) = (Strands::default(), Vec::new());
        for (strand, (helix, controls)) in rest.iter().zip(controls.iter()).enumerate() {
            let named = |source| SculptError::Control { strand, source };
            let one = Objective::new(&helix, controls, options).map_err(named)?;
            stiffness.extend(one.stiffness());
            placed.push(place(&one, helix.elements)).map_err(too_many)?;
        }
        let stiffness = rest.elements().with_points(stiffness).map_err(too_many)?;
        Ok(Self { rest, placed, stiffness })
    }

    /// The energy of each strand with these elements, and the gradients by their curvatures.
    ///
    /// # Panics
    ///
    /// If elements or gradients are not cut as the groom at rest is.
    pub fn evaluate(&self, pose: &Strands<Element>, gradients: &mut Strands<DVec3>) -> Vec<Energy> {
        let offsets = self.rest.elements().offsets();
        assert_eq!(pose.offsets(), offsets, "as many elements as at rest");
        assert_eq!(gradients.offsets(), offsets, "a gradient an element");
        let mut energies = vec![Energy::default(); pose.len()];
        let mut gradients: Vec<&mut [DVec3]> = gradients.iter_mut().collect();
        gradients
            .par_chunks_mut(STRANDS_AT_A_TIME)
            .zip(energies.par_chunks_mut(STRANDS_AT_A_TIME))
            .enumerate()
            .for_each(|(chunk, (gradients, energies))| {
                let first = chunk * STRANDS_AT_A_TIME;
                Arch::new().dispatch(Chunk { all: self, pose, first, gradients, energies });
            });
        energies
    }
}

fn too_many(error: OffsetsError) -> SculptError {
    SculptError::TooMany(error)
}

fn place<'b>(
    objective: &'b Objective<'_>,
    elements: &'b [Element],
) -> impl Iterator<Item = Placed> + 'b {
    let (mut element, mut begins) = (0, 0.0);
    objective.controls().iter().filter(|_| !elements.is_empty()).map(move |control| {
        while element + 1 < elements.len() && begins + elements[element].length < control.arc_length
        {
            begins += elements[element].length;
            element += 1;
        }
        let local = (control.arc_length - begins).clamp(0.0, elements[element].length);
        Placed { element, local, anchor: control.anchor, weight: control.weight }
    })
}

/// Neighbouring strands and where their results go.
struct Chunk<'a, 'b, 'c> {
    all: &'a GroomObjective<'b>,
    pose: &'a Strands<Element>,
    first: usize,
    gradients: &'a mut [&'c mut [DVec3]],
    energies: &'a mut [Energy],
}

/// What the way out leaves for the way back.
#[derive(Clone, Copy)]
struct Passed<S: Simd> {
    motion: Motion<S>,
    axes: LaneMat3<S>,
    end: LaneVec3<S>,
}

impl WithSimd for Chunk<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { all, pose, first, gradients, energies } = self;
        let mut passed: Vec<Passed<S>> = Vec::new();
        let groups = gradients.chunks_mut(S::F64_LANES).zip(energies.chunks_mut(S::F64_LANES));
        for (group, (gradients, energies)) in groups.enumerate() {
            let first = first + group * S::F64_LANES;
            let strands = first..first + gradients.len();
            let mut lanes = [(Frame::IDENTITY, &[][..], &[][..]); MAX_LANES];
            for (lane, i) in lanes.iter_mut().zip(strands.clone()) {
                *lane = (all.rest.roots()[i], pose.strand(i), all.placed.strand(i));
            }
            walk_out(simd, &lanes, &mut passed);
            let anchors = walk_back(simd, &lanes, &passed, gradients);
            for (lane, (energy, i)) in energies.iter_mut().zip(strands).enumerate() {
                let elements = (pose.strand(i), all.rest.elements().strand(i));
                let bending = bend(elements, all.stiffness.strand(i), gradients[lane]);
                *energy = Energy { anchors: anchors[lane], bending };
            }
        }
    }
}

type Lanes<'a> = [(Frame, &'a [Element], &'a [Placed]); MAX_LANES];

/// Joints and motions from root to tip, positions relative to the root.
#[inline(always)]
fn walk_out<S: Simd>(simd: S, lanes: &Lanes<'_>, passed: &mut Vec<Passed<S>>) {
    let column = |c: usize| vectors(simd, |i| lanes[i].0.axes.col(c));
    let mut axes = LaneMat3([column(0), column(1), column(2)]);
    let mut end = LaneVec3::zero(simd);
    passed.clear();
    for j in 0..lanes.iter().map(|lane| lane.1.len()).max().unwrap_or(0) {
        let element = |i: usize| lanes[i].1.get(j).copied().unwrap_or_default();
        let q = vectors(simd, |i| element(i).curvature);
        let motion = Motion::new(q, Lane::from_fn(simd, |i| element(i).length));
        end += axes.apply(motion.displacement());
        passed.push(Passed { motion, axes, end });
        axes = axes.times(&motion.rotation());
    }
}

/// Gradients of the anchors' term, and the term.
#[inline(always)]
fn walk_back<S: Simd>(
    simd: S,
    lanes: &Lanes<'_>,
    passed: &[Passed<S>],
    gradients: &mut [&mut [DVec3]],
) -> [f64; MAX_LANES] {
    let none = LaneVec3::zero(simd);
    let (mut force, mut moment, mut anchors) = (none, none, none.x);
    let mut left = lanes.map(|lane| lane.2.len());
    for (j, Passed { motion, axes, end }) in passed.iter().enumerate().rev() {
        let torque = moment - end.cross(force);
        let mut sum = motion.pull(axes.apply_transposed(force), axes.apply_transposed(torque));
        let start = match j.checked_sub(1) {
            Some(before) => passed[before].end,
            None => none,
        };
        while (0..MAX_LANES).any(|i| 0 < left[i] && lanes[i].2[left[i] - 1].element == j) {
            let mut here = [None; MAX_LANES];
            for (i, here) in here.iter_mut().enumerate() {
                let last = left[i].checked_sub(1).map(|last| lanes[i].2[last]);
                *here = last.filter(|placed| placed.element == j);
                left[i] -= usize::from(here.is_some());
            }
            let local = Lane::from_fn(simd, |i| here[i].map_or(0.0, |p| p.local));
            let weight = Lane::from_fn(simd, |i| here[i].map_or(0.0, |p| p.weight));
            let anchor = vectors(simd, |i| here[i].map_or(DVec3::ZERO, |p| p.anchor));
            let part = motion.to(local);
            let position = start + axes.apply(part.displacement());
            let off = position - anchor;
            anchors += weight * off.dot(off);
            let load = off * (weight + weight);
            sum += part.pull_here(axes.apply_transposed(load));
            force += load;
            moment += position.cross(load);
        }
        for (gradient, sum) in gradients.iter_mut().zip(sum.to_array()) {
            if let Some(gradient) = gradient.get_mut(j) {
                *gradient = sum;
            }
        }
    }
    anchors.to_array()
}

/// Adds the second term's gradient, and says what the term is.
fn bend(
    (pose, rest): (&[Element], &[Element]),
    stiffness: &[DVec3],
    gradient: &mut [DVec3],
) -> f64 {
    let mut bending = 0.0;
    for (((pose, rest), &stiffness), gradient) in pose.iter().zip(rest).zip(stiffness).zip(gradient)
    {
        let change = pose.curvature - rest.curvature;
        let pull = stiffness * change;
        bending += pull.dot(change);
        *gradient += 2.0 * pull;
    }
    bending
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::Stiffness;

    #[test]
    fn lanes_agree_with_one_strand_at_a_time() {
        let mut rng = Pcg64Mcg::seed_from_u64(5);
        let mut number = |to: f64| rng.random_range(-to..to);
        let (mut rest, mut controls) = (Strands::default(), Strands::default());
        for i in 0..77_usize {
            let n = (i * 5) % 13;
            let tight = if i % 3 == 0 { 20.0 } else { 2.0 };
            let element = |_| Element {
                curvature: DVec3::from_array([0; 3].map(|_| number(tight))),
                length: 0.3,
            };
            rest.push((0..n).map(element).collect::<Vec<_>>()).expect("few");
            let m = if n == 0 { 0 } else { i % 4 };
            let control = |k: usize| {
                let anchor = DVec3::from_array([0; 3].map(|_| number(0.2)));
                Control {
                    weight: 0.5 * k as f64,
                    ..Control::new(0.07 * n as f64 * k as f64, anchor)
                }
            };
            controls.push((0..m).map(control).collect::<Vec<_>>()).expect("few");
        }
        let groom = HelixGroom::new(vec![Frame::IDENTITY; 77], rest.clone()).expect("roots");
        let mut pose = rest;
        pose.points_mut().iter_mut().for_each(|e| e.curvature += DVec3::splat(number(0.5)));
        let stiffness = Stiffness::Relative(0.1);
        let options = SculptOptions { stiffness, ..Default::default() };
        let all = GroomObjective::new(&groom, &controls, &options).expect("good controls");
        let n = pose.points().len();
        let mut gradients = pose.with_points(vec![DVec3::NAN; n]).expect("as many");
        let energies = all.evaluate(&pose, &mut gradients);
        for (i, energies) in energies.iter().enumerate() {
            let strand = groom.strand(i);
            let mut one = Objective::new(&strand, controls.strand(i), &options).expect("good");
            let mut expected = vec![DVec3::ZERO; strand.elements.len()];
            let energy = one.evaluate(pose.strand(i), &mut expected);
            assert!((energy.total() - energies.total()).abs() < 1e-12 * (1.0 + energy.total()));
            for (a, b) in gradients.strand(i).iter().zip(&expected) {
                assert!(a.distance(*b) < 1e-11 * (1.0 + b.length()), "strand {i}: {a} {b}");
            }
        }
    }
}
