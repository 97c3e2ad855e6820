//! Laws without geometry, on plain columns of time, depth and force.
//!
//! *Mean modulus*: closed forms of the half-space for a flat punch (6.1), a sphere [Hertz 1881] and a cone
//! [Sneddon 1965]. *Linear elastic contact*, with adhesion of a sphere: [`ElasticContact`],
//! [`Adhesion`]. *Kelvin*: two springs and a damper, (6.3) as it must read: a step of depth d gives
//! d (k₂ + (k₁ − k₂) exp(−t k₁/b)); the printed form rises with time (`docs/errata.md`).
//!
//! *Column*: the exponential law (6.2) on a column with the indenter's face, pressed to λ = 1 − d/L of its
//! length L ([`column_size`]); the source gives neither face nor length, and inverts λ.
//!
//! *Nonlinear springs*: a spring, and in parallel one or two that relax, each in series with a unit mass and a unit
//! damper, (6.4) with its signs corrected (`docs/errata.md`):
//!   F = k₀₁ [x]^k₀₂ + Σ kᵢ₃ [eᵢ]^kᵢ₂,  eᵢ = x − yᵢ,  ÿᵢ = kᵢ₁ [eᵢ]^kᵢ₂ − ẏᵢ,  [e]^k = sign(e) |e|^k,
//! with x in mm, by the method of Runge and Kutta in steps of a twentieth of the fastest time; the changes
//! with the parameters go along.
//!
//! *A piece* that is pressed or pulled between faces that it slips on, pulled between clamps, or sheared: the nominal stress
//! −F/A of isotropic laws at λ = 1 − d/H in closed form; of the law with fibres, whose strip contracts unequally and shears,
//! by Newton's method. Pieces that are cut at several angles to their fibres are fitted together.
//!
//! *How we know*: `lumped…::…`: closed forms, recordings made from known parameters; the printed springs
//! against the steady forces of table 5-1; silicone against its authors' parameters.
//!
//! *Limits*: small strain but for the column, the springs and the piece; the numbers belong to one indenter on one specimen. A spring does not see that the
//! indenter may let go: on a fast way back it pulls.

mod column;
mod elastic_contact;
mod fibres;
mod kelvin;
mod mean_modulus;
mod piece;
mod springs;
mod springs_fit;
mod uniaxial;

pub use column::{ColumnFit, column_force, column_size, fit_column};
pub use elastic_contact::{Adhesion, ElasticContact, adhesive_force, fit_adhesion, fit_approach};
pub use kelvin::{DepthHistory, KelvinFit, fit_kelvin};
pub use mean_modulus::{Contact, MeanModulus, mean_elastic_modulus, mean_modulus};
pub use piece::{FittedPiece, PieceLoading, PieceTest, piece_stress};
pub use springs::springs_force;
pub use springs_fit::{SpringsFit, fit_springs};
pub use uniaxial::{UniaxialFit, fit_uniaxial, fit_uniaxial_recordings};
