use std::fmt;

use super::Tissue;
use super::laws::LawName;
use crate::words::or_list;
use crate::{Error, Estimate, Keys};

/// Most parameters of a law.
const MOST: usize = 6;

/// An elastic law with its parameters. All but [`LawName::Linear`] are incompressible.
#[derive(Clone, Copy, PartialEq)]
pub struct Elasticity {
    law: LawName,
    /// In the order of the law's keys; those beyond `count` are zero.
    estimates: [Estimate; MOST],
    count: usize,
}

impl Elasticity {
    /// A law with its parameters [unit of their keys], in the order of [`super::LawRow::keys`]; none where the law
    /// has another number of parameters. Reading or writing a file checks whether they are those of a solid.
    pub fn new(law: LawName, parameters: &[Estimate]) -> Option<Self> {
        let (row, count) = (law.row(), parameters.len());
        let most = row.parameters.len().min(MOST);
        if count == 0 || count > most || !count.is_multiple_of(row.term) {
            return None;
        }
        let mut estimates = [Estimate::exactly(0.0); MOST];
        estimates[..count].copy_from_slice(parameters);
        Some(Self {
            law,
            estimates,
            count,
        })
    }

    /// The law.
    pub fn law(&self) -> LawName {
        self.law
    }

    /// The parameters with their keys, in the order of the documentation.
    pub fn parameters(&self) -> Vec<(&'static str, Estimate)> {
        let estimates = self.estimates[..self.count].iter().copied();
        self.law.row().keys().zip(estimates).collect()
    }

    /// The values of the parameters [unit of their keys], in the same order.
    pub fn values(&self) -> Vec<f64> {
        let estimates = &self.estimates[..self.count];
        estimates.iter().map(|estimate| estimate.value).collect()
    }

    /// The law of a tissue that is stiffer by `factor` [-]: every modulus times it, with the standard errors as they are.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        let parameters = self.law.row().keys().zip(&mut self.estimates);
        for (_, estimate) in parameters.filter(|(key, _)| key.ends_with("_pa")) {
            estimate.value *= factor;
        }
        self
    }

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let law = keys.word_or_former("law", LawName::WORDS, LawName::FORMER)?;
        let law = law.ok_or_else(|| {
            let words = LawName::WORDS.iter().map(|(word, _)| format!("\"{word}\""));
            keys.missing("law", or_list(&words.collect::<Vec<_>>()))
        })?;
        // A parameter of another law is a mistake and must not be ignored.
        let has = |law: LawName, key: &str| law.row().keys().any(|own| own == key);
        let is_of_any = |key: &str| LawName::WORDS.iter().any(|(_, other)| has(*other, key));
        let known = Tissue::KEYS.iter().map(|key| key.name);
        let known = known.filter(|key| has(law, key) || !is_of_any(key));
        keys.only(&known.collect::<Vec<_>>())?;
        let estimates = estimates(keys, law)?;
        let values: Vec<_> = estimates.iter().map(|estimate| estimate.value).collect();
        if let Some(positive) = &law.row().positive
            && (positive.of)(&values) <= 0.0
        {
            return Err(Error::BadValue {
                place: keys.place().clone(),
                key: keys.full_name(positive.what),
                found: format!("{}", (positive.of)(&values)),
                expected: positive.expected.into(),
            });
        }
        Self::new(law, &estimates).ok_or_else(|| keys.missing("law", "a law with its parameters"))
    }
}

/// The first term, and those after it up to the last of which a parameter is given.
fn estimates(keys: &Keys<'_>, law: LawName) -> Result<Vec<Estimate>, Error> {
    let row = law.row();
    let given = row
        .parameters
        .iter()
        .rposition(|key| keys.contains(key.name));
    let terms = given.map_or(0, |last| last / row.term) + 1;
    let parameters = row.parameters.iter().take(terms * row.term);
    parameters
        .map(|key| {
            let estimate = keys.estimate_within(key.name, key.domain())?;
            estimate.ok_or_else(|| keys.missing(key.name, key.domain().expected()))
        })
        .collect()
}

impl fmt::Debug for Elasticity {
    /// As a variant of an enumeration: digests of sessions of the first version hold this text.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = f.debug_struct(&format!("{:?}", self.law));
        for (key, estimate) in self.parameters() {
            text.field(key, &estimate);
        }
        text.finish()
    }
}
