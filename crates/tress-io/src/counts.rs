//! Strands put together one after the other, and counts as files hold them.

use glam::DVec3;
use tress_geometry::{OffsetsError, Strands};

use crate::{EncodeError, ParseError, Place, Problem};

/// Strands under construction.
pub(crate) struct Builder {
    // Invariant: what `Strands` asks of them.
    offsets: Vec<u32>,
    points: Vec<DVec3>,
}

impl Builder {
    /// None yet, with room for so many.
    pub(crate) fn with_room(strands: usize, points: usize) -> Self {
        let mut offsets = Vec::with_capacity(strands + 1);
        offsets.push(0);
        Self { offsets, points: Vec::with_capacity(points) }
    }

    /// Adds a strand.
    pub(crate) fn push(&mut self, points: impl Iterator<Item = DVec3>) -> Result<(), ParseError> {
        self.points.extend(points);
        let points = self.points.len();
        let end = u32::try_from(points).map_err(|_| too_many(OffsetsError::TooMany { points }))?;
        self.offsets.push(end);
        Ok(())
    }

    /// All strands.
    pub(crate) fn finish(self) -> Result<Strands<DVec3>, ParseError> {
        Strands::new(self.offsets, self.points).map_err(too_many)
    }
}

/// A cut that is no set of strands, as an error of the whole file.
pub(crate) fn too_many(error: OffsetsError) -> ParseError {
    Problem::Unsupported(error.to_string()).at(Place::File)
}

/// A count as a signed 32-bit number.
pub(crate) fn signed_count(count: usize) -> Result<i32, EncodeError> {
    i32::try_from(count).map_err(|_| {
        EncodeError::Groom(format!("{count} is more than the 2,147,483,647 that a count may be"))
    })
}

/// The strands of these vertices; vertices that are in order already are taken as they are.
pub(crate) fn gather(
    strands: Strands<u32>,
    vertices: Vec<DVec3>,
) -> Result<Strands<DVec3>, ParseError> {
    let (offsets, indices) = strands.into_parts();
    let in_order = indices.len() == vertices.len() && (0..).eq(indices.iter().copied());
    let points =
        if in_order { vertices } else { indices.iter().map(|&i| vertices[i as usize]).collect() };
    Strands::new(offsets, points).map_err(too_many)
}
