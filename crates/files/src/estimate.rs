use crate::toml_document::{Value, toml_number};
use crate::{Domain, Error, Key, Keys};

/// A number with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The number [unit of its key].
    pub value: f64,
    /// Its standard error, when known [unit of its key].
    pub standard_error: Option<f64>,
}

impl Estimate {
    /// A number without a standard error [unit of its key].
    pub const fn exactly(value: f64) -> Self {
        Self {
            value,
            standard_error: None,
        }
    }

    /// The value of a TOML key: a plain number, or a table when the error is known.
    pub(crate) fn to_toml(self) -> String {
        let value = toml_number(self.value);
        match self.standard_error.map(toml_number) {
            None => value,
            Some(error) => format!("{{ value = {value}, standard_error = {error} }}"),
        }
    }
}

impl From<f64> for Estimate {
    fn from(value: f64) -> Self {
        Self::exactly(value)
    }
}

/// The keys of an estimate that is a table.
pub(crate) const PARTS: &[Key] = &[
    Key::number("value", Domain::FINITE, "The number.").required("1.0"),
    Key::number(
        "standard_error",
        Domain::NOT_NEGATIVE,
        "Its standard error, in the same unit.",
    )
    .optional("0.1", "unknown"),
];

impl Keys<'_> {
    /// A number or a table `{ value, standard_error }`, both in the unit of the key.
    ///
    /// # Errors
    /// When the value is neither or outside its `domain`.
    pub fn estimate(&self, key: &'static str) -> Result<Option<Estimate>, Error> {
        self.estimate_within(key, self.declared(key).domain())
    }

    /// An estimate in a `domain` that depends on other keys.
    ///
    /// # Errors
    /// When the value is neither or outside its `domain`.
    pub fn estimate_within(
        &self,
        key: &'static str,
        domain: Domain,
    ) -> Result<Option<Estimate>, Error> {
        let Some(found) = self.find(key)? else {
            return Ok(None);
        };
        if !matches!(found.value, Value::Table(_)) {
            return found.number(domain).map(|value| Some(value.into()));
        }
        let Some(parts) = self.table_of(key, PARTS)? else {
            return Ok(None);
        };
        // The domain is that of the key's own unit, so the parts are converted before the check.
        let part = |name, domain: Domain| {
            parts.find(name)?.map_or(Ok(None), |mut part| {
                part.unit = found.unit;
                part.number(domain).map(Some)
            })
        };
        let value =
            part("value", domain)?.ok_or_else(|| parts.missing("value", domain.expected()))?;
        Ok(Some(Estimate {
            value,
            standard_error: part("standard_error", Domain::NOT_NEGATIVE)?,
        }))
    }

    /// A required estimate.
    ///
    /// # Errors
    /// When it is missing, the value is neither or outside its `domain`.
    pub fn required_estimate(&self, key: &'static str) -> Result<Estimate, Error> {
        self.estimate(key)?
            .ok_or_else(|| self.missing(key, self.declared(key).domain().expected()))
    }
}
