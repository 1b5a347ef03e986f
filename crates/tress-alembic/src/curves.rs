//! The arrays of a sample of curves: whether they match, and what is said of them.

use crate::archive::check_name;
use crate::error::Error;
use crate::schema::{CurvesSample, Parameter, Scope};
use crate::values::{Numbers, Values};

/// An array of a sample of curves, as a property.
pub(crate) struct Array<'a> {
    pub(crate) name: &'a str,
    pub(crate) meta_data: String,
    pub(crate) values: Values<'a>,
    /// Whether it is one of any name, which lies with the others of its kind.
    pub(crate) is_parameter: bool,
}

/// The arrays of a sample, in the order in which they are written.
pub(crate) fn arrays<'a>(sample: &CurvesSample<'a>) -> Vec<Array<'a>> {
    let own = |name, meta_data, values| Array { name, meta_data, values, is_parameter: false };
    let points = Values::points(sample.points);
    let counts = Values::scalars(Numbers::I32(sample.counts));
    let mut arrays = vec![
        own("P", points.meta_data(Scope::Vertex), points),
        own("nVertices", String::new(), counts),
    ];
    if let Some((scope, widths)) = sample.widths {
        let widths = Values::scalars(Numbers::F32(widths));
        arrays.push(own("width", widths.parameter_meta_data(scope), widths));
    }
    if let Some((scope, uvs)) = sample.uvs {
        let uvs = Values::rows(Numbers::F32(uvs.as_flattened()), 2);
        arrays.push(own("uv", uvs.parameter_meta_data(scope), uvs));
    }
    arrays.extend(sample.parameters.iter().map(|&Parameter { name, scope, values }| {
        let meta_data = values.parameter_meta_data(scope);
        Array { name, meta_data, values, is_parameter: true }
    }));
    arrays
}

/// Whether counts, points and rows of parameters match.
pub(crate) fn check(sample: &CurvesSample<'_>) -> Result<(), Error> {
    let (curves, points) = (sample.counts.len(), sample.points.len());
    let sizes = sample.counts.iter().map(|&count| usize::try_from(count).unwrap_or(0));
    let counted = sizes.fold(0, usize::saturating_add);
    if counted != points || sample.counts.iter().any(|&count| count < 0) {
        return Err(Error::Counts { counted, points });
    }
    let check = |name: &str, scope: Scope, rows: usize| {
        let expected = match scope {
            Scope::Constant => rows,
            Scope::Uniform => curves,
            Scope::Vertex => points,
        };
        let error = || Error::Rows { name: name.into(), rows, expected };
        if rows == expected { Ok(()) } else { Err(error()) }
    };
    if let Some((scope, widths)) = sample.widths {
        check("width", scope, widths.len())?;
    }
    if let Some((scope, uvs)) = sample.uvs {
        check("uv", scope, uvs.len())?;
    }
    for (i, parameter) in sample.parameters.iter().enumerate() {
        check_name(parameter.name)?;
        if sample.parameters[..i].iter().any(|other| other.name == parameter.name) {
            return Err(Error::Taken(parameter.name.into()));
        }
        check(parameter.name, parameter.scope, parameter.values.len())?;
    }
    Ok(())
}
