use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use palpate_files::recording::RecordingHeader;
use palpate_servo::dynamics::{Imperfections, Machine};
use palpate_servo::{
    Clock, Limits, MECHANICS_STEP, ServoLoop, ServoSettings, Stage, Vec3, VirtualPhantom, latest,
};

use crate::approach::contact_height;
use crate::rig_settings::{LEAD, STANDOFF};
use crate::{Course, Error, ForceSensor, Indenter, Reference, RigSettings, VirtualSpecimen};

/// What the rig does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// It waits where it is.
    Waiting,
    /// It looks for tissue.
    Approaching,
    /// It presses a stimulus.
    Pressing,
    /// It leaves the tissue.
    Withdrawing,
}

/// What is seen at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigSample {
    /// On the rig's clock [s].
    pub time: f64,
    /// What it does.
    pub phase: Phase,
    /// Height of the tip as the encoders say [m].
    pub height: f64,
    /// How deep that is from first contact [m]; none before there was one.
    pub depth: Option<f64>,
    /// What the sensor shows [N], positive on the tissue.
    pub force: f64,
}

/// How a stimulus ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// With its last sample.
    Whole,
    /// Before, as whoever listened said; the indenter is withdrawn.
    Stopped,
}

/// Whoever listens to samples; false to stop.
pub type Listener<'a> = &'a mut dyn FnMut(&RigSample) -> bool;

/// An indenter on its device, with a sensor.
pub struct Rig {
    settings: RigSettings,
    header: RecordingHeader,
    servo: ServoLoop,
    clock: Clock,
    reference: latest::Sender<Reference>,
    felt: latest::Receiver<f64>,
    sensor: ForceSensor,
    breath_held: Arc<AtomicBool>,
    time: f64,
    aim: f64,
    contact: Option<f64>,
}

/// Time over which the zero of the sensor is taken [s].
const ZEROING: f64 = 0.5;

impl Rig {
    /// A rig over a specimen that is not there, on `clock`. The same `seed` gives the same bytes on a virtual
    /// one.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn over(
        specimen: VirtualSpecimen,
        (machine, imperfections): (Machine, Imperfections),
        settings: RigSettings,
        (clock, seed): (Clock, u64),
    ) -> Result<Self, Error> {
        let header = specimen.header.clone();
        let breath_held = specimen.breath_held();
        let (mut feel, felt) = latest::channel(&0.0);
        let mut specimen = specimen;
        let touch = move |time: f64, place: &Vec3, _: &Vec3| {
            let force = specimen.force(time, place.z, MECHANICS_STEP);
            feel.send(force);
            Vec3::z() * force
        };
        let device = VirtualPhantom::with_axes(machine, &Vec3::zeros(), imperfections)
            .touched_by(Box::new(touch));
        let first = Reference {
            position: Vec3::zeros(),
            velocity: Vec3::zeros(),
        };
        let (indenter, reference) = Indenter::new(settings.gains, first);
        let limits = Limits {
            // What the device needs for itself and its friction comes on top of what tissue may feel.
            force: settings.force_limit + 2.0,
            speed: 2.0 * settings.speed_limit,
            ..Limits::without_hand()
        };
        let of_loop = ServoSettings {
            period: settings.period,
            limits: Some(limits),
            log: 1,
            ..ServoSettings::default()
        };
        let (servo, _) = ServoLoop::new(Box::new(device), Box::new(indenter), of_loop)?;
        Ok(Self {
            settings,
            header,
            servo,
            clock,
            reference,
            felt,
            sensor: ForceSensor::nano17(seed),
            breath_held,
            time: 0.0,
            aim: 0.0,
            contact: None,
        })
    }

    /// Goes down until tissue is met, finds where that was and waits above it.
    ///
    /// # Errors
    /// When there is none, or a force is too large.
    pub fn approach(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        self.breath_held.store(true, Ordering::Relaxed);
        let found = self.find_contact(listener);
        self.breath_held.store(false, Ordering::Relaxed);
        found
    }

    fn find_contact(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        self.contact = None;
        let ticks = |time: f64, period: f64| (time / period) as usize;
        // Breath and device come to rest.
        if self.wait(2.0, listener)? == Ended::Stopped {
            return Ok(Ended::Stopped);
        }
        let resting = ticks(ZEROING, self.settings.period);
        let way = ticks(
            self.settings.approach_way / self.settings.approach_speed,
            self.settings.period,
        );
        // Room for all of it: a tick allocates nothing.
        let room = || Vec::with_capacity(resting + way);
        let (mut heights, mut forces) = (room(), room());
        let from = self.aim;
        for tick in 0..resting + way {
            let gone = tick.saturating_sub(resting) as f64 * self.settings.period;
            let speed = if tick < resting {
                0.0
            } else {
                -self.settings.approach_speed
            };
            let height = from - self.settings.approach_speed * gone;
            let sample = self.tick(Phase::Approaching, [height, speed])?;
            if !listener(&sample) {
                return self.withdraw().map(|()| Ended::Stopped);
            }
            heights.push(sample.height);
            forces.push(sample.force);
            if tick > resting && self.is_met(&forces, resting) {
                self.contact = contact_height(&heights, &forces);
                self.withdraw()?;
                return Ok(Ended::Whole);
            }
        }
        self.withdraw()?;
        Err(Error::NoContact {
            way_mm: 1e3 * self.settings.approach_way,
        })
    }

    fn is_met(&self, forces: &[f64], resting: usize) -> bool {
        const AVERAGED: usize = 32;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let last = &forces[forces.len().saturating_sub(AVERAGED)..];
        mean(last) - mean(&forces[..resting]) > self.settings.contact_force
    }

    /// Presses `course` from first contact and withdraws. `listener` hears what is to be recorded: it begins
    /// half a second before, above the tissue.
    ///
    /// # Errors
    /// When it goes beyond a limit, which is known before it begins, or the force does.
    pub fn press(&mut self, course: &Course, listener: Listener<'_>) -> Result<Ended, Error> {
        self.settings.check(course)?;
        let contact = self.contact.ok_or(Error::NoContact { way_mm: 0.0 })?;
        self.breath_held.store(true, Ordering::Relaxed);
        let pressed = self.press_from(contact, course, listener);
        let withdrawn = self.withdraw();
        self.breath_held.store(false, Ordering::Relaxed);
        let ended = pressed?;
        withdrawn.map(|()| ended)
    }

    fn press_from(
        &mut self,
        contact: f64,
        course: &Course,
        listener: Listener<'_>,
    ) -> Result<Ended, Error> {
        self.go(contact + STANDOFF, Phase::Waiting)?;
        let [_, speed] = course.at(0.0);
        let lead = LEAD + STANDOFF / speed;
        let ticks = ((lead + course.duration()) / self.settings.period).round() as usize;
        for tick in 0..=ticks {
            let time = tick as f64 * self.settings.period - lead;
            let [depth, speed] = if time >= 0.0 {
                course.at(time)
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
        Ok(Ended::Whole)
    }

    /// What a recording of `course` says at its top.
    pub fn describe(&self, course: &Course, repeat: u64) -> RecordingHeader {
        let mut header = self.header.clone();
        course.describe(&mut header);
        header.repeat = Some(repeat);
        header.sample_rate_hz = Some(1.0 / self.settings.period);
        header.breath_held = self.settings.breath.map(|_| true);
        header
    }

    /// Waits for `time` [s] where it is.
    ///
    /// # Errors
    /// When the device fails.
    pub fn wait(&mut self, time: f64, listener: Listener<'_>) -> Result<Ended, Error> {
        for _ in 0..(time / self.settings.period).round() as u64 {
            let sample = self.tick(Phase::Waiting, [self.aim, 0.0])?;
            if !listener(&sample) {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Whole)
    }

    /// Lets the tissue rest.
    ///
    /// # Errors
    /// When the device fails.
    pub fn recover(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        self.wait(self.settings.recovery, listener)
    }

    /// Leaves the tissue: to the clearance above the contact, or the way back that it came.
    fn withdraw(&mut self) -> Result<(), Error> {
        let above = self
            .contact
            .map_or(0.0, |contact| contact + self.settings.clearance);
        self.go(above, Phase::Withdrawing)
    }

    /// Goes straight to `height` [m].
    fn go(&mut self, height: f64, phase: Phase) -> Result<(), Error> {
        let (from, way) = (self.aim, height - self.aim);
        let speed = match phase {
            Phase::Withdrawing => self.settings.withdrawal_speed,
            _ => self.settings.approach_speed,
        };
        let ticks = (way.abs() / speed / self.settings.period).ceil().max(1.0);
        for tick in 1..=ticks as u64 {
            let part = tick as f64 / ticks;
            self.tick(phase, [from + part * way, speed.copysign(way)])?;
        }
        self.tick(phase, [height, 0.0])?;
        Ok(())
    }

    /// One tick toward a height [m] and speed [m/s] of the tip.
    fn tick(&mut self, phase: Phase, [height, speed]: [f64; 2]) -> Result<RigSample, Error> {
        self.aim = height;
        self.reference.send(Reference {
            position: Vec3::z() * height,
            velocity: Vec3::z() * speed,
        });
        self.clock.wait_until(self.time);
        let lateness = self.clock.now() - self.time;
        let sample = self.servo.tick(self.time, lateness)?;
        if let Stage::Faulted(fault) = sample.stage {
            return Err(fault.into());
        }
        let force = self.sensor.read(*self.felt.latest());
        let sample = RigSample {
            time: self.time,
            phase,
            height: sample.state.position.z,
            depth: self
                .contact
                .map(|contact| contact - sample.state.position.z),
            force,
        };
        self.time += self.settings.period;
        if phase != Phase::Withdrawing && force > self.settings.force_limit {
            return Err(Error::TooMuchForce {
                force,
                limit: self.settings.force_limit,
            });
        }
        Ok(sample)
    }
}
