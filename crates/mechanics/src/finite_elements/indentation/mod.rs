//! A rigid indenter pressed into an axisymmetric block, or into one on an elastic base.
//!
//! [`solve`] answers for forces at depths, [`solve_history`] for forces over time; [`IndentationRun`]
//! goes step by step on one mesh.
//!
//! *How we know*: `indentation::…`: closed forms of punch and sphere, F = dE/dd, the two values of a
//! bonded punch in an incompressible neo-Hookean block, refined runs, runs with moved parameters; `elastic_base::…`: transfer
//! matrices; `friction::…`: Spence's partial slip, both limits, the cone at every node.
//!
//! *Limits*: axisymmetric; sharp edge; one coefficient of friction, static as kinetic. A face that slides folds the
//! surface under it at some depth, and what lies beyond is refused.

mod base;
mod contact;
mod edge;
mod indenter;
mod mesh;
mod problem;
mod run;
mod sensitivities;
mod stiffening;

pub use base::ElasticBase;
pub use indenter::{Indenter, IndenterShape, Side};
pub use mesh::{Base, Block};
pub use problem::{
    History, IndentationAnswer, IndentationProblem, RelaxationMethod, solve, solve_history,
};
pub use run::{
    ContactNode, FrictionalContact, IndentationPoint, IndentationRun, IndentationSettings,
};
pub use stiffening::Stiffening;
