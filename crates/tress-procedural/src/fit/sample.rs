//! Which strands are compared, and with what.
//!
//! What operators do from strand to strand shows in the differences of strands, which know nothing
//! of what is wrong with the guides they share. Strands are taken in patches of a few operator
//! guides each, spread over the scalp: a strand is compared with the mean of its patch, which shows
//! curls, bends and lengths, and with the strand that grows next to it, its mate, which has most
//! often the same curl and so shows clump and frizz.

use std::ops::Range;

use glam::DVec3;

use crate::ProceduralGroom;
use crate::instancing::nearest;

/// Strands of a patch that are taken.
const PATCH: usize = 24;
/// Operator guides a patch reaches over: as many different curls, so that their mean has little
/// left of any.
const CURLS: usize = 6;

/// Strands to be compared.
pub(super) struct Sample {
    /// Strands in patches, one patch after the other, then the mates.
    pub(super) strands: Vec<usize>,
    /// The strands of each patch, in `strands`. None where there are so few operator guides that a
    /// patch would have all of them: what they have in common would not show.
    pub(super) patches: Vec<Range<usize>>,
    /// A strand and its mate, in `strands`.
    pub(super) mates: Vec<[usize; 2]>,
}

impl Sample {
    /// At most `count` of the `sound` strands, and their mates.
    pub(super) fn new(groom: &ProceduralGroom, sound: &[usize], count: usize) -> Self {
        let places = groom.roots.places(&groom.roots);
        let of = |strands: &[usize]| -> Vec<DVec3> { strands.iter().map(|&i| places[i]).collect() };
        let all = of(sound);
        let guides = groom.operator_guides.len().max(1);
        let (mut strands, mut patches) = (Vec::new(), Vec::new());
        if guides < 2 * CURLS {
            strands = spread(sound, count);
        } else {
            let middles = of(&spread(sound, (count / PATCH).max(1)));
            let reach = (CURLS * sound.len() / guides).max(PATCH);
            for near in nearest(&all, &middles, reach) {
                let patch: Vec<usize> = near.iter().map(|&(_, k)| sound[k as usize]).collect();
                let first = strands.len();
                strands.extend(spread(&patch, PATCH));
                patches.push(first..strands.len());
            }
        }
        let mut mates = Vec::new();
        for (k, near) in nearest(&all, &of(&strands), 2).iter().enumerate() {
            let others = near.iter().map(|&(_, other)| sound[other as usize]);
            if let Some(mate) = others.into_iter().find(|&i| i != strands[k]) {
                mates.push([k, strands.len()]);
                strands.push(mate);
            }
        }
        Self { strands, patches, mates }
    }
}

/// At most `count` of the strands, evenly spread over the list.
pub(super) fn spread(strands: &[usize], count: usize) -> Vec<usize> {
    let n = strands.len();
    if n <= count {
        return strands.to_vec();
    }
    (0..count).map(|k| strands[k * n / count]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::known;

    #[test]
    fn strands_are_compared_with_those_that_grow_about_them() {
        let groom = known(4, 0.1).expect("a known groom").groom;
        let sound: Vec<usize> = (0..groom.roots.len()).filter(|i| i % 5 != 0).collect();
        let sample = Sample::new(&groom, &sound, 480);
        assert_eq!(
            (sample.patches.len(), sample.mates.len(), sample.strands.len()),
            (20, 480, 960)
        );
        assert!(sample.strands.iter().all(|i| i % 5 != 0), "flawed strands are left out");
        let uv = groom.roots.uv.as_ref().expect("texture coordinates");
        let apart = |a: usize, b: usize| {
            let [a, b] = [a, b].map(|k| uv[sample.strands[k]]);
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        // 1,119 strands on a disc of radius 0.44: 0.023 apart, a patch within 0.07 of its middle.
        assert!(sample.mates.iter().all(|&[a, b]| a != b && apart(a, b) < 0.035));
        for patch in &sample.patches {
            assert!(patch.clone().all(|k| apart(patch.start, k) < 0.15));
        }
    }

    #[test]
    fn a_few_curls_are_not_compared_with_their_own_mean() {
        let mut groom = known(5, 0.01).expect("a known groom").groom;
        groom.operator_guides.truncate(11);
        groom.assign();
        let all: Vec<usize> = (0..groom.roots.len()).collect();
        let sample = Sample::new(&groom, &all, 50);
        assert!(sample.patches.is_empty());
        assert_eq!((sample.mates.len(), sample.strands.len()), (50, 100));
        let one = Sample::new(&groom, &[3], 50);
        assert_eq!((&one.strands[..], one.mates.len()), (&[3][..], 0));
    }
}
