//! Pictures as arrays of pixels.

use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde::Deserialize;
use tress::view::{
    ColorMap, Coloring, HairColor, RenderOptions, RgbImage, Scale, Size, StrandWidth, View, png,
};

use crate::arrays::{Shaped, integers, misshapen, scalars};
use crate::error::{TressError, refused};
use crate::groom::Groom;

/// The keywords of [`render`].
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct RenderKeywords {
    view: From,
    size: (u32, u32),
    hair: Option<[u8; 3]>,
    melanin: Option<f32>,
    redness: f32,
    width: Option<f64>,
    background: Option<[u8; 3]>,
    margin: f64,
    range: Option<(f64, f64)>,
    title: String,
    unit: String,
    colors: Colors,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum From {
    Front,
    Side,
    Back,
    Top,
    ThreeQuarter,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Colors {
    Viridis,
    Cividis,
    BlueRed,
    PurpleGreen,
    Cyclic,
}

impl Default for RenderKeywords {
    fn default() -> Self {
        let RenderOptions { size, margin, .. } = RenderOptions::default();
        Self {
            view: From::Front,
            size: (size.width, size.height),
            hair: None,
            melanin: None,
            redness: 0.1,
            width: None,
            background: None,
            margin,
            range: None,
            title: String::new(),
            unit: String::new(),
            colors: Colors::Viridis,
        }
    }
}

impl RenderKeywords {
    fn options(&self) -> PyResult<RenderOptions> {
        let defaults = RenderOptions::default();
        let hair = match (self.hair, self.melanin) {
            (None, None) => defaults.hair,
            (Some(dye), None) => HairColor::Dyed(dye),
            (None, Some(amount)) => HairColor::Melanin { amount, redness: self.redness },
            (Some(_), Some(_)) => {
                return Err(PyTypeError::new_err("expected hair or melanin, not both"));
            }
        };
        let view = match self.view {
            From::Front => View::Front,
            From::Side => View::Side,
            From::Back => View::Back,
            From::Top => View::Top,
            From::ThreeQuarter => View::ThreeQuarter,
        };
        Ok(RenderOptions {
            view,
            size: Size::new(self.size.0, self.size.1),
            hair,
            width: self.width.map_or(StrandWidth::Auto, StrandWidth::Fixed),
            background: self.background.unwrap_or(defaults.background),
            value_background: self.background.unwrap_or(defaults.value_background),
            margin: self.margin,
        })
    }

    fn scale(&self, values: &[f64]) -> Scale {
        let map = match self.colors {
            Colors::Viridis => ColorMap::Viridis,
            Colors::Cividis => ColorMap::Cividis,
            Colors::BlueRed => ColorMap::BlueRed,
            Colors::PurpleGreen => ColorMap::PurpleGreen,
            Colors::Cyclic => ColorMap::Cyclic,
        };
        let mut scale = Scale::without_strays(values.iter().copied(), 0.01);
        if let Some((min, max)) = self.range {
            (scale.min, scale.max) = (min, max);
        } else if map.is_diverging() {
            scale = scale.symmetric();
        }
        Scale { title: self.title.clone(), unit: self.unit.clone(), map, ..scale }
    }
}

/// Draws a groom as hair.
///
/// Args:
///     groom: The polylines.
///     values: Numbers that colour the hair, one a strand or one a point; NaN is grey.
///     view: "front", "side", "back", "top" or "three-quarter".
///     size: Pixels across and down.
///     hair: A colour, as three numbers from 0 to 255; or
///     melanin, redness: as grown: 0 white, 0.2 blond, 0.5 dark brown, 1 black; and the red share.
///     width: The hair's diameter in the groom's unit; its own, or a sensible one, where None.
///     background: What is seen where there is no hair, as three numbers from 0 to 255.
///     margin: The share of the picture that is left free around the groom.
///     range: The values at the ends of the colours; all but strays where None.
///     title, unit: Words of the legend.
///     colors: "viridis", "cividis", "blue-red", "purple-green" or "cyclic".
///
/// Returns:
///     Pixels, (height, width, 3) uint8.
#[pyfunction]
#[pyo3(signature = (groom, values=None, **options),
       text_signature = "(groom, values=None, *, view='front', size=(1200, 1200), hair=None, \
                         melanin=None, redness=0.1, width=None, background=None, margin=0.05, \
                         range=None, title='', unit='', colors='viridis')")]
pub(crate) fn render<'py>(
    py: Python<'py>,
    groom: &Bound<'_, Groom>,
    values: Option<&Bound<'_, PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let keywords: RenderKeywords = crate::plain::options(options)?;
    let options = keywords.options()?;
    let values = values.map(|values| scalars(values, "values")).transpose()?;
    let scale = keywords.scale(values.as_deref().unwrap_or_default());
    let groom = &groom.get().0;
    let coloring = match &values {
        None => Coloring::Natural,
        Some(values) if values.len() == groom.strands().len() => Coloring::Strands(values, &scale),
        Some(values) => Coloring::Points(values, &scale),
    };
    let image = py.detach(|| tress::view::render(groom, &coloring, &options)).map_err(refused)?;
    let (width, height) = image.dimensions();
    image.into_raw().into_pyarray(py).reshape([height as usize, width as usize, 3])
}

/// The bytes of a PNG file that holds a picture.
///
/// Args:
///     pixels: (height, width, 3) whole numbers from 0 to 255.
#[pyfunction]
#[pyo3(name = "png")]
pub(crate) fn encode<'py>(
    py: Python<'py>,
    pixels: &Bound<'_, PyAny>,
) -> PyResult<Bound<'py, PyBytes>> {
    let Shaped { shape, values } = integers(pixels, "pixels")?;
    let side = |n: usize| u32::try_from(n).map_err(refused);
    let [height, width, 3] = shape[..] else {
        return Err(misshapen("pixels", "(height, width, 3)", &shape));
    };
    let byte = |value: i64| {
        u8::try_from(value).map_err(|_| TressError::new_err("pixels: expected 0 to 255"))
    };
    let bytes = values.into_iter().map(byte).collect::<PyResult<Vec<u8>>>()?;
    let image = RgbImage::from_raw(side(width)?, side(height)?, bytes)
        .ok_or_else(|| TressError::new_err("pixels: more than a picture holds"))?;
    Ok(PyBytes::new(py, &py.detach(|| png(&image)).map_err(refused)?))
}
