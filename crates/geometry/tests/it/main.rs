//! Tests of the crate from outside.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "clippy.toml allows both in tests, but does not see helpers as tests"
)]

mod agreement;
mod analytic;
mod check;
mod coarsen;
mod cut;
mod data;
mod dicom;
mod files;
mod fill;
mod fuzz;
mod invariants;
mod io;
mod isosurface;
mod label_maps;
mod organ;
mod readers;
mod refine;
mod shapes;
mod sharp_edges;
mod simplify;
mod slit;
mod tetrahedra;
mod volumes;
mod wrap;
mod write;

/// Whether random tests shall try all of their cases: `PALPATE_FULL=1`.
fn wants_full() -> bool {
    std::env::var_os("PALPATE_FULL").is_some_and(|value| value == "1")
}
