//! What the tests of formats share: every format as a pair of functions on bytes, and grooms of
//! every kind.

use std::io::Cursor;

use glam::DVec3;
use tress_geometry::{Column, Groom, Strands, names};
use tress_io::{EncodeError, Format, ParseError, ct2hair, data, hair, npy, npz, obj, ply, tfx};

/// The formats of polylines that this file knows as functions on bytes.
pub(crate) const FORMATS: [Format; 8] = [
    Format::Obj,
    Format::Hair,
    Format::Data,
    Format::Bin,
    Format::Ply,
    Format::Tfx,
    Format::Npy,
    Format::Npz,
];

/// Writes a groom to bytes.
pub(crate) fn encode(format: Format, groom: &Groom) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    match format {
        Format::Obj => obj::write(groom, &mut out),
        Format::Hair => hair::write(groom, &mut out),
        Format::Data => data::write(groom, &mut out),
        Format::Bin => ct2hair::write(groom, &mut out),
        Format::Ply => ply::write(groom, &mut out),
        Format::Tfx => tfx::write(groom, &mut out),
        Format::Npy => npy::write(groom, &mut out),
        Format::Npz => {
            let mut seekable = Cursor::new(Vec::new());
            let written = npz::write(groom, &mut seekable);
            out = seekable.into_inner();
            written
        }
        _ => panic!("{format} is not one of `FORMATS`"),
    }?;
    Ok(out)
}

/// Reads a groom from bytes.
pub(crate) fn decode(format: Format, bytes: &[u8]) -> Result<Groom, ParseError> {
    match format {
        Format::Obj => obj::read(bytes),
        Format::Hair => hair::read(bytes),
        Format::Data => data::read(bytes),
        Format::Bin => ct2hair::read(bytes),
        Format::Ply => ply::read(bytes),
        Format::Tfx => tfx::read(bytes),
        Format::Npy => npy::read(bytes),
        Format::Npz => npz::read(bytes),
        _ => panic!("{format} is not one of `FORMATS`"),
    }
}

/// Strands of points that are nothing special.
pub(crate) fn strands(counts: &[usize]) -> Strands<DVec3> {
    let n = counts.iter().sum::<usize>();
    let points = (0..n).map(|i| DVec3::new(i as f64, 0.5, -0.25 * i as f64)).collect();
    Strands::from_counts(counts.iter().copied(), points).expect("the counts' own sum")
}

/// A groom with everything that `format` has a place for.
pub(crate) fn full_groom(format: Format) -> Groom {
    let counts: &[usize] = match format {
        Format::Tfx => &[4, 4, 4],
        Format::Npy => &[3, 3],
        _ => &[3, 1, 2],
    };
    let mut groom = Groom::new(strands(counts));
    let (n, m) = (groom.strands().points().len(), groom.strands().len());
    let ramp = |rows: usize, components: usize| Column::Float {
        components,
        values: (0..rows * components).map(|i| (i % 4) as f64 / 51.0).collect(),
    };
    let mut add = |name: &str, components, strand_too: bool| {
        let carries = format.carries();
        if carries.point_columns.hold(name, components) {
            groom.insert_point_attribute(name, ramp(n, components)).expect("a row a point");
        } else if strand_too && carries.strand_columns.hold(name, components) {
            groom.insert_strand_attribute(name, ramp(m, components)).expect("a row a strand");
        }
    };
    for (name, components) in [
        (names::WIDTH, 1),
        (names::OPACITY, 1),
        (names::COLOR, 3),
        (names::ROOT_UV, 2),
        ("normal", 3),
        ("label", 1),
        ("inverse_mass", 1),
        ("vertex_uv", 2),
    ] {
        add(name, components, true);
    }
    groom
}
