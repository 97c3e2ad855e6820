//! Any bytes as a problem of `palpate solve`, which is read and not solved.

#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/jobs/tests/it/readers.rs"]
mod readers;

fuzz_target!(|bytes: &[u8]| readers::read(bytes));
