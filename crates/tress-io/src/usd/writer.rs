//! Writing `.usda`: one `BasisCurves` prim, streamed.

use std::io::{self, Write};

use tress_geometry::{Column, Groom, UpAxis};

use super::primvars::{Primvar, Rows, primvars};
use crate::widths::{Extent, Widths};
use crate::{EncodeError, UsdCurves};

/// Writes the stage.
pub(super) fn write(
    groom: &Groom,
    curves: UsdCurves,
    out: &mut impl Write,
) -> Result<(), EncodeError> {
    super::check_counts(groom)?;
    header(groom, out)?;
    out.write_all(b"def Xform \"groom\"\n{\n    def BasisCurves \"strands\"\n    {\n")?;
    match curves {
        UsdCurves::Linear => out.write_all(b"        uniform token type = \"linear\"\n")?,
        UsdCurves::CatmullRom => out.write_all(
            b"        uniform token type = \"cubic\"\n        \
              uniform token basis = \"catmullRom\"\n        \
              uniform token wrap = \"pinned\"\n",
        )?,
    }
    out.write_all(b"        int[] curveVertexCounts = [")?;
    list(out, groom.strands().counts(), |out, count| write!(out, "{count}"))?;
    out.write_all(b"]\n        point3f[] points = [\n")?;
    for strand in groom.strands().iter() {
        lines(out, strand.iter(), |out, point| tuple(out, &point.to_array()))?;
    }
    out.write_all(b"        ]\n")?;
    let widths = Widths::of(groom);
    if let Some((low, high)) = Extent::of(groom).with(&widths) {
        out.write_all(b"        float3[] extent = [")?;
        list(out, [low, high].into_iter(), |out, corner| tuple(out, &corner.to_array()))?;
        out.write_all(b"]\n")?;
    }
    write_widths(&widths, groom, out)?;
    for primvar in primvars(groom) {
        write_primvar(groom, &primvar, out)?;
    }
    out.write_all(b"    }\n}\n")?;
    Ok(())
}

fn header(groom: &Groom, out: &mut impl Write) -> io::Result<()> {
    out.write_all(b"#usda 1.0\n(\n    defaultPrim = \"groom\"\n")?;
    if let Some(metres) = groom.unit {
        writeln!(out, "    metersPerUnit = {metres:?}")?;
    }
    match groom.up {
        Some(UpAxis::Y) => out.write_all(b"    upAxis = \"Y\"\n")?,
        Some(UpAxis::Z) => out.write_all(b"    upAxis = \"Z\"\n")?,
        None => {}
    }
    out.write_all(b")\n\n")
}

/// Diameters, with what they are of.
fn write_widths(widths: &Widths<'_>, groom: &Groom, out: &mut impl Write) -> io::Result<()> {
    let (values, rows) = match widths {
        Widths::Constant(width) => (std::slice::from_ref(width), Rows::Constant),
        Widths::Uniform(values) => (*values, Rows::Uniform),
        Widths::Vertex(values) => (*values, Rows::Vertex),
    };
    out.write_all(b"        float[] widths = [")?;
    floats(groom, values, (1, 1), rows, out)?;
    out.write_all(b"]")?;
    metadata(out, rows, 1)
}

fn write_primvar(groom: &Groom, primvar: &Primvar<'_>, out: &mut impl Write) -> io::Result<()> {
    let Primvar { name, kind, size, column, rows } = primvar;
    write!(out, "        {}[] primvars:{name} = [", kind.name())?;
    match column {
        Column::Float { components, values } => {
            floats(groom, values, (components / size, *size), *rows, out)?;
        }
        Column::Int(values) => list(out, values.iter(), |out, i| write!(out, "{i}"))?,
    }
    out.write_all(b"]")?;
    metadata(out, *rows, *size)
}

fn metadata(out: &mut impl Write, rows: Rows, size: usize) -> io::Result<()> {
    out.write_all(b" (\n")?;
    if size != 1 {
        writeln!(out, "            elementSize = {size}")?;
    }
    writeln!(out, "            interpolation = \"{}\"\n        )", rows.name())
}

/// Items of `components` numbers each, `size` of them a row; rows of points get a line a strand.
fn floats(
    groom: &Groom,
    values: &[f64],
    (components, size): (usize, usize),
    rows: Rows,
    out: &mut impl Write,
) -> io::Result<()> {
    if rows != Rows::Vertex {
        return list(out, values.chunks_exact(components), tuple);
    }
    out.write_all(b"\n")?;
    let row = components * size;
    for i in 0..groom.strands().len() {
        let range = groom.strands().range(i);
        let items = values[range.start * row..range.end * row].chunks_exact(components);
        lines(out, items, tuple)?;
    }
    out.write_all(b"        ")
}

/// Items with commas between them.
fn list<W: Write, T>(
    out: &mut W,
    items: impl Iterator<Item = T>,
    mut write: impl FnMut(&mut W, T) -> io::Result<()>,
) -> io::Result<()> {
    for (i, item) in items.enumerate() {
        if i != 0 {
            out.write_all(b", ")?;
        }
        write(out, item)?;
    }
    Ok(())
}

/// Items with a comma behind each, on a line of their own if there are any.
fn lines<W: Write, T>(
    out: &mut W,
    items: impl ExactSizeIterator<Item = T>,
    write: impl FnMut(&mut W, T) -> io::Result<()>,
) -> io::Result<()> {
    if items.len() == 0 {
        return Ok(());
    }
    list(out, items, write)?;
    out.write_all(b",\n")
}

/// One number as it is, several in parentheses.
fn tuple(out: &mut impl Write, numbers: &[f64]) -> io::Result<()> {
    if let [number] = numbers {
        return float(out, *number);
    }
    out.write_all(b"(")?;
    list(out, numbers.iter(), |out, number| float(out, *number))?;
    out.write_all(b")")
}

/// The shortest decimal that reads back as the same 32-bit number.
fn float(out: &mut impl Write, number: f64) -> io::Result<()> {
    #[expect(clippy::cast_possible_truncation, reason = "USD's points have 32 bits")]
    let number = number as f32;
    let magnitude = number.abs();
    if number.is_nan() {
        out.write_all(b"nan")
    } else if magnitude == 0.0 || (1e-5..1e9).contains(&magnitude) || number.is_infinite() {
        write!(out, "{number}")
    } else {
        write!(out, "{number:e}")
    }
}
