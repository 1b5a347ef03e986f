//! The refined fit of one strand: which elements are refined, and from which draft.
//!
//! Helices are first laid *through the points*: an element a segment, joints held by the points,
//! curvature as even as that allows. Of all the ways tried this comes nearest to what a coil does
//! between its points (see `docs/fit.md`), so it is the curve that fewer elements are drafted on.
//! Where points are dense the smooth curve through them is as good, and the first stage is left
//! out.

use glam::DVec3;

use crate::draft::Draft;
use crate::measure::coil_radius;
use crate::refine::{Hold, Problem, Refiner, is_near};
use crate::spacing::Spacing;
use crate::tolerance::Search;
use crate::{Elements, Floating, Refine, Spline, StrandFit, Tolerance, direct};

/// Up to this angle a segment, in radians, the smooth curve serves as the draft: its error there
/// is 1e-3 of a coil's radius.
const DENSE: f64 = 0.9;

/// The refined fit along the smooth curve through a strand's points.
pub(crate) fn fit(
    spline: &Spline,
    elements: Elements,
    floating: Floating,
    settings: &Refine,
) -> StrandFit {
    let points = spline.points();
    let segments = points.len() - 1;
    let mut refiner = Refiner::default();
    let draft = match elements {
        Elements::PerSegment => return joined(spline, segments, settings, &mut refiner),
        Elements::Count(n) if segments <= n => return joined(spline, n, settings, &mut refiner),
        Elements::Count(n) => {
            let (draft, cost) = counted(spline, n, settings, &mut refiner);
            if is_astray(cost, &draft, points) && direct::is_enough(spline, n) {
                return nearest(draft, direct::evenly(spline, n, floating), points);
            }
            draft
        }
        Elements::Tolerance(tolerance) => {
            let through = through_points(spline, settings, &mut refiner);
            match within(&through, spline, tolerance, settings, &mut refiner) {
                Some(draft) => draft,
                None => return direct::through_points(spline, segments),
            }
        }
    };
    draft.into_fit()
}

/// As many elements as segments, or more: a joint at each point, the rest between them.
fn joined(spline: &Spline, n: usize, settings: &Refine, refiner: &mut Refiner) -> StrandFit {
    let points = spline.points();
    let mut draft = Draft::on(spline, &direct::at_points_and_between(spline, n));
    let cost = refiner.refine(Problem { points, hold: Hold::Joints, settings }, &mut draft);
    if is_astray(cost, &draft, points) {
        return nearest(draft, direct::through_points(spline, n), points);
    }
    draft.into_fit()
}

/// Exactly `n` elements, fewer than segments and equal before they are refined, and what they cost.
///
/// Where that ends far from the points, elements that are drafted short where curvature changes
/// are tried too.
fn counted(spline: &Spline, n: usize, settings: &Refine, refiner: &mut Refiner) -> (Draft, f64) {
    let points = spline.points();
    let problem = Problem { points, hold: Hold::Nearest, settings };
    let dense = spline.turning() < DENSE * (points.len() - 1) as f64;
    let through = (!dense).then(|| through_points(spline, settings, refiner));
    let mut draft = match &through {
        Some(through) => through.redrawn(&evenly(through.length(), n)),
        None => Draft::on(spline, &evenly(spline.length(), n)),
    };
    let cost = refiner.refine(problem, &mut draft);
    if is_near(cost, points.len(), &draft) {
        return (draft, cost);
    }
    let through = through.unwrap_or_else(|| through_points(spline, settings, refiner));
    let mut other = through.redrawn(&Spacing::of(&through).joints(n));
    let other_cost = refiner.refine(problem, &mut other);
    if other_cost < cost { (other, other_cost) } else { (draft, cost) }
}

/// A point that is missed by more than this part of a segment's or element's length is off its arc,
/// not between bends that the arc averages: the refinement went astray, as it does on strands that
/// turn sharply at points. A fit that is not astray misses a coil's points by a hundredth.
const ASTRAY: f64 = 0.5;

fn is_astray(cost: f64, draft: &Draft, points: &[DVec3]) -> bool {
    let n = draft.elements.len().min(points.len() - 1);
    let mean_length = draft.length() / n as f64;
    !cost.is_finite() || ASTRAY * mean_length < draft.greatest_distance(points)
}

/// The draft or the arcs, whichever has the points nearer.
fn nearest(draft: Draft, arcs: StrandFit, points: &[DVec3]) -> StrandFit {
    let drafted = draft.into_fit();
    let square = |fit: &StrandFit| -> f64 {
        let strand = fit.super_helix();
        let places = strand.frames_at(fit.arc_lengths.iter().copied());
        let sum: f64 = places.zip(points).map(|(f, p)| f.position.distance_squared(*p)).sum();
        if sum.is_finite() { sum } else { f64::INFINITY }
    };
    if square(&arcs) < square(&drafted) { arcs } else { drafted }
}

/// Steps that the curve takes which others are drafted on: it need not be the best.
const DRAFT_STEPS: usize = 8;

/// An element a segment, refined so far that others can be drafted on it.
fn through_points(spline: &Spline, settings: &Refine, refiner: &mut Refiner) -> Draft {
    let mut draft = Draft::on(spline, spline.arc_lengths());
    let settings = &Refine { steps: settings.steps.min(DRAFT_STEPS), ..*settings };
    let problem = Problem { points: spline.points(), hold: Hold::Joints, settings };
    refiner.approach(problem, &mut draft);
    draft
}

/// Arc lengths of the joints of `n` equal elements.
fn evenly(length: f64, n: usize) -> Vec<f64> {
    (0..=n).map(|i| length * (i as f64 / n as f64)).collect()
}

/// Elements a segment, and parts of the prior, that are tried where fewer than segments do not keep
/// to a tolerance: points are missed the less the weaker the prior is.
const FINER: [(usize, f64); 6] = [(1, 1.0), (1, 1e-2), (1, 1e-5), (2, 1.0), (2, 1e-4), (4, 1e-6)];

/// The fewest elements found that keep all points within the tolerance; one a segment or more if
/// there are no fewer, and nothing if those do not either.
fn within(
    through: &Draft,
    spline: &Spline,
    tolerance: Tolerance,
    settings: &Refine,
    refiner: &mut Refiner,
) -> Option<Draft> {
    let points = spline.points();
    let bound = match tolerance {
        Tolerance::Length(length) => length,
        Tolerance::OfRadius(part) => part * coil_radius(&through.elements),
    };
    let search = Search { through, points, bound, settings, refiner: &mut *refiner };
    search.fewest().or_else(|| {
        FINER.iter().find_map(|&(parts, part)| {
            let n = parts * (points.len() - 1);
            let mut draft = Draft::on(spline, &direct::at_points_and_between(spline, n));
            let settings = &Refine { prior: part * settings.prior, ..*settings };
            let cost = refiner.refine(Problem { points, hold: Hold::Joints, settings }, &mut draft);
            (cost.is_finite() && draft.greatest_distance(points) <= bound).then_some(draft)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TangentRule;

    #[test]
    fn a_point_more_than_half_an_element_off_is_astray() {
        // Five elements of length 4 along ten segments.
        let mut points: Vec<_> = (0..=10).map(|i| 2.0 * f64::from(i) * DVec3::X).collect();
        let spline = Spline::through(&points, TangentRule::Helix);
        let draft = Draft::on(&spline, &evenly(spline.length(), 5));
        points[4].y = 1.9;
        assert!(!is_astray(0.0, &draft, &points));
        points[4].y = 2.1;
        assert!(is_astray(0.0, &draft, &points));
        points[4].y = 0.0;
        assert!(is_astray(f64::NAN, &draft, &points));
    }
}
