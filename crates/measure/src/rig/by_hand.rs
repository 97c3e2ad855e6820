use palpate_servo::{Fault, Stage, Vec3};

use super::{Ended, Listener, Phase, Reference, Rig, RigSample};
use crate::Error;

impl Rig {
    /// Goes up by `way` [m], down when that is negative, but not beyond where it may go.
    ///
    /// # Errors
    /// When it is at that end already, the device fails, or the force is too large: it is withdrawn then.
    pub fn jog(&mut self, way: f64, listener: Listener<'_>) -> Result<Ended, Error> {
        let to = self.within_reach(self.aim + way);
        if to == self.aim {
            return Err(self.end_of_way());
        }
        let gone = self.go((to, self.settings.jog_speed), Phase::Jogging, listener);
        self.withdraw_unless(gone, listener)
    }

    /// Moves as fast as a jog, up or down as the sign of what `wanted` answers at each tick, until that is
    /// zero or an end is reached.
    ///
    /// # Errors
    /// As for [`jog`](Self::jog).
    pub fn drive(&mut self, wanted: &mut dyn FnMut(&RigSample) -> f64) -> Result<Ended, Error> {
        let driven = self.drive_on(wanted);
        self.withdraw_unless(driven, &mut |sample| wanted(sample) != 0.0)
    }

    fn drive_on(&mut self, wanted: &mut dyn FnMut(&RigSample) -> f64) -> Result<Ended, Error> {
        let mut sample = self.tick(Phase::Jogging, [self.aim, 0.0])?;
        loop {
            let direction = wanted(&sample);
            if direction == 0.0 {
                return Ok(Ended::Whole);
            }
            let speed = self.settings.jog_speed.copysign(direction);
            let to = self.within_reach(self.aim + speed * self.settings.period);
            if to == self.aim {
                return Err(self.end_of_way());
            }
            sample = self.tick(Phase::Jogging, [to, speed])?;
        }
    }

    /// The height [m] nearest to one that a hand may go to: as deep as a stimulus from a contact, else as far as
    /// tissue is looked for.
    fn within_reach(&self, height: f64) -> f64 {
        let way = self.settings.approach_way;
        let lowest = self
            .contact
            .map_or(-way, |contact| contact - self.settings.depth_limit);
        // Where it is already is never out of reach.
        height.clamp(lowest.min(self.aim), way.max(self.aim))
    }

    fn end_of_way(&self) -> Error {
        Error::EndOfWay {
            height_mm: 1e3 * self.aim,
        }
    }

    /// Lets forces on again after a fault; until they are, the rig is [`limp`](Self::limp).
    pub fn arm(&self) {
        self.supervisor.arm();
    }

    /// One tick without force, and whether forces are on again. The indenter will stay where it is then.
    ///
    /// # Errors
    /// When the device does not answer.
    pub fn limp(&mut self, listener: Listener<'_>) -> Result<bool, Fault> {
        self.hold_breath(false);
        let reference = Reference {
            position: Vec3::z() * self.aim,
            velocity: Vec3::zeros(),
            driven: false,
        };
        let sample = self.exchange(Phase::Limp, reference)?;
        self.aim = sample.height;
        listener(&sample);
        Ok(self.stage == Stage::Live)
    }
}
