mod by_hand;
mod motions;
mod on_device;
mod sample;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use palpate_files::recording::RecordingHeader;
use palpate_servo::watch::{Pulse, Watched};
use palpate_servo::{
    Clock, Controller, Device, Fault, Limits, ServoLoop, ServoSettings, Stage, Supervisor, Vec3,
    latest,
};

pub use sample::{Ended, Listener, Phase, RigSample};

use crate::phantom::{Imperfections, MECHANICS_STEP, Machine, VirtualPhantom};
use crate::{Course, Error, ForceSensor, Indenter, Reference, RigSettings, VirtualSpecimen};

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
    /// Height to which it withdraws before there was a contact [m].
    retreat: f64,
    breath_since: Option<f64>,
    stage: Stage,
    supervisor: Supervisor,
    /// By how much the rig's time is behind that of its clock [s].
    waited: f64,
    /// Whether its device is there, and what is late for it is late.
    is_real: bool,
    pulse: Pulse,
}

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
        let (indenter, reference) = Indenter::new(settings.gains, Reference::at_rest());
        let driven = (Box::new(device) as Box<dyn Device>, Box::new(indenter) as _);
        let of_specimen = (header, breath_held, felt);
        Self::new(driven, of_specimen, reference, settings, (clock, seed))
    }

    fn new(
        (device, controller): (Box<dyn Device>, Box<dyn Controller>),
        (header, breath_held, felt): (RecordingHeader, Arc<AtomicBool>, latest::Receiver<f64>),
        reference: latest::Sender<Reference>,
        settings: RigSettings,
        (clock, seed): (Clock, u64),
    ) -> Result<Self, Error> {
        let of_loop = ServoSettings {
            period: settings.period,
            limits: Some(limits(&settings)),
            log: 1,
            ..ServoSettings::default()
        };
        let (servo, reader) = ServoLoop::new(device, controller, of_loop)?;
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
            retreat: 0.0,
            breath_since: None,
            stage: Stage::Off,
            supervisor: reader.supervisor,
            waited: 0.0,
            is_real: false,
            pulse: Pulse::default(),
        })
    }

    /// What a recording of `course` says at its top.
    pub fn describe(&self, course: &Course, repeat: u64) -> RecordingHeader {
        self.settings.describe(&self.header, (course, repeat))
    }

    /// The largest force that its sensor shows [N].
    pub fn sensor_range(&self) -> f64 {
        self.sensor.range
    }

    /// Asks for real-time priority for the thread that calls, which shall be the one that runs the rig.
    pub fn raise_priority(&mut self) {
        self.servo.raise_priority();
    }

    /// What takes every force off, from anywhere, and lets forces on again.
    pub fn supervisor(&self) -> Supervisor {
        self.supervisor.clone()
    }

    /// Whether its device is there; a hand may be on it.
    pub fn is_real(&self) -> bool {
        self.is_real
    }

    /// The clock that it runs on.
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// When it ticks, for a watch; a rig without a device never hangs.
    pub fn watched(&self) -> Watched {
        Watched {
            name: "the device of the rig".to_owned(),
            pulse: self.pulse.clone(),
        }
    }

    /// Why forces are off; none when they are not, or will be on in a moment.
    pub fn fault(&self) -> Option<Fault> {
        match self.stage {
            Stage::Faulted(fault) => Some(fault),
            _ => None,
        }
    }

    fn hold_breath(&mut self, held: bool) {
        self.breath_held.store(held, Ordering::Relaxed);
        self.breath_since = held.then_some(self.time);
    }

    /// One tick toward a height [m] and speed [m/s] of the tip.
    fn tick(&mut self, phase: Phase, [height, speed]: [f64; 2]) -> Result<RigSample, Error> {
        self.aim = height;
        let sample = self.exchange(
            phase,
            Reference {
                position: Vec3::z() * height,
                velocity: Vec3::z() * speed,
                driven: true,
            },
        )?;
        if let Some(fault) = self.fault() {
            return Err(fault.into());
        }
        if phase == Phase::Withdrawing {
            return Ok(sample);
        }
        if sample.force > self.settings.force_limit {
            return Err(Error::TooMuchForce {
                force: sample.force,
                limit: self.settings.force_limit,
            });
        }
        match self.settings.breath {
            Some(breath) if sample.breath.is_some_and(|held| held > breath) => {
                Err(Error::BreathIsOver { breath })
            }
            _ => Ok(sample),
        }
    }

    /// One tick of device and sensor.
    fn exchange(&mut self, phase: Phase, reference: Reference) -> Result<RigSample, Fault> {
        self.reference.send(reference);
        let time = self.time;
        let lateness = self.wait_for_tick();
        let of_loop = if self.is_real {
            time + self.waited
        } else {
            time
        };
        let seen = self.servo.tick(of_loop, lateness);
        if self.is_real {
            self.pulse.beat(self.clock.now());
        }
        self.time += self.settings.period;
        let seen = seen.inspect_err(|fault| self.stage = Stage::Faulted(*fault))?;
        self.stage = seen.stage;
        let height = seen.state.position.z;
        Ok(RigSample {
            time,
            phase,
            height,
            depth: self.contact.map(|contact| contact - height),
            force: self.sensor.read(*self.felt.latest()),
            breath: self.breath_since.map(|since| time - since),
            waited: self.waited,
        })
    }

    /// Waits until the next tick is due, and tells how late it is [s]. Where nothing is real, whatever is later than a
    /// period holds up device, tissue and rig together: no force acts for longer than a tick. No tick is made up for,
    /// and a device that is there has its loop's limits for what is late.
    fn wait_for_tick(&mut self) -> f64 {
        self.clock.wait_until(self.time + self.waited);
        let lateness = self.clock.now() - (self.time + self.waited);
        if lateness > self.settings.period {
            self.waited += lateness;
            return 0.0;
        }
        lateness
    }
}

impl Drop for Rig {
    /// A rig that is gone does not hang.
    fn drop(&mut self) {
        self.pulse.end();
    }
}

fn limits(settings: &RigSettings) -> Limits {
    Limits {
        // What the device needs for itself and its friction comes on top of what tissue may feel.
        force: settings.force_limit + 2.0,
        speed: 2.0 * settings.speed_limit,
        ..Limits::without_hand()
    }
}
