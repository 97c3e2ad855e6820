//! Tests of the crate from outside.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "clippy.toml allows both in tests, but does not see helpers as tests"
)]

mod agreement;
mod analytic;
mod bodies;
mod boundary_elements;
mod boundary_response;
mod boundary_tubes;
mod carried_field;
mod cavities;
mod condensed;
mod contacts;
mod convergence;
#[path = "../../../geometry/tests/it/data.rs"]
mod data;
mod dead_loads;
mod elastic_base;
mod enhance;
mod errors;
mod every_law;
mod exterior;
mod fibres;
mod field;
mod friction;
mod hexahedra;
mod homogeneous;
mod homogeneous_piece;
mod indentation;
mod inhomogeneous;
mod invariants;
mod laws;
mod linear_system;
mod no_allocation;
mod nonlinear;
mod nonlinear_cavities;
mod nonlinear_contact;
mod nonlinear_free;
mod nonlinear_friction;
mod nonlinear_judges;
mod nonlinear_regions;
mod nonlinear_relaxation;
mod nonlinear_slit;
mod nonlinear_touching;
mod orders;
mod patch_on_hemisphere;
mod path;
mod pressed_faces;
mod punch_edge;
mod real_organs;
mod refused_input;
mod rigid_tools;
mod rounded_indenters;
mod slit;
mod slit_bodies;
mod slit_closed;
mod slit_held_out;
mod slit_judge;
mod solid;
mod solid_fields;
mod solid_regions;
mod stiffening;
mod stretches;
mod thin_lobes;
mod thin_patch;
mod tip_field;
mod tip_tangent;
mod tube;
mod uncalibrated;
mod uniaxial;
mod unsound;
