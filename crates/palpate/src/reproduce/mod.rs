//! The tables and figures of the source, recomputed: one file per system of the specification.
//!
//! Published numbers are read from the tables in `published/`, never typed again.

mod m01;
mod m02;
mod m04;
mod m08;
mod m09;
mod m13;
mod published;
mod row;
mod select;
mod table;

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
pub(crate) const ITEMS: [Item; 11] = [
    m01::TABLE_3_1,
    m01::FIGURE_3_3,
    m01::FIGURE_3_4,
    m02::SECTION_3_4,
    m13::FIGURE_3_7,
    m04::FIGURE_4_5,
    m08::FIGURE_6_8,
    m08::FIGURE_6_12,
    m09::SECTION_6_4_5,
    m13::TABLE_7_1,
    m13::FIGURE_7_12,
];
