//! The energy of sculpting one strand, and its gradient in one sweep.
//!
//! `E(q) = sum_k w_k |S(lambda_k) - a_k|^2 + c sum_j |W_j^(1/2) (q_j - q0_j)|^2`
//!
//! is [CSE 15] with weights. The diagonal `W_j` is the weight of each component of `q`, made
//! less towards the tip; with a [relative stiffness](Stiffness::Relative) it is also in proportion
//! to the element's length (over the mean length), so that the sum is the elastic energy's integral
//! and cutting an element in two changes nothing. The relative stiffness is in parts of the tip's
//! mean *compliance* at rest,
//!
//! `c = stiffness tr(J W^-1 J^T) / 3`, `J` the derivative of the tip,
//!
//! because a single anchor at distance `a` moves the tip by `J W^-1 J^T (J W^-1 J^T + c)^-1 a`.

use glam::{DMat3, DVec3};
use tress_geometry::{ChainScratch, Element, SuperHelix, adjoint, jacobian};

use crate::control::Prepared;
use crate::{Control, ControlError, Energy, SculptOptions, Stiffness};

/// The energy of one strand whose controls are drawn to anchors.
///
/// ```
/// use glam::DVec3;
/// use tress_geometry::{Element, Frame, SuperHelix};
/// use tress_optimize::{Control, Objective, SculptOptions};
///
/// // A straight strand of length 2; its tip should go up by 1.
/// let elements = [Element { curvature: DVec3::ZERO, length: 2.0 }];
/// let strand = SuperHelix { root: Frame::IDENTITY, elements: &elements };
/// let up = [Control::new(2.0, DVec3::new(1.5, 1.0, 0.0))];
/// let mut energy = Objective::new(&strand, &up, &SculptOptions::published(0.1))?;
/// let mut gradient = [DVec3::ZERO];
/// let start = energy.evaluate(&elements, &mut gradient);
/// assert_eq!((start.anchors, start.bending), (1.25, 0.0));
/// assert_eq!(gradient[0], DVec3::new(0.0, 0.0, -4.0)); // bending about v raises the tip
/// # Ok::<(), tress_optimize::ControlError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Objective<'a> {
    rest: SuperHelix<'a>,
    prepared: Prepared,
    arc_lengths: Vec<f64>,
    c: f64,
    /// The diagonals of `W_j`.
    weights: Vec<DVec3>,
    scratch: ChainScratch,
}

impl<'a> Objective<'a> {
    /// The energy of a strand, which is at rest as it stands.
    ///
    /// # Errors
    ///
    /// If a control has no meaning.
    pub fn new(
        rest: &SuperHelix<'a>,
        controls: &[Control],
        options: &SculptOptions,
    ) -> Result<Self, ControlError> {
        let mut prepared = Prepared::default();
        prepared.prepare(rest, controls)?;
        let mut weights = Vec::new();
        element_weights(rest.elements, options, |w| weights.push(w));
        let mut objective = Self {
            rest: *rest,
            arc_lengths: prepared.controls.iter().map(|control| control.arc_length).collect(),
            prepared,
            c: options.stiffness.value(),
            weights,
            scratch: ChainScratch::default(),
        };
        if let Stiffness::Relative(stiffness) = options.stiffness {
            objective.c = stiffness * objective.compliance();
        }
        Ok(objective)
    }

    /// `c` in length^4, whichever way the stiffness was given.
    #[must_use]
    pub fn c(&self) -> f64 {
        self.c
    }

    /// The energy of `elements`, which differ from those at rest in their curvatures only, and its
    /// gradient by them. Nothing is allocated after the first call.
    ///
    /// # Panics
    ///
    /// If there are not as many elements and gradients as there were elements at rest.
    pub fn evaluate(&mut self, elements: &[Element], gradient: &mut [DVec3]) -> Energy {
        assert_eq!(elements.len(), self.rest.elements.len(), "as many elements as at rest");
        let root = tress_geometry::Frame { position: DVec3::ZERO, ..self.rest.root };
        let controls = &self.prepared.controls;
        let mut anchors = 0.0;
        let residual = |k: usize, position: DVec3| {
            let Control { anchor, weight, .. } = controls[k];
            let off = position - anchor;
            anchors += weight * off.length_squared();
            2.0 * weight * off
        };
        let strand = SuperHelix { root, elements };
        adjoint(&strand, &self.arc_lengths, residual, &mut self.scratch, gradient);
        let mut bending = 0.0;
        let changes = elements.iter().zip(self.rest.elements).zip(&self.weights);
        for (((element, rest), &weight), gradient) in changes.zip(gradient) {
            let change = element.curvature - rest.curvature;
            let pull = self.c * weight * change;
            bending += pull.dot(change);
            *gradient += 2.0 * pull;
        }
        Energy { anchors, bending }
    }

    /// Greatest distance of a control of positive weight, as of the last evaluation, to the anchor
    /// that was asked for.
    #[must_use]
    pub fn anchor_distance(&self) -> f64 {
        let asked = self.prepared.asked.iter().zip(&self.prepared.controls);
        let off = self.scratch.positions().zip(asked);
        off.filter(|(_, (_, control))| 0.0 < control.weight)
            .fold(0.0, |worst, (position, (asked, _))| f64::max(worst, position.distance(*asked)))
    }

    /// Anchors out of reach.
    #[must_use]
    pub fn unreachable(&self) -> usize {
        self.prepared.unreachable
    }

    /// `c W_j`, by element.
    pub(crate) fn stiffness(&self) -> impl Iterator<Item = DVec3> {
        self.weights.iter().map(|&weight| self.c * weight)
    }

    /// Controls in the order of their arc lengths, anchors relative to the root and within reach.
    pub(crate) fn controls(&self) -> &[Control] {
        &self.prepared.controls
    }

    /// `tr(J W^-1 J^T) / 3` of the tip at rest.
    fn compliance(&mut self) -> f64 {
        let mut blocks = vec![DMat3::ZERO; self.rest.elements.len()];
        jacobian(&self.rest, &[self.rest.length()], &mut self.scratch, &mut blocks);
        let of = |(block, &weight): (&DMat3, &DVec3)| {
            let columns = [block.x_axis, block.y_axis, block.z_axis];
            let squares = DVec3::from(columns.map(DVec3::length_squared));
            // An element of no length moves nothing and weighs nothing.
            if weight == DVec3::ZERO { 0.0 } else { (squares / weight).element_sum() }
        };
        blocks.iter().zip(&self.weights).map(of).sum::<f64>() / 3.0
    }
}

/// The diagonal of `W_j` for each element in turn; zero for one of no length where lengths weigh.
pub(crate) fn element_weights(
    elements: &[Element],
    options: &SculptOptions,
    mut give: impl FnMut(DVec3),
) {
    let length: f64 = elements.iter().map(|element| element.length).sum();
    let per_length = if 0.0 < length { 1.0 / length } else { 0.0 };
    let taper = options.tip_weight.ln();
    let mut begins = 0.0;
    for element in elements {
        let middle = (begins + 0.5 * element.length) * per_length;
        let weight = options.weights * (taper * middle).exp();
        give(match options.stiffness {
            Stiffness::Raw(_) => weight,
            Stiffness::Relative(_) => {
                weight * (element.length * per_length * elements.len() as f64)
            }
        });
        begins += element.length;
    }
}
