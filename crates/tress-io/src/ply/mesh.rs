//! The faces of a PLY file.

use glam::DVec3;

use super::header::Header;
use super::rows;
use crate::mesh::Faces;
use crate::{ParseError, Place, Problem};

/// Reads vertices, faces and the property `density` of either.
pub(crate) fn read(bytes: &[u8]) -> Result<Faces, ParseError> {
    let header = Header::read(bytes)?;
    let element = |name| header.elements.iter().position(|element| element.name == name);
    let missing = |what: &str| Problem::unexpected(what, "none").at(Place::Line(header.lines));
    let vertex = element("vertex").ok_or_else(|| missing("an element vertex"))?;
    let face = element("face").ok_or_else(|| missing("an element face"))?;
    let column = |element: usize, name: &str| {
        let properties = &header.elements[element].properties;
        properties.iter().position(|p| p.name == name && p.list.is_none())
    };
    let axes = ["x", "y", "z"].map(|axis| column(vertex, axis));
    let [Some(x), Some(y), Some(z)] = axes else {
        return Err(missing("an element vertex with properties x, y and z"));
    };
    let densities = [vertex, face].map(|element| (element, column(element, "density")));
    let mut faces = Faces::default();
    rows::for_each_row_and_list(&header, bytes, |element, row, items| {
        if element == vertex {
            faces.positions.push(DVec3::new(row[x], row[y], row[z]));
        }
        for (of, density) in densities {
            if let (true, Some(column)) = (of == element, density) {
                let values =
                    if of == vertex { &mut faces.of_vertices } else { &mut faces.of_faces };
                values.push(row[column]);
            }
        }
        if element == face {
            // Numbers that are no indices are found out when the mesh is made.
            faces.add(items.iter().map(|item| index(*item)));
        }
    })?;
    Ok(faces)
}

/// A vertex by its number in the file; one that is none is past all others.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked just before")]
fn index(value: f64) -> u32 {
    let is_index = value.fract() == 0.0 && (0.0..4294967295.0).contains(&value);
    if is_index { value as u32 } else { u32::MAX }
}
