//! Arrays in and out: what NumPy takes for numbers is taken, and what it does not is told with its name.

use numpy::ndarray::{Array, Array2, Dimension, IntoDimension};
use numpy::{IntoPyArray, PyArray, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use palpate_geometry::Vec3;
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

use crate::failure::Failure;

/// The array that `given` is, or is made to; `name` is that of the argument.
pub(crate) fn floats<'py>(
    given: &Bound<'py, PyAny>,
    name: &str,
) -> Result<Bound<'py, PyArrayDyn<f64>>, Failure> {
    if let Ok(array) = given.cast::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
    {
        return Ok(array.clone());
    }
    let options = [("dtype", "float64"), ("order", "C")].into_py_dict(given.py())?;
    let numpy = given.py().import("numpy")?;
    let made = numpy.call_method("asarray", (given,), Some(&options));
    let made = made.map_err(|error| no_numbers(given, name, &error))?;
    made.cast_into::<PyArrayDyn<f64>>()
        .map_err(|error| Failure::Python(error.into()))
}

fn no_numbers(given: &Bound<'_, PyAny>, name: &str, error: &PyErr) -> Failure {
    let said = error.value(given.py()).to_string();
    Failure::input(format!(
        "`{name}` is no array of numbers ({said}); give numbers in rows of one length"
    ))
}

/// What a shape is, as Python writes it.
pub(crate) fn shape_words(shape: &[usize]) -> String {
    match shape {
        [only] => format!("({only},)"),
        several => {
            let lengths: Vec<String> = several.iter().map(usize::to_string).collect();
            format!("({})", lengths.join(", "))
        }
    }
}

fn misshapen(name: &str, shape: &[usize], expected: &str) -> Failure {
    let found = shape_words(shape);
    Failure::input(format!("`{name}` has the shape {found}; give {expected}"))
}

/// A list of numbers.
pub(crate) fn list(given: &Bound<'_, PyAny>, name: &str) -> Result<Vec<f64>, Failure> {
    let array = floats(given, name)?;
    match array.shape() {
        [_] => copied(&array),
        shape => Err(misshapen(
            name,
            shape,
            "a list of numbers, with the shape (n,)",
        )),
    }
}

/// Points or vectors, three numbers each.
pub(crate) fn points(given: &Bound<'_, PyAny>, name: &str) -> Result<Vec<Vec3>, Failure> {
    let array = floats(given, name)?;
    match array.shape() {
        [_, 3] => {
            let numbers = copied(&array)?;
            Ok(numbers
                .chunks_exact(3)
                .map(Vec3::from_column_slice)
                .collect())
        }
        shape => Err(misshapen(
            name,
            shape,
            "rows of three numbers, with the shape (n, 3)",
        )),
    }
}

/// Rows of three numbers of things.
pub(crate) fn triples(given: &Bound<'_, PyAny>, name: &str) -> Result<Vec<[u32; 3]>, Failure> {
    let numpy = given.py().import("numpy")?;
    let array = numpy
        .call_method1("asarray", (given,))
        .map_err(|error| no_numbers(given, name, &error))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let (&[_, 3], "i" | "u") = (shape.as_slice(), kind.as_str()) else {
        let expected = "rows of three whole numbers, with the shape (n, 3)";
        return Err(match shape.as_slice() {
            [_, 3] => Failure::input(format!(
                "`{name}` holds numbers of the type {}; give {expected}",
                array.getattr("dtype")?
            )),
            shape => misshapen(name, shape, expected),
        });
    };
    let options = [("dtype", "int64"), ("order", "C")].into_py_dict(given.py())?;
    let array = numpy.call_method("asarray", (array,), Some(&options))?;
    let array = array
        .cast_into::<PyArrayDyn<i64>>()
        .map_err(|error| Failure::Python(error.into()))?;
    let borrowed = array.try_readonly().map_err(Failure::input)?;
    let numbers = borrowed.as_slice().map_err(Failure::input)?;
    let small: Result<Vec<u32>, _> = numbers
        .iter()
        .map(|&number| u32::try_from(number))
        .collect();
    let small = small.map_err(|_| {
        Failure::input(format!(
            "`{name}` holds a number that numbers nothing; give numbers from 0 to 4294967295"
        ))
    })?;
    Ok(small
        .chunks_exact(3)
        .map(|corners| [corners[0], corners[1], corners[2]])
        .collect())
}

/// The numbers of an array that lies in one piece.
pub(crate) fn copied(array: &Bound<'_, PyArrayDyn<f64>>) -> Result<Vec<f64>, Failure> {
    let borrowed = array.try_readonly().map_err(Failure::input)?;
    Ok(borrowed.as_slice().map_err(Failure::input)?.to_vec())
}

/// A new array of `shape` that holds `numbers`.
pub(crate) fn array<'py, T: numpy::Element, S: IntoDimension>(
    py: Python<'py>,
    shape: S,
    numbers: Vec<T>,
) -> Bound<'py, PyArray<T, S::Dim>>
where
    S::Dim: Dimension,
{
    Array::from_shape_vec(shape.into_dimension(), numbers)
        .expect("the shape is that of the numbers")
        .into_pyarray(py)
}

/// A row for each vector.
pub(crate) fn rows<'py, 'v>(
    py: Python<'py>,
    vectors: impl ExactSizeIterator<Item = &'v Vec3>,
) -> Bound<'py, PyArray<f64, <[usize; 2] as IntoDimension>::Dim>> {
    let count = vectors.len();
    let numbers: Vec<f64> = vectors.flat_map(|v| [v.x, v.y, v.z]).collect();
    let array: Array2<f64> =
        Array2::from_shape_vec([count, 3], numbers).expect("three numbers were taken of each");
    array.into_pyarray(py)
}
