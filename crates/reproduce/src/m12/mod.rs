//! M12, organ geometry: the simplification of section 7.4.

mod figure_7_10;
mod section_7_4;

pub(super) use figure_7_10::FIGURE_7_10;
pub(super) use section_7_4::SECTION_7_4;
