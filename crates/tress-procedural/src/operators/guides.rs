//! Operator guides as the operators read them: coordinates, normals and binormals in rows.

use glam::DVec3;
use rayon::prelude::*;

use super::{Operator, curl};
use crate::EvenStrands;

/// Rows of a guide: its coordinates, x and y of its normals, and its binormals.
const ROWS: usize = 8;

/// The rows of every operator guide.
#[derive(Clone, Debug)]
pub(crate) struct Guides {
    points_each: usize,
    /// `ROWS` rows of `points_each` numbers a guide; empty if no operator reads them.
    rows: Vec<f64>,
}

/// The rows of one operator guide; empty if no operator reads them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GuideRows<'a> {
    pub(crate) points: [&'a [f64]; 3],
    /// Normals have no z.
    pub(crate) normals: [&'a [f64]; 2],
    pub(crate) binormals: [&'a [f64]; 3],
}

impl Guides {
    /// Rows of the guides, as far as the operators read them.
    pub(crate) fn new(guides: &EvenStrands, operators: &[Operator]) -> Self {
        let points_each = guides.points_each();
        let reads =
            |operator: &Operator| matches!(operator, Operator::Clump(_) | Operator::Curl(_));
        if !operators.iter().any(reads) {
            return Self { points_each, rows: Vec::new() };
        }
        let mut rows = vec![0.0; ROWS * guides.points().len()];
        rows.par_chunks_mut(ROWS * points_each)
            .zip(guides.points().par_chunks(points_each))
            .for_each(|(rows, guide)| fill(rows, guide));
        Self { points_each, rows }
    }

    #[inline]
    pub(crate) fn rows(&self, guide: usize) -> GuideRows<'_> {
        let m = self.points_each;
        let Some(rows) = self.rows.get(ROWS * guide * m..ROWS * (guide + 1) * m) else {
            return GuideRows::default();
        };
        let row = |i: usize| &rows[i * m..(i + 1) * m];
        GuideRows {
            points: [row(0), row(1), row(2)],
            normals: [row(3), row(4)],
            binormals: [row(5), row(6), row(7)],
        }
    }
}

impl GuideRows<'_> {
    /// Normal and binormal at point `j`.
    pub(crate) fn normals(&self, j: usize) -> [DVec3; 2] {
        let [x, y] = self.normals.map(|row| row[j]);
        [DVec3::new(x, y, 0.0), DVec3::from_array(self.binormals.map(|row| row[j]))]
    }
}

fn fill(rows: &mut [f64], guide: &[DVec3]) {
    let m = guide.len();
    for (j, x) in guide.iter().enumerate() {
        let [n, b] = curl::normals(guide, j);
        for (i, value) in [x.x, x.y, x.z, n.x, n.y, b.x, b.y, b.z].into_iter().enumerate() {
            rows[i * m + j] = value;
        }
    }
}
