//! A look at a binary layer before openusd parses it: does every count fit in the file?
//!
//! openusd 0.6 allocates by the counts it finds, and an allocation that fails ends the process. A
//! binary layer ("crate file") begins with a bootstrap of 88 bytes (magic, version, where the table
//! of contents is); the table names sections. The sections `TOKENS`, `STRINGS`, `FIELDS`,
//! `FIELDSETS`, `PATHS` and `SPECS` begin with their counts; all but `STRINGS` are compressed. Each
//! field has a 64-bit value representation: flags and a type in the upper 16 bits, the value or
//! its address in the lower 48. Values that hold further representations (time samples,
//! dictionaries) are followed, to a depth, so that circles end.
//!
//! Compressed data is held to what it can expand to: LZ4 makes at most 255 bytes of one, and the
//! integer coding before it spends at least 2 bits on a number.

use std::io::Cursor;

use openusd::usdc::CrateFile;

/// Bytes that LZ4 makes of one at most, and what it makes of almost nothing.
const EXPANSION: (u64, u64) = (255, 64);
/// Integers in a byte at most.
const INTS_A_BYTE: u64 = 4;
/// Dictionaries in dictionaries.
const DEEPEST: usize = 32;

const ARRAY: u64 = 1 << 63;
const INLINED: u64 = 1 << 62;
const COMPRESSED: u64 = 1 << 61;
const PAYLOAD: u64 = (1 << 48) - 1;

/// Whether openusd can be let at a binary layer; the reason if not.
pub(super) fn check(bytes: &[u8]) -> Result<(), String> {
    let mut file = Scan { bytes, at: 8, version: 0, steps: bytes.len() };
    let [major, minor, patch] = file.take()?;
    file.version = u32::from_be_bytes([0, major, minor, patch]);
    if file.version < version(0, 4) {
        return Err(format!("binary USD of version {major}.{minor}.{patch} is too old"));
    }
    file.at = 16;
    file.at = file.address()?;
    let n_sections = file.count(32)?;
    for _ in 0..n_sections {
        let name: [u8; 16] = file.take()?;
        let (start, size) = (file.address()?, file.address()?);
        let end = start.checked_add(size).filter(|end| *end <= bytes.len());
        let Some(end) = end else { return Err(file.cut_short(size as u64)) };
        Scan { bytes: &bytes[..end], at: start, ..file }.section(&name)?;
    }
    let structure = CrateFile::open(Cursor::new(bytes)).map_err(|error| format!("{error:#}"))?;
    structure.fields.iter().try_for_each(|field| file.value(field.value_rep.0, 0))
}

const fn version(major: u32, minor: u32) -> u32 {
    major << 16 | minor << 8
}

/// A place in the file.
#[derive(Clone, Copy)]
struct Scan<'a> {
    bytes: &'a [u8],
    at: usize,
    version: u32,
    /// Representations that may still be looked at; no file has more than bytes.
    steps: usize,
}

impl Scan<'_> {
    fn section(mut self, name: &[u8; 16]) -> Result<(), String> {
        match name.split(|&byte| byte == 0).next() {
            Some(b"TOKENS") => {
                let (count, size) = (self.word()?, self.word()?);
                let size = count.max(size);
                let room = self.compressed()?;
                self.expect(size, room)
            }
            Some(b"STRINGS") => self.count(4).map(drop),
            Some(b"FIELDS") => {
                let count = self.word()?;
                self.integers(count)?;
                let room = self.compressed()?;
                self.expect(count.saturating_mul(8), room)
            }
            Some(b"FIELDSETS") => {
                let count = self.word()?;
                self.integers(count)
            }
            Some(b"PATHS") => {
                let (paths, count) = (self.word()?, self.word()?);
                // An index, an element and a jump for each.
                self.integers(paths.max(count))?;
                self.integers(count)?;
                self.integers(count)
            }
            Some(b"SPECS") => {
                let count = self.word()?;
                // A path, a field set and a type for each.
                (0..3).try_for_each(|_| self.integers(count))
            }
            _ => Ok(()),
        }
    }

    /// The value that a representation stands for.
    fn value(&mut self, rep: u64, depth: usize) -> Result<(), String> {
        self.steps = self.steps.checked_sub(1).ok_or("its values go round in circles")?;
        if DEEPEST < depth {
            return Err(format!("values lie more than {DEEPEST} deep in each other"));
        }
        let (kind, is_array) = (rep >> 48 & 0xff, rep & ARRAY != 0);
        if rep & INLINED != 0 {
            return Ok(());
        }
        self.at = usize::try_from(rep & PAYLOAD).map_err(|_| self.cut_short(0))?;
        match kind {
            // Strings, asset paths and path expressions; their vectors; tokens and paths.
            10 | 12 | 57 if is_array => self.count(4).map(drop),
            40 | 41 | 50 => self.count(4).map(drop),
            _ if is_array || kind == 48 => self.array(kind, rep & COMPRESSED != 0),
            31 => self.dictionary(depth),
            32..=39 | 54 | 55 => self.list_operation(kind, depth),
            45 | 58 => self.count(8).map(drop),
            46 => self.time_samples(depth),
            49 => self.count(16).map(drop),
            _ => Ok(()),
        }
    }

    fn array(&mut self, kind: u64, is_compressed: bool) -> Result<(), String> {
        if self.at == 0 {
            return Ok(());
        }
        if self.version < version(0, 5) {
            self.at = self.at.saturating_add(4);
        }
        let count = if self.version < version(0, 7) {
            u64::from(u32::from_le_bytes(self.take()?))
        } else {
            self.word()?
        };
        let size = element_size(kind);
        let floats = matches!(kind, 7..=9 | 48 | 56);
        let coded = self.version >= version(0, if floats { 6 } else { 5 });
        if !is_compressed || !coded || count < 4 || !(floats || (3..=6).contains(&kind)) {
            return self.expect(count.saturating_mul(size), self.left());
        }
        if floats && self.take::<1>()? == *b"t" {
            // A table of values; the integers are indices into it.
            let entries = u64::from(u32::from_le_bytes(self.take()?));
            let bytes = entries * size;
            self.expect(bytes, self.left())?;
            self.at += usize::try_from(bytes).unwrap_or_default();
        }
        self.integers(count)
    }

    /// A count and, for each entry, a key and a jump to a representation, which the next entry
    /// follows.
    fn dictionary(&mut self, depth: usize) -> Result<(), String> {
        for _ in 0..self.count(4 + 8)? {
            let _key: [u8; 4] = self.take()?;
            self.jump()?;
            let rep = self.word()?;
            let behind = self.at;
            self.value(rep, depth + 1)?;
            self.at = behind;
        }
        Ok(())
    }

    /// Times and values, each behind a jump.
    fn time_samples(&mut self, depth: usize) -> Result<(), String> {
        self.jump()?;
        let times = self.word()?;
        let behind = self.at;
        self.value(times, depth + 1)?;
        self.at = behind;
        self.jump()?;
        for _ in 0..self.count(8)? {
            let rep = self.word()?;
            let behind = self.at;
            self.value(rep, depth + 1)?;
            self.at = behind;
        }
        Ok(())
    }

    /// A byte of flags and a list for each flag but the first.
    fn list_operation(&mut self, kind: u64, depth: usize) -> Result<(), String> {
        let [flags] = self.take()?;
        for _ in 0..(flags >> 1).count_ones() {
            match kind {
                35 => {
                    // References: asset, prim, time offset and scale, and a dictionary.
                    for _ in 0..self.count(4 + 4 + 16 + 8)? {
                        let _fixed: [u8; 24] = self.take()?;
                        self.dictionary(depth + 1)?;
                    }
                }
                55 => {
                    // Payloads: asset and prim, and since 0.8 a time offset and scale.
                    let size = if self.version < version(0, 8) { 8 } else { 24 };
                    let count = self.count(size)?;
                    self.at += count * size;
                }
                _ => {
                    let size = if matches!(kind, 37 | 39) { 8 } else { 4 };
                    let count = self.count(size)?;
                    self.at += count * size;
                }
            }
        }
        Ok(())
    }

    /// A compressed block that holds `count` integers.
    fn integers(&mut self, count: u64) -> Result<(), String> {
        let room = self.compressed()?;
        self.expect(count / INTS_A_BYTE, room)
    }

    /// Steps over a compressed block; how large it can get.
    fn compressed(&mut self) -> Result<u64, String> {
        let size = self.count(1)?;
        self.at += size;
        Ok((size as u64).saturating_mul(EXPANSION.0) + EXPANSION.1)
    }

    /// A count of things of `size` bytes that follow it.
    fn count(&mut self, size: usize) -> Result<usize, String> {
        let count = self.word()?;
        self.expect(count.saturating_mul(size as u64), self.left())?;
        usize::try_from(count).map_err(|_| self.cut_short(count))
    }

    fn address(&mut self) -> Result<usize, String> {
        let address = self.word()?;
        usize::try_from(address).map_err(|_| self.cut_short(address))
    }

    fn word(&mut self) -> Result<u64, String> {
        self.take().map(u64::from_le_bytes)
    }

    /// Goes on where a signed distance says, which counts from its own first byte.
    fn jump(&mut self) -> Result<(), String> {
        let from = self.at;
        let distance = self.take().map(i64::from_le_bytes)?;
        let distance = isize::try_from(distance).ok();
        let target = distance.and_then(|distance| from.checked_add_signed(distance));
        self.at = target.ok_or_else(|| self.cut_short(8))?;
        Ok(())
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let bytes = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk::<N>());
        let bytes = bytes.ok_or_else(|| self.cut_short(N as u64))?;
        self.at += N;
        Ok(*bytes)
    }

    fn left(&self) -> u64 {
        self.bytes.len().saturating_sub(self.at) as u64
    }

    fn expect(&self, needed: u64, room: u64) -> Result<(), String> {
        if needed <= room { Ok(()) } else { Err(self.cut_short(needed)) }
    }

    fn cut_short(&self, needed: u64) -> String {
        format!("the file is cut short: {needed} bytes are needed at byte {}", self.at)
    }
}

/// Bytes of one element of an array, by type.
fn element_size(kind: u64) -> u64 {
    match kind {
        // Booleans and bytes.
        1 | 2 => 1,
        // 64-bit integers, doubles and time codes.
        5 | 6 | 9 | 48 | 56 => 8,
        // Halves, and vectors of 2 to 4 of them; a quaternion is as large as a vector of 4.
        7 => 2,
        21 => 4,
        25 => 6,
        18 | 29 => 8,
        // Vectors of 2 to 4 floats or integers.
        20 | 22 => 8,
        24 | 26 => 12,
        17 | 28 | 30 => 16,
        // Vectors of 2 to 4 doubles.
        19 => 16,
        23 => 24,
        16 | 27 => 32,
        // Square matrices of 2 to 4 rows of doubles.
        13 => 32,
        14 => 72,
        15 => 128,
        // 32-bit integers, floats and indices.
        _ => 4,
    }
}
