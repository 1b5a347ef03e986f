//! Which guide each root follows, [CC 3.3.1].

use std::num::NonZero;

use glam::DVec3;
use kiddo::immutable::float::kdtree::ImmutableKdTree;
use kiddo::{NearestNeighbour, SquaredEuclidean};
use rand::RngExt;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tress_edit::strand_rng;

/// How a root finds its guide.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Assignment {
    /// The guide whose root is nearest: partings along Voronoi cells, as of box braids.
    Nearest,
    /// One of so many nearest guides, all as likely: the noisy Voronoi assignment of \[CC\].
    Noisy(usize),
    /// One of so many nearest guides, likely as the inverse of the distance: partings blur, and a
    /// root at a guide's own root follows that guide.
    NoisyByDistance(usize),
}

/// Why roots are given no guides.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AssignError {
    /// There is no guide with a root.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tress_grow::{AssignError, Assignment, assign};
    /// let error = assign(&[DVec3::ZERO], &[DVec3::NAN], Assignment::Nearest, 1);
    /// assert_eq!(error, Err(AssignError::NoGuides));
    /// ```
    #[error("there is no guide whose root is a place")]
    NoGuides,
    /// A choice among no guides.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tress_grow::{AssignError, Assignment, assign};
    /// let error = assign(&[DVec3::ZERO], &[DVec3::ZERO], Assignment::Noisy(0), 1);
    /// assert_eq!(error, Err(AssignError::Among));
    /// ```
    #[error("a guide cannot be chosen among 0")]
    Among,
    /// A groupings file that does not fit roots and guides.
    #[error("line {line}: {problem}")]
    Groups {
        /// Which line, from 1.
        line: usize,
        /// What is wrong there.
        problem: String,
    },
}

type Tree = ImmutableKdTree<f64, u32, 3, 32>;

/// The guide of each root. With fewer guides than a rule chooses among, it chooses among all.
///
/// A root that is not finite gets the first guide.
///
/// ```
/// use glam::DVec3;
/// use tress_grow::{Assignment, assign};
///
/// let guides = [DVec3::ZERO, DVec3::X];
/// let roots = [DVec3::new(0.9, 0.1, 0.0), DVec3::new(0.1, 0.0, 0.0)];
/// assert_eq!(assign(&roots, &guides, Assignment::Nearest, 1)?, [1, 0]);
/// # Ok::<(), tress_grow::AssignError>(())
/// ```
///
/// # Errors
///
/// If there is no guide, or if a guide is to be chosen among none.
pub fn assign(
    roots: &[DVec3],
    guide_roots: &[DVec3],
    rule: Assignment,
    seed: u64,
) -> Result<Vec<u32>, AssignError> {
    let named = (0..).zip(guide_roots).filter(|(_, root)| root.is_finite());
    let (names, places): (Vec<u32>, Vec<[f64; 3]>) =
        named.map(|(i, root)| (i, root.to_array())).unzip();
    let among = match rule {
        Assignment::Nearest => 1,
        Assignment::Noisy(n) | Assignment::NoisyByDistance(n) => n,
    };
    let Some(&first) = names.first() else { return Err(AssignError::NoGuides) };
    let Some(among) = NonZero::new(among.min(names.len())) else { return Err(AssignError::Among) };
    let tree = Tree::new_from_slice(&places);
    let guide = |(i, root): (usize, &DVec3)| {
        if !root.is_finite() {
            return first;
        }
        let near = tree.nearest_n::<SquaredEuclidean>(&root.to_array(), among);
        names[choose(&near, rule, seed, i)]
    };
    Ok(roots.par_iter().enumerate().with_min_len(256).map(guide).collect())
}

/// The item of one of the nearest.
fn choose(near: &[NearestNeighbour<f64, u32>], rule: Assignment, seed: u64, root: usize) -> usize {
    // A stream of its own: the strand's other choices do not hang on how it found its guide.
    let chance: f64 = strand_rng(seed ^ 0x726f_6f74, root).random();
    let weight = |n: &NearestNeighbour<f64, u32>| match rule {
        Assignment::NoisyByDistance(_) => 1.0 / n.distance.sqrt().max(f64::MIN_POSITIVE),
        _ => 1.0,
    };
    let total: f64 = near.iter().map(weight).sum();
    let mut left = chance * total;
    let chosen = near.iter().find(|n| {
        left -= weight(n);
        left < 0.0
    });
    chosen.or(near.first()).map_or(0, |n| n.item as usize)
}

/// The guide of each root from a groupings file: a line for each guide, the indices of its roots
/// between commas. This is the file of the authors of \[CC\].
///
/// ```
/// use tress_grow::read_groups;
///
/// assert_eq!(read_groups("2,0\n1\n", 2, 3)?, [0, 1, 0]);
/// let error = read_groups("2,0\n7\n", 2, 3).unwrap_err();
/// assert_eq!(error.to_string(), "line 2: there is no root 7 among 3");
/// # Ok::<(), tress_grow::AssignError>(())
/// ```
///
/// # Errors
///
/// If there are more lines than guides, an entry that is no root, or a root that is named twice
/// or never.
pub fn read_groups(text: &str, guides: usize, roots: usize) -> Result<Vec<u32>, AssignError> {
    let mut found: Vec<Option<u32>> = vec![None; roots];
    for (i, line) in text.lines().enumerate() {
        let at = |problem: String| AssignError::Groups { line: i + 1, problem };
        let entries: Vec<&str> = line.split(',').map(str::trim).filter(|e| !e.is_empty()).collect();
        let guide = u32::try_from(i).ok().filter(|_| i < guides || entries.is_empty());
        let guide =
            guide.ok_or_else(|| at(format!("a line more than there are guides, {guides}")))?;
        for entry in entries {
            let root: usize = entry
                .parse()
                .map_err(|_| at(format!("expected the index of a root, found {entry:?}")))?;
            let place = found.get_mut(root);
            let place =
                place.ok_or_else(|| at(format!("there is no root {root} among {roots}")))?;
            if let Some(other) = place.replace(guide) {
                return Err(at(format!("root {root} is in line {} already", other + 1)));
            }
        }
    }
    let line = text.lines().count().max(1);
    let missing = |root| AssignError::Groups { line, problem: format!("root {root} has no guide") };
    found.into_iter().enumerate().map(|(root, guide)| guide.ok_or_else(|| missing(root))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered(n: u32) -> Vec<DVec3> {
        let at = |i: u32| (f64::from(i) * 12.9898).sin().fract();
        (0..n).map(|i| DVec3::new(at(i), at(i + 7777), at(i + 99_999)) * 10.0).collect()
    }

    #[test]
    fn the_nearest_is_the_nearest() {
        let (roots, guides) = (scattered(500), scattered(97));
        let found = assign(&roots, &guides, Assignment::Nearest, 1).expect("guides");
        for (root, &guide) in roots.iter().zip(&found) {
            let own = root.distance(guides[guide as usize]);
            assert!(guides.iter().all(|other| own <= root.distance(*other)));
        }
    }

    #[test]
    fn noise_stays_among_the_nearest_and_prefers_the_near() {
        let (roots, guides) = (scattered(4000), scattered(60));
        let rank = |root: &DVec3, guide: u32| {
            let own = root.distance(guides[guide as usize]);
            guides.iter().filter(|other| root.distance(**other) < own).count()
        };
        let mut shares = Vec::new();
        for rule in [Assignment::Noisy(4), Assignment::NoisyByDistance(4)] {
            let found = assign(&roots, &guides, rule, 5).expect("guides");
            assert_eq!(found, assign(&roots, &guides, rule, 5).expect("guides"));
            let ranks = roots.iter().zip(&found).map(|(root, guide)| rank(root, *guide));
            let mut count = [0_u32; 4];
            ranks.for_each(|rank| count[rank] += 1);
            shares.push(count.map(|n| f64::from(n) / 4000.0));
        }
        assert!(shares[0].iter().all(|share| (share - 0.25).abs() < 0.03), "{shares:?}");
        assert!(0.3 < shares[1][0] && shares[1][3] < 0.22, "{shares:?}");
    }

    #[test]
    fn many_guides_in_one_plane_or_one_place_are_no_trouble() {
        let flat: Vec<_> = scattered(3000).iter().map(|p| DVec3::new(p.x, 0.0, p.z)).collect();
        let found = assign(&flat, &flat, Assignment::Nearest, 1).expect("guides");
        assert!(found.iter().zip(0..).all(|(a, b)| *a == b));
        let same = vec![DVec3::ONE; 500];
        for rule in [Assignment::Nearest, Assignment::Noisy(40), Assignment::NoisyByDistance(40)] {
            let found = assign(&same[..50], &same, rule, 1).expect("guides");
            assert!(found.iter().all(|guide| *guide < 500));
        }
    }

    #[test]
    fn fewer_guides_than_asked_for_and_roots_nowhere() {
        let guides = [DVec3::NAN, DVec3::X, DVec3::Y];
        let found = assign(&[DVec3::X, DVec3::NAN], &guides, Assignment::Noisy(9), 1);
        assert!(found.expect("two guides").iter().all(|guide| (1..3).contains(guide)));
    }

    #[test]
    fn broken_groupings_say_where() {
        let problem =
            |text, guides, roots| read_groups(text, guides, roots).expect_err("broken").to_string();
        assert_eq!(problem("0,x", 1, 1), "line 1: expected the index of a root, found \"x\"");
        assert_eq!(problem("0\n0", 2, 1), "line 2: root 0 is in line 1 already");
        assert_eq!(problem("0\n1", 1, 2), "line 2: a line more than there are guides, 1");
        assert_eq!(problem("0", 1, 2), "line 1: root 1 has no guide");
        assert_eq!(read_groups("1,0,\r\n\r\n", 1, 2), Ok(vec![0, 0]));
    }
}
