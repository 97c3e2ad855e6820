//! A rigid indenter pressed into an axisymmetric block.

mod indenter;
mod mesh;
mod run;

pub use indenter::{Grip, Indenter, IndenterShape, Side};
pub use mesh::Block;
pub use run::{IndentationPoint, IndentationRun, IndentationSettings};
