use std::ops::Bound::{Excluded, Included};

use crate::toml_document::toml_number;
use crate::{Domain, Error, Estimate, Key, Keys};

/// One term of a Prony series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PronyTerm {
    /// The part of the instantaneous modulus that relaxes [-], from 0 to below 1.
    pub g: Estimate,
    /// Time constant of the relaxation [s].
    pub tau_s: Estimate,
}

pub(super) const KEYS: &[Key] = &[
    Key::number(
        "g",
        PART,
        "The part of the instantaneous modulus that relaxes; all parts together are less than 1.",
    )
    .required("0.4"),
    Key::number(
        "g_standard_error",
        Domain::NOT_NEGATIVE,
        "Its standard error.",
    )
    .optional("0.01", "unknown"),
    Key::number(
        "tau_s",
        Domain::TIME_CONSTANT,
        "Time constant of the relaxation.",
    )
    .required("1.0"),
    Key::number(
        "tau_standard_error_s",
        Domain::NOT_NEGATIVE,
        "Its standard error.",
    )
    .optional("0.05", "unknown"),
];

const PART: Domain = Domain::number("a number", [Included(0.0), Excluded(1.0)]);

pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Vec<PronyTerm>, Error> {
    let terms: Vec<_> = keys
        .tables("prony")?
        .iter()
        .map(term)
        .collect::<Result<_, _>>()?;
    let sum: f64 = terms.iter().map(|term| term.g.value).sum();
    // At 1 the tissue would end as a fluid and above 1 with a negative modulus.
    if sum < 1.0 {
        return Ok(terms);
    }
    Err(Error::BadValue {
        place: keys.place().clone(),
        key: keys.full_name("prony"),
        found: format!("a series whose g add up to {sum}"),
        expected: "terms whose g add up to less than 1".into(),
    })
}

fn term(keys: &Keys<'_>) -> Result<PronyTerm, Error> {
    Ok(PronyTerm {
        g: Estimate {
            value: keys.required_number("g")?,
            standard_error: keys.number("g_standard_error")?,
        },
        tau_s: Estimate {
            value: keys.required_number("tau_s")?,
            standard_error: keys.number("tau_standard_error_s")?,
        },
    })
}

impl PronyTerm {
    pub(super) fn to_toml(self) -> String {
        let Self { g, tau_s } = self;
        let error = |key: &str, error: Option<f64>| {
            error.map_or(String::new(), |error| {
                format!(", {key} = {}", toml_number(error))
            })
        };
        format!(
            "{{ g = {}{}, tau_s = {}{} }}",
            toml_number(g.value),
            error("g_standard_error", g.standard_error),
            toml_number(tau_s.value),
            error("tau_standard_error_s", tau_s.standard_error),
        )
    }
}
