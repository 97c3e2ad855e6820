use palpate_files::{Domain, Error, Keys};

use super::some_numbers;

/// A bar pulled or pressed along its axis, free to widen.
#[derive(Debug, Clone)]
pub(crate) struct Uniaxial {
    /// Length over length at rest [-].
    pub(crate) stretches: Vec<f64>,
}

impl Uniaxial {
    pub(crate) const KEYS: &'static [&'static str] = &["stretches"];

    pub(crate) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let domain = Domain {
            expected: "a stretch above 0 (1 is at rest)",
            holds: |stretch| stretch > 0.0,
        };
        Ok(Self {
            stretches: some_numbers(keys, "stretches", domain, None)?,
        })
    }
}
