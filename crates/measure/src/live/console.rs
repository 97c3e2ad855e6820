use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use palpate_servo::{Supervisor, Vec3, log};

use crate::DepthTrajectory;

/// A command to a rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigCommand {
    /// Move by a vector in the rig's axes [m].
    Jog(Vec3),
    /// Move to a position in the rig's axes [m].
    GoTo(Vec3),
    /// Move along a direction in the rig's axes for as long as the command is repeated within a sixth of a second.
    Drive(Vec3),
    /// Set the approach normal, a direction out of the tissue.
    Face(Vec3),
    /// Measure the normal by touching the surface around the position, and approach along it.
    MeasureNormal,
    /// Find the first contact.
    Approach,
    /// Press a trajectory; the number is that of its recording.
    Press(DepthTrajectory, u64),
    /// Leave the tissue.
    Withdraw,
    /// Let the tissue rest.
    Rest,
}

/// The operator's end of a live rig.
pub struct Console {
    commands: log::Writer<StampedCommand>,
    switches: Switches,
    supervisor: Supervisor,
    /// Whether the device is real; dropping the rig then takes all forces off at once: a hand may be on the device.
    is_real: bool,
}

/// A command, and the number of stops before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct StampedCommand {
    pub(super) stops: u64,
    pub(super) command: RigCommand,
}

/// Atomics that the console and the rig share.
#[derive(Debug, Clone, Default)]
pub(super) struct Switches {
    stops: Arc<AtomicU64>,
    arming: Arc<AtomicBool>,
    enough: Arc<AtomicU64>,
    end: Arc<AtomicBool>,
}

/// Capacity of the command ring: a long protocol.
const COMMANDS: usize = 8192;

impl Console {
    pub(super) fn new(
        supervisor: Supervisor,
        is_real: bool,
    ) -> (Self, log::Reader<StampedCommand>, Switches) {
        let (commands, reader) = log::ring(COMMANDS);
        let switches = Switches::default();
        let console = Self {
            commands,
            switches: switches.clone(),
            supervisor,
            is_real,
        };
        (console, reader, switches)
    }

    /// Queues a command.
    pub fn send(&mut self, command: RigCommand) {
        let stops = self.switches.stops();
        self.commands.add(StampedCommand { stops, command });
    }

    /// Ends the running command, out of the tissue, and drops the queued commands.
    pub fn stop(&self) {
        self.switches.stop();
    }

    /// Ends the press with this number, from one on, out of the tissue; the queued commands remain.
    pub fn end_press(&self, number: u64) {
        self.switches.enough.store(number, Ordering::Relaxed);
    }

    /// Takes all forces off at once, until a person arms again, and drops the queued commands.
    pub fn emergency_stop(&self) {
        self.supervisor.trip();
        self.switches.stop();
    }

    /// Lets forces on again after a fault.
    pub fn arm(&self) {
        self.switches.arming.store(true, Ordering::Relaxed);
    }

    pub(super) fn switches(&self) -> Switches {
        self.switches.clone()
    }

    pub(super) fn end(&self) {
        if self.is_real {
            self.supervisor.switch_off();
        }
        self.switches.end.store(true, Ordering::Relaxed);
    }
}

impl Switches {
    pub(super) fn stops(&self) -> u64 {
        self.stops.load(Ordering::Relaxed)
    }

    pub(super) fn stop(&self) {
        self.stops.fetch_add(1, Ordering::Relaxed);
    }

    /// Whether the press with this number shall end.
    pub(super) fn is_enough(&self, number: u64) -> bool {
        self.enough.load(Ordering::Relaxed) == number
    }

    pub(super) fn is_ending(&self) -> bool {
        self.end.load(Ordering::Relaxed)
    }

    pub(super) fn take_arming(&self) -> bool {
        self.arming.swap(false, Ordering::Relaxed)
    }
}
