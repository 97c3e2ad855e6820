use palpate_servo::{Fault, Stage, Vec3};

use super::{Ended, Line, Listener, Phase, Reference, Rig, RigSample};
use crate::Error;
use crate::rig_settings::check_within;

/// Rounding error of a way [m].
const ROUNDED: f64 = 1e-9;

impl Rig {
    /// Goes straight by `way` in the rig's axes [m]. After a way that is not along the normal the contact is not known
    /// any more.
    ///
    /// # Errors
    /// When that ends beyond where it may go, or leads sideways through tissue, which is known before it moves; when the
    /// device fails, or the force is too large: it is withdrawn then.
    pub fn jog(&mut self, way: &Vec3, listener: Listener<'_>) -> Result<Ended, Error> {
        let to = self.line.at(self.aim) + way;
        self.check_reach(&to)?;
        if self.leads_sideways(way) {
            self.check_out_of_tissue()?;
        }
        self.travel(&to, Phase::Jogging, listener)
    }

    /// The same, to a `place` in the rig's axes [m].
    ///
    /// # Errors
    /// As for [`jog`](Self::jog).
    pub fn go_to(&mut self, place: &Vec3, listener: Listener<'_>) -> Result<Ended, Error> {
        let way = place - self.line.at(self.aim);
        self.jog(&way, listener)
    }

    /// Moves as fast as a jog along what `wanted` answers at each tick, a direction in the rig's axes, until that is
    /// zero or an end is reached.
    ///
    /// # Errors
    /// As for [`jog`](Self::jog).
    pub fn drive(&mut self, wanted: &mut dyn FnMut(&RigSample) -> Vec3) -> Result<Ended, Error> {
        let driven = self.drive_on(wanted);
        self.withdraw_unless(driven, &mut |sample| wanted(sample) != Vec3::zeros())
    }

    fn drive_on(&mut self, wanted: &mut dyn FnMut(&RigSample) -> Vec3) -> Result<Ended, Error> {
        let mut sample = self.tick(Phase::Jogging, [self.aim, 0.0])?;
        loop {
            let Some(direction) = wanted(&sample).try_normalize(0.0) else {
                return Ok(Ended::Complete);
            };
            let velocity = self.settings.jog_speed * direction;
            let way = self.settings.period * velocity;
            let to = self.line.at(self.aim) + way;
            self.check_reach(&to)?;
            if self.leads_sideways(&way) {
                self.check_out_of_tissue()?;
                self.forget_contact();
            }
            sample = self.tick_at(Phase::Jogging, &to, velocity)?;
        }
    }

    /// Straight to a place [m] that was checked; it is withdrawn when that fails.
    pub(super) fn travel(
        &mut self,
        to: &Vec3,
        phase: Phase,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        let gone = self.travel_to(to, phase, listener);
        self.withdraw_unless(gone, listener)
    }

    fn travel_to(
        &mut self,
        to: &Vec3,
        phase: Phase,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        let speed = self.settings.jog_speed;
        let from = self.line.at(self.aim);
        let way = to - from;
        if !self.leads_sideways(&way) {
            return self.go(self.line.height(to), speed, phase, listener);
        }
        self.forget_contact();
        let ticks = (way.norm() / speed / self.settings.period).ceil().max(1.0) as u64;
        let velocity = speed * way.normalize();
        for tick in 1..=ticks + 1 {
            let (part, velocity) = match tick <= ticks {
                true => (tick as f64 / ticks as f64, velocity),
                false => (1.0, Vec3::zeros()),
            };
            let sample = self.tick_at(phase, &(from + part * way), velocity)?;
            if !listener(&sample) {
                break;
            }
        }
        self.retreat = self.retreat.max(self.aim);
        let is_there = (self.line.at(self.aim) - to).norm() <= ROUNDED;
        Ok(if is_there {
            Ended::Complete
        } else {
            Ended::Stopped
        })
    }

    /// One tick toward a place [m] with a velocity [m/s].
    fn tick_at(&mut self, phase: Phase, to: &Vec3, velocity: Vec3) -> Result<RigSample, Error> {
        self.line = Line::through(to, self.line.normal);
        let height = self.line.height(to);
        self.tick_with(phase, height, velocity)
    }

    /// Whether a way [m] is not along the normal.
    fn leads_sideways(&self, way: &Vec3) -> bool {
        let normal = self.line.normal;
        let tangential = way - normal * normal.dot(way);
        // A way that is not a number is refused as out of reach.
        tangential.norm() > ROUNDED * way.norm().max(1.0)
    }

    /// Sideways it goes only above the tissue.
    pub(super) fn check_out_of_tissue(&self) -> Result<(), Error> {
        match self.contact {
            Some(contact) if self.aim < contact - ROUNDED => Err(Error::InTissue {
                depth_mm: 1e3 * (contact - self.aim),
            }),
            _ => Ok(()),
        }
    }

    /// Forgets the first contact; the indenter withdraws as high as before, or stays at its height.
    pub(super) fn forget_contact(&mut self) {
        let above = self
            .contact
            .take()
            .map(|contact| contact + self.settings.clearance);
        self.retreat = above.unwrap_or(self.retreat).max(self.aim);
    }

    /// Whether a hand may go to a place [m]: as deep as a stimulus from a contact, else as far as tissue is looked for.
    ///
    /// # Errors
    /// When it may not.
    pub(super) fn check_reach(&self, to: &Vec3) -> Result<(), Error> {
        let settings = &self.settings;
        let lowest = match self.contact {
            Some(contact) => contact - settings.depth_limit,
            None => -settings.approach_distance,
        };
        let to_line = Line::through(to, self.line.normal);
        // Where it is already is never out of reach.
        let along = [
            lowest.min(self.aim),
            settings.approach_distance.max(self.aim),
        ];
        check_within("along the normal", self.line.height(to), along, ROUNDED)?;
        let sideways = [0.0, settings.lateral_limit.max(self.line.side.norm())];
        check_within("sideways", to_line.side.norm(), sideways, ROUNDED)
    }

    /// Lets forces on again after a fault; until they are, the rig is [`tick_without_force`](Self::tick_without_force).
    pub fn arm(&self) {
        self.supervisor.arm();
    }

    /// One tick without force, and whether forces are on again. The indenter will stay where it is then.
    ///
    /// # Errors
    /// When the device does not answer.
    pub fn tick_without_force(&mut self, listener: Listener<'_>) -> Result<bool, Fault> {
        self.hold_breath(false);
        let reference = Reference {
            position: self.line.at(self.aim),
            velocity: Vec3::zeros(),
            driven: false,
        };
        let sample = self.exchange(Phase::ForceOff, reference)?;
        self.line = Line::through(&sample.position, self.line.normal);
        self.aim = sample.height;
        listener(&sample);
        Ok(self.stage == Stage::Live)
    }
}
