//! How a haptic device moves: what stands between a hand and the force that a computer wants it to feel
//! (section 7.3).
//!
//! ```text
//! F_h = G₁ x_h + G₂ F_e         (7.1)      x_h, F_h: place and force of the hand
//! Z_h = G₁ + G₂ Z_tissue        (7.2)      F_e: force of the motors, against the hand
//! ```
//!
//! [`TwoPort`] is this in frequency: (7.6) as it is printed, and of two masses with one unit for
//! everything. [`Machine`] is the same in time, exact between two changes of a force. [`RigidBody`] is the
//! three-jointed machine itself [Çavuşoğlu, Feygin and Tendick 2002], [`FlexibleBody`] the same behind cables that
//! give way. With [`Imperfections`], each is a device: [`VirtualPhantom`](crate::VirtualPhantom).
//! [`Compensation`] is what such a device adds so that it is felt less.
//!
//! *How we know*: `dynamics::…`: sine injection beside the closed forms, energy that stays, masses at rest,
//! the largest stiffness of a rendered wall; `compensation::…`.
//!
//! *Limits*: the numbers of the machine are those of publications, not of a machine that was measured here;
//! a joint gives way by one spring, and the links themselves do not bend.

mod compensation;
mod flexible_body;
mod frequency_response;
mod imperfections;
mod machine;
mod rigid_body;
mod transfer;
mod two_mass;
mod two_port;

pub(crate) use compensation::Compensator;
pub use compensation::{Compensation, largest_mass};
pub use flexible_body::{FlexibleBody, FlexibleJoints};
pub use frequency_response::{Port, inject};
pub use imperfections::Imperfections;
pub(crate) use imperfections::LONGEST_DELAY;
pub use machine::{Machine, MachineState};
pub use rigid_body::{Joints, RigidBody};
pub use transfer::Transfer;
pub use two_mass::TwoMass;
pub use two_port::{TwoPort, transparent_up_to};
