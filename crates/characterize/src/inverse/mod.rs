//! The law of a tissue from the force of an indentation: inverse finite elements (section 6.4.3).
//!
//! All force grows with the modulus M, so with a punch of radius a the elastic force is
//!   Fₑ(d) = M f(d; w),
//! f from finite elements, once for each set of shapes w of the law ([`Curves`]); the relaxed force is its
//! convolution with a known relaxation ([`crate::viscoelastic`]). [`law_fit`] fits M and
//! w. ∂f/∂w comes from the factorization of the run, so that a derivative needs no further run. The
//! crate `reproduce` has the source's own iteration (6.16), with runs of perturbed parameters.
//!
//! *How we know*: `inverse::…`: forces of full viscoelastic runs, at other meshes and Poisson's ratios.
//!
//! *Limits*: one law and one relaxation for the whole body, homogeneous, isotropic and incompressible; a solid
//! specimen is indented in its middle, and large where its recording does not state its size ([`assumption`]), a layer on a
//! base ([`LayerBase`]), or an [`Organ`] of its own shape; a tube has no other law than the neo-Hookean.

mod body;
mod correlations;
mod curved_contact;
mod curves;
mod description;
mod expected;
mod family;
mod fitted_force;
mod forces;
mod law;
mod law_fit;
mod mesh_error;
mod organ;
mod repeated;
mod tables;
mod thickness;

pub use body::{BLOCK, BaseModulus, Body, LayerBase};
pub use correlations::Correlations;
pub use curves::{BaseSensitivity, Curves, UnitCurve};
pub use description::LawDescription;
pub(crate) use expected::expected_law;
pub use fitted_force::{ElasticForce, standard_errors};
pub use forces::{Indentation, ZeroErrors};
pub use law::{CandidateLaw, LawParameter, ShapeRange, Terms};
pub(crate) use law_fit::LawData;
pub use law_fit::{LawFit, OtherMinimum, law_fit};
pub use organ::{FarField, Organ};
pub use repeated::{MIN_DRAWS, NoiseEffect, Repeated, repeated};
pub(crate) use tables::has_curve;
pub use tables::{PUNCH, SHAPES};
pub use thickness::{CONE_ON_LAYER, PUNCH_ON_LAYER, THICKNESSES, assumption, sphere_on_layer};
