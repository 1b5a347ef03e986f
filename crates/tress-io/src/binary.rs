//! Walking through the bytes of a file without ever trusting a count in it.

use glam::DVec3;
use rayon::prelude::*;

use crate::{ParseError, Problem};

/// A file's bytes and how far they are read.
pub(crate) struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Bytes read so far.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// Bytes not read yet.
    pub(crate) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// An error unless `count` items of `size` bytes are left.
    pub(crate) fn expect(&self, count: usize, size: usize) -> Result<(), ParseError> {
        let (needed, left) = (count.saturating_mul(size), self.left());
        if needed <= left {
            return Ok(());
        }
        let problem = Problem::Truncated { needed: needed as u64, left: left as u64 };
        Err(problem.at_byte(self.at))
    }

    /// The next `count` items of `SIZE` bytes.
    pub(crate) fn items<const SIZE: usize>(
        &mut self,
        count: usize,
    ) -> Result<&'a [[u8; SIZE]], ParseError> {
        self.expect(count, SIZE)?;
        let taken = &self.bytes[self.at..self.at + count * SIZE];
        self.at += taken.len();
        Ok(taken.as_chunks().0)
    }

    /// The next item of `SIZE` bytes.
    pub(crate) fn item<const SIZE: usize>(&mut self) -> Result<[u8; SIZE], ParseError> {
        let items = self.items::<SIZE>(1)?;
        Ok(items.first().copied().unwrap_or([0; SIZE]))
    }

    pub(crate) fn u32(&mut self) -> Result<u32, ParseError> {
        self.item().map(u32::from_le_bytes)
    }

    pub(crate) fn f32(&mut self) -> Result<f64, ParseError> {
        self.item().map(|bytes| f64::from(f32::from_le_bytes(bytes)))
    }

    /// A signed count, which may not be below 0.
    pub(crate) fn count(&mut self, what: &str) -> Result<usize, ParseError> {
        let at = self.at;
        let count = self.item().map(i32::from_le_bytes)?;
        usize::try_from(count).map_err(|_| {
            Problem::unexpected(format!("a number of {what}"), count.to_string()).at_byte(at)
        })
    }

    /// The next `count` 32-bit floats, widened.
    pub(crate) fn f32s(&mut self, count: usize) -> Result<Vec<f64>, ParseError> {
        Ok(self.items::<4>(count)?.iter().map(|&bytes| widen(bytes)).collect())
    }

    /// The next `count` triples of 32-bit floats, widened.
    pub(crate) fn points(
        &mut self,
        count: usize,
    ) -> Result<impl ExactSizeIterator<Item = DVec3> + use<'a>, ParseError> {
        Ok(self.items::<12>(count)?.iter().map(point))
    }

    /// An error if anything is left.
    pub(crate) fn finish(self) -> Result<(), ParseError> {
        let bytes = self.left() as u64;
        if bytes == 0 { Ok(()) } else { Err(Problem::Trailing { bytes }.at_byte(self.at)) }
    }
}

/// A 32-bit float as 64 bits.
pub(crate) fn widen(bytes: [u8; 4]) -> f64 {
    f64::from(f32::from_le_bytes(bytes))
}

/// The first three 32-bit floats of an item.
pub(crate) fn point<const SIZE: usize>(item: &[u8; SIZE]) -> DVec3 {
    let [x, y, z] = [0, 4, 8].map(|at| widen([item[at], item[at + 1], item[at + 2], item[at + 3]]));
    DVec3::new(x, y, z)
}

/// Whether numbers are the same, bit for bit.
pub(crate) fn same<const N: usize>(a: [f64; N], b: [f64; N]) -> bool {
    a.map(f64::to_bits) == b.map(f64::to_bits)
}

/// A number as the 32-bit float nearest to it.
#[expect(clippy::cast_possible_truncation, reason = "narrowing is the point")]
pub(crate) fn narrow(value: f64) -> [u8; 4] {
    (value as f32).to_le_bytes()
}

/// A position as three 32-bit floats.
pub(crate) fn narrow_point(p: DVec3) -> [u8; 12] {
    let ([a, b, c, d], [e, f, g, h], [i, j, k, l]) = (narrow(p.x), narrow(p.y), narrow(p.z));
    [a, b, c, d, e, f, g, h, i, j, k, l]
}

/// Numbers as the 32-bit floats nearest to them.
#[expect(clippy::cast_possible_truncation, reason = "narrowing is the point")]
pub(crate) fn narrow_all(values: &[f64]) -> Vec<f32> {
    values.par_iter().map(|&value| value as f32).collect()
}

/// The bytes of values, one after the other.
pub(crate) fn packed<T: Copy + Sync, const SIZE: usize>(
    values: &[T],
    encode: impl Fn(T) -> [u8; SIZE] + Sync,
) -> Vec<u8> {
    let mut bytes = vec![0; values.len() * SIZE];
    let (rows, _) = bytes.as_chunks_mut::<SIZE>();
    rows.par_iter_mut().zip(values).for_each(|(row, &value)| *row = encode(value));
    bytes
}
