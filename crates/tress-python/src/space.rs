//! The unit and the up axis, as people say them.

use pyo3::prelude::*;
use tress::geometry::UpAxis;

use crate::error::TressError;

/// A unit of length: `"mm"`, `"cm"`, `"m"`, `"in"`, `"ft"`, or metres.
#[derive(Debug, FromPyObject)]
pub(crate) enum Unit {
    Metres(f64),
    Name(String),
}

impl Unit {
    /// Metres in one unit of length.
    pub(crate) fn metres(&self) -> PyResult<f64> {
        match self {
            Self::Metres(metres) if 0.0 < *metres && metres.is_finite() => Ok(*metres),
            Self::Metres(metres) => {
                Err(TressError::new_err(format!("unit: {metres} is no length in metres")))
            }
            Self::Name(name) => match name.as_str() {
                "mm" => Ok(0.001),
                "cm" => Ok(0.01),
                "m" => Ok(1.0),
                "in" => Ok(0.0254),
                "ft" => Ok(0.3048),
                _ => Err(TressError::new_err(format!(
                    "unit: expected mm, cm, m, in, ft, or a number of metres, found {name:?}"
                ))),
            },
        }
    }
}

/// Metres and up axis from what a caller said of them.
pub(crate) fn space(
    unit: Option<&Unit>,
    up: Option<&str>,
) -> PyResult<(Option<f64>, Option<UpAxis>)> {
    Ok((unit.map(Unit::metres).transpose()?, up.map(up_axis).transpose()?))
}

/// The axis of a letter.
pub(crate) fn up_axis(letter: &str) -> PyResult<UpAxis> {
    match letter {
        "y" | "Y" => Ok(UpAxis::Y),
        "z" | "Z" => Ok(UpAxis::Z),
        _ => Err(TressError::new_err(format!("up: expected \"y\" or \"z\", found {letter:?}"))),
    }
}

/// The letter of an axis.
pub(crate) fn letter(up: UpAxis) -> &'static str {
    match up {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    }
}
