//! The interface of devices. Virtual and real devices are the same to all callers.
//!
//! Only a [`ServoLoop`](crate::ServoLoop) commands a device, since nothing else can make a [`Command`] with a force:
//! that force is an [`OutputForce`], which the guard makes, and the loop gives it to the device whose [`Capabilities`]
//! the guard was made for.
//!
//! ```compile_fail,E0624
//! use palpate_servo::{Command, Vec3};
//! // No constructor with a force outside this crate.
//! let command = Command::new(0.0, Vec3::x());
//! ```
//!
//! ```compile_fail,E0451
//! use palpate_servo::{OutputForce, Vec3};
//! // Its field is private.
//! let force = OutputForce { force: Vec3::x() };
//! ```
//!
//! ```compile_fail,E0451
//! use palpate_servo::{Command, OutputForce};
//! // Nor can the force of a guard with other limits be sent.
//! fn sent(force: OutputForce) -> Command {
//!     Command { time: 0.0, force }
//! }
//! ```
//!
//! ```compile_fail,E0616
//! use palpate_servo::{Command, Vec3};
//! fn enlarged(command: &mut Command) {
//!     command.force = Vec3::x();
//! }
//! ```
//!
//! Commands without force are public:
//!
//! ```
//! use palpate_servo::{Command, Device, NoDevice, Vec3};
//! let mut device = NoDevice::new(Vec3::zeros());
//! let state = device.exchange(&Command::without_force(0.0)).unwrap();
//! assert_eq!(state.position, Vec3::zeros());
//! ```

mod capabilities;
mod hand;
mod no_device;
mod pointer;
mod scheduler;
mod trajectory;
mod virtual_device;

use nalgebra::UnitQuaternion;

pub use capabilities::Capabilities;
pub use hand::HandImpedance;
pub use no_device::NoDevice;
pub use pointer::{Pointer, PointerHand};
pub use scheduler::{Next, Scheduler, Tick};
pub use trajectory::{Trajectory, Waypoint};
pub use virtual_device::VirtualDevice;

use crate::{Fault, OutputForce, Vec3};

/// The command for a device at a tick.
#[derive(Debug, PartialEq)]
pub struct Command {
    /// The time on the loop's clock [s].
    pub time: f64,
    force: OutputForce,
}

impl Command {
    /// `force` from `time` [s] on.
    pub(crate) fn new(time: f64, force: OutputForce) -> Self {
        Self { time, force }
    }

    /// No force from `time` [s] on.
    pub fn without_force(time: f64) -> Self {
        Self::new(time, OutputForce::default())
    }

    /// The force on the hand until the next command [N], within the limits of the device's loop.
    pub fn force(&self) -> Vec3 {
        self.force.newtons()
    }
}

/// The state that a device returns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviceState {
    /// The time on the loop's clock [s].
    pub time: f64,
    /// Position of its handle [m].
    pub position: Vec3,
    /// Velocity of its handle [m/s]; none if the device does not measure it. The loop then computes it from the
    /// positions.
    pub velocity: Option<Vec3>,
    /// The rotation from the handle's frame to the device's.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Bit mask of the pressed buttons.
    pub buttons: u32,
    /// Whether a hand holds the handle: false before the first grasp, for a mouse outside its window, and for a stylus
    /// in its inkwell.
    pub present: bool,
    /// Whether it is calibrated, powered and free to display forces.
    pub ready: bool,
    /// The force that it reports as displayed [N]; none if it does not report one.
    pub displayed: Option<Vec3>,
    /// Why it took its forces off by itself although it still answers; the loop then keeps them off until a person arms
    /// again.
    pub fault: Option<Fault>,
}

impl DeviceState {
    /// A device that is ready, at `position` [m] at `time` [s].
    pub fn at(time: f64, position: Vec3) -> Self {
        Self {
            time,
            position,
            velocity: None,
            orientation: None,
            grip: 0.0,
            buttons: 0,
            present: true,
            ready: true,
            displayed: None,
            fault: None,
        }
    }
}

/// The result of disabling a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Disabled {
    /// It confirmed the command for zero force, and displays none.
    NoForce,
    /// It did not answer, or cannot confirm: its own watchdog or switch has to take the force off.
    Unknown,
}

/// A haptic device, or a substitute for one.
///
/// A loop calls [`enable`](Self::enable) after a person armed, [`exchange`](Self::exchange) at every tick, and
/// [`disable`](Self::disable) at once after a fault, at its end, and when it is dropped.
pub trait Device: Send {
    /// Its properties.
    fn capabilities(&self) -> &Capabilities;

    /// Lets it display forces, also after it took them off by itself. Until then it answers and displays none.
    ///
    /// # Errors
    /// When the device refuses; it goes on answering without force.
    fn enable(&mut self) -> Result<(), Fault>;

    /// Sends the force and returns the state: the one call of a tick. It allocates nothing, unless the device's
    /// protocol requires it, and waits no longer than the timeout with which the device was opened.
    ///
    /// # Errors
    /// When the device does not answer or reports a fault; the loop then disables it and ends.
    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault>;

    /// Takes every force off, and returns when that is done or cannot be confirmed. It can be called at any time and
    /// any number of times; dropping a device does the same.
    fn disable(&mut self) -> Disabled;

    /// The scheduler on whose thread the device has to be called; none if any thread may call it.
    fn scheduler(&self) -> Option<Box<dyn Scheduler>> {
        None
    }
}
