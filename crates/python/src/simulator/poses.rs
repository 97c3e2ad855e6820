//! Poses as rows of numbers.
//!
//! ```text
//! 3: x y z      5: x y z grip cut      7: x y z qx qy qz qw      9: x y z qx qy qz qw grip cut
//! ```
//!
//! A row of NaN alone, or None, is a tool that is not there. NaN beside numbers is a mistake, and told.

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use palpate_files::Pose;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

use crate::failure::Failure;
use crate::numbers;

const WIDTHS: &str = "3 numbers (x, y, z), 5 (and grip, cut), 7 (and a quaternion) or 9 (and both)";

/// Reads as many poses as there are slots, each for a `thing`: a tool, a time.
pub(crate) fn read(
    given: &Bound<'_, PyAny>,
    slots: &mut [Option<Pose>],
    thing: &str,
) -> Result<(), Failure> {
    if let Ok(array) = given.cast::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
    {
        return read_array(array, slots, thing);
    }
    if is_list_of_rows(given, slots.len())? {
        for (number, item) in given.try_iter()?.enumerate() {
            let item = item?;
            slots[number] = match item.is_none() {
                true => None,
                false => pose(&numbers::list(&item, "poses")?, thing, number)?,
            };
        }
        return Ok(());
    }
    read_array(&numbers::floats(given, "poses")?, slots, thing)
}

/// A list with None in it, or with rows of different lengths.
fn is_list_of_rows(given: &Bound<'_, PyAny>, count: usize) -> PyResult<bool> {
    if !(given.is_instance_of::<PyList>() || given.is_instance_of::<PyTuple>())
        || given.len()? != count
    {
        return Ok(false);
    }
    for item in given.try_iter()? {
        let item = item?;
        if !item.is_none() && !item.hasattr("__len__")? {
            return Ok(false);
        }
    }
    Ok(true)
}

fn read_array(
    array: &Bound<'_, PyArrayDyn<f64>>,
    slots: &mut [Option<Pose>],
    thing: &str,
) -> Result<(), Failure> {
    let width = match *array.shape() {
        [count, width] if count == slots.len() => width,
        // A single tool needs no list of one.
        [width] if slots.len() == 1 => width,
        ref shape => return Err(misshapen(shape, slots.len(), thing)),
    };
    let borrowed = array.try_readonly().map_err(Failure::input)?;
    let flat = borrowed.as_slice().map_err(Failure::input)?;
    of_flat(flat, width, slots, thing)
}

fn misshapen(shape: &[usize], count: usize, thing: &str) -> Failure {
    Failure::input(format!(
        "`poses` has the shape {}; give {}, a row for each {thing}, of {WIDTHS}",
        numbers::shape_words(shape),
        numbers::shape_words(&[count, 3])
    ))
}

/// Poses of rows of `width` numbers.
pub(super) fn of_flat(
    flat: &[f64],
    width: usize,
    slots: &mut [Option<Pose>],
    thing: &str,
) -> Result<(), Failure> {
    if !matches!(width, 3 | 5 | 7 | 9) {
        return Err(misshapen(&[slots.len(), width], slots.len(), thing));
    }
    for (number, (slot, row)) in slots.iter_mut().zip(flat.chunks_exact(width)).enumerate() {
        *slot = pose(row, thing, number)?;
    }
    Ok(())
}

/// The pose of a row.
fn pose(row: &[f64], thing: &str, number: usize) -> Result<Option<Pose>, Failure> {
    let (position_m, orientation, deeds) = match *row {
        [x, y, z] => ([x, y, z], None, None),
        [x, y, z, grip, cut] => ([x, y, z], None, Some([grip, cut])),
        [x, y, z, i, j, k, w] => ([x, y, z], Some([i, j, k, w]), None),
        [x, y, z, i, j, k, w, grip, cut] => ([x, y, z], Some([i, j, k, w]), Some([grip, cut])),
        _ => {
            return Err(Failure::input(format!(
                "the pose of {thing} {number} has {} numbers; give {WIDTHS}",
                row.len()
            )));
        }
    };
    if row.iter().all(|number| number.is_nan()) {
        return Ok(None);
    }
    let wrong = |expected: &str| {
        Failure::input(format!(
            "the pose of {thing} {number} is {row:?}; give {expected}"
        ))
    };
    let [grip, cut] = deeds.unwrap_or_default();
    let pose = Pose {
        position_m,
        orientation,
        grip,
        cut: match cut {
            0.0 => false,
            1.0 => true,
            _ => return Err(wrong("0 or 1 for whether it cuts")),
        },
    };
    pose.checked().map(Some).map_err(wrong)
}

/// Adds a row of 9 numbers, or of 5 without an orientation, to `flat`.
pub(crate) fn write(pose: Option<&Pose>, is_turned: bool, flat: &mut Vec<f64>) {
    let width = if is_turned { 9 } else { 5 };
    let Some(pose) = pose else {
        return flat.extend(std::iter::repeat_n(f64::NAN, width));
    };
    flat.extend(pose.position_m);
    if is_turned {
        flat.extend(pose.orientation.unwrap_or(palpate_files::motion::IDENTITY));
    }
    flat.extend([pose.grip, f64::from(u8::from(pose.cut))]);
}
