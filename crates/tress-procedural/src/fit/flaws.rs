//! Strands that a reconstruction got wrong, found without its cameras [IPG 5.7].
//!
//! Three kinds: *short* ones, far shorter than the strands about them; *straight* ones, far nearer
//! to their chord than the strands about them, which are curly; and *inner* ones, which none of 26
//! views all around sees. The last are what the paper leaves out, by the cameras of the
//! reconstruction; a dense groom that was never reconstructed has inner strands that are sound, so
//! they are counted and left out only when asked for.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::EvenStrands;
use crate::instancing::nearest;

/// What counts as a flaw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FlawOptions {
    /// Shorter than this fraction of the neighbours' median length. Default 0.4; 0 for none.
    pub short: f64,
    /// Less of its length in turns than this fraction of the neighbours' median, where they are
    /// curly. Default 0.3; 0 for none.
    pub straight: f64,
    /// Whether strands that no view sees are left out. Default no.
    pub inner: bool,
}

impl Default for FlawOptions {
    fn default() -> Self {
        Self { short: 0.4, straight: 0.3, inner: false }
    }
}

/// Which strands are flawed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Flaws {
    /// Far shorter than those about them.
    pub short: Vec<usize>,
    /// Straight among curly ones.
    pub straight: Vec<usize>,
    /// Seen from nowhere.
    pub inner: Vec<usize>,
    /// All others, ascending: those to go by.
    pub sound: Vec<usize>,
}

/// Strands whose medians a strand is held against.
const NEIGHBORS: usize = 24;
/// Neighbours are curly when this fraction of their length is lost in turns.
const CURLY: f64 = 0.1;
/// Cells along a side of a view.
const CELLS: usize = 128;

/// Finds flawed strands.
///
/// ```
/// use glam::DVec3;
/// use tress_procedural::EvenStrands;
/// use tress_procedural::fit::{FlawOptions, find_flaws};
///
/// let line = |i: u32| {
///     let (x, length) = (f64::from(i), if i == 7 { 1.0 } else { 10.0 });
///     [DVec3::X * x, DVec3::X * x + DVec3::Y * length]
/// };
/// let strands = EvenStrands::new(2, (0..30).flat_map(line).collect())?;
/// let flaws = find_flaws(&strands, &FlawOptions::default());
/// assert_eq!((flaws.short, flaws.sound.len()), (vec![7], 29));
/// # Ok::<(), tress_procedural::EvenError>(())
/// ```
#[must_use]
pub fn find_flaws(strands: &EvenStrands, options: &FlawOptions) -> Flaws {
    let roots = strands.roots();
    let near = nearest(&roots, &roots, NEIGHBORS);
    let length =
        |strand: &[DVec3]| -> f64 { strand.windows(2).map(|ends| ends[0].distance(ends[1])).sum() };
    let lengths: Vec<f64> = strands.iter().map(length).collect();
    // The part of the length that is lost in turns: against a line through every tenth point.
    let lost: Vec<f64> = strands
        .iter()
        .zip(&lengths)
        .map(|(strand, length)| {
            let stride = (strand.len() / 10).max(1);
            let coarse: Vec<DVec3> = strand.iter().copied().step_by(stride).collect();
            let coarse: f64 = coarse.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
            1.0 - (coarse / length).min(1.0)
        })
        .collect();
    let median = |values: &[f64], i: usize| {
        let mut about: Vec<f64> = near[i].iter().map(|&(_, k)| values[k as usize]).collect();
        about.sort_unstable_by(f64::total_cmp);
        about[about.len() / 2]
    };
    let all = 0..strands.len();
    let short = all.clone().filter(|&i| lengths[i] < options.short * median(&lengths, i)).collect();
    let straight = all
        .clone()
        .filter(|&i| {
            let about = median(&lost, i);
            CURLY < about && lost[i] < options.straight * about
        })
        .collect();
    let inner = unseen(strands);
    let mut flaws = Flaws { short, straight, inner, sound: Vec::new() };
    flaws.sound = all
        .filter(|i| {
            let inner = options.inner && flaws.inner.binary_search(i).is_ok();
            !inner
                && flaws.short.binary_search(i).is_err()
                && flaws.straight.binary_search(i).is_err()
        })
        .collect();
    flaws
}

/// Strands of which no point is the nearest in its cell in any of the views.
fn unseen(strands: &EvenStrands) -> Vec<usize> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    strands.points().iter().for_each(|x| (low, high) = (low.min(*x), high.max(*x)));
    let size = (high - low).length();
    if size <= 0.0 || !size.is_finite() {
        return Vec::new();
    }
    let middle = 0.5 * (low + high);
    let views: Vec<Vec<u32>> =
        directions().into_par_iter().map(|view| seen(strands, view, middle, size)).collect();
    let mut visible = vec![false; strands.len()];
    views.into_iter().flatten().for_each(|i| visible[i as usize] = true);
    (0..strands.len()).filter(|&i| !visible[i]).collect()
}

/// From the faces, edges and corners of a cube.
fn directions() -> Vec<DVec3> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(|x| {
        steps.into_iter().flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z)))
    });
    all.filter_map(DVec3::try_normalize).collect()
}

/// The strand nearest the viewer in every cell.
fn seen(strands: &EvenStrands, view: DVec3, middle: DVec3, size: f64) -> Vec<u32> {
    const EMPTY: (f64, u32) = (f64::NEG_INFINITY, u32::MAX);
    let (u, v) = view.any_orthonormal_pair();
    let mut cells = vec![EMPTY; CELLS * CELLS];
    let cell = |x: f64| {
        let at = ((x / size + 0.5) * CELLS as f64).clamp(0.0, (CELLS - 1) as f64);
        #[expect(clippy::cast_possible_truncation, reason = "clamped to the cells there are")]
        #[expect(clippy::cast_sign_loss, reason = "clamped to the cells there are")]
        let at = at as usize;
        at
    };
    for (i, strand) in (0..).zip(strands.iter()) {
        for x in strand {
            let from = *x - middle;
            let nearest = &mut cells[cell(from.dot(u)) * CELLS + cell(from.dot(v))];
            let depth = from.dot(view);
            if depth > nearest.0 {
                *nearest = (depth, i);
            }
        }
    }
    cells.into_iter().filter(|cell| cell.1 != u32::MAX).map(|cell| cell.1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 200 coils on a dome, strand 40 straight, strand 60 short.
    fn coils() -> EvenStrands {
        let strand = |i: u32| {
            let (sine, cosine) = (2.4 * f64::from(i)).sin_cos();
            let r = 0.3 * f64::from(i).sqrt();
            let root = DVec3::new(r * cosine, 0.0, r * sine);
            let (radius, length) = match i {
                40 => (0.0, 8.0),
                60 => (0.3, 1.0),
                _ => (0.3, 8.0),
            };
            let turns = 60.0 * length / 8.0;
            (0..100).map(move |j| {
                let s = f64::from(j) / 99.0;
                let (sine, cosine) = (turns * s).sin_cos();
                root + DVec3::new(radius * sine, length * s, radius * cosine)
            })
        };
        EvenStrands::new(100, (0..200).flat_map(strand).collect()).expect("whole strands")
    }

    #[test]
    fn short_and_straight_strands_are_found() {
        let flaws = find_flaws(&coils(), &FlawOptions::default());
        assert_eq!(flaws.short, [60]);
        assert!(flaws.straight.contains(&40));
        assert_eq!(flaws.sound.len(), 198);
        let none = FlawOptions { short: 0.0, straight: 0.0, inner: false };
        assert_eq!(find_flaws(&coils(), &none).sound.len(), 200);
    }

    #[test]
    fn a_strand_inside_a_shell_is_inner() {
        let line =
            |from: DVec3, to: DVec3| (0..12).map(move |j| from.lerp(to, f64::from(j) / 11.0));
        let shell = (0..20_000).flat_map(|i| {
            let (y, turn) = (1.0 - (f64::from(i) + 0.5) / 10_000.0, 2.399963 * f64::from(i));
            let r = (1.0 - y * y).sqrt();
            let out = DVec3::new(r * turn.cos(), y, r * turn.sin());
            let aside = out.any_orthonormal_vector() * 0.1;
            line(out - aside, out + aside)
        });
        let inside = line(DVec3::NEG_X * 0.1, DVec3::X * 0.1);
        let outside = line(DVec3::Y, DVec3::Y * 1.3);
        let points = inside.chain(shell).chain(outside).collect();
        let strands = EvenStrands::new(12, points).expect("whole strands");
        let flaws = find_flaws(&strands, &FlawOptions { inner: true, ..FlawOptions::default() });
        assert!(flaws.inner.contains(&0) && !flaws.sound.contains(&0));
        assert!(!flaws.inner.contains(&20_001), "what sticks out is seen");
    }
}
