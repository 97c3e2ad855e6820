//! M5, the rig: the waveforms of figure 5-8 as the device tracks them, recordings like those of figures 5-12 and 5-13,
//! whether the device disturbs what it measures (5.2.2), and chapter 5 as a whole on virtual animals.

pub(crate) mod chapter_5;
pub(crate) mod figure_5_12;
pub(crate) mod figure_5_8;
mod organ;
mod rig;
pub(crate) mod section_5_2_2;
mod subjects;
