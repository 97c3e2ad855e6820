use std::path::PathBuf;
use std::time::Instant;

use palpate_files::write_whole;
use palpate_jobs::Watch;
use palpate_jobs::plot::Plot;
use serde::Serialize;

use super::figures::{Figures, stem};
use super::mark::Mark;
use crate::Error;

/// A number or a figure of the source beside ours.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// Its name, which begins with that of its item.
    pub row: String,
    /// As printed in the source [unit]; none for a figure.
    pub published: Option<f64>,
    /// [unit]; none for a figure, and for a row with a mark that says so.
    pub ours: Option<f64>,
    /// Of both numbers.
    pub unit: &'static str,
    /// Ours over the published one [-].
    pub ratio: Option<f64>,
    /// The figure.
    #[serde(serialize_with = "palpate_jobs::lossy")]
    pub file: Option<PathBuf>,
    /// What the numbers are, and what was assumed.
    pub note: String,
    /// None for our number, or our figure, beside the source's.
    pub mark: Option<Mark>,
    /// How long it took [s].
    pub seconds: f64,
}

/// A number beside its published value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Value {
    /// [unit]
    pub(crate) published: Option<f64>,
    /// [unit]
    pub(crate) ours: Option<f64>,
    pub(crate) unit: &'static str,
}

impl Value {
    /// A number that the source does not print.
    pub(crate) fn own(ours: f64, unit: &'static str) -> Self {
        Self::beside(None, ours, unit)
    }

    /// A number beside what the source prints, if it does.
    pub(crate) fn beside(published: Option<f64>, ours: f64, unit: &'static str) -> Self {
        Self {
            published,
            ours: Some(ours),
            unit,
        }
    }
}

const NOTHING: Value = Value {
    published: None,
    ours: None,
    unit: "",
};

/// Where the rows of a table or figure are gathered; each is as long as it took since the last.
pub struct Rows<'a> {
    item: &'static str,
    figures: &'a Figures,
    watch: &'a dyn Watch,
    since: Instant,
    rows: Vec<Row>,
}

impl<'a> Rows<'a> {
    /// For the rows of `item`; figures are written among `figures`, and `watch` hears what goes on.
    pub fn of(item: &'static str, figures: &'a Figures, watch: &'a dyn Watch) -> Self {
        watch.say(item);
        Self {
            item,
            figures,
            watch,
            since: Instant::now(),
            rows: Vec::new(),
        }
    }

    /// Adds the row `item/name`.
    pub(crate) fn add(&mut self, name: &str, value: Value, note: impl Into<String>) {
        self.push(format!("{}/{name}", self.item), value, None, note.into());
    }

    /// Adds the row `item/name` of a printed number that was put into a virtual recording and found again.
    pub(crate) fn add_pipeline_only(&mut self, name: &str, value: Value, note: impl Into<String>) {
        self.add_marked(name, value, Mark::PipelineOnly, note);
    }

    /// Adds the row `item/name` of a bound: the last value that could be tried.
    pub(crate) fn add_at_least(&mut self, name: &str, value: Value, note: impl Into<String>) {
        self.add_marked(name, value, Mark::AtLeast, note);
    }

    /// A row without a number keeps its own mark.
    fn add_marked(&mut self, name: &str, value: Value, mark: Mark, note: impl Into<String>) {
        self.add(name, value, note);
        if let Some(row) = self.rows.last_mut() {
            row.mark = row.mark.or(Some(mark));
        }
    }

    /// Adds the row `item`, which is not computed for this reason.
    pub(crate) fn not_computed(&mut self, reason: &str) {
        self.push(self.item.to_owned(), NOTHING, None, reason.to_owned());
    }

    /// Adds the row `item/name` without a number, with the reason.
    pub(crate) fn add_missing(
        &mut self,
        name: &str,
        unit: &'static str,
        reason: impl Into<String>,
    ) {
        self.add(name, Value { unit, ..NOTHING }, reason);
    }

    /// Draws `plot` to the file `item.png`, or `item-name.png`, and adds its row.
    pub(crate) fn add_figure(
        &mut self,
        name: Option<&str>,
        plot: &Plot,
        note: impl Into<String>,
    ) -> Result<(), Error> {
        let (row, path) = self.figure(name, "png")?;
        let png = self.figures.drawn(plot)?;
        self.write_figure((row, path), &png, note.into())
    }

    /// Writes the picture `png` to the file `item.png`, or `item-name.png`, and adds its row.
    pub(crate) fn add_picture(
        &mut self,
        name: Option<&str>,
        png: &[u8],
        note: impl Into<String>,
    ) -> Result<(), Error> {
        let (row, path) = self.figure(name, "png")?;
        self.write_figure((row, path), png, note.into())
    }

    /// Writes `text` to the file `item.extension`, and adds its row.
    pub(crate) fn add_text(
        &mut self,
        extension: &str,
        text: &str,
        note: impl Into<String>,
    ) -> Result<(), Error> {
        let (row, path) = self.figure(None, extension)?;
        self.write_figure((row, path), text.as_bytes(), note.into())
    }

    /// The name of a figure's row, and its file, which may be written.
    fn figure(&self, name: Option<&str>, ending: &str) -> Result<(String, PathBuf), Error> {
        let stem = stem(self.item);
        let (row, file) = match name {
            None => (self.item.to_owned(), format!("{stem}.{ending}")),
            Some(name) => (
                format!("{}/{name}", self.item),
                format!("{stem}-{name}.{ending}"),
            ),
        };
        Ok((row, self.figures.path(&file)?))
    }

    fn write_figure(
        &mut self,
        (row, path): (String, PathBuf),
        bytes: &[u8],
        note: String,
    ) -> Result<(), Error> {
        let mut written = Ok(());
        self.watch
            .unbroken(&mut || written = write_whole(&path, bytes));
        written?;
        self.push(row, NOTHING, Some(path), note);
        Ok(())
    }

    /// Tells those who wait what goes on within an item.
    pub(crate) fn say(&self, what: impl std::fmt::Display) {
        self.watch.say(&format!("{}: {what}", self.item));
    }

    /// All that were added, and if the item failed a last one that says why.
    pub fn finished(mut self, outcome: Result<(), Error>) -> Vec<Row> {
        if let Err(failure) = outcome {
            self.push(self.item.to_owned(), NOTHING, None, failure.to_string());
            if let Some(row) = self.rows.last_mut() {
                row.mark = Some(Mark::Failed);
            }
        }
        self.rows
    }

    fn push(&mut self, row: String, value: Value, file: Option<PathBuf>, note: String) {
        self.watch.say(&row);
        // JSON has no other numbers, and a reader no use for them.
        let value = Value {
            ours: value.ours.filter(|ours| ours.is_finite()),
            ..value
        };
        let is_missing = value.ours.is_none() && file.is_none();
        let ratio = value
            .ours
            .zip(value.published)
            .map(|(ours, published)| ours / published);
        self.rows.push(Row {
            row,
            published: value.published,
            ours: value.ours,
            unit: value.unit,
            ratio,
            file,
            note,
            mark: is_missing.then_some(Mark::NotComputed),
            seconds: self.since.elapsed().as_secs_f64(),
        });
        self.since = Instant::now();
    }
}

/// A job within an item: how far it is says nothing of all items.
impl Watch for Rows<'_> {
    fn say(&self, doing: &str) {
        Rows::say(self, doing);
    }

    fn at(&self, _part: f64) {}

    fn is_asked_to_stop(&self) -> bool {
        self.watch.is_asked_to_stop()
    }

    fn unbroken(&self, write: &mut dyn FnMut()) {
        self.watch.unbroken(write);
    }
}
