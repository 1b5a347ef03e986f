//! AMD `TressFX`, `.tfx`: versions 1 to 4 are read, 4 is written.
//!
//! | version | |
//! |---|---|
//! | 1, 2 | text: a header of a word and its values a line, then strands of any number of points |
//! | 3 | binary: a header of 296 bytes, positions of three `f32`, all strands alike |
//! | 4 | binary: a header of 160 bytes, positions of four `f32`, 4, 8, 16, 32 or 64 a strand |
//!
//! The fourth number is an inverse mass: 0 for the first two points of a strand, which are held to
//! the head, and 1 for the others. Where a file says otherwise it becomes the attribute
//! `inverse_mass` of points. Thickness and texture coordinates of strands become `width` and `uv`,
//! colours `color` and `opacity`, texture coordinates of points `vertex_uv`.
//!
//! A text whose header scales, turns or moves the hair is an error: in which order it does so is
//! not said.

mod binary;
mod text;
mod write;

use tress_geometry::Groom;

use crate::{ParseError, Place, Problem};

pub use write::write;

/// Points that are held to the head where nothing else is said.
const HELD_POINTS: usize = 2;

/// Reads the bytes of a file.
///
/// ```
/// let text = "numStrands 1\nis sorted 1\nstrand 0 numVerts 2 texcoord 0 0\n0 0 0\n1 2 3\n";
/// let groom = tress_io::tfx::read(text.as_bytes())?;
/// assert_eq!(groom.strands().strand(0)[1], glam::DVec3::new(1.0, 2.0, 3.0));
/// # Ok::<(), tress_io::ParseError>(())
/// ```
///
/// # Errors
///
/// If the version is none of 1 to 4, if the counts do not match the size of the file, or if a
/// number is none.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    match bytes.first_chunk().map(|&version| f32::from_le_bytes(version)) {
        Some(3.0) => binary::read(&binary::VERSION_3, bytes),
        Some(4.0) => binary::read(&binary::VERSION_4, bytes),
        _ if bytes.first().is_some_and(u8::is_ascii_alphabetic) => text::read(bytes),
        _ => {
            let problem = Problem::unexpected("TressFX version 1 to 4", "other bytes");
            Err(problem.at(Place::Byte(0)))
        }
    }
}
