//! The machine-readable answer: what stays of a characterization.

mod specimen;
mod values;

use std::collections::BTreeMap;

use serde::Serialize;

use super::pooled::{self, Pooled};
use crate::command::recordings::Unusable;
use crate::output::VERSION;

pub(super) use self::specimen::Specimen;
pub(super) use self::values::{Known, LawAnswer, Named};

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    pub(super) specimens: Vec<Specimen>,
    pub(super) pooled: BTreeMap<String, Pooled>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) unusable: Vec<Unusable>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) warnings: Vec<String>,
}

impl Answer {
    pub(super) fn new(specimens: Vec<Specimen>, unusable: &[Unusable]) -> Self {
        let several = specimens.len() > 1;
        let of = |specimen: &Specimen, doubt: &String| match several {
            true => format!("{}: {doubt}", specimen.title),
            false => doubt.clone(),
        };
        let each = specimens.iter().flat_map(|specimen| {
            specimen
                .warnings
                .iter()
                .map(move |doubt| of(specimen, doubt))
        });
        Self {
            palpate: VERSION,
            pooled: pooled::of(&specimens),
            warnings: each
                .chain(unusable.iter().map(Unusable::sentence))
                .collect(),
            specimens,
            unusable: unusable.to_vec(),
        }
    }
}
