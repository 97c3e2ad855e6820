//! Tests of the crate from outside.

mod check;
mod data;
mod fuzz;
mod io;
