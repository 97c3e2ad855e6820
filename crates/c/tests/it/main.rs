//! The interface as a program in C meets it: through pointers.

#![allow(
    unsafe_code,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests call as C does, may unwrap, and print what they measured"
)]

mod agreement;
mod calling;
mod cmake;
mod csharp;
mod example;
mod header;
mod no_allocation;
mod preparation;
mod refusals;
mod states;
