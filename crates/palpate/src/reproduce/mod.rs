//! The tables and figures of the source, recomputed: one file per system of the specification.
//!
//! Published numbers are read from the tables in `published/`, never typed again.

mod figures;
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
mod portrait;
pub(crate) mod published;
mod real_mesh;
mod row;
mod select;
mod table;
mod virtual_rig;

pub(crate) use figures::Figures;
pub(crate) use row::{Row, Rows};
pub(crate) use select::select;
pub(crate) use table::table;

use crate::failure::Failure;

/// A table or a figure of the source.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Item {
    /// As the source counts it, such as `table-3-1`; its rows are called `table-3-1/…`.
    pub(crate) name: &'static str,
    /// What it shows.
    pub(crate) title: &'static str,
    /// Adds its rows.
    pub(crate) run: fn(&mut Rows<'_>) -> Result<(), Failure>,
}

/// All that can be reproduced, in the order of the source.
pub(crate) const ITEMS: [Item; 60] = [
    m01::TABLE_3_1,
    m01::FIGURE_3_3,
    m01::FIGURE_3_4,
    m02::SECTION_3_4,
    m13::FIGURE_3_7,
    m03::TABLE_4_1[0],
    m03::TABLE_4_1[1],
    m03::TABLE_4_1[2],
    m03::GROWTH,
    m03::EQUATION_4_3,
    m03::FIGURE_4_2,
    m04::FIGURE_4_4,
    m04::FIGURE_4_5,
    m04::FIGURE_4_6,
    m13::FIGURE_4_7,
    m06::FIGURE_5_1,
    m11::FIGURE_5_6,
    m05::SECTION_5_2_2,
    m05::FIGURE_5_8,
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
    m07::TABLE_6_1,
    m07::FIGURE_6_3,
    m07::EQUATION_6_3,
    m07::FIGURE_6_4,
    m07::TABLE_6_2,
    m07::FIGURE_6_5,
    m08::TABLE_6_3,
    m08::FIGURE_6_7,
    m08::FIGURE_6_8,
    m08::SECTION_6_4_4,
    m08::TABLE_6_4,
    m08::TABLE_6_5,
    m08::FIGURE_6_9,
    m08::FIGURE_6_10,
    m08::FIGURE_6_11,
    m08::FIGURE_6_12,
    m09::SECTION_6_4_5,
    m09::FIGURE_6_15,
    m11::SECTION_7_3,
    m11::EQUATION_7_6,
    m11::FIGURE_7_7,
    m11::FIGURE_7_8,
    m12::SECTION_7_4,
    m13::TABLE_7_1,
    m13::FIGURE_7_12,
    m15::FIGURE_7_15,
    m15::FIGURE_7_16,
    m09::FIGURE_7_17,
    m16::SECTION_7_8,
    m16::FIGURE_7_18,
    m16::FIGURE_7_19,
];
