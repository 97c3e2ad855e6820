//! M11, the device between hand and tissue: (7.6), its Bode plots, what a hand feels through it, and the figure of
//! chapter 5 that shows the same device as an indenter.

mod bode;
mod device;
mod equation_7_6;
mod figure_5_6;
mod figure_7_7;
mod figure_7_8;
mod frequency_response;
mod printed_machine;
mod section_7_3;
mod transfer;
mod two_port;

pub(super) use equation_7_6::EQUATION_7_6;
pub(super) use figure_5_6::FIGURE_5_6;
pub(super) use figure_7_7::FIGURE_7_7;
pub(super) use figure_7_8::FIGURE_7_8;
pub(super) use section_7_3::SECTION_7_3;
