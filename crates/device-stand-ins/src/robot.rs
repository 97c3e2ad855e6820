use std::time::{Duration, Instant};

use palpate_servo::{DeviceState, Vec3};

use super::Mechanics;

/// How time goes by for the mechanics under a stand-in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StandInClock {
    /// So much at every command [s]: the same commands give the same states.
    PerCommand(f64),
    /// As on the wall.
    Wall,
}

/// Forces that are remembered.
const REMEMBERED: usize = 1 << 20;

/// A simulated device under a stand-in.
pub(crate) struct Robot {
    mechanics: Box<dyn Mechanics>,
    clock: StandInClock,
    began: Instant,
    commands: u64,
    commanded: Option<Instant>,
    pub(crate) force: Vec3,
    /// Every force that was commanded.
    pub(crate) forces: Vec<Vec3>,
    pub(crate) state: DeviceState,
}

impl Robot {
    pub(crate) fn new(mechanics: Box<dyn Mechanics>, clock: StandInClock) -> Self {
        let mut robot = Self {
            mechanics,
            clock,
            began: Instant::now(),
            commands: 0,
            commanded: None,
            force: Vec3::zeros(),
            // Room for a test that counts allocations.
            forces: Vec::with_capacity(1 << 13),
            state: DeviceState::at(0.0, Vec3::zeros()),
        };
        robot.state = robot.mechanics.advance(0.0, &Vec3::zeros());
        robot
    }

    /// The device takes `force` [N], given in our axes, and says where it is.
    pub(crate) fn command(&mut self, force: Vec3) {
        let time = match self.clock {
            StandInClock::PerCommand(step) => step * self.commands as f64,
            StandInClock::Wall => self.began.elapsed().as_secs_f64(),
        };
        self.commands += 1;
        self.commanded = Some(Instant::now());
        if self.forces.len() < REMEMBERED {
            self.forces.push(force);
        }
        self.force = force;
        self.state = self.mechanics.advance(time, &force);
    }

    /// Without a command for `long` it takes its force off.
    pub(crate) fn rest_after(&mut self, long: Duration) {
        if self.commanded.is_some_and(|when| when.elapsed() > long) {
            self.rest();
        }
    }

    pub(crate) fn rest(&mut self) {
        self.commanded = None;
        self.force = Vec3::zeros();
    }
}
