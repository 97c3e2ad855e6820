//! A device that another thread moves: the mouse in a window.
//!
//! The owner of the window maps a gesture to a position and moves the [`PointerHand`] there, some sixty times a second;
//! the [`Pointer`] follows at every tick, x ← x + (1 − exp(−Δt/τ)) (target − x), so that the tool moves smoothly where
//! the mouse jumps. It accepts every force and displays none.
//!
//! *How we know*: `devices::a_pointer_glides_to_its_hand`, `devices::a_pointer_that_is_put_down_glides_from_there`.
//!
//! *Limits*: the tool lags behind the mouse by τ, 15 ms unless set otherwise.

use nalgebra::UnitQuaternion;

use super::{Capabilities, Command, Device, DeviceState, Disabled};
use crate::latest::{Receiver, Sender, channel};
use crate::{Fault, Vec3};

/// About a frame of a display [s].
const SMOOTHING: f64 = 0.015;

#[derive(Debug, Clone, Copy, Default)]
struct Target {
    position: Option<Vec3>,
    /// The position [m] at which the tool last appeared, and how often it did.
    put: (Vec3, u32),
    orientation: Option<UnitQuaternion<f64>>,
    grip: f64,
    buttons: u32,
}

/// The window's end of a pointer.
pub struct PointerHand {
    sender: Sender<Target>,
    target: Target,
}

/// The device's end of a pointer.
pub struct Pointer {
    capabilities: Capabilities,
    receiver: Receiver<Target>,
    smoothing: f64,
    position: Option<Vec3>,
    /// How often the tool has appeared.
    put: u32,
    time: f64,
}

impl Pointer {
    /// A device without a hand yet, and the hand that moves it.
    pub fn new() -> (Self, PointerHand) {
        let target = Target::default();
        let (sender, receiver) = channel(&target);
        let pointer = Self {
            capabilities: Capabilities::without_force("mouse"),
            receiver,
            smoothing: SMOOTHING,
            position: None,
            put: 0,
            time: 0.0,
        };
        (pointer, PointerHand { sender, target })
    }

    /// The same with another time constant [s]; zero follows the mouse at once.
    pub fn with_smoothing(mut self, time: f64) -> Self {
        self.smoothing = time.max(0.0);
        self
    }
}

impl PointerHand {
    /// Moves the tool to `position` [m]; a tool without a hand appears there.
    pub fn move_to(&mut self, position: Vec3) {
        self.target.position = Some(position);
        self.sender.send(self.target);
    }

    /// Makes the tool appear at `start` [m] without a path to it, and moves it to `position` [m].
    pub fn move_from(&mut self, start: Vec3, position: Vec3) {
        self.target.put = (start, self.target.put.1.wrapping_add(1));
        self.move_to(position);
    }

    /// Turns the handle; with none the scene determines its direction.
    pub fn turn_to(&mut self, orientation: Option<UnitQuaternion<f64>>) {
        self.target.orientation = orientation;
        self.sender.send(self.target);
    }

    /// Closes the grip, from 0, open, to 1, shut [-], and presses `buttons` (bit mask).
    pub fn press(&mut self, grip: f64, buttons: u32) {
        self.target.grip = grip.clamp(0.0, 1.0);
        self.target.buttons = buttons;
        self.sender.send(self.target);
    }

    /// Removes the hand; at the next `move_to` the tool appears there, without a path to it.
    pub fn leave(&mut self) {
        self.target.position = None;
        self.sender.send(self.target);
    }
}

impl Device for Pointer {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        let target = *self.receiver.latest();
        let elapsed = command.time - self.time;
        self.time = command.time;
        let (start, put) = target.put;
        if put != self.put {
            self.put = put;
            self.position = Some(start);
        }
        self.position = match (target.position, self.position) {
            (Some(target), Some(from)) if self.smoothing > 0.0 => {
                let part = -(-elapsed / self.smoothing).exp_m1();
                Some(from + (target - from) * part)
            }
            (target, _) => target,
        };
        Ok(DeviceState {
            orientation: target.orientation,
            grip: target.grip,
            buttons: target.buttons,
            present: self.position.is_some(),
            ..DeviceState::at(command.time, self.position.unwrap_or_else(Vec3::zeros))
        })
    }

    fn disable(&mut self) -> Disabled {
        Disabled::NoForce
    }
}
