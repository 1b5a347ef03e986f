//! Columns as geometry parameters: under their own names, or as Unreal's groom schema 1.5 has them.
//!
//! | column | parameter | scope | type |
//! |---|---|---|---|
//! | `group` | `groom_group_id`, and `groom_group_name` as `group_ID` | uniform | `int32`, text |
//! | `guide` (1 or 0) | `groom_guide` | uniform | `int32` |
//! | `id` | `groom_id` | uniform | `int32` |
//! | `clump` | `groom_clumpid` | uniform | `int32` |
//! | `uv` | `groom_root_uv` | uniform | `float32[2]` |
//! | `closest_guides` | `groom_closest_guides` | uniform | `int32[3]` |
//! | `guide_weights` | `groom_guide_weights` | uniform | `float32[3]` |
//! | `color` | `groom_color` | vertex | `float32[3]` |
//! | `roughness`, `ao` | `groom_roughness`, `groom_ao` | vertex | `float32` |
//!
//! A column of points takes a uniform place by its row at the root, one of strands a vertex place
//! by being the same at all points.

use tress_alembic::{Numbers, Parameter, Scope, Values};
use tress_geometry::{Column, Groom, names};

use crate::EncodeError;
use crate::binary::narrow_all;
use crate::columns::{PointValues, Rows, every_point};
use crate::named::named;
use crate::widths::is_width;

/// A parameter of Unreal's schema.
pub(super) struct Field {
    /// The column that holds it here.
    pub(super) ours: &'static str,
    /// Its name in the schema.
    pub(super) theirs: &'static str,
    scope: Scope,
    components: usize,
    is_whole: bool,
}

const fn uniform(ours: &'static str, theirs: &'static str, n: usize, is_whole: bool) -> Field {
    Field { ours, theirs, scope: Scope::Uniform, components: n, is_whole }
}

const fn vertex(ours: &'static str, theirs: &'static str, n: usize) -> Field {
    Field { ours, theirs, scope: Scope::Vertex, components: n, is_whole: false }
}

/// Every parameter of the schema that a column holds.
pub(super) const FIELDS: [Field; 10] = [
    uniform(names::GROUP, "groom_group_id", 1, true),
    uniform("guide", "groom_guide", 1, true),
    uniform("id", "groom_id", 1, true),
    uniform("clump", "groom_clumpid", 1, true),
    uniform(names::ROOT_UV, "groom_root_uv", 2, false),
    uniform("closest_guides", "groom_closest_guides", 3, true),
    uniform("guide_weights", "groom_guide_weights", 3, false),
    vertex(names::COLOR, "groom_color", 3),
    vertex("roughness", "groom_roughness", 1),
    vertex("ao", "groom_ao", 1),
];

/// Parameters of a groom.
pub(super) struct Parameters(Vec<Owned>);

struct Owned {
    name: String,
    scope: Scope,
    components: u8,
    data: Data,
}

enum Data {
    I32(Vec<i32>),
    I64(Vec<i64>),
    F32(Vec<f32>),
    Text(Vec<String>),
}

impl Parameters {
    /// Every column but those that curves have a place for, under its own name.
    pub(super) fn own(groom: &Groom) -> Result<Self, EncodeError> {
        Self::columns(groom, |name, column| is_width(name, column) || is_uv(name, column))
    }

    /// Every column that the schema knows, and the others under their own names.
    pub(super) fn unreal(groom: &Groom) -> Result<Self, EncodeError> {
        let mut parameters = Vec::new();
        for field in &FIELDS {
            if let Some(data) = field.data(groom)? {
                let components = u8::try_from(field.components).unwrap_or_default();
                let (name, scope) = (field.theirs.to_owned(), field.scope);
                parameters.push(Owned { name, scope, components, data });
            }
        }
        if let Some(groups) = Rows::of_strands(groom, names::GROUP, 1) {
            let data = Data::Text(groups.iter().map(|group| format!("group_{group}")).collect());
            let name = "groom_group_name".to_owned();
            parameters.push(Owned { name, scope: Scope::Uniform, components: 1, data });
        }
        let others = Self::columns(groom, |name, column| {
            is_width(name, column) || FIELDS.iter().any(|field| field.takes(name, column))
        })?;
        parameters.extend(others.0);
        Ok(Self(parameters))
    }

    fn columns(
        groom: &Groom,
        has_place: impl Fn(&str, &Column) -> bool,
    ) -> Result<Self, EncodeError> {
        let owned = named(groom, has_place, spell).into_iter().map(|named| {
            let scope = if named.of_points { Scope::Vertex } else { Scope::Uniform };
            let components = named.column.components();
            let components = u8::try_from(components).map_err(|_| {
                let name = &named.name;
                EncodeError::Groom(format!(
                    "column {name:?} has {components} numbers a row, more \
                                            than the 255 that Alembic can hold"
                ))
            })?;
            Ok(Owned { name: named.name, scope, components, data: data(named.column) })
        });
        Ok(Self(owned.collect::<Result<_, EncodeError>>()?))
    }

    /// The texts of all parameters, to be borrowed from.
    pub(super) fn texts(&self) -> Vec<Vec<&str>> {
        let texts = self.0.iter().map(|owned| match &owned.data {
            Data::Text(texts) => texts.iter().map(String::as_str).collect(),
            _ => Vec::new(),
        });
        texts.collect()
    }

    /// The parameters as they are written.
    pub(super) fn borrow<'a>(&'a self, texts: &'a [Vec<&'a str>]) -> Vec<Parameter<'a>> {
        let parameters = self.0.iter().zip(texts).map(|(owned, texts)| {
            let numbers = match &owned.data {
                Data::I32(values) => Numbers::I32(values),
                Data::I64(values) => Numbers::I64(values),
                Data::F32(values) => Numbers::F32(values),
                Data::Text(_) => Numbers::Text(texts),
            };
            Parameter::new(&owned.name, owned.scope, Values::rows(numbers, owned.components))
        });
        parameters.collect()
    }
}

impl Field {
    /// Whether this is where a column goes.
    fn takes(&self, name: &str, column: &Column) -> bool {
        name == self.ours && column.components() == self.components
    }

    /// The rows of this parameter, if the groom has such a column.
    fn data(&self, groom: &Groom) -> Result<Option<Data>, EncodeError> {
        let n = self.components;
        let mut values = Vec::new();
        if self.scope == Scope::Vertex {
            let Some(rows) = PointValues::new(groom, self.ours, n) else { return Ok(None) };
            for (strand, point) in every_point(groom) {
                values.extend((0..n).map(|component| rows.get(strand, point, component)));
            }
        } else if let Some(rows) = Rows::of_strands(groom, self.ours, n) {
            values.extend(rows.iter());
        } else if let Some(rows) = Rows::of_points(groom, self.ours, n) {
            for i in 0..groom.strands().len() {
                let root = groom.strands().range(i).next();
                let row = |component| root.map_or(0.0, |root| rows.get(root, component));
                values.extend((0..n).map(row));
            }
        } else {
            return Ok(None);
        }
        if self.is_whole {
            let whole = values.iter().map(|&value| self.whole(value));
            return Ok(Some(Data::I32(whole.collect::<Result<_, _>>()?)));
        }
        Ok(Some(Data::F32(narrow_all(&values))))
    }

    #[expect(clippy::cast_possible_truncation, reason = "what does not fit is refused")]
    fn whole(&self, value: f64) -> Result<i32, EncodeError> {
        let rounded = value.round();
        if (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&rounded) {
            return Ok(rounded as i32);
        }
        let (ours, theirs) = (self.ours, self.theirs);
        let message = format!("{ours} {value} does not fit the 32 bits of {theirs}");
        Err(EncodeError::Groom(message))
    }
}

fn is_uv(name: &str, column: &Column) -> bool {
    name == names::ROOT_UV && matches!(column, Column::Float { components: 2, .. })
}

/// A name as Alembic can have it.
fn spell(name: &str) -> String {
    let spelled: String =
        name.chars().map(|c| if c == '/' || c.is_control() { '_' } else { c }).collect();
    if spelled.is_empty() { "_".into() } else { spelled }
}

fn data(column: &Column) -> Data {
    match column {
        Column::Float { values, .. } => Data::F32(narrow_all(values)),
        Column::Int(values) => {
            let short: Result<Vec<i32>, _> = values.iter().map(|&i| i32::try_from(i)).collect();
            short.map_or_else(|_| Data::I64(values.clone()), Data::I32)
        }
    }
}
