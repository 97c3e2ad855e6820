//! The seam to devices. The virtual ones and the real ones are the same to everybody above it.

mod hand;
mod no_device;
mod pointer;
mod trajectory;
mod virtual_device;

use std::time::Duration;

use nalgebra::UnitQuaternion;

pub use hand::Hand;
pub use no_device::NoDevice;
pub use pointer::{Pointer, PointerHand};
pub use trajectory::{Trajectory, Waypoint};
pub use virtual_device::VirtualDevice;

use crate::{DeadMan, Fault, Vec3};

/// What a device is. Its frame is right-handed: x right, y up, z toward the user.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviceSpec {
    /// Its name.
    pub name: String,
    /// Least and greatest corner of where its handle can go [m]; none for everywhere.
    pub workspace: Option<[Vec3; 2]>,
    /// The largest force that it displays [N].
    pub peak_force: f64,
    /// The largest that its motors bear for as long as one likes [N].
    pub continuous_force: f64,
    /// What a hand holds while it wants forces; none where there is no such switch.
    pub dead_man: Option<DeadMan>,
    /// Whether its forces reach a hand. A mouse takes every force and displays none.
    pub displays_force: bool,
}

impl DeviceSpec {
    /// One that takes every force and displays none.
    pub fn without_force(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            workspace: None,
            peak_force: f64::INFINITY,
            continuous_force: f64::INFINITY,
            dead_man: None,
            displays_force: false,
        }
    }

    /// A PHANTOM Premium 1.5: 8.5 N, and 1.4 N for as long as one likes, as its maker states.
    pub fn premium(name: &str) -> Self {
        Self {
            peak_force: 8.5,
            continuous_force: 1.4,
            displays_force: true,
            ..Self::without_force(name)
        }
    }
}

/// What is said to a device at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// The time on the loop's clock [s].
    pub time: f64,
    /// The force on the hand until the next command [N].
    pub force: Vec3,
}

/// What a device answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviceState {
    /// The time on the loop's clock [s].
    pub time: f64,
    /// Where its handle is [m].
    pub position: Vec3,
    /// How it moves [m/s]; none when the device does not measure it, and then the loop takes it from the
    /// positions.
    pub velocity: Option<Vec3>,
    /// The rotation from the handle's frame to the device's.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Bit by bit, which buttons are pressed.
    pub buttons: u32,
    /// Whether somebody is there: false before a hand takes a tool up, as a mouse outside its window.
    pub present: bool,
    /// Whether it is calibrated, powered and free to display forces.
    pub ready: bool,
    /// The force that it says it displays [N]; none when it does not say.
    pub displayed: Option<Vec3>,
    /// Why it took its forces off by itself, while it goes on answering; the loop then takes them off until
    /// somebody arms again.
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

/// A haptic device, or what stands for one.
pub trait Device: Send {
    /// What it is.
    fn spec(&self) -> &DeviceSpec;

    /// Force out, state back, within `patience`: the one call of a tick. It allocates nothing, unless the
    /// device's protocol cannot do without.
    ///
    /// # Errors
    /// When the device does not answer or reports a fault; the loop then stops it and ends.
    fn exchange(&mut self, command: &Command, patience: Duration) -> Result<DeviceState, Fault>;

    /// Takes every force off. It can be called at any time and any number of times; a device does it by
    /// itself when it is dropped.
    fn stop(&mut self);
}
