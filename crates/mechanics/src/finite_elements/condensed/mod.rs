//! Finite elements condensed to the surface: the response of a solid whose walls are too thin for
//! boundary elements.
//!
//! The solid is filled with quadratic tetrahedra with a pressure field [Taylor and Hood 1973], K its
//! stiffness with E = 1 and P the nodes' parts in the mean displacement of each triangle of the surface.
//! A force on a triangle is spread over it evenly, which is Pᵀ again, so that
//!
//! ```text
//! Ξ = P K⁻¹ Pᵀ
//! ```
//!
//! is symmetric and positive, and what a force does to the solid as a whole is exact. K is factored once;
//! each column of Pᵀ for a triangle that can be touched goes through the factors, many at a time, on all
//! cores. Contacts are computed from Ξ as from that of boundary elements, of means instead of centroids
//! ([`Sampling`](crate::surface_response::Sampling)).
//!
//! The tetrahedra follow the surface but not its triangles: P takes the sixteen equal parts of a
//! triangle, each at the nearest place of their boundary.
//!
//! Layers and inclusions have tetrahedra of their own, which do not cross their borders ([`RegionLaws`]).
//!
//! *How we know*: `condensed::…`: tubes and a hemisphere under a tip against finite elements that are
//! graded toward it, boundary elements on a thick body, symmetry; `projection::tests`: forces that balance.
//! Measured: `docs/theory/condensed_elements.md`.
//!
//! *Limits*: a load is resolved where it is wider than an edge of the tetrahedra, as that of a tip is where
//! they are no longer than some triangles; the turn of a force about its triangle is that of the nearest
//! place, off by the distance between the two surfaces.

mod filling;
mod problem;
mod projection;

pub use problem::{CondensedProblem, RegionLaws};
