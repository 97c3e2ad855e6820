//! What organs are made of.

use std::path::PathBuf;

use palpate_files::{BuiltinTissue, Tissue as Document};
use palpate_jobs::nearest;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple, PyType};
use toml::{Table, Value};

use crate::documents;
use crate::failure::Failure;
use crate::written;

/// What stands for the file of a tissue that comes from Python in a sentence.
const NAME: &str = "tissue";

/// A tissue: an elastic law with its parameters, and how it relaxes. All moduli are instantaneous.
///
/// Parameters
/// ----------
/// law : {"linear", "neo_hookean", "mooney_rivlin", "exponential", "ogden", "reduced_polynomial", "holzapfel_gasser_ogden"}
///     The elastic law.
/// name : str, optional
///     What it is, for people.
/// density_kg_m3 : float, optional
///     Its density [kg/m³].
/// prony : list of (g, tau_s), optional
///     Parts of the modulus that relax [-] and their time constants [s].
/// **parameters : float or dict
///     Those of the law, by the keys of a tissue's file: ``youngs_modulus_pa`` [Pa] and ``poissons_ratio`` [-];
///     ``c10_pa`` and ``c01_pa`` [Pa]; ``gamma_pa`` [Pa] and ``alpha`` [-]; ``mu_1_pa`` [Pa] and ``alpha_1`` [-], and
///     up to two terms more; ``c10_pa``, ``c20_pa`` and ``c30_pa`` [Pa], the last two optional; ``c10_pa`` and ``k1_pa`` [Pa],
///     ``k2`` [-], ``dispersion`` [-] and ``fibre_angle_deg`` [degrees]. A dict has a ``value`` and its
///     ``standard_error``.
#[pyclass(frozen, module = "palpate")]
#[derive(Debug, Clone)]
pub(crate) struct Tissue {
    pub(crate) tissue: Document,
}

#[pymethods]
impl Tissue {
    #[new]
    #[pyo3(signature = (*, law, name=None, density_kg_m3=None, prony=None, **parameters))]
    fn new(
        law: String,
        name: Option<String>,
        density_kg_m3: Option<&Bound<'_, PyAny>>,
        prony: Option<&Bound<'_, PyAny>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> Result<Self, Failure> {
        let mut table = match parameters {
            Some(parameters) => documents::table(parameters, "")?,
            None => Table::new(),
        };
        table.insert("law".to_owned(), Value::String(law));
        if let Some(name) = name {
            table.insert("name".to_owned(), Value::String(name));
        }
        if let Some(density) = density_kg_m3 {
            table.insert(
                "density_kg_m3".to_owned(),
                documents::value(density, "density_kg_m3")?,
            );
        }
        if let Some(prony) = prony {
            table.insert(
                "prony".to_owned(),
                series(documents::value(prony, "prony")?),
            );
        }
        let whole: Table = [
            ("format".to_owned(), Value::Integer(1)),
            ("tissue".to_owned(), Value::Table(table)),
        ]
        .into_iter()
        .collect();
        let tissue = Document::parse(&documents::text(&whole)?, NAME)?;
        Ok(Self { tissue })
    }

    /// A tissue that comes with the program: pig-liver, pig-kidney, pig-spleen or pig-esophagus. Each carries
    /// `warnings`.
    #[classmethod]
    fn builtin(_class: &Bound<'_, PyType>, name: &str) -> Result<Self, Failure> {
        let words: Vec<&str> = BuiltinTissue::WORDS.iter().map(|(word, _)| *word).collect();
        let tissue = BuiltinTissue::from_word(name).ok_or_else(|| {
            Failure::input(format!(
                "there is no built-in tissue `{name}`; the nearest is `{}`, and there are {}",
                nearest(name, &words),
                words.join(", ")
            ))
        })?;
        let tissue = Document::builtin(tissue);
        Ok(Self { tissue })
    }

    /// Reads a tissue's file.
    #[classmethod]
    fn read(_class: &Bound<'_, PyType>, path: PathBuf) -> Result<Self, Failure> {
        let tissue = Document::read(path)?;
        Ok(Self { tissue })
    }

    /// Reads the text of a tissue's file.
    #[classmethod]
    fn parse(_class: &Bound<'_, PyType>, text: &str) -> Result<Self, Failure> {
        let tissue = Document::parse(text, NAME)?;
        Ok(Self { tissue })
    }

    /// What it is, for people; or None.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.tissue.name.as_deref()
    }

    /// Its elastic law.
    #[getter]
    fn law(&self) -> &'static str {
        self.tissue.elasticity.law().word()
    }

    /// Its density [kg/m³].
    #[getter]
    fn density(&self) -> f64 {
        self.tissue.density_kg_m3.value
    }

    /// The law's parameters by their keys, which end in their units.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for (key, estimate) in self.tissue.elasticity.parameters() {
            values.set_item(key, estimate.value)?;
        }
        Ok(values)
    }

    /// The standard errors of the parameters, where they are known, by the same keys.
    #[getter]
    fn standard_errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let errors = PyDict::new(py);
        for (key, estimate) in self.tissue.elasticity.parameters() {
            if let Some(error) = estimate.standard_error {
                errors.set_item(key, error)?;
            }
        }
        Ok(errors)
    }

    /// How it relaxes: a list of parts of the modulus [-] and their time constants [s].
    #[getter]
    fn prony(&self) -> Vec<(f64, f64)> {
        let terms = self.tissue.prony.iter();
        terms.map(|term| (term.g.value, term.tau_s.value)).collect()
    }

    /// Plain sentences on warnings.
    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, &self.tissue.source.warnings)
    }

    /// The text of its file.
    fn to_toml(&self) -> String {
        self.tissue.to_toml()
    }

    /// The keywords of Abaqus for it, in newtons, metres, kilograms and seconds.
    fn to_abaqus(&self) -> Result<String, Failure> {
        Ok(self.tissue.to_abaqus()?)
    }

    /// The material of FEBio 4 for it, in newtons, metres, kilograms and seconds.
    fn to_febio(&self) -> Result<String, Failure> {
        Ok(self.tissue.to_febio()?)
    }

    /// Writes its file, whole or not at all. A file that exists is replaced with
    /// `overwrite=True`, else it is an error.
    #[pyo3(signature = (path, overwrite=false))]
    fn write(&self, path: PathBuf, overwrite: bool) -> Result<(), Failure> {
        written::write(&path, overwrite, |path| self.tissue.write(path))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.tissue == other.tissue
    }

    fn __repr__(&self) -> String {
        let parameters = self.tissue.elasticity.parameters();
        let parameters: Vec<String> = parameters
            .iter()
            .map(|(key, estimate)| format!("{key}={:?}", estimate.value))
            .collect();
        let name = self.tissue.name.as_deref();
        let name = name.map_or(String::new(), |name| format!("{name:?}, "));
        let (law, parameters) = (self.law(), parameters.join(", "));
        format!("<palpate.Tissue {name}law={law:?}, {parameters}>")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let parse = slf.get_type().getattr("parse")?;
        (parse, (slf.get().to_toml(),)).into_pyobject(slf.py())
    }
}

/// Pairs of a part and a time as the terms of a file.
fn series(value: Value) -> Value {
    let Value::Array(terms) = value else {
        return value;
    };
    let term = |term: Value| match term {
        Value::Array(pair) if pair.len() == 2 => {
            let keys = ["g", "tau_s"].map(str::to_owned);
            Value::Table(keys.into_iter().zip(pair).collect())
        }
        other => other,
    };
    Value::Array(terms.into_iter().map(term).collect())
}
