//! Python's dicts in the shape of the documents, and back. Text is made of them and read by the documents' own
//! reader, so that it refuses what it refuses of a file, in the same words.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use crate::failure::Failure;

/// A dict as a table.
pub(crate) fn table(given: &Bound<'_, PyDict>, name: &str) -> Result<Table, Failure> {
    let mut table = Table::new();
    for (key, item) in given {
        let Ok(key) = key.cast::<PyString>() else {
            let found = key.repr()?.to_string();
            let place = match name {
                "" => String::new(),
                _ => format!(" of `{name}`"),
            };
            return Err(Failure::input(format!(
                "a key{place} is {found}; give the keys as texts"
            )));
        };
        let key = key.to_string();
        let inner = match name {
            "" => key.clone(),
            _ => format!("{name}.{key}"),
        };
        table.insert(key, value(&item, &inner)?);
    }
    Ok(table)
}

/// A value, which `name` names in errors.
pub(crate) fn value(given: &Bound<'_, PyAny>, name: &str) -> Result<Value, Failure> {
    if let Ok(truth) = given.cast::<PyBool>() {
        return Ok(Value::Boolean(truth.is_true()));
    }
    if let Ok(text) = given.cast::<PyString>() {
        return Ok(Value::String(text.to_string()));
    }
    if given.is_instance_of::<PyInt>() {
        return Ok(Value::Integer(given.extract()?));
    }
    if given.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(given.extract()?));
    }
    if let Ok(inner) = given.cast::<PyDict>() {
        return Ok(Value::Table(table(inner, name)?));
    }
    if given.is_instance_of::<PyList>() || given.is_instance_of::<PyTuple>() {
        let items = given.try_iter()?.map(|item| value(&item?, name));
        return Ok(Value::Array(items.collect::<Result<_, Failure>>()?));
    }
    // Numbers and arrays of NumPy, and paths.
    if given.hasattr("tolist")? {
        return value(&given.call_method0("tolist")?, name);
    }
    if given.hasattr("__fspath__")? {
        return value(&given.call_method0("__fspath__")?, name);
    }
    let found = match given.is_none() {
        true => "None".to_owned(),
        false => format!("of the type {}", given.get_type().name()?),
    };
    Err(Failure::input(format!(
        "`{name}` is {found}; give a number, a text, true or false, or a list or a dict of these, or leave it out"
    )))
}

/// The text of a table.
pub(crate) fn text(table: &Table) -> Result<String, Failure> {
    toml::to_string(table).map_err(Failure::input)
}

/// What a JSON text holds.
pub(crate) fn json<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}

/// What a text holds, as a dict.
pub(crate) fn dict<'py>(py: Python<'py>, text: &str) -> Result<Bound<'py, PyDict>, Failure> {
    let table: Table = toml::from_str(text).map_err(Failure::failed)?;
    Ok(dict_of(py, &table)?)
}

fn dict_of<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (key, value) in table {
        dict.set_item(key, object(py, value)?)?;
    }
    Ok(dict)
}

/// A value as Python has it.
pub(crate) fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Integer(number) => number.into_pyobject(py)?.into_any(),
        Value::Float(number) => number.into_pyobject(py)?.into_any(),
        Value::Boolean(truth) => truth.into_pyobject(py)?.to_owned().into_any(),
        Value::Datetime(time) => time.to_string().into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let items: Vec<_> = items
                .iter()
                .map(|item| object(py, item))
                .collect::<PyResult<_>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Table(table) => dict_of(py, table)?.into_any(),
    })
}

/// A header `# key = value` of a table of numbers, from a dict.
pub(crate) fn header(given: &Bound<'_, PyDict>) -> Result<String, Failure> {
    let table = table(given, "")?;
    let lines = table
        .iter()
        .filter(|(key, _)| *key != "format")
        .map(|(key, value)| format!("# {key} = {value}\n"));
    Ok(format!("# format = 1\n{}", lines.collect::<String>()))
}
