//! M4, local enhancement (`palpate_mechanics::enhance`): the interpolation functions of section 4.3 in one
//! dimension, as the library makes them of the weights, and a cube that it makes finer and smooths.

pub(crate) mod figure_4_4;
pub(crate) mod figure_4_5;
pub(crate) mod figure_4_6;
