use super::axes::{Reading, SensorAxes};
use crate::table::{Row, TableText};
use crate::{Domain, Error, units};

/// The samples of a recording, column by column; all columns have one number for each sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Samples {
    /// The times [s].
    pub time_s: Vec<f64>,
    /// The depths [m].
    pub depth_m: Vec<f64>,
    /// The forces [N].
    pub force_n: Vec<f64>,
}

/// An unknown column of a recording, which is preserved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExtraColumn {
    /// Its name.
    pub name: String,
    /// Its fields, as written.
    pub values: Vec<String>,
}

impl Samples {
    pub(super) fn check(&self) -> Result<(), Error> {
        let wrong = |what: String, found: String, expected: String| {
            Err(Error::BadContent {
                what,
                found,
                expected: expected.into(),
            })
        };
        let samples = self.time_s.len();
        if samples == 0 {
            return wrong(
                "a recording".into(),
                "empty".into(),
                "at least one sample".into(),
            );
        }
        for (name, values, domain) in self.columns() {
            if values.len() != samples {
                let found = format!("{} numbers for {samples} times", values.len());
                return wrong(name.into(), found, "one for each time".into());
            }
            if let Some(sample) = values.iter().position(|value| !domain.contains(*value)) {
                let what = format!("{name} of sample {sample}");
                return wrong(what, values[sample].to_string(), domain.expected());
            }
        }
        let stands_still = self.time_s.windows(2).position(|pair| pair[1] <= pair[0]);
        if let Some(sample) = stands_still {
            let what = format!("time_s of sample {}", sample + 1);
            let found = self.time_s[sample + 1].to_string();
            return wrong(what, found, "a time after that of the sample before".into());
        }
        Ok(())
    }

    fn columns(&self) -> [(&'static str, &[f64], Domain); 3] {
        [
            ("time_s", &self.time_s, Domain::TIME),
            ("depth_m", &self.depth_m, Domain::POSITION),
            ("force_n", &self.force_n, Domain::ANY_FORCE),
        ]
    }
}

impl ExtraColumn {
    /// The fields as numbers [unit of the name]; none when one is no number.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        self.values.iter().map(|text| text.parse().ok()).collect()
    }

    pub(super) fn check(&self, samples: usize) -> Result<(), Error> {
        let wrong = |found: String, expected: &'static str| {
            Err(Error::BadContent {
                what: format!("the extra column {:?}", self.name),
                found,
                expected: expected.into(),
            })
        };
        let taken = ["time_s", "depth_m", "force_n"]
            .into_iter()
            .chain(SensorAxes::COLUMNS)
            .any(|name| units::matches(&self.name, name).is_some());
        if taken || self.name.is_empty() || self.name.trim() != self.name {
            let expected = "another name, without spaces at its ends";
            return wrong("named like that".to_owned(), expected);
        }
        if self.values.len() != samples {
            let found = format!("{} values long", self.values.len());
            return wrong(found, "one value for each sample");
        }
        match self.values.iter().find(|value| value.trim() != *value) {
            Some(value) => wrong(format!("{value:?}"), "values without spaces at their ends"),
            None => Ok(()),
        }
    }
}

/// The treatment of a row that repeats the one above it in every field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Repeated {
    /// It is an error, because time stands still.
    Refused,
    /// It is left out.
    LeftOut,
}

/// The samples of a table with its other content.
#[derive(Debug, Default)]
pub(super) struct Read {
    pub(super) samples: Samples,
    pub(super) axes: Option<SensorAxes>,
    pub(super) extra_columns: Vec<ExtraColumn>,
    /// Rows that were left out because they repeat another.
    pub(super) repeated: usize,
}

/// The samples of a table. Rows that `is_passed_over` are left out.
pub(super) fn read(
    table: &TableText<'_>,
    reading: &Reading<'_>,
    is_passed_over: impl Fn(&Row<'_>) -> bool,
) -> Result<Read, Error> {
    let [time, depth, force] = reading.columns;
    let mut read = Read {
        axes: reading.axes.map(|_| SensorAxes::default()),
        ..Read::default()
    };
    let mut extra = extra_columns(table, reading);
    let mut above: Vec<String> = Vec::new();
    let mut rows = table.rows();
    while let Some(row) = rows.next()? {
        if is_passed_over(&row) {
            continue;
        }
        if reading.on_repeated == Repeated::LeftOut {
            if row.fields().eq(above.iter().map(String::as_str)) {
                read.repeated += 1;
                continue;
            }
            above.clear();
            above.extend(row.fields().map(str::to_owned));
        }
        let samples = &mut read.samples;
        let time_s = row.number(time, Domain::TIME)?;
        row.check_after(time, time_s, samples.time_s.last().copied())?;
        samples.time_s.push(time_s);
        samples.depth_m.push(row.number(depth, Domain::POSITION)?);
        samples.force_n.push(row.number(force, Domain::ANY_FORCE)?);
        if let Some((own, columns)) = read.axes.as_mut().zip(reading.axes) {
            own.take(&row, columns)?;
        }
        for (index, column) in &mut extra {
            column.values.push(row.field(*index).to_owned());
        }
    }
    if read.samples.time_s.is_empty() {
        let path = table.path.clone();
        return Err(Error::NoRows { path });
    }
    read.extra_columns = extra.into_iter().map(|(_, column)| column).collect();
    Ok(read)
}

fn extra_columns(table: &TableText<'_>, reading: &Reading<'_>) -> Vec<(usize, ExtraColumn)> {
    let names = table.columns().iter().enumerate();
    let axes = reading.axes.into_iter().flatten();
    let known: Vec<usize> = reading
        .columns
        .iter()
        .chain(axes)
        .map(|c| c.index)
        .collect();
    names
        .filter(|(index, name)| !name.is_empty() && !known.contains(index))
        .map(|(index, name)| {
            let column = ExtraColumn {
                name: name.clone(),
                values: Vec::new(),
            };
            (index, column)
        })
        .collect()
}
