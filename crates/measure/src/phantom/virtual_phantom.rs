//! A virtual PHANTOM: the mechanics of [`crate::phantom`] with encoders, amplifiers, friction and
//! delay, between a loop and a hand or specimen at the handle.
//!
//! Between two exchanges the motors keep their force, and the machine moves in steps of 50 µs under that force and
//! the force of the hand, or of the specimen under the tip.
//!
//! *How we know*: `phantom::…`: tracking, a rendered wall at the edge of stability, sticking friction.
//!
//! *Limits*: the axes of a linear machine are independent; steps of encoders are taken at the handle.

use palpate_servo::{Capabilities, Command, Device, DeviceState, Disabled, Fault, Vec3};

use super::{
    FlexibleBody, FlexibleJoints, Imperfections, Joints, LONGEST_DELAY, Machine, MachineState,
    RigidBody,
};

/// What touches a handle: its force on it [N], given the time [s], the place [m] and the velocity [m/s].
pub type Touch = Box<dyn FnMut(f64, &Vec3, &Vec3) -> Vec3 + Send>;

/// Steps of the mechanics [s].
pub const MECHANICS_STEP: f64 = 50e-6;

/// A handle with mechanics.
pub struct VirtualPhantom {
    capabilities: Capabilities,
    mechanics: Mechanics,
    imperfections: Imperfections,
    touch: Touch,
    time: f64,
    /// The last commands; the newest is at `exchanges`.
    commands: [Vec3; LONGEST_DELAY + 1],
    exchanges: usize,
}

/// The mechanics.
enum Mechanics {
    /// Three axes alike.
    Axes(Box<Machine>, [MachineState; 3]),
    /// Three joints.
    Links(Box<RigidBody>, Joints),
    /// Three joints behind springs.
    Flexible(Box<FlexibleBody>, FlexibleJoints),
}

impl VirtualPhantom {
    /// Three axes like `machine`, which must step by [`MECHANICS_STEP`], at rest at `position` [m].
    pub fn with_axes(machine: Machine, position: &Vec3, imperfections: Imperfections) -> Self {
        let states = [position.x, position.y, position.z].map(MachineState::at);
        Self::new(Mechanics::Axes(Box::new(machine), states), imperfections)
    }

    /// Three joints at rest, the handle at zero.
    pub fn with_links(body: RigidBody, imperfections: Imperfections) -> Self {
        let joints = Joints {
            angles: Vec3::zeros(),
            rates: Vec3::zeros(),
        };
        Self::new(Mechanics::Links(Box::new(body), joints), imperfections)
    }

    /// Three joints behind springs at rest, the handle at zero.
    pub fn with_flexible_links(body: FlexibleBody, imperfections: Imperfections) -> Self {
        let joints = FlexibleBody::at_rest();
        Self::new(Mechanics::Flexible(Box::new(body), joints), imperfections)
    }

    fn new(mechanics: Mechanics, imperfections: Imperfections) -> Self {
        Self {
            capabilities: Capabilities {
                peak_force: imperfections.peak_force,
                ..Capabilities::premium("virtual PHANTOM")
            },
            mechanics,
            imperfections,
            touch: Box::new(|_, _, _| Vec3::zeros()),
            time: 0.0,
            commands: [Vec3::zeros(); LONGEST_DELAY + 1],
            exchanges: 0,
        }
    }

    /// The same, where a function gives the contact force on its handle.
    pub fn with_contact(mut self, touch: Touch) -> Self {
        self.touch = touch;
        self
    }

    /// Moves on to `time` [s] under the last force, and takes `force` [N] from then on. What simulates a device under
    /// another's driver calls it; no hand is there.
    pub fn advance(&mut self, time: f64, force: &Vec3) -> DeviceState {
        self.move_on(time);
        self.exchanges += 1;
        let newest = self.exchanges % self.commands.len();
        self.commands[newest] = *force;
        let seen = self
            .mechanics
            .encoded()
            .map(|place| self.imperfections.encoder_reading(place));
        DeviceState::at(time, seen)
    }

    /// The force of the motors now [N].
    fn driven(&self) -> Vec3 {
        let delay = self.imperfections.delay.min(LONGEST_DELAY);
        if self.exchanges < delay {
            return Vec3::zeros();
        }
        let command = self.commands[(self.exchanges - delay) % self.commands.len()];
        command.map(|force| self.imperfections.amplified(force))
    }

    /// Moves on until `time` [s].
    fn move_on(&mut self, time: f64) {
        let motor = self.driven();
        let steps = ((time - self.time) / MECHANICS_STEP)
            .round()
            .clamp(0.0, 1e6) as u32;
        for _ in 0..steps {
            let (position, velocity) = self.mechanics.handle();
            let touched = (self.touch)(self.time, &position, &velocity);
            let friction = self.imperfections.friction;
            self.mechanics.step(&touched, &motor, friction);
            self.time += MECHANICS_STEP;
        }
    }
}

impl Mechanics {
    /// Place [m] and velocity [m/s] of the handle.
    fn handle(&self) -> (Vec3, Vec3) {
        match self {
            Self::Axes(_, states) => (
                Vec3::from_fn(|axis, _| states[axis].position()),
                Vec3::from_fn(|axis, _| states[axis].velocity()),
            ),
            Self::Links(body, joints) => (
                body.linkage.position(&joints.angles),
                body.linkage.jacobian(&joints.angles) * joints.rates,
            ),
            Self::Flexible(body, joints) => (
                body.links.linkage.position(&joints.links.angles),
                body.links.linkage.jacobian(&joints.links.angles) * joints.links.rates,
            ),
        }
    }

    /// Where its encoders say that the handle is [m].
    fn encoded(&self) -> Vec3 {
        match self {
            Self::Flexible(body, joints) => body.links.linkage.position(&joints.rotors.angles),
            _ => self.handle().0,
        }
    }

    fn step(&mut self, touched: &Vec3, motor: &Vec3, friction: f64) {
        match self {
            Self::Axes(machine, states) => {
                for (axis, state) in states.iter_mut().enumerate() {
                    machine.advance(state, touched[axis], motor[axis]);
                    machine.rub(state, friction);
                }
            }
            Self::Links(body, joints) => {
                let torque = body.linkage.jacobian(&joints.angles).transpose() * motor;
                body.advance(joints, &torque, touched, MECHANICS_STEP);
                body.rub(joints, friction, MECHANICS_STEP);
            }
            Self::Flexible(body, joints) => {
                let torque = body
                    .links
                    .linkage
                    .jacobian(&joints.rotors.angles)
                    .transpose()
                    * motor;
                body.advance(joints, &torque, touched, MECHANICS_STEP);
                body.rub(joints, friction, MECHANICS_STEP);
            }
        }
    }
}

impl Device for VirtualPhantom {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if command.time >= self.imperfections.disconnect_time {
            return Err(Fault::Silent);
        }
        Ok(self.advance(command.time, &command.force()))
    }

    fn disable(&mut self) -> Disabled {
        self.commands = [Vec3::zeros(); LONGEST_DELAY + 1];
        Disabled::NoForce
    }
}

impl Drop for VirtualPhantom {
    fn drop(&mut self) {
        self.disable();
    }
}
