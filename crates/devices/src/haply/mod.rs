//! The devices of Haply, by their Inverse Service: one message with a force out, one with a state back.
//!
//! The driver supports both generations of messages: forces are `vector` from version 3.5 on and `values` before. A
//! connected grip turns the tool, shuts it and cuts. Events of the service become faults.
//!
//! *How we know*: `haply::…`, `haply_faults::…`, `haply_messages::…` in the tests, against a stand-in for the service.
//!
//! *Limits*: that `cursor_position` is (x right, y away from the user, z up) follows from the middle of its workspace
//! and was not verified; neither were the axes of a grip. The WebSocket allocates a message at every tick. The largest
//! forces of the devices are our assumptions. Not tried on hardware.

mod address;
mod channel;
mod device;
mod event;
mod frame;
pub mod message;
mod timed_stream;

pub use address::HaplyAddress;
pub use device::{HaplyDevice, list};
pub use event::Event;
pub use message::{Generation, ServiceInventory, State, force_command};
