//! Arrays out: numpy sees the memory of a groom, without a copy and read-only.

use numpy::ndarray::{ArrayView, ArrayView1, ArrayView2, Dimension};
use numpy::{Element, PyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{PyClass, pyclass::boolean_struct::True};
use tress::geometry::glam::DVec3;
use tress::geometry::{Attributes, Column};

/// A read-only array over memory that `owner` holds; the array keeps its owner alive.
///
/// `view` must find the memory in the owner itself, whatever the owner's lifetime, which the
/// signature asks for; and as the owner is frozen and nothing in a groom changes behind a shared
/// reference, that memory neither moves nor changes while the owner lives.
#[expect(unsafe_code, reason = "numpy is told who owns the memory, which no type can express")]
pub(crate) fn lend<'py, C, T, D>(
    owner: &Bound<'py, C>,
    view: impl for<'a> FnOnce(&'a C) -> ArrayView<'a, T, D>,
) -> Bound<'py, PyArray<T, D>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
    D: Dimension,
{
    let array = view(owner.get());
    // SAFETY: the array's base is `owner`, a frozen object that holds the memory (see above): it is
    // not freed, moved or written while the array lives.
    let lent = unsafe { PyArray::borrow_from_array(&array, owner.clone().into_any()) };
    lent.readwrite().make_nonwriteable();
    lent
}

/// Vectors as rows of three.
pub(crate) fn rows(vectors: &[DVec3]) -> ArrayView2<'_, f64> {
    table(bytemuck::cast_slice(vectors), 3)
}

/// Numbers as rows of so many; numbers beyond the last whole row are left out.
pub(crate) fn table(values: &[f64], components: usize) -> ArrayView2<'_, f64> {
    let n = values.len().checked_div(components).unwrap_or(0);
    ArrayView2::from_shape((n, components), &values[..n * components])
        .expect("as many values as rows times components were taken")
}

/// The columns of a table by name, each a read-only array of integers or floating-point numbers.
pub(crate) fn columns<'py, C>(
    owner: &Bound<'py, C>,
    attributes: impl for<'a> Fn(&'a C) -> &'a Attributes,
) -> PyResult<Bound<'py, PyDict>>
where
    C: PyClass<Frozen = True> + Sync,
{
    let named = PyDict::new(owner.py());
    for (name, column) in attributes(owner.get()).iter() {
        match column {
            Column::Int(_) => {
                let array = lend(owner, |owner| whole(attributes(owner).get(name)));
                named.set_item(name, array)?;
            }
            Column::Float { components: 1, .. } => {
                let array =
                    lend(owner, |owner| ArrayView1::from(numbers(attributes(owner).get(name)).1));
                named.set_item(name, array)?;
            }
            Column::Float { .. } => {
                let array = lend(owner, |owner| {
                    let (components, values) = numbers(attributes(owner).get(name));
                    table(values, components)
                });
                named.set_item(name, array)?;
            }
        }
    }
    Ok(named)
}

fn whole(column: Option<&Column>) -> ArrayView1<'_, i64> {
    match column {
        Some(Column::Int(values)) => ArrayView1::from(values.as_slice()),
        _ => ArrayView1::from(&[]),
    }
}

fn numbers(column: Option<&Column>) -> (usize, &[f64]) {
    match column {
        Some(Column::Float { components, values }) => (*components, values),
        _ => (1, &[]),
    }
}
