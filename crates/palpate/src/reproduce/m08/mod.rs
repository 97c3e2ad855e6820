//! M8, characterization with continuum mechanics: the block of figure 6-8 with the published laws.

mod block;
mod figure_6_12;
mod figure_6_8;

pub(super) use figure_6_8::FIGURE_6_8;
pub(super) use figure_6_12::FIGURE_6_12;
