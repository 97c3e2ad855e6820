//! M5, the rig: what the waveforms of figure 5-8 become on the device, recordings like those of figures 5-12 and 5-13,
//! whether the device disturbs what it measures (5.2.2), and chapter 5 as a whole on animals that are not there.

mod chapter_5;
mod figure_5_12;
mod figure_5_8;
mod organ;
mod rig;
mod section_5_2_2;
mod subjects;

pub(super) use chapter_5::CHAPTER_5;
pub(super) use figure_5_8::FIGURE_5_8;
pub(super) use figure_5_12::{FIGURE_5_12, FIGURE_5_13};
pub(super) use section_5_2_2::SECTION_5_2_2;
