//! M16, the trainer: the demonstration of section 7.8.

mod section_7_8;

pub(super) use section_7_8::SECTION_7_8;
