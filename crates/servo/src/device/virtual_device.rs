//! A scripted hand on a virtual handle, for tests, demonstrations and runs without a device.
//!
//! A stiff hand follows its trajectory exactly, whatever the force. The force deflects a compliant hand
//! ([`HandImpedance`]) from it.
//!
//! *How we know*: `devices::a_hand_yields_as_its_spring_says`, `devices::a_hand_swings_at_its_frequency`.
//!
//! *Limits*: it has no link inertia, no friction and no encoder: it models a hand, not a machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::hand::HandState;
use super::{Capabilities, Command, Device, DeviceState, Disabled, HandImpedance, Trajectory};
use crate::{Fault, Vec3};

/// A handle that follows a script.
#[derive(Debug)]
pub struct VirtualDevice {
    capabilities: Capabilities,
    trajectory: Trajectory,
    hand: Option<HandImpedance>,
    state: Option<HandState>,
    held_force: Vec3,
    time: f64,
    stops: Arc<AtomicU32>,
}

impl VirtualDevice {
    /// A hand that is exactly where `trajectory` says.
    pub fn new(trajectory: Trajectory) -> Self {
        Self {
            capabilities: Capabilities::premium("virtual"),
            trajectory,
            hand: None,
            state: None,
            held_force: Vec3::zeros(),
            time: 0.0,
            stops: Arc::default(),
        }
    }

    /// The same with a compliant hand.
    ///
    /// # Errors
    /// When a number of the hand is not above zero.
    pub fn with_hand(mut self, hand: HandImpedance) -> Result<Self, Fault> {
        hand.check()?;
        self.hand = Some(hand);
        Ok(self)
    }

    /// The same with other capabilities.
    pub fn with_capabilities(mut self, capabilities: Capabilities) -> Self {
        self.capabilities = capabilities;
        self
    }

    /// How often it was disabled; also readable after it is dropped.
    pub fn disable_count(&self) -> Arc<AtomicU32> {
        self.stops.clone()
    }

    /// Advances to `time` [s] under the last force, and applies `force` [N] from then on. Stand-ins that simulate a
    /// device under a real driver call it; no hand is present.
    pub fn advance(&mut self, time: f64, force: &Vec3) -> DeviceState {
        let scripted = self.trajectory.at(time);
        let position = match self.hand {
            None => scripted.position,
            Some(hand) => {
                let moved = self.move_hand(hand, time);
                self.state = Some(moved);
                moved.position
            }
        };
        self.time = time;
        self.held_force = *force;
        DeviceState {
            orientation: scripted.orientation,
            grip: scripted.grip,
            buttons: scripted.buttons,
            ..DeviceState::at(time, position)
        }
    }

    fn move_hand(&self, hand: HandImpedance, time: f64) -> HandState {
        let elapsed = time - self.time;
        let (from, to) = (self.trajectory.at(self.time), self.trajectory.at(time));
        let mut state = self.state.unwrap_or(HandState {
            position: to.position,
            velocity: Vec3::zeros(),
        });
        if elapsed > 0.0 {
            let way = to.position - from.position;
            let velocity = way / elapsed;
            hand.advance(&mut state, &self.held_force, elapsed, |part| {
                (from.position + way * part, velocity)
            });
        }
        state
    }
}

impl Device for VirtualDevice {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        Ok(self.advance(command.time, &command.force()))
    }

    fn disable(&mut self) -> Disabled {
        self.held_force = Vec3::zeros();
        self.stops.fetch_add(1, Ordering::Relaxed);
        Disabled::NoForce
    }
}

impl Drop for VirtualDevice {
    fn drop(&mut self) {
        self.disable();
    }
}
