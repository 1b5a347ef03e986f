//! Properties of an object, at their first sample.
//!
//! The samples of a property are the children of its group; the first sample's numbers are the
//! first child, whether or not the property is animated. A sample is a digest of 16 bytes and its
//! numbers behind that.

use ogawa_rs::{
    DataType, F32_TYPE, F32X2_TYPE, F32X3_TYPE, F32X4_TYPE, GroupChunk, I32_TYPE, ObjectReader,
    PodArray, PropertyHeader, PropertyReader,
};
use tress_geometry::Column;

use super::{Hierarchy, unreadable};
use crate::basis_curves::Rows;
use crate::{ParseError, Place, Problem};

/// Bytes of the digest.
const DIGEST: usize = 16;

/// The compound of this name among the properties of an object, as `.geom` of curves.
pub(super) fn of_object(
    hierarchy: &mut Hierarchy,
    object: &ObjectReader,
    name: &str,
) -> Result<Option<PropertyReader>, ParseError> {
    let place = Place::Part(object.header.full_name.clone());
    let Some(properties) = object.properties() else { return Ok(None) };
    match properties.find_sub_property_index(name) {
        Some(i) if i < properties.group.children.len() => properties
            .load_sub_property(i, &mut hierarchy.file, &hierarchy.archive)
            .map(Some)
            .map_err(|e| unreadable(place, &e)),
        _ => Ok(None),
    }
}

/// The property of this name in a compound; nothing in what is no compound.
pub(super) fn get(
    hierarchy: &mut Hierarchy,
    compound: &PropertyReader,
    name: &str,
    place: &Place,
) -> Result<Option<PropertyReader>, ParseError> {
    let PropertyReader::Compound(reader) = compound else { return Ok(None) };
    match reader.find_sub_property_index(name) {
        Some(i) if i < reader.group.children.len() => reader
            .load_sub_property(i, &mut hierarchy.file, &hierarchy.archive)
            .map(Some)
            .map_err(|e| unreadable(place.clone(), &e)),
        _ => Ok(None),
    }
}

/// The names in a compound, in the order of the file.
pub(super) fn names(compound: &PropertyReader) -> Vec<String> {
    match compound {
        PropertyReader::Compound(reader) => {
            reader.property_headers.iter().map(|header| header.name.clone()).collect()
        }
        _ => Vec::new(),
    }
}

/// Group and header of what is no compound.
fn leaf(property: &PropertyReader) -> Option<(&GroupChunk, &PropertyHeader)> {
    match property {
        PropertyReader::Array(reader) => Some((&reader.group, &reader.header)),
        PropertyReader::Scalar(reader) => Some((&reader.group, &reader.header)),
        PropertyReader::Compound(_) => None,
    }
}

/// The numbers of the first sample; nothing of a compound, without samples, or of booleans.
pub(super) fn sample(
    hierarchy: &mut Hierarchy,
    property: &PropertyReader,
    place: &Place,
) -> Result<Option<PodArray>, ParseError> {
    let Some((group, header)) = leaf(property) else { return Ok(None) };
    // ogawa-rs does not read booleans.
    if group.children.is_empty() || header.data_type == ogawa_rs::BOOL_TYPE {
        return Ok(None);
    }
    let file = &mut hierarchy.file;
    let data = group.load_data(file, 0).map_err(|e| unreadable(place.clone(), &e))?;
    if data.size <= DIGEST as u64 {
        return Ok(None);
    }
    data.read_pod_array(&header.data_type, file)
        .map(Some)
        .map_err(|e| unreadable(place.clone(), &e))
}

/// The first sample of a single boolean.
pub(super) fn flag(
    hierarchy: &mut Hierarchy,
    property: &PropertyReader,
    place: &Place,
) -> Result<Option<bool>, ParseError> {
    let Some((group, _)) = leaf(property).filter(|(group, _)| !group.children.is_empty()) else {
        return Ok(None);
    };
    let file = &mut hierarchy.file;
    let data = group.load_data(file, 0).map_err(|e| unreadable(place.clone(), &e))?;
    if data.size <= DIGEST as u64 {
        return Ok(None);
    }
    let mut sample = [0_u8; DIGEST + 1];
    data.read(0, file, &mut sample).map_err(|e| unreadable(place.clone(), &e))?;
    Ok(Some(sample[DIGEST] != 0))
}

/// A geometry parameter: its rows, looked up if it has indices, and what they stand for if it
/// says. Nothing where it is not of 32-bit integers or floats.
pub(super) fn column(
    hierarchy: &mut Hierarchy,
    property: &PropertyReader,
    place: &Place,
) -> Result<Option<(Column, Option<Rows>)>, ParseError> {
    let rows = scope(property);
    let Some(values) = get(hierarchy, property, ".vals", place)? else {
        return Ok(plain_column(hierarchy, property, place)?.map(|column| (column, rows)));
    };
    let Some(column) = plain_column(hierarchy, &values, place)? else { return Ok(None) };
    let indices = match get(hierarchy, property, ".indices", place)? {
        Some(indices) => sample(hierarchy, &indices, place)?,
        None => None,
    };
    let Some(PodArray::U32(indices)) = indices else { return Ok(Some((column, rows))) };
    let n = column.rows();
    let indices: Vec<usize> = indices.into_iter().map(|i| i as usize).collect();
    if indices.iter().any(|&i| n <= i) {
        let problem = Problem::unexpected(format!("indices below {n}"), "one outside");
        return Err(problem.at(place.clone()));
    }
    Ok(Some((column.select(indices), rows)))
}

fn plain_column(
    hierarchy: &mut Hierarchy,
    property: &PropertyReader,
    place: &Place,
) -> Result<Option<Column>, ParseError> {
    let Some((_, header)) = leaf(property) else { return Ok(None) };
    let Some(components) = components(&header.data_type) else { return Ok(None) };
    Ok(match sample(hierarchy, property, place)? {
        Some(PodArray::F32(values)) => {
            let values = values.into_iter().map(f64::from).collect();
            Some(Column::Float { components, values })
        }
        Some(PodArray::I32(values)) => {
            Some(Column::Int(values.into_iter().map(i64::from).collect()))
        }
        _ => None,
    })
}

/// Numbers in a row of the types that are read as columns; ogawa-rs keeps its fields to itself.
fn components(data_type: &DataType) -> Option<usize> {
    let known = [(F32_TYPE, 1), (F32X2_TYPE, 2), (F32X3_TYPE, 3), (F32X4_TYPE, 4), (I32_TYPE, 1)];
    known.into_iter().find(|(known, _)| known == data_type).map(|(_, components)| components)
}

fn scope(property: &PropertyReader) -> Option<Rows> {
    let meta_data = match property {
        PropertyReader::Array(reader) => &reader.header.meta_data,
        PropertyReader::Scalar(reader) => &reader.header.meta_data,
        PropertyReader::Compound(reader) => &reader.header.meta_data,
    };
    match meta_data.tokens.get("geoScope")?.as_str() {
        "con" => Some(Rows::Constant),
        "uni" => Some(Rows::Uniform),
        "var" => Some(Rows::Varying),
        "vtx" | "fvr" => Some(Rows::Vertex),
        _ => None,
    }
}
