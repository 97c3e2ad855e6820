use std::fmt::Display;
use std::path::PathBuf;
use std::time::Instant;

use palpate_files::write_atomically;
use palpate_jobs::ProgressCallback;
use palpate_jobs::plot::Series;
use palpate_mechanics::finite_elements::estimate::Progress;
use serde::Serialize;

use crate::Error;
use crate::figures::{Figures, stem};
use crate::mark::Mark;
use crate::published::cell;
use crate::registry::{self, FigureData, Published, RowData, Values, filled};

/// A number or a figure of the source versus ours.
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
    /// None for our number, or our figure, versus the source's.
    pub mark: Option<Mark>,
    /// How long it took [s].
    pub seconds: f64,
}

/// Where the rows of a table or figure are gathered; each is as long as it took since the last.
pub(crate) struct Rows<'a> {
    item: &'static str,
    figures: &'a Figures,
    watch: &'a dyn ProgressCallback,
    since: Instant,
    rows: Vec<Row>,
}

impl<'a> Rows<'a> {
    pub(crate) fn of(
        item: &'static str,
        figures: &'a Figures,
        watch: &'a dyn ProgressCallback,
    ) -> Self {
        watch.report_step(item);
        Self {
            item,
            figures,
            watch,
            since: Instant::now(),
            rows: Vec::new(),
        }
    }

    /// What follows the slash in the name of the item.
    pub(crate) fn part(&self) -> &'static str {
        self.item.split_once('/').map_or("", |(_, part)| part)
    }

    /// Adds the row `item/name` of the registry with our number.
    pub(crate) fn add(&mut self, name: &str, ours: impl Into<Option<f64>>) {
        self.row(name).is(ours);
    }

    /// Adds the row `item/name` of the registry without a number; its note says why.
    pub(crate) fn without(&mut self, name: &str) {
        self.row(name).is(None::<f64>);
    }

    /// The row `item/name` of the registry, to be filled.
    pub(crate) fn row(&mut self, name: &str) -> Line<'_, 'a> {
        let (data, values) = registry::row(self.item, name).unzip();
        Line {
            name: self.named(name),
            rows: self,
            data,
            values: values.unwrap_or_default(),
            published: None,
            mark: None,
        }
    }

    /// The figure `item/name` of the registry, or with an empty name `item`, to be drawn.
    pub(crate) fn figure(&mut self, name: &str) -> Figure<'_, 'a> {
        let (data, values) = registry::figure(self.item, name).unzip();
        Figure {
            name: name.to_owned(),
            rows: self,
            data,
            values: values.unwrap_or_default(),
        }
    }

    /// Adds the row `item` with the reason why it is not computed.
    pub(crate) fn not_computed(&mut self) -> Result<(), Error> {
        let data = registry::items().find(|data| data.name == self.item);
        let reason = data.and_then(|data| data.not_computed.as_deref());
        self.row("").missing(reason.unwrap_or_default());
        Ok(())
    }

    /// Reports progress within an item.
    pub(crate) fn report_step(&self, what: impl Display) {
        self.watch.report_step(&format!("{}: {what}", self.item));
    }

    /// The same of a solution on finer and finer meshes.
    pub(crate) fn meshes(&self, what: &str) -> impl FnMut(Progress) {
        move |Progress { mesh, part, .. }| {
            self.report_step(format_args!(
                "{what}mesh {}, {:.0} %",
                mesh + 1,
                100.0 * part
            ));
        }
    }

    /// All that were added, and if the item failed a last one that says why.
    pub(crate) fn finished(mut self, outcome: Result<(), Error>) -> Vec<Row> {
        if let Err(error) = outcome {
            self.push(Row {
                note: error.to_string(),
                mark: Some(Mark::Failed),
                ..empty(self.item.to_owned())
            });
        }
        self.rows
    }

    fn named(&self, name: &str) -> String {
        match name {
            "" => self.item.to_owned(),
            name => format!("{}/{name}", self.item),
        }
    }

    fn push(&mut self, row: Row) {
        self.watch.report_step(&row.row);
        // JSON has no other numbers, and a reader no use for them.
        let ours = row.ours.filter(|ours| ours.is_finite());
        let is_missing = ours.is_none() && row.file.is_none();
        self.rows.push(Row {
            ours,
            ratio: ours
                .zip(row.published)
                .map(|(ours, published)| ours / published),
            mark: match (is_missing, row.mark) {
                (true, mark) if mark != Some(Mark::Failed) => Some(Mark::NotComputed),
                (_, mark) => mark,
            },
            seconds: self.since.elapsed().as_secs_f64(),
            ..row
        });
        self.since = Instant::now();
    }
}

/// A row of which nothing is known but its name.
fn empty(row: String) -> Row {
    Row {
        row,
        published: None,
        ours: None,
        unit: "",
        ratio: None,
        file: None,
        note: String::new(),
        mark: None,
        seconds: 0.0,
    }
}

/// What has no entry in the registry.
const UNKNOWN: &str = "published/rows has no entry of this name; please report this";

/// A row before its number.
pub(crate) struct Line<'r, 'a> {
    rows: &'r mut Rows<'a>,
    name: String,
    data: Option<&'static RowData>,
    values: Values,
    published: Option<f64>,
    mark: Option<Mark>,
}

impl Line<'_, '_> {
    /// What stands in its note for `{name}`.
    pub(crate) fn with(mut self, name: &str, value: impl Display) -> Self {
        self.values.push((name.to_owned(), value.to_string()));
        self
    }

    /// A published number that follows from several of the source's.
    pub(crate) fn published(mut self, value: impl Into<Option<f64>>) -> Self {
        self.published = value.into();
        self
    }

    /// A bound: the last value that could be tried.
    pub(crate) fn at_least(mut self) -> Self {
        self.mark = Some(Mark::AtLeast);
        self
    }

    /// Adds the row with our number.
    pub(crate) fn is(self, ours: impl Into<Option<f64>>) {
        let item = self.rows.item;
        let Some(data) = self.data else {
            return self.missing(UNKNOWN);
        };
        let printed = data.published.as_ref().and_then(|printed| match printed {
            Published::Number(value) => Some(*value),
            Published::Cell(place) => cell(&filled(item, place, &self.values)).ok(),
        });
        self.rows.push(Row {
            published: self.published.or(printed),
            ours: ours.into(),
            unit: &data.unit,
            note: filled(item, &data.note, &self.values),
            mark: self.mark.or(data.mark),
            ..empty(self.name)
        });
    }

    /// Adds the row without a number, with the reason.
    pub(crate) fn missing(self, reason: impl Display) {
        self.rows.push(Row {
            unit: self.data.map_or("", |data| &data.unit),
            note: reason.to_string(),
            ..empty(self.name)
        });
    }
}

/// A figure before it is drawn.
pub(crate) struct Figure<'r, 'a> {
    rows: &'r mut Rows<'a>,
    name: String,
    data: Option<&'static FigureData>,
    values: Values,
}

impl Figure<'_, '_> {
    /// What stands in its note and its title for `{name}`.
    pub(crate) fn with(mut self, name: &str, value: impl Display) -> Self {
        self.values.push((name.to_owned(), value.to_string()));
        self
    }

    /// Draws `series` to the file `item.png`, or `item-name.png`, and adds its row.
    pub(crate) fn draw(self, series: Vec<Series>) -> Result<(), Error> {
        let Some(data) = self.data else {
            return Err(Error::failed(UNKNOWN));
        };
        let plot = data.plot(|text| filled(self.rows.item, text, &self.values), series);
        let png = self.rows.figures.drawn(&plot)?;
        self.file("png", &png)
    }

    /// Writes the picture `png` to the file `item.png`, or `item-name.png`, and adds its row.
    pub(crate) fn picture(self, png: &[u8]) -> Result<(), Error> {
        self.file("png", png)
    }

    /// Writes `bytes` to the file `item.ending`, or `item-name.ending`, and adds its row.
    pub(crate) fn file(self, ending: &str, bytes: &[u8]) -> Result<(), Error> {
        let Some(data) = self.data else {
            return Err(Error::failed(UNKNOWN));
        };
        let item = self.rows.item;
        let separator = if self.name.is_empty() { "" } else { "-" };
        let file = format!("{}{separator}{}.{ending}", stem(item), self.name);
        let path = self.rows.figures.path(&file)?;
        let mut written = Ok(());
        let write = &mut || written = write_atomically(&path, bytes);
        self.rows.watch.without_cancellation(write);
        written?;
        self.rows.push(Row {
            file: Some(path),
            note: filled(item, &data.note, &self.values),
            ..empty(self.rows.named(&self.name))
        });
        Ok(())
    }
}

/// A job within an item: how far it is says nothing of all items.
impl ProgressCallback for Rows<'_> {
    fn report_step(&self, doing: &str) {
        Rows::report_step(self, doing);
    }

    fn report_fraction(&self, _part: f64) {}

    fn should_stop(&self) -> bool {
        self.watch.should_stop()
    }

    fn without_cancellation(&self, write: &mut dyn FnMut()) {
        self.watch.without_cancellation(write);
    }
}
