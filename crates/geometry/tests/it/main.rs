//! Tests of the crate from outside.

mod check;
mod data;
mod files;
mod fuzz;
mod io;
mod organ;
