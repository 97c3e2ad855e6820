//! Soft-tissue laws and the methods that solve them.
//!
//! The crate does no input and output, starts no thread that outlives a call and does not know what a
//! tool, a device or a frame rate is. A method is three types: a model, built once and immutable; where
//! needed a state, all that must be kept to go on; and a workspace, scratch whose loss changes no result.

pub mod boundary_elements;
pub mod contact;
mod cores;
pub mod enhance;
mod error;
pub mod finite_elements;
pub mod finite_spheres;
mod indentation_curve;
pub mod layered;
mod limits;
mod linear;
mod material;
pub mod nonlinear;
pub mod surface_response;
mod tip_law;

pub use cores::{on_all_cores, threads_were_refused};
pub use error::Error;
pub use indentation_curve::IndentationCurve;
pub use limits::{Limit, Limits, Reached};
pub use material::exponential::Exponential;
pub use material::law::{Distortion, Law, Tangent};
pub use material::linear_elastic::LinearElastic;
pub use material::material::{Material, named as law_named};
pub use material::mooney_rivlin::MooneyRivlin;
pub use material::neo_hookean::NeoHookean;
pub use material::ogden::Ogden;
pub use material::prony::{ForceHistory, MAX_TERMS, PronySeries, branch};
pub use material::reduced_polynomial::ReducedPolynomial;
pub use material::volume::{Strain, Volume};
pub use palpate_geometry::Vec3;
pub use tip_law::{NormalForce, TipForce, TipLaw};
