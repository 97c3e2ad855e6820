use std::ops::Bound::{Excluded, Included};

use palpate_files::{Domain, Error, Key, Keys};

use super::some_numbers;

/// A bar pulled or pressed along its axis, free to widen.
#[derive(Debug, Clone)]
pub(crate) struct Uniaxial {
    /// Length over length at rest [-].
    pub(crate) stretches: Vec<f64>,
}

const STRETCH: Domain = Domain::number("a stretch", [Excluded(0.0), Included(1e3)])
    .usually(0.05, 10.0)
    .with_remark("1 is at rest");

impl Uniaxial {
    pub(crate) const KEYS: &'static [Key] = &[Key::numbers(
        "stretches",
        STRETCH,
        "Length over length at rest, for each answer.",
    )
    .required("[0.9, 1.1, 1.5]")];

    pub(crate) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            stretches: some_numbers(keys, "stretches", None)?,
        })
    }
}
