//! The values of a sample, as numbers or texts.

/// The values of a property at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<'a> {
    bytes: &'a [u8],
    pod: u8,
    extent: u8,
}

/// Numbers of a type that is read, each made another by a function.
macro_rules! numbers {
    ($bytes:expr, $type:ty, $convert:expr) => {{
        let (chunks, _) = $bytes.as_chunks::<{ size_of::<$type>() }>();
        chunks.iter().map(|bytes| $convert(<$type>::from_le_bytes(*bytes))).collect()
    }};
}

impl<'a> Sample<'a> {
    pub(super) fn new(bytes: &'a [u8], pod: u8, extent: u8) -> Self {
        Self { bytes, pod, extent: extent.max(1) }
    }

    /// Numbers in a row.
    #[must_use]
    pub fn extent(&self) -> usize {
        self.extent.into()
    }

    /// Integers of any type; nothing if these are other values, or too large for 64 bits.
    #[must_use]
    pub fn integers(&self) -> Option<Vec<i64>> {
        let bytes = self.bytes;
        Some(match self.pod {
            0 | 1 => numbers!(bytes, u8, i64::from),
            2 => numbers!(bytes, i8, i64::from),
            3 => numbers!(bytes, u16, i64::from),
            4 => numbers!(bytes, i16, i64::from),
            5 => numbers!(bytes, u32, i64::from),
            6 => numbers!(bytes, i32, i64::from),
            7 => {
                let whole: Vec<u64> = numbers!(bytes, u64, |x| x);
                let signed = whole.into_iter().map(i64::try_from);
                return signed.collect::<Result<_, _>>().ok();
            }
            8 => numbers!(bytes, i64, |x| x),
            _ => return None,
        })
    }

    /// Floating-point numbers of 32 or 64 bits; nothing if these are other values.
    #[must_use]
    pub fn floats(&self) -> Option<Vec<f64>> {
        Some(match self.pod {
            10 => numbers!(self.bytes, f32, f64::from),
            11 => numbers!(self.bytes, f64, |x| x),
            _ => return None,
        })
    }

    /// Vectors of three 32-bit floats; nothing if these are other values.
    pub fn vectors(&self) -> Option<impl ExactSizeIterator<Item = [f32; 3]> + use<'a>> {
        let (rows, _) = self.bytes.as_chunks::<12>();
        let row = |row: &[u8; 12]| {
            let (numbers, _) = row.as_chunks::<4>();
            [0, 1, 2].map(|i| f32::from_le_bytes(numbers[i]))
        };
        ((self.pod, self.extent) == (10, 3)).then(|| rows.iter().map(row))
    }

    /// Texts; nothing if these are other values.
    #[must_use]
    pub fn texts(&self) -> Option<Vec<String>> {
        if self.pod != crate::values::TEXT {
            return None;
        }
        let ended = self.bytes.strip_suffix(b"\0").unwrap_or(self.bytes);
        let texts = ended.split(|&byte| byte == 0);
        Some(texts.map(|text| String::from_utf8_lossy(text).into_owned()).collect())
    }
}
