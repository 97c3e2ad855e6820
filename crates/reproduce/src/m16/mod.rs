//! M16, the trainer: the demonstration of section 7.8.

pub(crate) mod esophagus;
pub(crate) mod figures;
pub(crate) mod section_7_8;
