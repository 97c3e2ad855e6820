//! M12, organ geometry: the simplification of section 7.4.

pub(crate) mod figure_7_10;
pub(crate) mod section_7_4;
