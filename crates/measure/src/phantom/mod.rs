//! A simulated PHANTOM: mechanics with encoders, amplifiers, friction and delay, as a device for a servo loop.
//!
//! [`Machine`] is one linear axis, such as the two masses of the source's figure 7-6 ([`TwoMass`]), exact between two
//! changes of a force. [`RigidBody`] is the three-jointed machine itself [Çavuşoğlu, Feygin and Tendick 2002],
//! [`FlexibleBody`] the same behind compliant cables. With [`Imperfections`], each is a device: [`VirtualPhantom`].
//!
//! *How we know*: `phantom_dynamics::…`: energy is conserved, masses at rest are those published; `phantom::…`: tracking,
//! the largest stable stiffness of a rendered wall, sticking friction; sine injection against the closed forms (7.6):
//! the tests of `m11` of the crate `reproduce`.
//!
//! *Limits*: the numbers are those of publications, not of a machine that was measured here; a joint has one spring, and
//! the links themselves are rigid.

mod flexible_body;
mod imperfections;
mod machine;
mod rigid_body;
mod two_mass;
mod virtual_phantom;

pub use flexible_body::{FlexibleBody, FlexibleJoints};
pub use imperfections::Imperfections;
pub(crate) use imperfections::LONGEST_DELAY;
pub use machine::{ForceMatrix, Machine, MachineState, STATES, StateMatrix};
pub use rigid_body::{Joints, RigidBody};
pub use two_mass::TwoMass;
pub use virtual_phantom::{MECHANICS_STEP, Touch, VirtualPhantom};
