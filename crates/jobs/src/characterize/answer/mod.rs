//! The machine-readable answer of a characterization.

mod fit;
pub(crate) mod former;
mod specimen;
mod values;
mod verdicts;

use std::collections::BTreeMap;

use serde::Serialize;

use super::pooled::{self, Pooled};
use crate::{Unusable, VERSION};

pub use self::fit::{CovarianceAnswer, ElasticAnswer, FitAnswer};
pub use self::specimen::Specimen;
pub use self::values::{
    Known, LawAnswer, LumpedAnswer, Named, Noise, RelaxationAnswer, Steps, Tried,
};
pub use self::verdicts::{Identified, Partner};

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub struct Answer {
    palpate: &'static str,
    /// In the order of their first files.
    #[serde(serialize_with = "former::of_all")]
    pub specimens: Vec<Specimen>,
    /// Parameters over subjects, by organ, condition and key.
    pub pooled: BTreeMap<String, Pooled>,
    /// Recordings that cannot be used, with the reason.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unusable: Vec<Unusable>,
    /// Warnings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl Answer {
    pub(crate) fn new(specimens: Vec<Specimen>, unusable: Vec<Unusable>) -> Self {
        let several = specimens.len() > 1;
        let of = |specimen: &Specimen, warning: &String| match several {
            true => format!("{}: {warning}", specimen.title),
            false => warning.clone(),
        };
        let each = specimens.iter().flat_map(|specimen| {
            specimen
                .warnings
                .iter()
                .map(move |warning| of(specimen, warning))
        });
        Self {
            palpate: VERSION,
            pooled: pooled::of(&specimens),
            warnings: each
                .chain(unusable.iter().map(Unusable::sentence))
                .collect(),
            specimens,
            unusable,
        }
    }
}
