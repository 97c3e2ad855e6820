//! Tests of the crate, one binary.

mod fit;
