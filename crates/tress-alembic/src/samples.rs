//! The values of a property over time.
//!
//! A *scalar* has one row a sample, an *array* any number. A sample that equals the one before is
//! not written again: the file holds the first sample and those from the first to the last that
//! differ from the one before. Values that stand in the file already, of whatever property, are
//! shared.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Seek, Write};

use crate::chunks::{Address, Chunks};
use crate::digest::{Digest, digest};
use crate::values::{DataType, TEXT, Values};

/// The samples of a property that are written so far.
#[derive(Debug)]
pub(crate) struct Samples {
    is_scalar: bool,
    data_type: DataType,
    /// The time sampling that they are of.
    time: u32,
    samples: Vec<Sample>,
}

/// A sample that is in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    data: Address,
    dimensions: Address,
    rows: usize,
    digest: Digest,
}

/// Values as the file holds them, and the digest that stands before them.
#[derive(Debug)]
pub(crate) struct Encoded<'a> {
    bytes: Cow<'a, [u8]>,
    rows: usize,
    digest: Digest,
}

impl<'a> Encoded<'a> {
    pub(crate) fn new(values: &Values<'a>) -> Self {
        let bytes = values.bytes();
        let digest = digest(&bytes);
        Self { bytes, rows: values.len(), digest }
    }
}

/// Values that are in the file already, by what they hold.
pub(crate) type Written = HashMap<(Digest, DataType, usize), Address>;

impl Samples {
    /// None yet, of one row each.
    pub(crate) fn scalar(values: &Values<'_>, time: u32) -> Self {
        Self { is_scalar: true, data_type: values.data_type(), time, samples: Vec::new() }
    }

    /// None yet, of any number of rows.
    pub(crate) fn array(values: &Values<'_>, time: u32) -> Self {
        Self { is_scalar: false, data_type: values.data_type(), time, samples: Vec::new() }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.samples.len()
    }

    /// The time sampling that they are of.
    pub(crate) fn time(&self) -> u32 {
        self.time
    }

    /// Whether values are of the type of these.
    pub(crate) fn take(&self, values: &Values<'_>) -> bool {
        self.data_type == values.data_type()
    }

    /// Writes the next sample, of a scalar.
    pub(crate) fn push_scalar<W: Write + Seek>(
        &mut self,
        values: &Values<'_>,
        out: &mut Chunks<W>,
        written: &mut Written,
    ) -> io::Result<()> {
        let row = if 1 < values.len() { values.first() } else { *values };
        self.push(&Encoded::new(&row), out, written)
    }

    /// Writes the next sample.
    pub(crate) fn push<W: Write + Seek>(
        &mut self,
        values: &Encoded<'_>,
        out: &mut Chunks<W>,
        written: &mut Written,
    ) -> io::Result<()> {
        let Encoded { bytes, rows, digest } = values;
        let (rows, digest) = (*rows, *digest);
        let key = (digest, self.data_type, bytes.len());
        let data = match written.get(&key) {
            _ if bytes.is_empty() => Address::NO_DATA,
            Some(&address) => address,
            None => out.data(&digest, bytes)?,
        };
        written.insert(key, data);
        // How many rows there are follows from the size, unless they are texts.
        let dimensions = if self.data_type.pod == TEXT && !self.is_scalar && 0 < rows {
            out.data(&[], &(rows as u64).to_le_bytes())?
        } else {
            Address::NO_DATA
        };
        self.samples.push(Sample { data, dimensions, rows, digest });
        Ok(())
    }

    /// Writes the group of the samples.
    pub(crate) fn write<W: Write + Seek>(&self, out: &mut Chunks<W>) -> io::Result<Address> {
        let (first, last) = self.changes();
        let begin = self.samples.get(..1).unwrap_or_default();
        let changed = if first == 0 { &[] } else { &self.samples[first..=last] };
        let mut addresses = Vec::new();
        for sample in begin.iter().chain(changed) {
            addresses.push(sample.data);
            addresses.extend((!self.is_scalar).then_some(sample.dimensions));
        }
        out.group(&addresses)
    }

    /// What the header of the property says of its samples: flags, and numbers that follow them.
    pub(crate) fn info(&self) -> (u32, Vec<usize>) {
        let first_rows = self.samples.first().map_or(1, |sample| sample.rows);
        let is_even = self.samples.iter().all(|sample| sample.rows == first_rows);
        let mut info = match (self.is_scalar, first_rows == 1 && is_even) {
            (true, _) => 1,
            (false, false) => 2,
            (false, true) => 3,
        };
        info |= u32::from(self.data_type.pod) << 4 | u32::from(self.data_type.extent) << 12;
        info |= u32::from(is_even) << 10;
        let mut numbers = vec![self.len()];
        let (first, last) = self.changes();
        if first == 0 {
            info |= 0x800;
        } else if (first, last) != (1, self.len() - 1) {
            info |= 0x200;
            numbers.extend([first, last]);
        }
        if self.time != 0 {
            info |= 0x100;
            numbers.push(self.time as usize);
        }
        (info, numbers)
    }

    /// The digests of all samples.
    pub(crate) fn digests(&self) -> Vec<u8> {
        self.samples.iter().flat_map(|sample| sample.digest).collect()
    }

    /// The first and the last sample that differ from the one before; 0 and 0 if none does.
    fn changes(&self) -> (usize, usize) {
        let differs = |i: &usize| self.samples[*i] != self.samples[*i - 1];
        let mut changed = (1..self.len()).filter(differs);
        let first = changed.next().unwrap_or(0);
        (first, changed.next_back().unwrap_or(first))
    }
}
