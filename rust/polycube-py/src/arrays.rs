//! Numpy arrays in, by a checked copy, and out, as read-only views of memory that Rust owns.

use crate::errors;
use numpy::ndarray::{ArrayView, Dimension, IntoDimension};
use numpy::{Element, PyArray, PyArrayDescrMethods, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use polycube::mesh::Point;
use polycube::{Error, ErrorKind};
use pyo3::PyClass;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;

/// Points as numbers: x, y, z of the first, and so on.
pub fn flat(points: &[Point]) -> &[f64] {
    bytemuck::cast_slice(points)
}

/// Points as rows of three numbers, which can be pickled.
pub fn rows(points: &[Point]) -> Vec<[f64; 3]> {
    points.iter().map(|&p| p.into()).collect()
}

/// Rows of three numbers as points.
pub fn points(rows: Vec<[f64; 3]>) -> Vec<Point> {
    rows.into_iter().map(Point::from).collect()
}

/// A read-only one-dimensional array over numbers that `owner` holds, without copying them.
pub fn vector<'py, C, T>(
    owner: &Bound<'py, C>,
    pick: impl for<'a> FnOnce(&'a C) -> &'a [T],
) -> PyResult<Bound<'py, PyAny>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
{
    let numbers = pick(owner.get());
    view(owner, numbers, numbers.len())
}

/// A read-only array of `columns` columns over numbers that `owner` holds row by row, without copying them.
pub fn matrix<'py, C, T>(
    owner: &Bound<'py, C>,
    columns: usize,
    pick: impl for<'a> FnOnce(&'a C) -> &'a [T],
) -> PyResult<Bound<'py, PyAny>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
{
    let numbers = pick(owner.get());
    view(owner, numbers, (numbers.len() / columns, columns))
}

fn view<'py, C, T, D>(owner: &Bound<'py, C>, numbers: &[T], shape: D) -> PyResult<Bound<'py, PyAny>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
    D: IntoDimension,
{
    let view = ArrayView::from_shape(shape.into_dimension(), numbers)
        .map_err(|e| errors::raise(owner.py(), &Error::new(ErrorKind::Internal, e.to_string()), None))?;
    Ok(borrowed(owner, &view).into_any())
}

#[expect(unsafe_code, reason = "numpy cannot know that the memory is Rust's; the object that owns it can")]
fn borrowed<'py, C, T, D>(owner: &Bound<'py, C>, view: &ArrayView<'_, T, D>) -> Bound<'py, PyArray<T, D>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
    D: Dimension,
{
    // SAFETY: `vector` and `matrix` picked the numbers from within `owner`, which is frozen, so they neither move nor
    // change while it lives; the array keeps it alive, and is made read-only before anyone sees it.
    let array = unsafe { PyArray::borrow_from_array(view, owner.clone().into_any()) };
    array.readwrite().make_nonwriteable();
    array
}

/// Whole numbers up to this are exact as floats.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// What an argument must be.
pub struct Expected {
    /// The name of the argument, for messages.
    pub name: &'static str,
    /// Its type in numpy.
    pub dtype: &'static str,
    /// Whether numbers that are not whole are fine.
    pub real: bool,
}

/// Real numbers.
pub fn real(name: &'static str) -> Expected {
    Expected { name, dtype: "float64", real: true }
}

/// Whole numbers, also as floats that have no fraction.
pub fn whole(name: &'static str) -> Expected {
    Expected { name, dtype: "int64", real: false }
}

impl Expected {
    /// The numbers of an array of any layout, or of nested sequences, row by row, and the shape they came in.
    ///
    /// # Errors
    /// `TypeError` for anything but numbers of the expected type, with the first that is not whole.
    pub fn read<T: Element + Copy>(&self, value: &Bound<'_, PyAny>) -> PyResult<(Vec<T>, Vec<usize>)> {
        let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
        let array = array.cast_into::<PyUntypedArray>()?;
        let kind = array.dtype().kind();
        if !matches!(kind, b'i' | b'u' | b'f') && !array.is_empty() {
            let what = if self.real { "numbers" } else { "integers" };
            return Err(PyTypeError::new_err(format!("{}: expected {what}, not {}", self.name, array.dtype())));
        }
        if kind == b'f' && !self.real {
            self.check_whole(&array)?;
        }
        let shape = array.shape().to_vec();
        let flat = array.call_method1("astype", (self.dtype,))?.call_method1("reshape", (-1,))?;
        let flat = flat.cast_into::<PyArray<T, numpy::Ix1>>().map_err(PyErr::from)?;
        Ok((flat.to_vec()?, shape))
    }

    /// Refuses floats that have a fraction, are not finite, or are too large to be exact.
    fn check_whole(&self, floats: &Bound<'_, PyUntypedArray>) -> PyResult<()> {
        let (floats, shape) = real(self.name).read::<f64>(floats.as_any())?;
        let Some(bad) = floats.iter().position(|x| x.fract() != 0.0 || x.abs() > EXACT) else { return Ok(()) };
        let row = bad / shape.iter().skip(1).product::<usize>().max(1);
        Err(PyTypeError::new_err(format!("{}: expected integers, but row {row} has {}", self.name, floats[bad])))
    }
}

/// Whether a value becomes an array of a kind: `b'b'` for booleans, `b'i'` and `b'u'` for integers.
pub fn is_of_kind(value: &Bound<'_, PyAny>, kinds: &[u8]) -> PyResult<bool> {
    let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
    Ok(kinds.contains(&array.cast_into::<PyUntypedArray>()?.dtype().kind()))
}

/// Where a mask is true, which must have one value for each of `count`; the numbers themselves where it is no mask.
///
/// # Errors
/// `InvalidOption` for a mask of another length.
pub fn numbers_of<'py>(name: &str, value: &Bound<'py, PyAny>, count: usize) -> PyResult<Bound<'py, PyAny>> {
    if !is_of_kind(value, b"b")? {
        return Ok(value.clone());
    }
    let numpy = value.py().import("numpy")?;
    let shape: Vec<usize> = numpy.call_method1("shape", (value,))?.extract()?;
    if shape != [count] {
        let message = format!("{name} is a mask of the shape {shape:?}, and there are {count} boundary faces");
        return Err(errors::option(value.py(), message, "give one True or False per boundary face, or their numbers"));
    }
    numpy.call_method1("flatnonzero", (value,))
}
