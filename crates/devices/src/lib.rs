//! Haptic devices that users own, each behind [`palpate_servo::Device`], force sensors ([`force_sensor`]), and servers
//! that send the running simulation to other programs ([`publisher`]).
//!
//! ```text
//!  our thread ────────▶ ServoLoop ─exchange▶ HaplyDevice ─── WebSocket, one message each way ──▶ Inverse Service
//!                       ServoLoop ─exchange▶ ForceDimensionDevice ──────────── calls ──────────▶ libdhd
//!  scheduler of libHD ▶ ServoLoop ─exchange▶ OpenHapticsDevice ────────── a frame per tick ────▶ libHD
//! ```
//!
//! A driver converts the axes of its device to the common device axes (x right, y up, z toward the user, zero in the
//! middle of the handle's workspace), and every error to a named [`Fault`](palpate_servo::Fault). It limits no force:
//! the servo loop does, in the same way for all devices. [`Places`] alone says where to look for services and
//! libraries.
//!
//! *How we know*: every driver runs against a stand-in that speaks its protocol (`crates/device-stand-ins`), with every
//! fault at random moments in contact (`campaign::…` in the tests).
//!
//! *Limits*: the stand-ins were written from the same documents as the drivers. **Nothing here was tried on
//! hardware.**

mod error;
pub mod force_dimension;
pub mod force_sensor;
mod found;
pub mod haply;
mod kind;
mod library;
pub mod open_haptics;
pub mod openigtlink;
mod places;
pub mod publisher;
pub mod rosbridge;
mod rotation;
mod self_test;

pub use error::OpenError;
pub use found::{Found, Origin};
pub use kind::Kind;
pub use places::Places;
pub use self_test::{SelfTest, self_test};
