//! Writing `.usda`: one `BasisCurves` prim, streamed.

use std::collections::BTreeSet;
use std::io::{self, Write};

use glam::DVec3;
use tress_geometry::{Column, Groom, UpAxis, names};

use crate::{EncodeError, UsdCurves};

/// Diameter of a hair that says nothing of it, in metres: between fine (0.05 mm) and thick
/// (0.12 mm) hair.
const HAIR: f64 = 1e-4;
/// The same over the diagonal of the box around a groom, where the unit is unknown: a head of
/// hair is some 0.4 m across.
const HAIR_OVER_SIZE: f64 = 1.0 / 4000.0;

/// Writes the stage.
pub(super) fn write(
    groom: &Groom,
    curves: UsdCurves,
    out: &mut impl Write,
) -> Result<(), EncodeError> {
    check_counts(groom)?;
    let extent = Extent::of(groom);
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
    let widths = Widths::of(groom, &extent);
    if let Some((low, high)) = extent.with(&widths) {
        out.write_all(b"        float3[] extent = [")?;
        list(out, [low, high].into_iter(), |out, corner| tuple(out, &corner.to_array()))?;
        out.write_all(b"]\n")?;
    }
    widths.write(groom, out)?;
    primvars(groom, out)?;
    out.write_all(b"    }\n}\n")?;
    Ok(())
}

fn check_counts(groom: &Groom) -> Result<(), EncodeError> {
    match groom.strands().counts().position(|count| i32::try_from(count).is_err()) {
        Some(strand) => Err(EncodeError::Strand {
            strand,
            reason: "has more points than USD can count (2,147,483,647)".into(),
        }),
        None => Ok(()),
    }
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

/// The box around the finite points, if there are any.
struct Extent(Option<(DVec3, DVec3)>);

impl Extent {
    fn of(groom: &Groom) -> Self {
        let finite = groom.strands().points().iter().filter(|point| point.is_finite());
        Self(finite.fold(None, |extent: Option<(DVec3, DVec3)>, &point| {
            let (low, high) = extent.unwrap_or((point, point));
            Some((low.min(point), high.max(point)))
        }))
    }

    fn size(&self) -> f64 {
        self.0.map_or(0.0, |(low, high)| low.distance(high))
    }

    /// The box with half the greatest width around it.
    fn with(&self, widths: &Widths<'_>) -> Option<(DVec3, DVec3)> {
        let margin = 0.5 * widths.greatest();
        self.0.map(|(low, high)| (low - margin, high + margin))
    }
}

/// What an array has a row for: USD's interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rows {
    Constant,
    Uniform,
    Vertex,
}

/// Diameters of the strands.
enum Widths<'a> {
    Constant(f64),
    Uniform(&'a [f64]),
    Vertex(&'a [f64]),
}

impl<'a> Widths<'a> {
    fn of(groom: &'a Groom, extent: &Extent) -> Self {
        let values = |column: Option<&'a Column>| match column {
            Some(Column::Float { components: 1, values }) => Some(values.as_slice()),
            _ => None,
        };
        if let Some(values) = values(groom.point_attributes().get(names::WIDTH)) {
            return Self::Vertex(values);
        }
        if let Some(values) = values(groom.strand_attributes().get(names::WIDTH)) {
            return Self::Uniform(values);
        }
        let by_size = Some(extent.size() * HAIR_OVER_SIZE).filter(|width| 0.0 < *width);
        Self::Constant(groom.unit.map(|metres| HAIR / metres).or(by_size).unwrap_or(HAIR))
    }

    fn greatest(&self) -> f64 {
        let values = match self {
            Self::Constant(width) => return *width,
            Self::Uniform(values) | Self::Vertex(values) => values,
        };
        values.iter().copied().filter(|width| width.is_finite()).fold(0.0, f64::max)
    }

    fn write(&self, groom: &Groom, out: &mut impl Write) -> io::Result<()> {
        let (values, rows) = match self {
            Self::Constant(width) => (std::slice::from_ref(width), Rows::Constant),
            Self::Uniform(values) => (*values, Rows::Uniform),
            Self::Vertex(values) => (*values, Rows::Vertex),
        };
        out.write_all(b"        float[] widths = [")?;
        floats(groom, values, (1, 1), rows, out)?;
        out.write_all(b"]")?;
        metadata(out, rows, 1)
    }
}

/// Every column but the widths.
fn primvars(groom: &Groom, out: &mut impl Write) -> io::Result<()> {
    let (points, strands) = (groom.point_attributes(), groom.strand_attributes());
    let mut taken = BTreeSet::new();
    for (name, column) in points.iter().filter(|(name, column)| !is_width(name, column)) {
        primvar(groom, &free_name(name, &mut taken), column, Rows::Vertex, out)?;
    }
    for (name, column) in strands.iter() {
        let name = match points.get(name) {
            Some(_) => format!("{name}_strand"),
            None if is_width(name, column) => continue,
            None => name.to_owned(),
        };
        primvar(groom, &free_name(&name, &mut taken), column, Rows::Uniform, out)?;
    }
    Ok(())
}

/// Whether a column is what `widths` holds.
fn is_width(name: &str, column: &Column) -> bool {
    name == names::WIDTH && matches!(column, Column::Float { components: 1, .. })
}

/// The name of a column as USD spells it: known names by USD's own, others with `_` for what may
/// not stand in an identifier, and a number behind what is taken already.
fn free_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let legal = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' };
    let mut spelled = match name {
        names::COLOR => "displayColor".to_owned(),
        names::OPACITY => "displayOpacity".to_owned(),
        names::ROOT_UV => "st".to_owned(),
        _ => name.chars().map(legal).collect(),
    };
    if !spelled.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
        spelled.insert(0, '_');
    }
    let stem = spelled.clone();
    let mut next = 2;
    while !taken.insert(spelled.clone()) {
        spelled = format!("{stem}_{next}");
        next += 1;
    }
    spelled
}

fn primvar(
    groom: &Groom,
    name: &str,
    column: &Column,
    rows: Rows,
    out: &mut impl Write,
) -> io::Result<()> {
    let (kind, size) = type_name(name, column);
    write!(out, "        {kind}[] primvars:{name} = [")?;
    match column {
        Column::Float { components, values } => {
            floats(groom, values, (components / size, size), rows, out)?;
        }
        Column::Int(values) => list(out, values.iter(), |out, i| write!(out, "{i}"))?,
    }
    out.write_all(b"]")?;
    metadata(out, rows, size)
}

/// The USD type of one item, and how many items make a row.
fn type_name(name: &str, column: &Column) -> (&'static str, usize) {
    match column {
        Column::Int(values) if values.iter().all(|&i| i32::try_from(i).is_ok()) => ("int", 1),
        Column::Int(_) => ("int64", 1),
        Column::Float { components, .. } => match (components, name) {
            (1, _) => ("float", 1),
            (2, "st") => ("texCoord2f", 1),
            (2, _) => ("float2", 1),
            (3, "displayColor") => ("color3f", 1),
            (3, _) => ("float3", 1),
            (4, _) => ("float4", 1),
            (n, _) => ("float", *n),
        },
    }
}

fn metadata(out: &mut impl Write, rows: Rows, size: usize) -> io::Result<()> {
    out.write_all(b" (\n")?;
    if size != 1 {
        writeln!(out, "            elementSize = {size}")?;
    }
    let interpolation = match rows {
        Rows::Constant => "constant",
        Rows::Uniform => "uniform",
        Rows::Vertex => "vertex",
    };
    writeln!(out, "            interpolation = \"{interpolation}\"\n        )")
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
