//! The tables and figures of the source, recomputed: one file per system of the specification.
//!
//! Published numbers are read from the tables in `published/`, never typed again.

mod error;
mod figures;
mod kept;
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
mod not_computed;
mod portrait;
mod published;
mod real_mesh;
mod row;
mod select;
mod table;
mod virtual_rig;

pub use error::Error;
pub use figures::{DrawPlot, Figures};
pub use kept::{KEPT, KeptRows};
pub use mark::Mark;
pub use row::{Row, Rows};
pub use select::{Selection, select};
pub use table::{legend, section};

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
    /// Adds its rows.
    pub run: fn(&mut Rows<'_>) -> Result<(), Error>,
}

/// All tables, figures and numbered statements, in the order of the source.
pub const ITEMS: &[Item] = &[
    not_computed::FIGURE_2_1,
    not_computed::FIGURE_2_2,
    not_computed::TABLE_2_1,
    not_computed::FIGURE_2_3,
    not_computed::FIGURE_2_4,
    not_computed::FIGURE_2_5,
    not_computed::FIGURE_2_6,
    not_computed::FIGURE_3_1,
    not_computed::FIGURE_3_2,
    m01::TABLE_3_1,
    m01::FIGURE_3_3,
    m01::FIGURE_3_4,
    m02::SECTION_3_4,
    not_computed::FIGURE_3_5,
    not_computed::FIGURE_3_6,
    m13::FIGURE_3_7,
    not_computed::FIGURE_4_1,
    m03::EQUATION_4_3,
    m03::TABLE_4_1[0],
    m03::TABLE_4_1[1],
    m03::TABLE_4_1[2],
    m03::GROWTH,
    m03::FIGURE_4_2,
    not_computed::FIGURE_4_3,
    m04::FIGURE_4_4,
    m04::FIGURE_4_5,
    m04::FIGURE_4_6,
    m13::FIGURE_4_7,
    m06::FIGURE_5_1,
    not_computed::FIGURE_5_2,
    not_computed::FIGURE_5_3,
    not_computed::FIGURE_5_4,
    not_computed::FIGURE_5_5,
    m05::SECTION_5_2_2,
    m11::FIGURE_5_6,
    not_computed::FIGURE_5_7,
    m05::FIGURE_5_8,
    not_computed::FIGURE_5_9,
    not_computed::FIGURE_5_10,
    not_computed::FIGURE_5_11,
    m05::FIGURE_5_12,
    m05::FIGURE_5_13,
    m06::FIGURE_5_14,
    m06::TABLE_5_1,
    m06::FIGURE_5_15,
    m06::FIGURE_5_16,
    m05::CHAPTER_5[0],
    m05::CHAPTER_5[1],
    m05::CHAPTER_5[2],
    m05::CHAPTER_5[3],
    not_computed::FIGURE_6_1,
    m07::TABLE_6_1,
    not_computed::FIGURE_6_2,
    m07::FIGURE_6_3,
    m07::EQUATION_6_3,
    m07::FIGURE_6_4,
    m07::TABLE_6_2,
    m07::FIGURE_6_5,
    not_computed::FIGURE_6_6,
    m08::TABLE_6_3,
    m08::FIGURE_6_7,
    m08::FIGURE_6_8,
    m08::SECTION_6_4_4,
    m08::EQUATION_6_17,
    m08::EQUATION_6_18,
    m08::TABLE_6_4,
    m08::TABLE_6_5,
    m08::FIGURE_6_9,
    m08::FIGURE_6_10,
    m08::FIGURE_6_11,
    m08::FIGURE_6_12,
    m09::SECTION_6_4_5,
    not_computed::FIGURE_6_13,
    not_computed::FIGURE_6_14,
    m09::FIGURE_6_15,
    m08::SECTION_6_4_6,
    not_computed::FIGURE_7_1,
    not_computed::FIGURE_7_2,
    not_computed::FIGURE_7_3,
    not_computed::FIGURE_7_4,
    m11::SECTION_7_3,
    not_computed::FIGURE_7_5,
    m11::EQUATION_7_6,
    not_computed::FIGURE_7_6,
    m11::FIGURE_7_7,
    m11::FIGURE_7_8,
    not_computed::FIGURE_7_9,
    m12::SECTION_7_4,
    m12::FIGURE_7_10,
    not_computed::FIGURE_7_11,
    m13::TABLE_7_1,
    not_computed::TABLE_7_2,
    m13::FIGURE_7_12,
    not_computed::FIGURE_7_13,
    not_computed::FIGURE_7_14,
    m15::FIGURE_7_15,
    m15::FIGURE_7_16,
    m09::FIGURE_7_17,
    m16::SECTION_7_8,
    m16::ESOPHAGUS,
    m16::FIGURE_7_18,
    m16::FIGURE_7_19,
    not_computed::APPENDIX_A,
];

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
                    assert!(ITEMS.iter().any(is_there), "{name}");
                }
            }
        }
    }

    #[test]
    fn no_two_items_have_one_name() {
        let names: BTreeSet<&str> = ITEMS.iter().map(|item| item.name).collect();
        assert_eq!(names.len(), ITEMS.len());
    }
}
