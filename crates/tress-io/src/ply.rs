//! Stanford PLY with strands, `.ply`, ascii or binary of either byte order.
//!
//! How vertices make strands depends on what the file holds beside them:
//!
//! * an element `strand` with a property `nsegs` (hairutil): segments a strand, one fewer than
//!   points, vertices in order;
//! * an element `edge` with `vertex1` and `vertex2` alone: edges that share a vertex are joined as
//!   in [`obj`](crate::obj);
//! * neither, nor faces, but colours (NeuralHaircut): every 100 vertices are a strand, and have the
//!   same colour.
//!
//! `red green blue` become the attribute `color` of points, `alpha` becomes `opacity`; bytes are
//! 255ths. Everything else is passed over. Written are hairutil's elements, binary and
//! little-endian, with `f32` coordinates.

mod header;
pub(crate) mod mesh;
mod rows;
mod write;

use glam::DVec3;
use tress_geometry::{Attributes, Column, Groom, Strands, names};

use crate::binary::same;
use crate::chain::chains;
use crate::columns::misfit;
use crate::counts::{gather, too_many};
use crate::text::printed;
use crate::{ParseError, Place, Problem};

use header::Header;

pub(crate) use write::rounds_colors;
pub use write::write;

/// Points of a strand in files of `NeuralHaircut`.
const NEURAL_HAIRCUT_POINTS: usize = 100;

/// Reads the bytes of a file.
///
/// ```
/// let text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
///             property float z\nelement strand 1\nproperty ushort nsegs\nend_header\n\
///             0 0 0\n1 2 3\n1\n";
/// let groom = tress_io::ply::read(text.as_bytes())?;
/// assert_eq!(groom.strands().strand(0)[1], glam::DVec3::new(1.0, 2.0, 3.0));
/// # Ok::<(), tress_io::ParseError>(())
/// ```
///
/// # Errors
///
/// If the header is no PLY header or counts more than the file can hold, if a number is none, if
/// the segments do not make up the vertices, or if nothing says which vertices are a strand.
pub fn read(bytes: &[u8]) -> Result<Groom, ParseError> {
    let header = Header::read(bytes)?;
    let mut contents = Contents::new(&header)?;
    rows::for_each_row(&header, bytes, |element, row| contents.add(element, row))?;
    contents.into_groom()
}

/// A quantity: columns of an element, and the values read so far.
struct Quantity<const N: usize> {
    element: usize,
    columns: [usize; N],
    /// What the numbers are parts of: 255 for colours of 8 bits.
    whole: f64,
    values: Vec<[f64; N]>,
}

impl<const N: usize> Quantity<N> {
    /// The quantity, if the header has all its columns.
    fn find(header: &Header, element: &str, names: [&str; N]) -> Option<Self> {
        let element = header.elements.iter().position(|other| other.name == element)?;
        let properties = &header.elements[element].properties;
        let mut columns = [0; N];
        for (column, name) in columns.iter_mut().zip(names) {
            *column = properties.iter().position(|p| p.name == name && p.list.is_none())?;
        }
        Some(Self { element, columns, whole: 1.0, values: Vec::new() })
    }

    /// The same with whole numbers as parts of their type's greatest.
    fn in_parts(mut self, header: &Header) -> Self {
        let kinds =
            self.columns.map(|column| header.elements[self.element].properties[column].kind);
        self.whole = kinds.first().and_then(|kind| kind.greatest()).unwrap_or(1.0);
        self
    }

    fn add(&mut self, element: usize, row: &[f64]) {
        if element == self.element {
            self.values.push(self.columns.map(|column| row[column] / self.whole));
        }
    }

    /// A column of all values.
    fn into_column(self) -> Column {
        Column::Float { components: N, values: self.values.into_flattened() }
    }
}

/// What is read of a file.
struct Contents {
    positions: Quantity<3>,
    colors: Option<Quantity<3>>,
    opacities: Option<Quantity<1>>,
    segments: Option<Quantity<1>>,
    edges: Option<Quantity<2>>,
    is_mesh: bool,
}

impl Contents {
    fn new(header: &Header) -> Result<Self, ParseError> {
        let positions = Quantity::find(header, "vertex", ["x", "y", "z"]).ok_or_else(|| {
            let expected = "an element vertex with properties x, y and z";
            Problem::unexpected(expected, "none").at(Place::Line(header.lines))
        })?;
        let parts = |names| Some(Quantity::find(header, "vertex", names)?.in_parts(header));
        let alpha = Quantity::find(header, "vertex", ["alpha"]);
        Ok(Self {
            positions,
            colors: parts(["red", "green", "blue"]),
            opacities: alpha.map(|alpha| alpha.in_parts(header)),
            segments: Quantity::find(header, "strand", ["nsegs"]),
            edges: Quantity::find(header, "edge", ["vertex1", "vertex2"]),
            is_mesh: header
                .elements
                .iter()
                .any(|element| element.name == "face" && 0 < element.rows),
        })
    }

    fn add(&mut self, element: usize, row: &[f64]) {
        self.positions.add(element, row);
        for quantity in [&mut self.opacities, &mut self.segments].into_iter().flatten() {
            quantity.add(element, row);
        }
        if let Some(colors) = &mut self.colors {
            colors.add(element, row);
        }
        if let Some(edges) = &mut self.edges {
            edges.add(element, row);
        }
    }

    fn into_groom(mut self) -> Result<Groom, ParseError> {
        let edges = self.edges.take().map(|edges| edges.values);
        let n = self.positions.values.len();
        let (strands, attributes) = if let Some(segments) = self.segments.take() {
            (self.cut(&segments.values, edges.as_ref().map(Vec::len))?, self.attributes(n)?)
        } else if let Some(edges) = edges {
            self.join(&edges)?
        } else if self.is_mesh {
            return Err(Problem::unexpected("strands", "a mesh").at(Place::File));
        } else {
            (self.hundreds()?, self.attributes(n)?)
        };
        let per_strand = Attributes::new(strands.len());
        Groom::with_attributes(strands, attributes, per_strand)
            .map_err(|error| Problem::Unsupported(error.to_string()).at(Place::File))
    }

    /// Strands of so many segments each.
    fn cut(
        &mut self,
        segments: &[[f64; 1]],
        edges: Option<usize>,
    ) -> Result<Strands<DVec3>, ParseError> {
        let strand = || Place::Part("element strand".into());
        let mut counts = Vec::with_capacity(segments.len());
        for (i, &[n]) in segments.iter().enumerate() {
            let problem = || Problem::unexpected("a number of segments", printed(n));
            let n = whole(n).ok_or_else(|| problem().at(strand()).in_strand(i))?;
            counts.push(n as usize + 1);
        }
        let (vertices, sum) = (self.positions.values.len(), counts.iter().sum::<usize>());
        if sum != vertices {
            let expected = format!("segments that make up {vertices} vertices");
            let problem = Problem::unexpected(expected, format!("segments of {sum}"));
            return Err(problem.at(strand()));
        }
        let expected = vertices - counts.len();
        if let Some(edges) = edges.filter(|&edges| edges != expected) {
            let problem = Problem::unexpected(format!("{expected} edges"), edges.to_string());
            return Err(problem.at(Place::Part("element edge".into())));
        }
        Strands::from_counts(counts, self.points()).map_err(too_many)
    }

    /// Strands of edges that share a vertex, and the attributes of their points.
    fn join(&mut self, edges: &[[f64; 2]]) -> Result<(Strands<DVec3>, Attributes), ParseError> {
        let points = self.points();
        let mut ends = Vec::with_capacity(edges.len());
        for (i, edge) in edges.iter().enumerate() {
            let place = || Place::Part(format!("edge {i}"));
            let end = |value| vertex(value, points.len()).map_err(|problem| problem.at(place()));
            ends.push([end(edge[0])?, end(edge[1])?]);
        }
        let strands = chains(points.len(), ends.iter().map(<[u32; 2]>::as_slice));
        let strands = strands.map_err(too_many)?;
        let vertices = || strands.points().iter().map(|&i| i as usize);
        let attributes = self.attributes(points.len())?;
        let attributes = attributes.map(vertices().len(), |column| column.select(vertices()));
        Ok((gather(strands, points)?, attributes))
    }

    /// Strands of a hundred vertices of one colour.
    fn hundreds(&mut self) -> Result<Strands<DVec3>, ParseError> {
        const N: usize = NEURAL_HAIRCUT_POINTS;
        let n = self.positions.values.len();
        let expected =
            || format!("an element strand or edge, or {N} vertices of one colour a strand");
        let Some(colors) = &self.colors else {
            return Err(Problem::unexpected(expected(), "a cloud of points").at(Place::File));
        };
        if !n.is_multiple_of(N) {
            return Err(Problem::unexpected(expected(), format!("{n} vertices")).at(Place::File));
        }
        let alike = |colors: &[[f64; 3]]| colors.iter().all(|&color| same(color, colors[0]));
        if let Some(i) = colors.values.chunks(N).position(|colors| !alike(colors)) {
            let problem = Problem::unexpected(expected(), "other colours");
            return Err(problem.at(Place::File).in_strand(i));
        }
        Strands::from_counts(std::iter::repeat_n(N, n / N), self.points()).map_err(too_many)
    }

    fn points(&mut self) -> Vec<DVec3> {
        std::mem::take(&mut self.positions.values).into_iter().map(DVec3::from_array).collect()
    }

    fn attributes(&mut self, vertices: usize) -> Result<Attributes, ParseError> {
        let mut attributes = Attributes::new(vertices);
        if let Some(colors) = self.colors.take() {
            attributes.insert(names::COLOR, colors.into_column()).map_err(misfit)?;
        }
        if let Some(opacities) = self.opacities.take() {
            attributes.insert(names::OPACITY, opacities.into_column()).map_err(misfit)?;
        }
        Ok(attributes)
    }
}

/// A whole number that may count or name vertices.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked just before")]
fn whole(value: f64) -> Option<u32> {
    let fits = value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value);
    fits.then_some(value as u32)
}

/// The index of one of so many vertices.
fn vertex(value: f64, vertices: usize) -> Result<u32, Problem> {
    let there = whole(value).filter(|&i| (i as usize) < vertices);
    let expected = || format!("the index of one of {vertices} vertices");
    there.ok_or_else(|| Problem::unexpected(expected(), printed(value)))
}
