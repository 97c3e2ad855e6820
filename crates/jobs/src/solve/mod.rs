//! Solves a described problem with the finite element reference.

mod answer;
mod problem;
mod solution;
mod solver_progress;
mod table;

pub use answer::Answer;
pub use problem::Problem;
pub use solution::{
    Displacements, Figures, FrictionFigures, PatchFigures, PointFigures, Profile, RequestedOutputs,
    SolidFigures, Solution, ToolFigures, TubeFigures, solve,
};
pub use table::in_words;
