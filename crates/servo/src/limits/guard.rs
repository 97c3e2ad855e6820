use super::arming::{Conditions, Stage};
use super::dead_man::Hold;
use super::magnitude::saturate;
use super::passivity::Passivity;
use super::slew::limit_rise;
use super::thermal::ThermalModel;
use super::walls::wall_force;
use super::watchdog::{Verdict, judge_gap, judge_silence};
use super::{Interventions, Limits};
use crate::{Capabilities, DeviceState, Fault, Vec3};

/// The force of a tick, within every limit. The guard makes it, and nobody else; all may make one that is zero.
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

/// A force that a controller wants, and what is known at the tick.
#[derive(Debug, Clone, Copy)]
pub struct CommandedForce {
    /// The force [N]; any number, or none.
    pub force: Vec3,
    /// What is wanted besides against the device's own weight, spring and mass [N].
    pub compensation: Vec3,
    /// The velocity of the hand [m/s].
    pub velocity: Vec3,
    /// How far what it is made of is beyond its time [s], below zero before; none for what does not age.
    pub overdue: Option<f64>,
    /// How long the device has had its last force [s].
    pub gap: f64,
    /// Whether the session allows a force.
    pub allowed: bool,
    /// Whether a person asked to arm again.
    pub asked: bool,
}

/// All stages in their order, and what they remember. Nothing reaches a device but through it.
#[derive(Debug, Clone)]
pub struct Guard {
    limits: Limits,
    device: Bounds,
    period: f64,
    stage: Stage,
    hold: Hold,
    thermal: ThermalModel,
    passivity: Passivity,
    /// Where the hand was at the last tick [m].
    position: Option<Vec3>,
    /// What was sent last, and before that, which the device had until now.
    last: Sent,
    before: Sent,
    faults: u64,
    interventions: Interventions,
}

/// The two parts of a force that was sent.
#[derive(Debug, Clone, Copy, Default)]
struct Sent {
    /// Of the controller and the walls [N].
    rendered: Vec3,
    /// Of both [N].
    whole: Vec3,
}

/// What of a device the stages ask for.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    workspace: Option<[Vec3; 2]>,
    dead_man: Option<super::DeadMan>,
    /// The largest force that may be sent [N].
    most: f64,
    /// The largest that it displays, and that its motors bear [N].
    peak: f64,
    continuous: f64,
}

impl Guard {
    /// Off, with `limits`, for a device and ticks of `period` [s].
    ///
    /// # Errors
    /// When a limit is not a number above zero.
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
            hold: Hold::Free,
            thermal: ThermalModel::default(),
            passivity: Passivity::default(),
            position: None,
            last: Sent::default(),
            before: Sent::default(),
            faults: 0,
            interventions: Interventions::default(),
        })
    }

    /// How far forces are on.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// The part of a force that is on [-].
    pub fn part(&self) -> f64 {
        self.stage.part(&self.limits) * self.hold.part(self.limits.release)
    }

    /// The largest force that may be sent now [N].
    pub fn most(&self) -> f64 {
        self.thermal.most(self.device.most, self.device.continuous)
    }

    /// Whether a fault keeps forces off until somebody arms them.
    pub(crate) fn is_latched(&self) -> bool {
        self.limits.latched
    }

    /// How many faults there were.
    pub fn faults(&self) -> u64 {
        self.faults
    }

    /// How often the stages changed a force.
    pub fn interventions(&self) -> Interventions {
        self.interventions
    }

    /// What was sent last of what the controller wants [N].
    pub fn rendered(&self) -> Vec3 {
        self.last.rendered
    }

    /// What was sent last against the device's own weight, spring and mass [N].
    pub fn compensation(&self) -> Vec3 {
        self.last.whole - self.last.rendered
    }

    /// Takes forces off for a reason from outside.
    pub fn trip(&mut self, fault: Fault) {
        if !matches!(self.stage, Stage::Faulted(_)) {
            self.faults += 1;
            self.stage = Stage::Faulted(fault);
        }
        self.last = Sent::default();
    }

    /// Takes forces off for another reason than the one before, which a person has seen.
    pub(crate) fn trip_again(&mut self, fault: Fault) {
        self.stage = Stage::Off;
        self.trip(fault);
    }

    /// The force that may be sent for `wish` at `state`, `dt` [s] after the last.
    pub fn pass(
        &mut self,
        commanded: &CommandedForce,
        state: &DeviceState,
        dt: f64,
    ) -> OutputForce {
        self.observe(state, dt);
        self.follow_hold(state, dt);
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

    /// What the last forces did.
    fn observe(&mut self, state: &DeviceState, dt: f64) {
        let there = state.present && is_finite(&state.position);
        let place = there.then_some(state.position);
        if let (Some(from), Some(to)) = (self.position, place) {
            self.passivity
                .observe(&self.before.rendered, &(to - from), dt);
        }
        self.position = place;
        let force = self.before.whole.norm();
        self.thermal.add(force, dt, self.limits.heat_time);
        self.before = self.last;
    }

    /// Whether somebody holds the device, also while there is a fault.
    fn follow_hold(&mut self, state: &DeviceState, dt: f64) {
        let held = self
            .device
            .dead_man
            .is_none_or(|switch| switch.is_held(state));
        let hold = self.hold.next(held, dt, self.limits.release);
        let lets_go = self.hold == Hold::Held && hold != Hold::Held;
        self.interventions.dead_man_released += u64::from(lets_go && self.part() > 0.0);
        self.hold = hold;
    }

    fn limited(&mut self, commanded: &CommandedForce, state: &DeviceState, dt: f64) -> Sent {
        self.arm(commanded, state, dt);
        let part = self.part();
        let late = self.judge_gap(commanded) == Verdict::NoForce;
        let (on, counted) = (part > 0.0, &mut self.interventions);
        counted.deadline_missed += u64::from(on && late);
        let is_overdue = |overdue: f64| overdue > 0.0 && overdue.is_finite();
        counted.faded += u64::from(on && commanded.overdue.is_some_and(is_overdue));
        if late || !on {
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

    /// What is sent of what the controller wants [N].
    fn render(&mut self, commanded: &CommandedForce, state: &DeviceState, dt: f64) -> Vec3 {
        // Saturated before and after: a rise towards a long force would else turn it.
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

    /// The most that a force may rise in `dt` [s] [N].
    fn rise(&self, dt: f64) -> f64 {
        self.limits.slew * dt.min(self.period)
    }

    /// How far forces are on after `dt` [s] more.
    fn arm(&mut self, commanded: &CommandedForce, state: &DeviceState, dt: f64) {
        let conditions = Conditions {
            ready: commanded.allowed && state.ready && state.present && self.hold != Hold::Free,
            allowed: commanded.allowed,
            speed: commanded.velocity.norm(),
            force: commanded.force.norm(),
            asked: commanded.asked,
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
        // Before the first answer there is no force that could be too old.
        let overdue = commanded
            .overdue
            .filter(|overdue| on && overdue.is_finite());
        let judged = [
            self.judge_gap(commanded),
            overdue.map_or(Verdict::InTime, |overdue| {
                judge_silence(overdue, self.limits.silence)
            }),
        ];
        judged.into_iter().find_map(|verdict| match verdict {
            Verdict::Faulted(fault) if on => Some(fault),
            _ => None,
        })
    }

    fn judge_gap(&self, commanded: &CommandedForce) -> Verdict {
        let Limits {
            late,
            much_too_late,
            ..
        } = self.limits;
        judge_gap(commanded.gap, self.period, late, much_too_late)
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
