//! A linear hemisphere under a rigid patch, and the half-ball that the local model's constants come from.
//!
//! The base z = 0 of the hemisphere is fixed; every point of its surface whose arc from the pole is at
//! most a moves by the depth along −z. A half-ball, fixed on its round side under a punch in the
//! middle of the flat one, gives the stiffness that a fixed periphery adds.
//!
//! *How we know*: `patch_on_hemisphere::…`: the half-space for small patches, the profile of a rigid
//! punch near the edge, order one under halving, base and patch in balance, far finer meshes.
//!
//! *Limits*: small strain; the force is linear in the depth whatever the depth.

mod half_ball;
mod problem;
mod quarter_disc;

pub use half_ball::HalfBall;
pub use problem::{HemisphereAnswer, HemisphereProblem, Patch, solve};
pub(super) use quarter_disc::{Lines, QuarterDisc};
