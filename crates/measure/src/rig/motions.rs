use palpate_files::recording::RecordingHeader;

use super::{Ended, Listener, Phase, Rig, ZEROING};
use crate::approach::contact_height;
use crate::rig_settings::{LEAD, SETTLING_TIME, STANDOFF};
use crate::{DepthTrajectory, Error, RigSettings};

/// Ticks of an approach that room is made for at once: an hour and more at 1 kHz, 64 MB.
const MAX_CAPACITY: usize = 4_000_000;

impl Rig {
    /// Goes down until contact, finds the first contact and waits above it.
    ///
    /// # Errors
    /// When there is none, or a force is too large; the indenter is withdrawn all the same.
    pub fn approach(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        self.hold_breath(true);
        self.contact = None;
        self.retreat = self.aim;
        let found = self.find_contact(listener);
        let withdrawn = self.withdraw(listener);
        self.hold_breath(false);
        let ended = found?;
        withdrawn.map(|_| ended)
    }

    fn find_contact(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        if self.stay(SETTLING_TIME, listener)? == Ended::Stopped {
            return Ok(Ended::Stopped);
        }
        let RigSettings {
            period,
            approach_speed,
            approach_distance,
            ..
        } = self.settings;
        let resting = (ZEROING / period) as usize;
        let ticks = resting + (approach_distance / approach_speed / period) as usize;
        // A tick allocates nothing, unless a caller asks for an approach of more than an hour.
        let room = ticks.min(MAX_CAPACITY);
        let mut heights = Vec::with_capacity(room);
        let mut forces = Vec::with_capacity(room);
        let from = self.aim;
        self.sensing.begin_zero(resting);
        for tick in 0..ticks {
            let gone = tick.saturating_sub(resting) as f64 * period;
            let speed = if tick < resting { 0.0 } else { -approach_speed };
            let height = from - approach_speed * gone;
            let sample = self.tick(Phase::Approaching, [height, speed])?;
            if !listener(&sample) {
                return Ok(Ended::Stopped);
            }
            heights.push(sample.height);
            forces.push(sample.force);
            if tick > resting && self.is_met(&forces, resting) {
                self.contact = contact_height(&heights, &forces);
                return Ok(Ended::Complete);
            }
        }
        Err(Error::NoContact {
            way_mm: 1e3 * approach_distance,
        })
    }

    fn is_met(&self, forces: &[f64], resting: usize) -> bool {
        const AVERAGED: usize = 32;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let last = &forces[forces.len().saturating_sub(AVERAGED)..];
        mean(last) - mean(&forces[..resting]) > self.settings.contact_force
    }

    /// Presses `trajectory` from first contact and withdraws. `listener` receives the samples to record, which begin
    /// half a second before contact, above the tissue.
    ///
    /// # Errors
    /// When it goes beyond a limit, which is known before it begins, or the force does.
    pub fn press(
        &mut self,
        trajectory: &DepthTrajectory,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        self.press_with_listener(trajectory, &mut |sample| {
            sample.phase != Phase::Pressing || listener(sample)
        })
    }

    /// The same, but `listener` also receives the samples of the way there and back; samples to record have the phase
    /// [`Phase::Pressing`].
    ///
    /// # Errors
    /// As for [`press`](Self::press).
    pub fn press_with_listener(
        &mut self,
        trajectory: &DepthTrajectory,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        self.settings.check(trajectory)?;
        let contact = self.contact.ok_or(Error::NotApproached)?;
        self.hold_breath(true);
        let pressed = self.press_from(contact, trajectory, listener);
        let withdrawn = self.withdraw(listener);
        self.hold_breath(false);
        let ended = pressed?;
        withdrawn.map(|_| ended)
    }

    fn press_from(
        &mut self,
        contact: f64,
        trajectory: &DepthTrajectory,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        let RigSettings {
            clearance,
            approach_speed,
            withdrawal_speed,
            period,
            ..
        } = self.settings;
        let mut ended = self.stay(self.settings.settling_time(), listener)?;
        for (above, speed) in [(clearance, withdrawal_speed), (STANDOFF, approach_speed)] {
            if ended == Ended::Complete {
                ended = self.go(contact + above, speed, Phase::Waiting, listener)?;
            }
        }
        if ended == Ended::Stopped {
            return Ok(ended);
        }
        let [_, speed] = trajectory.at(0.0);
        let lead = LEAD + STANDOFF / speed;
        let ticks = ((lead + trajectory.duration()) / period).round() as usize;
        for tick in 0..=ticks {
            // What is asked for now is where the device is at the next tick.
            let time = (tick + 1) as f64 * period - lead;
            let [depth, speed] = if time >= 0.0 {
                trajectory.at(time)
            } else if speed * time > -STANDOFF {
                [speed * time, speed]
            } else {
                [-STANDOFF, 0.0]
            };
            let sample = self.tick(Phase::Pressing, [contact - depth, -speed])?;
            if !listener(&sample) {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Complete)
    }

    /// Waits for `time` [s] where it is.
    ///
    /// # Errors
    /// When the device fails, or the tissue rises against the indenter, which is withdrawn then.
    pub fn wait(&mut self, time: f64, listener: Listener<'_>) -> Result<Ended, Error> {
        let waited = self.stay(time, listener);
        self.withdraw_unless(waited, listener)
    }

    /// Waits for one tick. A fault of the sensor is an error once; until it is over, the indenter stays where it is.
    ///
    /// # Errors
    /// As for [`wait`](Self::wait).
    pub fn wait_one_tick(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        let was_blind = self.sensing.fault.is_some();
        let waited = self.stay(self.settings.period, listener);
        match waited {
            Err(Error::Sensor(_)) if was_blind => Ok(Ended::Complete),
            waited => self.withdraw_unless(waited, listener),
        }
    }

    /// Lets the tissue rest.
    ///
    /// # Errors
    /// As for [`wait`](Self::wait).
    pub fn recover(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        self.wait(self.settings.recovery, listener)
    }

    fn stay(&mut self, time: f64, listener: Listener<'_>) -> Result<Ended, Error> {
        for _ in 0..(time / self.settings.period).round() as u64 {
            let sample = self.tick(Phase::Waiting, [self.aim, 0.0])?;
            if !listener(&sample) {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Complete)
    }

    /// Leaves the tissue: to the clearance above the contact, or to where it was before it looked for one; never down.
    ///
    /// # Errors
    /// When the device fails.
    pub fn withdraw(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        let waits = self.settings.clearance + self.settings.breath_motion;
        let above = self.contact.map_or(self.retreat, |contact| contact + waits);
        let above = above.max(self.aim);
        let speed = self.settings.withdrawal_speed;
        self.go(above, speed, Phase::Withdrawing, listener)
    }

    /// Returns `done`; withdraws the indenter first when it is an error.
    pub(super) fn withdraw_unless(
        &mut self,
        done: Result<Ended, Error>,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        if done.is_err() {
            // The first error says more than that of the withdrawal.
            let _ = self.withdraw(listener);
        }
        done
    }

    /// Goes along the normal to a height [m] with a speed [m/s].
    pub(super) fn go(
        &mut self,
        height: f64,
        speed: f64,
        phase: Phase,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        let (from, way) = (self.aim, height - self.aim);
        let ticks = (way.abs() / speed / self.settings.period).ceil().max(1.0) as u64;
        for tick in 1..=ticks + 1 {
            let (part, speed) = match tick <= ticks {
                true => (tick as f64 / ticks as f64, speed.copysign(way)),
                false => (1.0, 0.0),
            };
            let sample = self.tick(phase, [from + part * way, speed])?;
            if !listener(&sample) && phase != Phase::Withdrawing {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Complete)
    }
}

impl RigSettings {
    /// What a recording of a course says at its top, with what its `specimen` says of itself and which
    /// repetition it is.
    pub fn describe(
        &self,
        specimen: &RecordingHeader,
        trajectory: &DepthTrajectory,
        repeat: u64,
    ) -> RecordingHeader {
        let mut header = specimen.clone();
        trajectory.describe(&mut header);
        header.repeat = Some(repeat);
        header.sample_rate_hz = Some(1.0 / self.period);
        header.breath_held = self.breath.map(|_| true);
        header
    }
}
