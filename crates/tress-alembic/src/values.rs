//! Numbers and texts as samples hold them.

use std::borrow::Cow;
use std::fmt::Write;

use crate::schema::Scope;

/// Numbers of one type, or texts, in a flat array.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Numbers<'a> {
    /// Yes or no.
    Bool(&'a [bool]),
    /// Bytes.
    U8(&'a [u8]),
    /// Signed bytes.
    I8(&'a [i8]),
    /// 16-bit integers.
    I16(&'a [i16]),
    /// 32-bit integers.
    I32(&'a [i32]),
    /// 64-bit integers.
    I64(&'a [i64]),
    /// 32-bit floats.
    F32(&'a [f32]),
    /// 64-bit floats.
    F64(&'a [f64]),
    /// Texts; they end where a NUL stands in them.
    Text(&'a [&'a str]),
}

/// Rows of numbers, and what a row is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values<'a> {
    pub(crate) numbers: Numbers<'a>,
    /// Numbers in a row.
    pub(crate) extent: u8,
    /// What Alembic calls a row of so many numbers.
    pub(crate) interpretation: &'static str,
}

/// What a property says of its values: it may not change between samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct DataType {
    /// Alembic's number for the type.
    pub(crate) pod: u8,
    pub(crate) extent: u8,
}

/// Alembic's number for texts.
pub(crate) const TEXT: u8 = 12;

impl<'a> Values<'a> {
    /// One number, or text, a row.
    #[must_use]
    pub fn scalars(numbers: Numbers<'a>) -> Self {
        Self { numbers, extent: 1, interpretation: "" }
    }

    /// Rows of `extent` numbers; those of 2 and 3 are vectors to readers.
    ///
    /// Numbers left over at the end are no row and are not written.
    #[must_use]
    pub fn rows(numbers: Numbers<'a>, extent: u8) -> Self {
        let interpretation = if (2..=3).contains(&extent) { "vector" } else { "" };
        Self { numbers, extent: extent.max(1), interpretation }
    }

    /// Positions.
    pub(crate) fn points(points: &'a [[f32; 3]]) -> Self {
        let numbers = Numbers::F32(points.as_flattened());
        Self { numbers, extent: 3, interpretation: "point" }
    }

    /// A box: its lowest and its highest corner.
    pub(crate) fn bounds(corners: &'a [f64; 6]) -> Self {
        Self { numbers: Numbers::F64(corners), extent: 6, interpretation: "box" }
    }

    /// How many rows there are.
    #[must_use]
    pub fn len(&self) -> usize {
        let numbers = match self.numbers {
            Numbers::Bool(v) => v.len(),
            Numbers::U8(v) => v.len(),
            Numbers::I8(v) => v.len(),
            Numbers::I16(v) => v.len(),
            Numbers::I32(v) => v.len(),
            Numbers::I64(v) => v.len(),
            Numbers::F32(v) => v.len(),
            Numbers::F64(v) => v.len(),
            Numbers::Text(v) => v.len(),
        };
        numbers / usize::from(self.extent)
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The first row alone.
    pub(crate) fn first(&self) -> Self {
        let n = usize::from(self.extent);
        let numbers = match self.numbers {
            Numbers::Bool(v) => Numbers::Bool(&v[..n]),
            Numbers::U8(v) => Numbers::U8(&v[..n]),
            Numbers::I8(v) => Numbers::I8(&v[..n]),
            Numbers::I16(v) => Numbers::I16(&v[..n]),
            Numbers::I32(v) => Numbers::I32(&v[..n]),
            Numbers::I64(v) => Numbers::I64(&v[..n]),
            Numbers::F32(v) => Numbers::F32(&v[..n]),
            Numbers::F64(v) => Numbers::F64(&v[..n]),
            Numbers::Text(v) => Numbers::Text(&v[..n]),
        };
        Self { numbers, ..*self }
    }

    /// Alembic's number and name of the type.
    fn pod(&self) -> (u8, &'static str) {
        match self.numbers {
            Numbers::Bool(_) => (0, "bool_t"),
            Numbers::U8(_) => (1, "uint8_t"),
            Numbers::I8(_) => (2, "int8_t"),
            Numbers::I16(_) => (4, "int16_t"),
            Numbers::I32(_) => (6, "int32_t"),
            Numbers::I64(_) => (8, "int64_t"),
            Numbers::F32(_) => (10, "float32_t"),
            Numbers::F64(_) => (11, "float64_t"),
            Numbers::Text(_) => (TEXT, "string"),
        }
    }

    pub(crate) fn data_type(&self) -> DataType {
        DataType { pod: self.pod().0, extent: self.extent }
    }

    /// What a plain property of these values says of itself.
    pub(crate) fn meta_data(&self, scope: impl Into<Option<Scope>>) -> String {
        let scope = scope.into().map_or("", Scope::name);
        let pairs = [("geoScope", scope), ("interpretation", self.interpretation)];
        let said = pairs.iter().filter(|(_, value)| !value.is_empty());
        said.map(|(key, value)| format!("{key}={value}")).collect::<Vec<_>>().join(";")
    }

    /// What a geometry parameter of these values says of itself, keys in order.
    pub(crate) fn parameter_meta_data(&self, scope: Scope) -> String {
        let mut text = String::from("arrayExtent=1;");
        for pair in self.meta_data(scope).split(';').filter(|pair| !pair.is_empty()) {
            text += pair;
            text.push(';');
        }
        let (_, name) = self.pod();
        // Writing to a text does not fail.
        let _ = write!(text, "isGeomParam=true;podExtent={};podName={name}", self.extent);
        text
    }

    /// The rows as the file holds them.
    pub(crate) fn bytes(&self) -> Cow<'a, [u8]> {
        let n = self.len() * usize::from(self.extent);
        match self.numbers {
            Numbers::Bool(v) => v[..n].iter().map(|&b| u8::from(b)).collect(),
            Numbers::U8(v) => Cow::Borrowed(&v[..n]),
            Numbers::I8(v) => bytes(&v[..n], i8::to_le_bytes),
            Numbers::I16(v) => bytes(&v[..n], i16::to_le_bytes),
            Numbers::I32(v) => bytes(&v[..n], i32::to_le_bytes),
            Numbers::I64(v) => bytes(&v[..n], i64::to_le_bytes),
            Numbers::F32(v) => bytes(&v[..n], f32::to_le_bytes),
            Numbers::F64(v) => bytes(&v[..n], f64::to_le_bytes),
            Numbers::Text(v) => {
                let until_nul = |text: &&'a str| text.split('\0').next().unwrap_or_default();
                let ended = |text: &'a str| text.bytes().chain([0]);
                v[..n].iter().map(until_nul).flat_map(ended).collect()
            }
        }
    }
}

/// Numbers one after the other: as they lie in memory where that is what the file wants.
fn bytes<T: bytemuck::NoUninit, const SIZE: usize>(
    values: &[T],
    encode: impl Fn(T) -> [u8; SIZE],
) -> Cow<'_, [u8]> {
    if cfg!(target_endian = "little") {
        return Cow::Borrowed(bytemuck::cast_slice(values));
    }
    values.iter().flat_map(|&value| encode(value)).collect()
}
