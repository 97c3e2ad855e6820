//! Tests of the crate, one binary.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "clippy.toml allows both in tests, but does not see helpers as tests"
)]

mod contact;
mod data;
mod design;
mod elastic_contact;
mod errors;
mod family;
mod fibres;
mod filter;
mod fit;
mod fitted;
mod in_loop;
mod independent;
mod law_repeated;
mod layer;
mod lumped;
mod lumped_column;
mod lumped_springs;
mod lumped_uniaxial;
mod made_up;
mod online;
mod organ;
mod planar_tension;
mod random;
mod real;
mod relaxation;
mod ripple;
mod segments;
mod sinusoid;
mod specimen;
mod static_response;
mod tables;
mod thickness;
mod viscoelastic;
mod warnings;
