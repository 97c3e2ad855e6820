use super::TableText;
use crate::units::{self, Match, Unit};
use crate::words::near_miss;
use crate::{Domain, Error};

/// A column that was found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Column {
    pub(crate) index: usize,
    /// Its name, as written.
    pub(crate) name: String,
    unit: Match,
}

impl Column {
    pub(super) fn convert(&self, value: f64) -> f64 {
        self.unit.convert(value)
    }

    /// A warning about an unusual number of the column [the unit expected]; none for a usual one.
    pub(crate) fn warning(&self, value: f64, domain: Domain) -> Option<String> {
        let given = match self.unit {
            Match::Exact => value,
            Match::Converted(from, to) => to.convert(value, from),
        };
        let warning = domain.warning(&self.name, given, self.unit)?;
        Some(format!(
            "the column `{}` goes to {given}; {warning}",
            self.name
        ))
    }

    /// The unit of a foreign column, as it is printed.
    pub(crate) fn spelling(&self) -> &'static str {
        match self.unit {
            Match::Exact => "",
            Match::Converted(from, _) => from.spelling,
        }
    }
}

impl TableText<'_> {
    /// The column of a quantity, perhaps in another unit than that of its `expected` name.
    pub(crate) fn column(&self, expected: &str) -> Result<Column, Error> {
        if let Some(column) = self.optional_column(expected)? {
            return Ok(column);
        }
        let strange_unit = self
            .columns()
            .iter()
            .find_map(|own| Some((own, units::accepted_instead(own, expected)?)));
        Err(match strange_unit {
            Some((own, accepted)) => Error::UnknownUnit {
                place: self.column_place(),
                key: own.clone(),
                accepted,
            },
            None => self.missing_column(expected),
        })
    }

    pub(crate) fn missing_column(&self, expected: &str) -> Error {
        let found: Vec<_> = self
            .columns()
            .iter()
            .map(|own| format!("`{own}`"))
            .collect();
        Error::MissingColumn {
            place: self.column_place(),
            column: expected.to_owned(),
            found: found.join(", "),
        }
    }

    /// The column called `name`, whose numbers are in the unit `from` and wanted in the unit `to`.
    pub(crate) fn foreign_column(
        &self,
        name: &str,
        from: &'static Unit,
        to: &'static Unit,
    ) -> Result<Column, Error> {
        let index = self.columns().iter().position(|own| own == name);
        Ok(Column {
            index: index.ok_or_else(|| self.missing_column(name))?,
            name: name.to_owned(),
            unit: Match::Converted(from, to),
        })
    }

    /// The column of an optional quantity.
    pub(crate) fn optional_column(&self, expected: &str) -> Result<Option<Column>, Error> {
        let mut all = self
            .columns()
            .iter()
            .enumerate()
            .filter_map(|(index, own)| Some((index, own, units::matches(own, expected)?)));
        let Some((index, name, unit)) = all.next() else {
            return Ok(None);
        };
        match all.next() {
            Some((_, twin, _)) => Err(Error::GivenTwice {
                place: self.column_place(),
                first: name.clone(),
                second: twin.clone(),
            }),
            None => Ok(Some(Column {
                index,
                name: name.clone(),
                unit,
            })),
        }
    }

    /// Checks that no column is nearly one of the `known`: a misspelled one would be ignored.
    pub(crate) fn refuse_near_misses(&self, known: &[&str]) -> Result<(), Error> {
        for own in self.columns() {
            if known
                .iter()
                .any(|known| units::matches(own, known).is_some())
            {
                continue;
            }
            if let Some(nearest) = near_miss(own, known) {
                return Err(Error::UnknownKey {
                    place: self.column_place(),
                    key: own.clone(),
                    nearest: nearest.to_owned(),
                });
            }
        }
        Ok(())
    }
}
