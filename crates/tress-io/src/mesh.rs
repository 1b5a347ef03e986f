//! Triangle meshes, `.obj` and `.ply`: the scalp that roots are scattered on.
//!
//! Of an `.obj` the `v` and `f` lines are read, of a `.ply` (ascii or binary) the elements `vertex`
//! and `face`, and the property `density` of either where there is one. Faces of more than three
//! corners become fans of triangles; everything else is passed over.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use glam::DVec3;
use tress_geometry::Mesh;

use crate::text::{Lines, integer, point, quoted, words};
use crate::{Format, ParseError, Place, Problem, ReadError, ply};

/// A mesh and how dense hair is to stand on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scalp {
    /// The mesh.
    pub mesh: Mesh,
    /// The property `density` of vertices, where the file has it.
    pub vertex_density: Option<Vec<f64>>,
    /// The property `density` of faces, for each triangle, where the file has it.
    pub face_density: Option<Vec<f64>>,
}

/// Reads a mesh; the extension, `.obj` or `.ply`, names its format.
///
/// # Errors
///
/// If the extension is another, the file cannot be opened, or it holds no mesh.
pub fn read(path: impl AsRef<Path>) -> Result<Scalp, ReadError> {
    let path = path.as_ref();
    let format = Format::from_path(path);
    if !matches!(format, Ok(Format::Obj | Format::Ply)) {
        return Err(ReadError::NotAMesh { path: path.into() });
    }
    let file = File::open(path).map_err(|source| ReadError::Open { path: path.into(), source })?;
    let scalp = if format == Ok(Format::Obj) {
        read_obj(BufReader::with_capacity(1 << 16, file))
    } else {
        contents(file).and_then(|bytes| read_ply(&bytes))
    };
    scalp.map_err(|source| ReadError::Parse { path: path.into(), source })
}

fn contents(mut file: File) -> Result<Vec<u8>, ParseError> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads the text of an `.obj` file.
///
/// ```
/// let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/1 3/1 -1/1\n";
/// let scalp = tress_io::mesh::read_obj(square.as_bytes())?;
/// assert_eq!(scalp.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
/// # Ok::<(), tress_io::ParseError>(())
/// ```
///
/// # Errors
///
/// If a number is none, if a face names a vertex that is not there, or if there are no faces.
pub fn read_obj(text: impl BufRead) -> Result<Scalp, ParseError> {
    let mut lines = Lines::new(text);
    let mut faces = Faces::default();
    while let Some((line, statement)) = lines.next_statement()? {
        let mut words = words(statement);
        let done = match words.next() {
            Some(b"v") => point(&mut words).map(|position| faces.positions.push(position)),
            Some(b"f") => corners(words, faces.positions.len()).map(|face| faces.add(face)),
            _ => Ok(()),
        };
        done.map_err(|problem| problem.at(Place::Line(line)))?;
    }
    faces.into_scalp()
}

/// Reads the bytes of a `.ply` file.
///
/// # Errors
///
/// If the header is none, if the rows do not match it, or if a face names a vertex that is not
/// there.
pub fn read_ply(bytes: &[u8]) -> Result<Scalp, ParseError> {
    ply::mesh::read(bytes)?.into_scalp()
}

/// The vertices, from 0, of an `f` line.
fn corners<'a>(
    words: impl Iterator<Item = &'a [u8]>,
    n_vertices: usize,
) -> Result<Vec<u32>, Problem> {
    let corner = |word: &[u8]| {
        let vertex = word.split(|&byte| byte == b'/').next().unwrap_or(word);
        let index: i64 = integer(vertex, "a vertex index")?;
        let behind = if index < 0 { n_vertices as i64 } else { -1 };
        let from_zero = behind.checked_add(index).and_then(|i| u32::try_from(i).ok());
        from_zero.ok_or_else(|| Problem::unexpected("a vertex index", quoted(vertex)))
    };
    words.map(corner).collect()
}

/// What is read of a file.
#[derive(Default)]
pub(crate) struct Faces {
    pub(crate) positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The face that each triangle is of.
    faces: Vec<usize>,
    n_faces: usize,
    pub(crate) of_vertices: Vec<f64>,
    pub(crate) of_faces: Vec<f64>,
}

impl Faces {
    /// Adds a face as a fan of triangles.
    pub(crate) fn add(&mut self, corners: impl IntoIterator<Item = u32>) {
        let mut corners = corners.into_iter();
        if let (Some(first), Some(mut before)) = (corners.next(), corners.next()) {
            for next in corners {
                self.triangles.push([first, before, next]);
                self.faces.push(self.n_faces);
                before = next;
            }
        }
        self.n_faces += 1;
    }

    fn into_scalp(self) -> Result<Scalp, ParseError> {
        if self.triangles.is_empty() {
            return Err(
                Problem::unexpected("faces of three corners or more", "none").at(Place::File)
            );
        }
        let of_faces = self.faces.iter().filter_map(|face| self.of_faces.get(*face).copied());
        let face_density: Vec<f64> = of_faces.collect();
        let mesh = Mesh::new(self.positions, self.triangles);
        let mesh = mesh.map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))?;
        let given = |values: Vec<f64>| (!values.is_empty()).then_some(values);
        Ok(Scalp {
            mesh,
            vertex_density: given(self.of_vertices),
            face_density: given(face_density),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASCII: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n\
        property float y\nproperty float z\nproperty float density\nelement face 2\n\
        property list uchar int vertex_indices\nproperty double density\nend_header\n\
        0 0 0 1\n1 0 0 1\n1 1 0 0.5\n0 1 0 0\n3 0 1 2 7\n4 0 1 2 3 9\n";

    fn binary() -> Vec<u8> {
        let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n\
            property float y\nproperty float z\nelement face 1\n\
            property list uchar uint vertex_indices\nend_header\n";
        let mut bytes = header.as_bytes().to_vec();
        for value in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.push(3);
        [0_u32, 1, 2].into_iter().for_each(|i| bytes.extend(i.to_le_bytes()));
        bytes
    }

    #[test]
    fn faces_become_fans_and_densities_follow_them() {
        let scalp = read_ply(ASCII.as_bytes()).expect("a mesh");
        assert_eq!(scalp.mesh.triangles(), [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
        assert_eq!(scalp.vertex_density, Some(vec![1.0, 1.0, 0.5, 0.0]));
        assert_eq!(scalp.face_density, Some(vec![7.0, 9.0, 9.0]));
        let scalp = read_ply(&binary()).expect("a mesh");
        assert_eq!(scalp.mesh.triangles(), [[0, 1, 2]]);
        assert!((scalp.mesh.area(0) - 0.5).abs() < 1e-15);
        assert_eq!((scalp.vertex_density, scalp.face_density), (None, None));
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        let problem = |text: &str| read_obj(text.as_bytes()).expect_err("no mesh").to_string();
        assert_eq!(problem("v 0 0 0\n"), "expected faces of three corners or more, found none");
        assert!(problem("v 0 0 0\nf 1 1 2\n").contains("corner 1, but there are 1 positions"));
        assert_eq!(problem("f 1 2 x\n"), "line 1: expected a vertex index, found \"x\"");
        assert_eq!(problem("f 1 2 -1\n"), "line 1: expected a vertex index, found \"-1\"");
        assert!(read_ply(&ASCII.as_bytes()[..ASCII.len() - 6]).is_err());
        assert!(read_ply(ASCII.replace("3 0 1 2 7", "3 0 1 2.5 7").as_bytes()).is_err());
        let bytes = binary();
        for end in 0..bytes.len() {
            assert!(read_ply(&bytes[..end]).is_err(), "{end}");
        }
        assert!(read("hair.tfx").is_err() && read("nowhere.ply").is_err());
    }
}
