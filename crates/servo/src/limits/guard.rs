use super::arming::{Conditions, Stage};
use super::dead_man::DeadManState;
use super::magnitude::saturate;
use super::passivity::Passivity;
use super::slew::limit_rise;
use super::thermal::ThermalModel;
use super::walls::wall_force;
use super::watchdog::{Verdict, check_deadline, check_model_age};
use super::{Interventions, Limits};
use crate::{Capabilities, DeviceState, Fault, Vec3};

/// The force of a tick, within every limit. Only the guard makes it; anyone can make a zero force.
#[derive(Debug, PartialEq)]
pub struct OutputForce {
    force: Vec3,
}

impl Default for OutputForce {
    /// No force.
    fn default() -> Self {
        Self {
            force: Vec3::zeros(),
        }
    }
}

impl OutputForce {
    /// The force [N].
    pub fn newtons(&self) -> Vec3 {
        self.force
    }
}

/// The force that a controller commands, and the inputs of the limits at a tick.
#[derive(Debug, Clone, Copy)]
pub struct CommandedForce {
    /// The force [N]; any number, also not finite.
    pub force: Vec3,
    /// The additional force that compensates the device's own weight, spring and mass [N].
    pub compensation: Vec3,
    /// The velocity of the hand [m/s].
    pub velocity: Vec3,
    /// How far the age of the model's answer exceeds its validity [s], negative before; none for a force that does not
    /// age.
    pub overdue: Option<f64>,
    /// How long the device has had its last force [s].
    pub gap: f64,
    /// Whether the session allows a force.
    pub allowed: bool,
    /// Whether a person asked to arm again.
    pub rearm_requested: bool,
}

/// All stages in their order, with their state. No force reaches a device without it.
#[derive(Debug, Clone)]
pub struct Guard {
    limits: Limits,
    device: Bounds,
    period: f64,
    stage: Stage,
    hold: DeadManState,
    thermal: ThermalModel,
    passivity: Passivity,
    /// Position of the hand at the last tick [m].
    position: Option<Vec3>,
    /// The last force sent, and the one before, which the device had until now.
    last: Sent,
    before: Sent,
    faults: u64,
    interventions: Interventions,
}

/// The two parts of a force that was sent.
#[derive(Debug, Clone, Copy, Default)]
struct Sent {
    /// From the controller and the walls [N].
    rendered: Vec3,
    /// With the compensation [N].
    whole: Vec3,
}

/// The properties of a device that the stages need.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    workspace: Option<[Vec3; 2]>,
    dead_man: Option<super::DeadMan>,
    /// The largest force that may be sent [N].
    most: f64,
    /// The largest force that it displays, and the largest that its motors bear continuously [N].
    peak: f64,
    continuous: f64,
}

impl Guard {
    /// A guard in stage off, with `limits`, for a device and ticks of `period` [s].
    ///
    /// # Errors
    /// When a limit is not positive.
    pub fn new(limits: Limits, capabilities: &Capabilities, period: f64) -> Result<Self, Fault> {
        limits.check()?;
        Fault::unless_positive(
            "the largest force of the device [N]",
            capabilities.peak_force,
        )?;
        Fault::unless_positive(
            "the continuous force of the device [N]",
            capabilities.continuous_force,
        )?;
        Fault::unless_finite_and_positive("the period of the loop [s]", period)?;
        let part = match capabilities.dead_man {
            None if capabilities.displays_force => limits.without_dead_man,
            _ => 1.0,
        };
        Ok(Self {
            device: Bounds {
                workspace: capabilities.workspace,
                dead_man: capabilities.dead_man,
                most: part * limits.force.min(capabilities.peak_force),
                peak: capabilities.peak_force,
                continuous: capabilities.continuous_force,
            },
            period,
            limits,
            stage: Stage::Off,
            hold: DeadManState::Free,
            thermal: ThermalModel::default(),
            passivity: Passivity::default(),
            position: None,
            last: Sent::default(),
            before: Sent::default(),
            faults: 0,
            interventions: Interventions::default(),
        })
    }

    /// The stage of arming.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// The gain on forces: ramp times dead-man's switch [-].
    pub fn part(&self) -> f64 {
        self.stage.part(&self.limits) * self.hold.part(self.limits.release_time)
    }

    /// The current upper bound of the force [N].
    pub fn most(&self) -> f64 {
        self.thermal.most(self.device.most, self.device.continuous)
    }

    /// Whether a fault keeps forces off until a person arms again.
    pub(crate) fn is_latched(&self) -> bool {
        self.limits.latched
    }

    /// Number of faults.
    pub fn faults(&self) -> u64 {
        self.faults
    }

    /// How often the stages changed a force.
    pub fn interventions(&self) -> Interventions {
        self.interventions
    }

    /// The controller's part of the last force sent [N].
    pub fn rendered(&self) -> Vec3 {
        self.last.rendered
    }

    /// The compensation in the last force sent, against the device's own weight, spring and mass [N].
    pub fn compensation(&self) -> Vec3 {
        self.last.whole - self.last.rendered
    }

    /// Takes forces off for an external reason.
    pub fn trip(&mut self, fault: Fault) {
        if !matches!(self.stage, Stage::Faulted(_)) {
            self.faults += 1;
            self.stage = Stage::Faulted(fault);
        }
        self.last = Sent::default();
    }

    /// Takes forces off for a new reason, after a person has acknowledged the last one.
    pub(crate) fn trip_again(&mut self, fault: Fault) {
        self.stage = Stage::Off;
        self.trip(fault);
    }

    /// The output force for `commanded` at `state`, `dt` [s] after the last.
    pub fn pass(
        &mut self,
        commanded: &CommandedForce,
        state: &DeviceState,
        dt: f64,
    ) -> OutputForce {
        self.observe(state, dt);
        self.update_dead_man(state, dt);
        let fault = self.fault_of(commanded, state);
        self.last = match fault {
            Some(fault) => {
                self.trip(fault);
                Sent::default()
            }
            None => self.limited(commanded, state, dt),
        };
        OutputForce {
            force: self.last.whole,
        }
    }

    /// Updates the energy and heat of the last forces.
    fn observe(&mut self, state: &DeviceState, dt: f64) {
        let there = state.present && is_finite(&state.position);
        let place = there.then_some(state.position);
        if let (Some(from), Some(to)) = (self.position, place) {
            self.passivity
                .observe(&self.before.rendered, &(to - from), dt);
        }
        self.position = place;
        let force = self.before.whole.norm();
        self.thermal
            .add(force, dt, self.limits.thermal_time_constant);
        self.before = self.last;
    }

    /// Updates the dead-man's switch, also during a fault.
    fn update_dead_man(&mut self, state: &DeviceState, dt: f64) {
        let held = self
            .device
            .dead_man
            .is_none_or(|switch| switch.is_pressed(state));
        let hold = self.hold.next(held, dt, self.limits.release_time);
        let is_released = self.hold == DeadManState::Held && hold != DeadManState::Held;
        self.interventions.dead_man_released += u64::from(is_released && self.part() > 0.0);
        self.hold = hold;
    }

    fn limited(&mut self, commanded: &CommandedForce, state: &DeviceState, dt: f64) -> Sent {
        self.arm(commanded, state, dt);
        let part = self.part();
        let deadline_tolerance = self.check_deadline(commanded) == Verdict::NoForce;
        let (on, counted) = (part > 0.0, &mut self.interventions);
        counted.deadline_missed += u64::from(on && deadline_tolerance);
        let is_overdue = |overdue: f64| overdue > 0.0 && overdue.is_finite();
        counted.faded += u64::from(on && commanded.overdue.is_some_and(is_overdue));
        if deadline_tolerance || !on {
            return Sent::default();
        }
        let rendered = self.render(commanded, state, dt);
        if commanded.compensation == Vec3::zeros() && self.last.whole == self.last.rendered {
            return Sent {
                rendered,
                whole: rendered,
            };
        }
        let whole = rendered + commanded.compensation * part;
        let most = self.thermal.most(self.device.peak, self.device.continuous);
        let risen = limit_rise(&self.last.whole, &saturate(&whole, most), self.rise(dt));
        Sent {
            rendered,
            whole: saturate(&risen, most),
        }
    }

    /// The controller's part of the output force [N].
    fn render(&mut self, commanded: &CommandedForce, state: &DeviceState, dt: f64) -> Vec3 {
        // Saturated before and after: otherwise limiting the rise towards a large force would turn it.
        let cold = saturate(&commanded.force, self.device.most);
        let damped = self.passivity.control(&cold, self.limits.energy_budget);
        let walls = self.walls(state);
        let most = self.most();
        let bounded = saturate(&(damped + walls), most) * self.part();
        let risen = limit_rise(&self.last.rendered, &bounded, self.rise(dt));
        let counted = &mut self.interventions;
        counted.damped += u64::from(damped != cold);
        counted.walls += u64::from(walls != Vec3::zeros());
        let size = (damped + walls).norm();
        counted.thermally_limited += u64::from(size > most && most < self.device.most);
        counted.saturated += u64::from(cold != commanded.force || size > self.device.most);
        counted.rate_limited += u64::from(risen != bounded);
        saturate(&risen, most)
    }

    /// The largest rise of a force in `dt` [s] [N].
    fn rise(&self, dt: f64) -> f64 {
        self.limits.slew * dt.min(self.period)
    }

    /// Advances the stage of arming by `dt` [s].
    fn arm(&mut self, commanded: &CommandedForce, state: &DeviceState, dt: f64) {
        let conditions = Conditions {
            ready: commanded.allowed
                && state.ready
                && state.present
                && self.hold != DeadManState::Free,
            allowed: commanded.allowed,
            speed: commanded.velocity.norm(),
            force: commanded.force.norm(),
            rearm_requested: commanded.rearm_requested,
        };
        self.stage = self.stage.next(&conditions, &self.limits, dt);
    }

    fn fault_of(&self, commanded: &CommandedForce, state: &DeviceState) -> Option<Fault> {
        if state.fault.is_some() {
            return state.fault;
        }
        if !is_finite(&state.position) || !is_finite(&commanded.velocity) {
            return Some(Fault::NonFiniteState);
        }
        if !is_finite(&commanded.force) || !is_finite(&commanded.compensation) {
            return Some(Fault::NonFiniteForce);
        }
        let (speed, limit) = (commanded.velocity.norm(), self.limits.speed);
        let on = self.stage.part(&self.limits) > 0.0;
        if on && speed > limit {
            return Some(Fault::TooFast { speed, limit });
        }
        // Before the first answer no force can be too old.
        let overdue = commanded
            .overdue
            .filter(|overdue| on && overdue.is_finite());
        let judged = [
            self.check_deadline(commanded),
            overdue.map_or(Verdict::InTime, |overdue| {
                check_model_age(overdue, self.limits.model_timeout)
            }),
        ];
        judged.into_iter().find_map(|verdict| match verdict {
            Verdict::Faulted(fault) if on => Some(fault),
            _ => None,
        })
    }

    fn check_deadline(&self, commanded: &CommandedForce) -> Verdict {
        let Limits {
            deadline_tolerance,
            deadline_fault_threshold,
            ..
        } = self.limits;
        check_deadline(
            commanded.gap,
            self.period,
            deadline_tolerance,
            deadline_fault_threshold,
        )
    }

    fn walls(&self, state: &DeviceState) -> Vec3 {
        self.device.workspace.map_or(Vec3::zeros(), |corners| {
            wall_force(
                &corners,
                &state.position,
                self.limits.wall,
                self.device.most,
            )
        })
    }
}

fn is_finite(vector: &Vec3) -> bool {
    vector.iter().all(|component| component.is_finite())
}
