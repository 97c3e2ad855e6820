use super::Limits;
use super::arming::{Conditions, Stage};
use super::magnitude::shorten;
use super::slew::limit_rise;
use super::walls::wall_force;
use super::watchdog::{Verdict, judge_age, judge_gap};
use crate::{DeviceSpec, DeviceState, Fault, Vec3};

/// A force that a controller wants, and what is known at the tick.
#[derive(Debug, Clone, Copy)]
pub struct Wish {
    /// The force [N]; any number, or none.
    pub force: Vec3,
    /// The velocity of the hand [m/s].
    pub velocity: Vec3,
    /// How old what it is made of is [s]; infinite when nothing has come yet.
    pub age: Option<f64>,
    /// How long the device has had its last force [s].
    pub gap: f64,
    /// Whether somebody asked to arm again.
    pub asked: bool,
}

/// All stages in their order, and what they remember. Nothing reaches a device but through it.
#[derive(Debug, Clone)]
pub struct Guard {
    limits: Limits,
    workspace: Option<[Vec3; 2]>,
    most: f64,
    period: f64,
    stage: Stage,
    last: Vec3,
    faults: u64,
}

impl Guard {
    /// Off, with `limits`, for a device and ticks of `period` [s].
    ///
    /// # Errors
    /// When a limit is not a number above zero.
    pub fn new(limits: Limits, spec: &DeviceSpec, period: f64) -> Result<Self, Fault> {
        limits.check()?;
        Fault::unless_positive("the largest force of the device [N]", spec.peak_force)?;
        Fault::unless_finite_and_positive("the period of the loop [s]", period)?;
        Ok(Self {
            limits,
            workspace: spec.workspace,
            most: limits.force.min(spec.peak_force),
            period,
            stage: Stage::Off,
            last: Vec3::zeros(),
            faults: 0,
        })
    }

    /// How far forces are on.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// How many faults there were.
    pub fn faults(&self) -> u64 {
        self.faults
    }

    /// Takes forces off for a reason from outside.
    pub fn trip(&mut self, fault: Fault) {
        if !matches!(self.stage, Stage::Faulted(_)) {
            self.faults += 1;
            self.stage = Stage::Faulted(fault);
        }
        self.last = Vec3::zeros();
    }

    /// The force [N] that may be sent for `wish` at `state`, `dt` [s] after the last.
    pub fn pass(&mut self, wish: &Wish, state: &DeviceState, dt: f64) -> Vec3 {
        if let Some(fault) = self.fault_of(wish, state) {
            self.trip(fault);
            return self.last;
        }
        let walls = self.walls(state);
        let conditions = Conditions {
            ready: state.ready && state.present,
            speed: wish.velocity.norm(),
            force: wish.force.norm(),
            asked: wish.asked,
        };
        self.stage = self.stage.next(&conditions, &self.limits, dt);
        let late = self.judge_gap(wish) == Verdict::NoForce;
        let part = self.stage.part(&self.limits);
        if late || part == 0.0 {
            self.last = Vec3::zeros();
            return self.last;
        }
        // Shortened before and after: a rise towards a long force would else turn it.
        let wanted = shorten(&(shorten(&wish.force, self.most) + walls), self.most) * part;
        let risen = limit_rise(&self.last, &wanted, self.limits.slew * dt.min(self.period));
        self.last = shorten(&risen, self.most);
        self.last
    }

    fn fault_of(&self, wish: &Wish, state: &DeviceState) -> Option<Fault> {
        let finite = |v: &Vec3| v.iter().all(|component| component.is_finite());
        if !finite(&state.position) || !finite(&wish.velocity) {
            return Some(Fault::NonFiniteState);
        }
        if !finite(&wish.force) {
            return Some(Fault::NonFiniteForce);
        }
        let (speed, limit) = (wish.velocity.norm(), self.limits.speed);
        let on = self.stage.part(&self.limits) > 0.0;
        if on && speed > limit {
            return Some(Fault::TooFast { speed, limit });
        }
        // Before the first answer there is no force that could be too old.
        let age = wish.age.filter(|age| on && age.is_finite());
        let judged = [
            self.judge_gap(wish),
            age.map_or(Verdict::InTime, |age| judge_age(age, self.limits.silence)),
        ];
        judged.into_iter().find_map(|verdict| match verdict {
            Verdict::Faulted(fault) if on => Some(fault),
            _ => None,
        })
    }

    fn judge_gap(&self, wish: &Wish) -> Verdict {
        let limits = (self.limits.late, self.limits.much_too_late);
        judge_gap(wish.gap, self.period, limits)
    }

    fn walls(&self, state: &DeviceState) -> Vec3 {
        self.workspace.map_or(Vec3::zeros(), |corners| {
            wall_force(&corners, &state.position, self.limits.wall, self.most)
        })
    }
}
