//! How well a few anchors a strand bring a real droop back, and a spline in position space beside.

use glam::DVec3;
use tress_fit::{FitOptions, Refine, StrandFit, fit_strand};
use tress_geometry::{HelixGroom, Strands, SuperHelix};
use tress_optimize::{Control, SculptError, SculptOptions, sculpt};

/// Distances to the true positions, root mean square over all points of all strands.
#[derive(Clone, Copy, Debug)]
pub struct Droop {
    /// Of the strands before: how far there is to go.
    pub moved: f64,
    /// Of the fit of the strands before: what no sculpting can better.
    pub fitted: f64,
    /// Sculpted.
    pub sculpted: f64,
    /// A cubic spline of the anchors' displacements along the strand, clamped at the root.
    pub baseline: f64,
}

/// Strands before a droop, fitted once, and where their points were behind it.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    before: &'a Strands<DVec3>,
    after: &'a Strands<DVec3>,
    fits: Vec<StrandFit>,
    groom: HelixGroom,
}

impl<'a> Scene<'a> {
    /// Fits the strands before with one element a segment; `None` when the two grooms are not the
    /// same strands or a strand cannot be fitted.
    #[must_use]
    pub fn new(before: &'a Strands<DVec3>, after: &'a Strands<DVec3>) -> Option<Self> {
        if before.offsets() != after.offsets() {
            return None;
        }
        let options = FitOptions { refine: Some(Refine::default()), ..FitOptions::default() };
        let fits: Option<Vec<_>> = before.iter().map(|p| fit_strand(p, &options).ok()).collect();
        let fits = fits?;
        let roots = fits.iter().map(|fit| fit.root).collect();
        let mut elements = Strands::default();
        for fit in &fits {
            elements.push(fit.elements.iter().copied()).ok()?;
        }
        let groom = HelixGroom::new(roots, elements).ok()?;
        Some(Self { before, after, fits, groom })
    }

    /// Sculpts to `m` evenly spaced points a strand, the tip always one.
    ///
    /// # Errors
    ///
    /// If an option has no meaning.
    pub fn droop(&self, m: usize, options: &SculptOptions) -> Result<Droop, SculptError> {
        let mut controls = Strands::default();
        for (fit, points) in self.fits.iter().zip(self.after.iter()) {
            let control = |i: usize| Control::new(fit.arc_lengths[i], points[i]);
            let strand: Vec<_> = anchored(points.len(), m).map(control).collect();
            // There are fewer anchors than points.
            let _ = controls.push(strand);
        }
        let mut groom = self.groom.clone();
        sculpt(&mut groom, &controls, options)?;
        let mut squares = [0.0; 4];
        for (i, (before, after)) in self.before.iter().zip(self.after.iter()).enumerate() {
            let shape = |strand: SuperHelix<'_>| -> Vec<DVec3> {
                let s = self.fits[i].arc_lengths.iter().copied();
                strand.frames_at(s).map(|frame| frame.position).collect()
            };
            let spline = spline_displaced(before, after, &self.fits[i].arc_lengths, m);
            squares[0] += square_distance(before, after);
            squares[1] += square_distance(&shape(self.fits[i].super_helix()), before);
            squares[2] += square_distance(&shape(groom.strand(i)), after);
            squares[3] += square_distance(&spline, after);
        }
        let n = self.before.points().len() as f64;
        let [moved, fitted, sculpted, baseline] = squares.map(|square| (square / n).sqrt());
        Ok(Droop { moved, fitted, sculpted, baseline })
    }
}

/// Which of `n` points are anchored.
fn anchored(n: usize, m: usize) -> impl Iterator<Item = usize> {
    (1..=m).map(move |k| ((n - 1) * k + m / 2) / m)
}

fn square_distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance_squared(*b)).sum()
}

/// The points before, moved by the cubic spline through the displacements of the anchored points:
/// displacement and slope 0 at the root, and a parabola on the last piece, which did better than a
/// spline without curvature at the tip.
fn spline_displaced(before: &[DVec3], after: &[DVec3], s: &[f64], m: usize) -> Vec<DVec3> {
    let knots: Vec<usize> = std::iter::once(0).chain(anchored(before.len(), m)).collect();
    let d: Vec<DVec3> = knots.iter().map(|&i| after[i] - before[i]).collect();
    let slopes = spline_slopes(&knots.iter().map(|&i| s[i]).collect::<Vec<_>>(), &d);
    let mut moved = before.to_vec();
    for (piece, ends) in knots.windows(2).enumerate() {
        let h = s[ends[1]] - s[ends[0]];
        for i in ends[0]..=ends[1] {
            let t = (s[i] - s[ends[0]]) / h;
            let (a, b) = (slopes[piece] * h, slopes[piece + 1] * h);
            let step = d[piece + 1] - d[piece];
            // Hermite's cubic.
            let shift = d[piece]
                + t * a
                + t * t * (3.0 * step - 2.0 * a - b)
                + t * t * t * (a + b - 2.0 * step);
            moved[i] = before[i] + shift;
        }
    }
    moved
}

/// Slopes at the knots of the cubic spline that starts flat and ends as a parabola.
fn spline_slopes(s: &[f64], d: &[DVec3]) -> Vec<DVec3> {
    let n = s.len();
    // The tridiagonal system of continuous curvature, eliminated from the root.
    let mut upper = vec![0.0; n];
    let mut slopes = vec![DVec3::ZERO; n];
    for i in 1..n {
        let h = s[i] - s[i - 1];
        let chord = (d[i] - d[i - 1]) / h;
        let (lower, middle, next, side) = if i + 1 < n {
            let k = s[i + 1] - s[i];
            let ahead = (d[i + 1] - d[i]) / k;
            (1.0 / h, 2.0 / h + 2.0 / k, 1.0 / k, 3.0 * (chord / h + ahead / k))
        } else {
            (1.0, 1.0, 0.0, 2.0 * chord)
        };
        let pivot = middle - lower * upper[i - 1];
        upper[i] = next / pivot;
        slopes[i] = (side - lower * slopes[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        slopes[i] = slopes[i] - upper[i] * slopes[i + 1];
    }
    slopes
}
