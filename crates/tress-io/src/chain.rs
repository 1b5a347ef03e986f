//! Strands from edges: segments that share a vertex are joined end to end.

use tress_geometry::{OffsetsError, Strands};

/// Joins segments (elements of two vertices) to strands of vertices; an element of a single vertex
/// is a strand of its own.
///
/// Strands are in the order of their first segments and run the way these do. A vertex of more than
/// two segments ends the strands that reach it; a closed strand begins with its first segment and
/// ends where it began. `vertices` is how many there are; every element names only such.
pub(crate) fn chains<'a>(
    vertices: usize,
    elements: impl Iterator<Item = &'a [u32]> + Clone,
) -> Result<Strands<u32>, OffsetsError> {
    let mut chain = Chain::new(vertices, elements.clone());
    let mut strands = Strands::default();
    let (mut before, mut behind) = (Vec::new(), Vec::new());
    for (first, element) in elements.enumerate() {
        let &[a, b] = element else {
            strands.push(element.iter().copied())?;
            continue;
        };
        if !chain.take(first) {
            continue;
        }
        behind.clear();
        chain.follow(first, b, &mut behind);
        before.clear();
        chain.follow(first, a, &mut before);
        let whole = before.iter().rev().chain([&a, &b]).chain(&behind);
        strands.push(whole.copied())?;
    }
    Ok(strands)
}

/// The segments at a vertex.
#[derive(Clone, Copy)]
enum Joint {
    None,
    One(usize),
    Two(usize, usize),
    More,
}

struct Chain<'a> {
    elements: Vec<&'a [u32]>,
    taken: Vec<bool>,
    joints: Vec<Joint>,
}

impl<'a> Chain<'a> {
    fn new(vertices: usize, elements: impl Iterator<Item = &'a [u32]>) -> Self {
        let elements: Vec<_> = elements.collect();
        let mut joints = vec![Joint::None; vertices];
        for (i, element) in elements.iter().enumerate().filter(|(_, ends)| ends.len() == 2) {
            for &vertex in *element {
                let joint = &mut joints[vertex as usize];
                *joint = match *joint {
                    Joint::None => Joint::One(i),
                    Joint::One(other) => Joint::Two(other, i),
                    Joint::Two(..) | Joint::More => Joint::More,
                };
            }
        }
        Self { taken: vec![false; elements.len()], elements, joints }
    }

    /// Takes a segment, unless it is taken.
    fn take(&mut self, segment: usize) -> bool {
        !std::mem::replace(&mut self.taken[segment], true)
    }

    /// Walks on from `segment` over its end `vertex`, and appends the vertices that come.
    fn follow(&mut self, mut segment: usize, mut vertex: u32, walked: &mut Vec<u32>) {
        while let Joint::Two(a, b) = self.joints[vertex as usize] {
            segment = if a == segment { b } else { a };
            if !self.take(segment) {
                return;
            }
            let ends = self.elements[segment];
            vertex = if ends[0] == vertex { ends[1] } else { ends[0] };
            walked.push(vertex);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(elements: &[&[u32]]) -> Vec<Vec<u32>> {
        let strands = chains(10, elements.iter().copied()).unwrap();
        strands.iter().map(<[u32]>::to_vec).collect()
    }

    #[test]
    fn segments_in_any_order_and_direction() {
        assert_eq!(joined(&[&[2, 3], &[0, 1], &[2, 1]]), [[0, 1, 2, 3]]);
        assert_eq!(joined(&[&[3, 2], &[0, 1], &[2, 1]]), [[3, 2, 1, 0]]);
        assert_eq!(
            joined(&[&[4, 5], &[7], &[0, 1], &[1, 2]]),
            [vec![4, 5], vec![7], vec![0, 1, 2]]
        );
    }

    #[test]
    fn closed_and_degenerate_chains() {
        assert_eq!(joined(&[&[0, 1], &[1, 2], &[2, 0]]), [[0, 1, 2, 0]]);
        assert_eq!(joined(&[&[5, 5]]), [[5, 5]]);
        assert_eq!(joined(&[&[1, 2], &[2, 1]]), [[1, 2, 1]]);
    }

    #[test]
    fn a_fork_ends_the_strands_that_reach_it() {
        let forked = joined(&[&[0, 1], &[1, 2], &[2, 3], &[2, 4], &[4, 5]]);
        assert_eq!(forked, [vec![0, 1, 2], vec![2, 3], vec![2, 4, 5]]);
    }
}
