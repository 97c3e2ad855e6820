//! M16, the trainer: the demonstration of section 7.8.

mod esophagus;
mod figures;
mod section_7_8;

pub(super) use esophagus::ESOPHAGUS;
pub(super) use figures::{FIGURE_7_18, FIGURE_7_19};
pub(super) use section_7_8::SECTION_7_8;
