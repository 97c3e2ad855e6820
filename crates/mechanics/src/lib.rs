//! Soft-tissue laws and the methods that solve them.
//!
//! The crate does no input and output, starts no thread that outlives a call and has no notion of a tool,
//! a device or a frame rate. A method is three types: a model, built once and immutable; where needed a
//! state, from which a solution continues; and a workspace, scratch whose loss changes no result.
//!
//! ```
//! use std::sync::Arc;
//!
//! use palpate_mechanics::NeoHookean;
//! use palpate_mechanics::contact::FrictionLaw;
//! use palpate_mechanics::finite_elements::indentation::{
//!     Base, Block, IndentationProblem, Indenter, IndenterShape, solve,
//! };
//!
//! // A sphere of 5 mm radius is pressed 1 mm into a block of 50 mm, without friction.
//! let problem = IndentationProblem {
//!     block: Block { radius: 0.05, height: 0.05, base: Base::Bonded },
//!     indenter: Indenter { shape: IndenterShape::Sphere, radius: 5e-3, face: FrictionLaw::Frictionless },
//!     law: Arc::new(NeoHookean::incompressible(1000.0)?), // C10 [Pa]
//! };
//! let found = solve(&problem, &[1e-3], 0.02, &mut |_| {})?;
//! println!("{:.3} mN, within {:.1} %", 1e3 * found.answer.points[0].force, 100.0 * found.error);
//!
//! // Hertz's closed form at small strain: 16/9 E √(R d³), E = 6 C10.
//! let hertz = 16.0 / 9.0 * 6000.0 * (5e-3_f64 * 1e-3_f64.powi(3)).sqrt();
//! assert!((found.answer.points[0].force / hertz - 1.0).abs() < 0.12);
//! # Ok::<(), palpate_mechanics::Error>(())
//! ```

pub mod boundary_elements;
pub mod contact;
pub mod enhance;
mod error;
pub mod finite_elements;
pub mod finite_spheres;
mod gauss;
pub mod inclusion;
mod indentation_curve;
pub mod layered;
mod limits;
mod linear;
mod material;
pub mod nonlinear;
pub mod regions;
pub mod surface_response;
mod tip_law;
pub mod wall;

pub use error::Error;
pub use indentation_curve::IndentationCurve;
pub use limits::{Limit, Limits, Reached};
pub use material::exponential::Exponential;
pub use material::fibres::{FibreError, FibreField, FibreFrame, FibreSample};
pub use material::holzapfel_gasser_ogden::{Fibres, HolzapfelGasserOgden};
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
