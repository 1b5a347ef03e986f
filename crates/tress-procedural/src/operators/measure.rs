//! Lengths along a strand and their derivatives, shared by the operators.

use glam::DVec3;

/// Work space of one thread: one number a point or segment in each array.
#[derive(Clone, Debug)]
pub(crate) struct Scratch {
    /// Length of each segment; the last entry is unused.
    pub(crate) lengths: Vec<f64>,
    /// Arc length of each point.
    pub(crate) arc: Vec<f64>,
    pub(crate) weight: Vec<f64>,
    pub(crate) sine: Vec<f64>,
    pub(crate) cosine: Vec<f64>,
    /// Gradients by `arc` and `lengths`.
    pub(crate) by_arc: Vec<f64>,
    pub(crate) by_length: Vec<f64>,
    pub(crate) points: Vec<DVec3>,
}

impl Scratch {
    /// For strands of so many points.
    pub(crate) fn new(points_each: usize) -> Self {
        let row = vec![0.0; points_each];
        Self {
            lengths: row.clone(),
            arc: row.clone(),
            weight: row.clone(),
            sine: row.clone(),
            cosine: row.clone(),
            by_arc: row.clone(),
            by_length: row,
            points: vec![DVec3::ZERO; points_each],
        }
    }

    /// Fills `lengths` and `arc`; gives one over the strand's length, 0 for a strand of none.
    #[inline]
    pub(crate) fn measure(&mut self, strand: &[DVec3]) -> f64 {
        let n = strand.len() - 1;
        let lengths = &mut self.lengths[..n];
        for (length, ends) in lengths.iter_mut().zip(strand.windows(2)) {
            *length = (ends[1] - ends[0]).length_squared();
        }
        lengths.iter_mut().for_each(|length| *length = length.sqrt());
        let mut s = 0.0;
        let arc = &mut self.arc[..=n];
        arc[0] = 0.0;
        for (arc, length) in arc[1..].iter_mut().zip(lengths) {
            s += *length;
            *arc = s;
        }
        if s > 0.0 { 1.0 / s } else { 0.0 }
    }

    /// Clears the gradients by arc lengths and segment lengths.
    pub(crate) fn clear(&mut self) {
        self.by_arc.fill(0.0);
        self.by_length.fill(0.0);
    }

    /// Adds the gradient by `v_j = s_j / l` to those by arc lengths, the strand's length `l` being
    /// the last of them.
    pub(crate) fn by_fraction(&mut self, j: usize, by_fraction: f64, one_over_length: f64) {
        let last = self.arc.len() - 1;
        self.by_arc[j] += by_fraction * one_over_length;
        self.by_arc[last] -= by_fraction * self.arc[j] * one_over_length * one_over_length;
    }

    /// Adds what the gradients by arc lengths and segment lengths come to for the points.
    pub(crate) fn pull_back(&self, strand: &[DVec3], gradient: &mut [DVec3]) {
        let mut behind = 0.0;
        for j in (0..strand.len() - 1).rev() {
            behind += self.by_arc[j + 1];
            if self.lengths[j] > 0.0 {
                let by_length = behind + self.by_length[j];
                let by_end = (strand[j + 1] - strand[j]) * (by_length / self.lengths[j]);
                gradient[j + 1] += by_end;
                gradient[j] -= by_end;
            }
        }
    }
}

/// The gradient by a vector from that by its direction.
pub(crate) fn by_vector(direction: DVec3, length: f64, by_direction: DVec3) -> DVec3 {
    if length > 0.0 {
        (by_direction - direction * direction.dot(by_direction)) / length
    } else {
        DVec3::ZERO
    }
}
