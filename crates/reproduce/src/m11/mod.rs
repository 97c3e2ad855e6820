//! M11, the device between hand and tissue: (7.6), its Bode plots, its transparency, and the figure of
//! chapter 5 that shows the same device as an indenter.

mod bode;
mod device;
pub(crate) mod equation_7_6;
pub(crate) mod figure_5_6;
pub(crate) mod figure_7_7;
pub(crate) mod figure_7_8;
mod frequency_response;
mod printed;
pub(crate) mod section_7_3;
mod transfer;
mod two_port;
