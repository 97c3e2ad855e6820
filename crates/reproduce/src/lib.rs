//! The tables and figures of the source, reproduced: one module per system of the specification, and the rows as
//! data in `published/rows` (`registry`). The source's tables are in `published`; their numbers stand there only.
//!
//! Prints nothing: the caller draws the plots ([`Figures`]), receives progress
//! ([`palpate_jobs::ProgressCallback`]) and shows the rows.

mod error;
mod figures;
mod finished_rows;
mod m01;
mod m02;
mod m03;
mod m04;
mod m05;
mod m06;
mod m07;
mod m08;
mod m09;
mod m11;
mod m12;
mod m13;
mod m15;
mod m16;
mod machine;
mod mark;
mod published;
mod real_mesh;
mod registry;
mod rendered_body;
mod row;
mod select;
mod table;
mod virtual_rig;
mod wire_frame;

pub use error::Error;
pub use figures::{DrawPlot, Figures};
pub use finished_rows::{FinishedRows, KEPT};
pub use mark::Mark;
pub use row::Row;
pub use select::{Selection, select};
pub use table::{legend, section};

use palpate_jobs::ProgressCallback;

use row::Rows;

/// A table, a figure or a statement of the source.
#[derive(Debug, Clone, Copy)]
pub struct Item {
    /// As the source counts it, such as `table-3-1`; its rows are called `table-3-1/…`.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Usual duration, which only the time left is estimated from [s]: one core at 2.8 GHz, development profile. 0 when
    /// nothing is computed.
    pub seconds: f64,
    run: Run,
}

/// Adds the rows of an item.
type Run = fn(&mut Rows<'_>) -> Result<(), Error>;

/// What computes an item, by its name or by what its name begins with before a slash; the first one counts.
const RUNS: [(&str, Run); 60] = [
    ("table-3-1", m01::table_3_1::run),
    ("figure-3-3", m01::figure_3_3::run),
    ("figure-3-4", m01::figure_3_4::run),
    ("section-3-4", m02::run),
    ("figure-3-7", m13::pictures::figure_3_7),
    ("equation-4-3", m03::equation_4_3::run),
    ("table-4-1/growth", m03::growth::run),
    ("table-4-1", m03::table_4_1::run),
    ("figure-4-2", m03::figure_4_2::run),
    ("figure-4-4", m04::figure_4_4::run),
    ("figure-4-5", m04::figure_4_5::run),
    ("figure-4-6", m04::figure_4_6::run),
    ("figure-4-7", m13::pictures::figure_4_7),
    ("figure-5-1", m06::figure_5_1::run),
    ("section-5-2-2", m05::section_5_2_2::run),
    ("figure-5-6", m11::figure_5_6::run),
    ("figure-5-8", m05::figure_5_8::run),
    ("figure-5-12", m05::figure_5_12::liver),
    ("figure-5-13", m05::figure_5_12::kidney),
    ("figure-5-14", m06::figure_5_14::run),
    ("table-5-1", m06::table_5_1::run),
    ("figure-5-15", m06::figure_5_15::run),
    ("figure-5-16", m06::figure_5_16::run),
    ("chapter-5", m05::chapter_5::run),
    ("table-6-1", m07::table_6_1::run),
    ("figure-6-3", m07::figure_6_3::run),
    ("equation-6-3", m07::equation_6_3::run),
    ("figure-6-4", m07::figure_6_4::run),
    ("table-6-2", m07::table_6_2::run),
    ("figure-6-5", m07::figure_6_5::run),
    ("table-6-3", m08::table_6_3::run),
    ("figure-6-7", m08::figure_6_7::run),
    ("figure-6-8", m08::figure_6_8::run),
    ("section-6-4-4", m08::section_6_4_4::run),
    ("equation-6-17", m08::equation_6_17::neo_hookean),
    ("equation-6-18", m08::equation_6_17::mooney_rivlin),
    ("table-6-4", m08::table_6_4::neo_hookean),
    ("table-6-5", m08::table_6_4::mooney_rivlin),
    ("figure-6-9", m08::figure_6_9::neo_hookean),
    ("figure-6-10", m08::figure_6_9::mooney_rivlin),
    ("figure-6-11", m08::figure_6_11::run),
    ("figure-6-12", m08::figure_6_12::run),
    ("section-6-4-5", m09::section_6_4_5::run),
    ("figure-6-15", m09::figure_6_15::run),
    ("section-6-4-6", m08::section_6_4_6::run),
    ("section-7-3", m11::section_7_3::run),
    ("equation-7-6", m11::equation_7_6::run),
    ("figure-7-7", m11::figure_7_7::run),
    ("figure-7-8", m11::figure_7_8::run),
    ("section-7-4", m12::section_7_4::run),
    ("figure-7-10", m12::figure_7_10::run),
    ("table-7-1", m13::table_7_1::run),
    ("figure-7-12", m13::pictures::figure_7_12),
    ("figure-7-15", m15::figure_7_15::run),
    ("figure-7-16", m15::figure_7_16::run),
    ("figure-7-17", m09::figure_7_17::run),
    ("section-7-8/esophagus", m16::esophagus::run),
    ("section-7-8", m16::section_7_8::run),
    ("figure-7-18", m16::figures::figure_7_18),
    ("figure-7-19", m16::figures::figure_7_19),
];

/// All tables, figures and numbered statements, in the order of the source.
pub fn items() -> Vec<Item> {
    let item = |data: &'static registry::ItemData| Item {
        name: &data.name,
        title: &data.title,
        seconds: data.seconds,
        run: RUNS
            .iter()
            .find(|(name, _)| is_of(name, &data.name))
            .map_or(|rows| rows.not_computed(), |(_, run)| *run),
    };
    registry::items().map(item).collect()
}

/// Whether `item` is `name` or a part of it.
fn is_of(name: &str, item: &str) -> bool {
    let rest = item.strip_prefix(name);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

impl Item {
    /// Computes its rows; when that fails, a last row says why. Figures are written among `figures`, and `watch`
    /// receives the progress.
    pub fn rows(&self, figures: &Figures, watch: &dyn ProgressCallback) -> Vec<Row> {
        let mut rows = Rows::of(self.name, figures, watch);
        let outcome = (self.run)(&mut rows);
        rows.finished(outcome)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Judge: the captions of the source, whose figures and tables are counted from 1 in each chapter.
    #[test]
    fn every_figure_and_table_of_the_source_is_an_item() {
        let chapters = [
            (2, 6, 1),
            (3, 7, 1),
            (4, 7, 1),
            (5, 16, 1),
            (6, 15, 5),
            (7, 19, 2),
        ];
        for (chapter, figures, tables) in chapters {
            for (kind, count) in [("figure", figures), ("table", tables)] {
                for number in 1..=count {
                    let name = format!("{kind}-{chapter}-{number}");
                    // A table may have its parts as items.
                    let is_there = |item: &Item| {
                        item.name == name || item.name.starts_with(&format!("{name}/"))
                    };
                    assert!(items().iter().any(is_there), "{name}");
                }
            }
        }
    }

    #[test]
    fn no_two_items_have_one_name() {
        let names: BTreeSet<&str> = items().iter().map(|item| item.name).collect();
        assert_eq!(names.len(), items().len());
    }

    #[test]
    fn every_computation_is_that_of_an_item() {
        for (name, _) in RUNS {
            assert!(items().iter().any(|item| is_of(name, item.name)), "{name}");
        }
    }
}
