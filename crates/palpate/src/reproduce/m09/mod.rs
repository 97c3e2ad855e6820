//! M9, the hollow organ: the tube of section 6.4.5.

mod section_6_4_5;

pub(super) use section_6_4_5::SECTION_6_4_5;
