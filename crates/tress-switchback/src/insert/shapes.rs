//! Solved switchbacks, kept for all strands that coil alike.
//!
//! Strands of a groom have frequencies close together, so solutions are kept on a grid of them. A
//! strand takes the nearest, and its own coil makes up for the difference outside of the middle
//! (see [`super::surgery`]). Which thread solves one does not matter: each solution is found from
//! its frequency alone.

use std::sync::OnceLock;

use glam::DVec3;

use super::InsertOptions;
use crate::profile::{GAUSS, material_curvature};
use crate::{Material, Profile, Switchback};

/// Frequencies from 0 to 1 that are solved for: 1 / 512 apart, a coil of the nearest differs by
/// 0.001 at most.
const GRID: usize = 512;

/// Frequencies below are flat rings, those above all but straight: neither is solved for.
const FREQUENCIES: std::ops::RangeInclusive<f64> = 0.02..=0.98;

/// A switchback sampled for insertion, right-handed before it; in units of the rest curvature.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    /// `|kappa|` of its coil.
    pub(super) turning: f64,
    /// Distance from the middle to either end of its room.
    pub(super) half_width: f64,
    /// Material curvatures at the two Gauss points of steps of equal length over the room.
    pub(super) steps: Vec<[DVec3; 2]>,
    /// Material curvature of the coil before it.
    pub(super) coil: DVec3,
}

/// Shapes by frequency, each solved when first asked for.
#[derive(Debug)]
pub(super) struct Shapes {
    options: InsertOptions,
    kept: Vec<OnceLock<Option<Shape>>>,
}

impl Shapes {
    pub(super) fn new(options: InsertOptions) -> Self {
        Self { options, kept: std::iter::repeat_with(OnceLock::new).take(GRID + 1).collect() }
    }

    /// The shape for coils of frequency `v` or `-v`; `None` where there is none.
    pub(super) fn get(&self, v: f64) -> Option<&Shape> {
        let v = v.abs();
        if !FREQUENCIES.contains(&v) {
            return None;
        }
        let nearest = (v * GRID as f64).round();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and GRID"
        )]
        let entry = &self.kept[nearest as usize];
        entry.get_or_init(|| self.solve(nearest / GRID as f64)).as_ref()
    }

    fn solve(&self, v: f64) -> Option<Shape> {
        let material = Material { poisson_ratio: self.options.poisson_ratio, rest_twist: 0.0 };
        let switchback = Switchback::new(v, &material).ok()?;
        let half_width = switchback.half_width(self.options.share);
        let turning = switchback.coil().turning();
        let turns = 2.0 * half_width * turning / std::f64::consts::TAU;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a positive number of steps"
        )]
        let steps = (turns * self.options.elements_per_turn as f64).ceil() as usize;
        let h = 2.0 * half_width / steps as f64;
        let step = |i: usize| {
            let middle = -half_width + h * (i as f64 + 0.5);
            [-GAUSS, GAUSS].map(|x| material_curvature(switchback.curvature(middle + h * x)))
        };
        let steps = (0..steps).map(step).collect();
        let coil = material_curvature(switchback.coil().curvature);
        Some(Shape { turning, half_width, steps, coil })
    }
}
