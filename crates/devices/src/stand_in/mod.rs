//! What stands for devices that are not at hand: for tests, and for trying without hardware.
//!
//! Each speaks the protocol of a service, or has the functions of a library, over any
//! [`Device`](palpate_servo::Device), a virtual one as a rule, and has switches for what can go wrong.
//!
//! *Limits*: they were written from documents. A driver that gets along with them was not tried on hardware.

mod daq;
mod haply;
mod library;
mod misbehaviour;
mod net_ft;
mod robot;

pub use daq::DaqStandIn;
pub use haply::{HaplyStandIn, HaplyStandInSettings, StandInGrip};
pub use library::StandInLibrary;
pub use misbehaviour::Misbehaviour;
pub use net_ft::{NetFtFault, NetFtStandIn};
pub use robot::StandInClock;
