//! What stands for devices that are not at hand: for tests, and for trying without hardware. No crate that is shipped
//! depends on it.
//!
//! Each speaks the protocol of a service, or has the functions of a library, over any [`Mechanics`], and has switches for
//! what can go wrong. Where a vendor's documents promise nothing they do the worst: a closed device keeps its force, a
//! scheduler calls late, twice, at once, and after it was stopped, and a call may never return.
//!
//! *Limits*: they were written from documents. A driver that gets along with them was not tried on hardware.

mod daq;
mod haply;
mod library;
mod mechanics;
mod misbehaviour;
mod net_ft;
mod robot;

pub use daq::DaqStandIn;
pub use haply::{HaplyStandIn, HaplyStandInSettings, StandInGrip};
pub use library::StandInLibrary;
pub use mechanics::Mechanics;
pub use misbehaviour::Misbehaviour;
pub use net_ft::{NetFtFault, NetFtStandIn};
pub use robot::StandInClock;
