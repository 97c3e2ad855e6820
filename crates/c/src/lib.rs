//! The step of [`palpate_simulate`] for programs that speak C: `include/palpate.h`, `libpalpate_c`.
//!
//! ```text
//! palpate_simulation_open ──▶ palpate_simulation ──palpate_state_new──▶ palpate_state ◀──▶ palpate_step
//!                             (any thread)                              (one thread at a time)
//! ```
//!
//! The model and the state of the crate below, each behind an opaque pointer; a state keeps its model alive.
//! Every call ends in a [`Status`]; what is wrong is a sentence, one per thread ([`palpate_error_message`]).
//! A panic ends here: it is caught, told, and the state that it happened in is refused from then on.
//!
//! *How we know*: `agreement::…` (steps through C and in Rust, bit by bit), `header::…` (the header is what cbindgen
//! makes of this), `example::…` (compiled as C and as C++, linked both ways, run), `refusals::…`,
//! `no_allocation::…`; the bench `overhead`.
//!
//! *Limits*: what C cannot tell is not checked: a freed pointer, an array shorter than said. Finer triangles
//! around a contact, sessions, tasks and devices are not here.

#![allow(
    unsafe_code,
    reason = "what comes from C comes as pointers; every one of them is taken up in `pointers` or where it is told \
              about"
)]
#![allow(
    clippy::missing_safety_doc,
    reason = "these comments become the header, whose top says what pointers must be"
)]

mod events;
mod message;
mod pointers;
mod preparation;
mod refused;
mod simulation;
mod state;
mod status;
mod step;
mod surface;
mod version;

pub use events::*;
pub use message::palpate_error_message;
pub use preparation::{Preparation, Watch};
pub use simulation::*;
pub use state::*;
pub use status::Status;
pub use step::{ToolPose, ToolTouch, palpate_step};
pub use surface::*;
pub use version::*;
