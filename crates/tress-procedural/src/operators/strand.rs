//! One strand at work: its points, the lengths along it, and their derivatives.
//!
//! Points are held as three rows, one a coordinate. Loops along rows are turned into vector
//! instructions by the compiler; loops over points of three coordinates are not.

use glam::DVec3;

/// Work space of one thread: rows of one number a point or segment.
#[derive(Clone, Debug)]
pub(crate) struct Scratch {
    /// The strand's points, a row for x, y and z.
    pub(crate) rows: [Vec<f64>; 3],
    /// Length of each segment.
    pub(crate) lengths: Vec<f64>,
    /// Arc length of each point.
    pub(crate) arc: Vec<f64>,
    pub(crate) weight: Vec<f64>,
    pub(crate) sine: Vec<f64>,
    pub(crate) cosine: Vec<f64>,
    /// What is added to the rows, or takes their place.
    pub(crate) moved: [Vec<f64>; 3],
    /// Gradients by `arc` and `lengths`.
    pub(crate) by_arc: Vec<f64>,
    pub(crate) by_length: Vec<f64>,
    pub(crate) points: Vec<DVec3>,
}

impl Scratch {
    /// For strands of so many points.
    pub(crate) fn new(points_each: usize) -> Self {
        let row = vec![0.0; points_each];
        let by_segment = vec![0.0; points_each - 1];
        Self {
            rows: [row.clone(), row.clone(), row.clone()],
            lengths: by_segment.clone(),
            arc: row.clone(),
            weight: row.clone(),
            sine: row.clone(),
            cosine: row.clone(),
            moved: [by_segment.clone(), by_segment.clone(), by_segment.clone()],
            by_arc: row,
            by_length: by_segment,
            points: vec![DVec3::ZERO; points_each],
        }
    }

    /// Points of a strand.
    pub(crate) fn points_each(&self) -> usize {
        self.arc.len()
    }

    /// Takes a strand to work on.
    #[inline(always)]
    pub(crate) fn load(&mut self, strand: &[DVec3]) {
        let [xs, ys, zs] = &mut self.rows;
        for (point, ((x, y), z)) in strand.iter().zip(xs.iter_mut().zip(ys).zip(zs)) {
            (*x, *y, *z) = (point.x, point.y, point.z);
        }
    }

    /// Puts the strand out.
    #[inline(always)]
    pub(crate) fn store(&self, strand: &mut [DVec3]) {
        let [xs, ys, zs] = &self.rows;
        for (point, ((x, y), z)) in strand.iter_mut().zip(xs.iter().zip(ys).zip(zs)) {
            *point = DVec3::new(*x, *y, *z);
        }
    }

    /// Fills `lengths` and `arc`; gives one over the strand's length, 0 for a strand of none.
    #[inline(always)]
    pub(crate) fn measure(&mut self) -> f64 {
        let n = self.lengths.len();
        let [xs, ys, zs] = &self.rows;
        let (x, x_next) = (&xs[..n], &xs[1..=n]);
        let (y, y_next) = (&ys[..n], &ys[1..=n]);
        let (z, z_next) = (&zs[..n], &zs[1..=n]);
        for (j, length) in self.lengths.iter_mut().enumerate() {
            let (dx, dy, dz) = (x_next[j] - x[j], y_next[j] - y[j], z_next[j] - z[j]);
            *length = (dx * dx + dy * dy + dz * dz).sqrt();
        }
        self.arc[0] = 0.0;
        let length = running_sums(0.0, &self.lengths, &mut self.arc[1..]);
        if length > 0.0 { 1.0 / length } else { 0.0 }
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

/// `sums[j] = start + row[0] + .. + row[j]`; gives the last.
///
/// Four are added up among themselves before they are added to what came before, so that only one
/// addition in four waits for the one before it.
#[inline(always)]
pub(crate) fn running_sums(start: f64, row: &[f64], sums: &mut [f64]) -> f64 {
    let (fours, rest) = row.as_chunks::<4>();
    let (sums_of_fours, sums_of_rest) = sums.as_chunks_mut::<4>();
    let mut sum = start;
    for ([a, b, c, d], sums) in fours.iter().zip(sums_of_fours) {
        let (two, last_two) = (a + b, c + d);
        *sums = [sum + a, sum + two, sum + (two + c), sum + (two + last_two)];
        sum = sums[3];
    }
    for (x, out) in rest.iter().zip(sums_of_rest) {
        sum += x;
        *out = sum;
    }
    sum
}

/// The gradient by a vector from that by its direction.
pub(crate) fn by_vector(direction: DVec3, length: f64, by_direction: DVec3) -> DVec3 {
    if length > 0.0 {
        (by_direction - direction * direction.dot(by_direction)) / length
    } else {
        DVec3::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_sums_are_those_of_one_after_the_other() {
        for n in 0..11_u32 {
            let row: Vec<f64> = (0..n).map(|i| f64::from(i * i) - 7.5).collect();
            let mut sums = vec![0.0; row.len()];
            let last = running_sums(2.0, &row, &mut sums);
            // Sums of halves are exact.
            let one_after_the_other = row.iter().scan(2.0, |sum, x| {
                *sum += x;
                Some(*sum)
            });
            assert_eq!(sums, one_after_the_other.collect::<Vec<f64>>());
            assert!((last - sums.last().unwrap_or(&2.0)).abs() < 1e-300, "of {n}");
        }
    }
}
