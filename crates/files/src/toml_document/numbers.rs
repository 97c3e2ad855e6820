use std::ops::RangeInclusive;

use crate::error::Place;
use crate::{Domain, Error, Keys};

use super::key::ValueType;
use super::keys::Found;
use super::value::Value;

impl Keys<'_> {
    /// A number, in the unit that the key ends in [unit of `key`].
    ///
    /// # Errors
    /// When the value is no number or outside its `domain`.
    pub fn number(&self, key: &'static str) -> Result<Option<f64>, Error> {
        let domain = self.declared(key).domain();
        self.find(key)?
            .map(|found| found.number(domain))
            .transpose()
    }

    /// A required number [unit of `key`].
    ///
    /// # Errors
    /// When it is missing, no number or outside its `domain`.
    pub fn required_number(&self, key: &'static str) -> Result<f64, Error> {
        self.number(key)?
            .ok_or_else(|| self.missing(key, self.declared(key).domain().expected()))
    }

    /// Three numbers [unit of `key`].
    ///
    /// # Errors
    /// When the value is anything else or a number is outside its `domain`.
    pub fn vector(&self, key: &'static str) -> Result<Option<[f64; 3]>, Error> {
        let domain = self.declared(key).domain();
        self.find(key)?
            .map(|found| found.vector(domain))
            .transpose()
    }

    /// A list of three numbers each [unit of `key`].
    ///
    /// # Errors
    /// When the value is anything else or a number is outside its `domain`.
    pub fn vectors(&self, key: &'static str) -> Result<Option<Vec<[f64; 3]>>, Error> {
        let Some(found) = self.find(key)? else {
            return Ok(None);
        };
        let domain = self.declared(key).domain();
        let Value::List(values) = found.value else {
            return Err(found.invalid("a list of points, each three numbers [x, y, z]"));
        };
        let each = values.iter().enumerate();
        let each = each.map(|(number, value)| found.item(number, value).vector(domain));
        each.collect::<Result<_, _>>().map(Some)
    }

    /// Three required numbers [unit of `key`].
    ///
    /// # Errors
    /// When they are missing, the value is anything else or a number is outside its `domain`.
    pub fn required_vector(&self, key: &'static str) -> Result<[f64; 3], Error> {
        self.vector(key)?
            .ok_or_else(|| self.missing(key, "a list of three numbers [x, y, z]"))
    }

    /// A direction: three numbers of which one is not zero [-].
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn direction(&self, key: &'static str) -> Result<Option<[f64; 3]>, Error> {
        let direction = self.vector(key)?;
        // Below this length the square underflows and no unit vector can be made.
        if direction.is_some_and(|v| !(v.iter().map(|c| c * c).sum::<f64>().is_normal()))
            && let Some(found) = self.find(key)?
        {
            return Err(found.invalid("a direction whose length is not 0, such as [0.0, 0.0, 1.0]"));
        }
        Ok(direction)
    }

    /// A list of numbers [unit of `key`].
    ///
    /// # Errors
    /// When the value is anything else or a number is outside its `domain`.
    pub fn numbers(&self, key: &'static str) -> Result<Option<Vec<f64>>, Error> {
        let domain = self.declared(key).domain();
        self.find(key)?
            .map(|found| found.numbers(domain, "a list of numbers"))
            .transpose()
    }

    /// A required list of numbers [unit of `key`].
    ///
    /// # Errors
    /// When it is missing, the value is anything else or a number is outside its domain.
    pub fn required_numbers(&self, key: &'static str) -> Result<Vec<f64>, Error> {
        self.numbers(key)?.ok_or_else(|| {
            let each = self.declared(key).domain().expected();
            self.missing(key, format!("a list of numbers, each {each}"))
        })
    }

    /// A whole number in the range of its declaration.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn integer(&self, key: &'static str) -> Result<Option<u64>, Error> {
        let ValueType::Integer(least, most) = self.declared(key).value_type else {
            unreachable!("`{key}` is not declared as a whole number");
        };
        self.integer_within(key, least..=most)
    }

    /// A whole number in a range that depends on other keys.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn integer_within(
        &self,
        key: &'static str,
        range: RangeInclusive<u64>,
    ) -> Result<Option<u64>, Error> {
        let Some(found) = self.find(key)? else {
            return Ok(None);
        };
        let inside = match found.value {
            Value::Integer(value, _) => u64::try_from(*value).ok().filter(|v| range.contains(v)),
            _ => None,
        };
        inside.map(Some).ok_or_else(|| {
            found.invalid(match *range.end() {
                u64::MAX => format!("a whole number of {} or more", range.start()),
                end => format!("a whole number from {} to {end}", range.start()),
            })
        })
    }
}

impl Found<'_> {
    pub(crate) fn number(&self, domain: Domain) -> Result<f64, Error> {
        let given = as_number(self.value).ok_or_else(|| self.invalid(domain.expected()))?;
        let value = self.unit.convert(given);
        if !domain.contains(value) {
            let meant = domain.meant(&self.key, given);
            return Err(self.invalid(domain.expected() + &meant));
        }
        if let Some(warning) = domain.warning(&self.key, given, self.unit) {
            self.warnings.add(format!(
                "{}: `{}` is {}; {warning}",
                self.place,
                self.key,
                self.value.described()
            ));
        }
        Ok(value)
    }

    fn numbers(&self, domain: Domain, expected: &'static str) -> Result<Vec<f64>, Error> {
        let Value::List(values) = self.value else {
            return Err(self.invalid(expected));
        };
        let each = values.iter().enumerate();
        each.map(|(number, value)| self.item(number, value).number(domain))
            .collect()
    }

    fn vector(&self, domain: Domain) -> Result<[f64; 3], Error> {
        const EXPECTED: &str = "a list of three numbers [x, y, z]";
        let numbers = self.numbers(domain, EXPECTED)?;
        <[f64; 3]>::try_from(numbers).map_err(|_| self.invalid(EXPECTED))
    }
}

impl<'d> Found<'d> {
    /// An item of a list, from 0.
    fn item(&self, number: usize, value: &'d Value) -> Self {
        Self {
            place: Place::clone(&self.place),
            key: format!("{}[{number}]", self.key),
            value,
            unit: self.unit,
            warnings: self.warnings,
        }
    }
}

fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(value, _) => Some(*value as f64),
        Value::Number(value, _) => Some(*value),
        _ => None,
    }
}
