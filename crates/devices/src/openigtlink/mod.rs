//! An OpenIGTLink server that sends the touch to image-guidance software, as 3D Slicer and PLUS read it.
//!
//! Fifty times a second every client gets the transform of each tool, the force on it and the status; at first and on
//! request (`GET_POLYDATA`) the organ's surface. Messages are of version 1, which every reader knows. Lengths are
//! millimetres; the axes are those of medical images, right, anterior and superior, which is a scene's (−x, −y, z).
//!
//! It listens on this machine alone, unless configured otherwise; it accepts no command, and validates all input.
//!
//! *How we know*: `openigtlink::…` in the tests: the published vectors of the protocol; Debian's own library reads what
//! is sent, where it is installed.
//!
//! *Limits*: no streams on request (`STT_`), no encryption. It is for display, not for a force loop. The display in 3D
//! Slicer was not tried: `docs/slicer.md`.

mod checksum;
pub mod message;
mod request;
mod server;

pub use checksum::checksum;
pub use request::{Request, Requests};
pub use server::PORT;
pub(crate) use server::Server;
