mod line;
mod manual;
mod motions;
mod normal;
mod on_device;
mod sample;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use palpate_files::recording::RecordingHeader;
use palpate_servo::monitor::{Heartbeat, MonitoredLoop};
use palpate_servo::{
    Clock, Controller, Device, Fault, ForceTorque, Limits, ServoLoop, ServoSettings, Stage,
    SteppedLoop, Supervisor, Vec3, latest,
};

pub use sample::{Ended, Listener, Phase, RigSample};

use line::Line;

use crate::phantom::{Imperfections, MECHANICS_STEP, Machine, VirtualPhantom};
use crate::sensing::{Sensing, Source};
use crate::{DepthTrajectory, Error, Indenter, Reference, RigSettings, VirtualSpecimen};

/// Samples that a device with a scheduler may be ahead of the rig.
const LOG: usize = 64;

/// An indenter on its device, with a sensor.
pub struct Rig {
    settings: RigSettings,
    header: RecordingHeader,
    servo: SteppedLoop,
    clock: Clock,
    reference: latest::Sender<Reference>,
    sensing: Sensing,
    breath_held: Arc<AtomicBool>,
    time: f64,
    /// Line along which it approaches, presses and withdraws.
    line: Line,
    /// Commanded height on the line [m].
    aim: f64,
    /// Height of first contact on the line [m].
    contact: Option<f64>,
    /// Height to which it withdraws before there was a contact [m].
    retreat: f64,
    breath_since: Option<f64>,
    stage: Stage,
    supervisor: Supervisor,
    /// By how much the rig's time is behind that of its clock [s].
    waited: f64,
    /// Whether its device is real; ticks for it can then be late.
    is_real: bool,
    /// Where the handle of such a device was at first [m].
    rest: Arc<OnceLock<Vec3>>,
    /// When its device answered last.
    pulse: Heartbeat,
}

impl Rig {
    /// A rig over a virtual specimen, on `clock`. The same `seed` gives the same bytes on a virtual clock.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn over(
        specimen: VirtualSpecimen,
        machine: Machine,
        imperfections: Imperfections,
        settings: RigSettings,
        clock: Clock,
        seed: u64,
    ) -> Result<Self, Error> {
        settings.check_direction()?;
        let mut specimen = specimen;
        specimen.indenter_axis = settings.indenter_axis.normalize();
        let (header, breath_held) = (specimen.header.clone(), specimen.breath_held());
        let (mut load_sender, tip_load) = latest::channel(&ForceTorque::zero());
        let touch = move |time: f64, place: &Vec3, _: &Vec3| {
            let on_tip = specimen.touch(time, place, MECHANICS_STEP);
            load_sender.send(on_tip);
            on_tip.force
        };
        let device = VirtualPhantom::with_axes(machine, &Vec3::zeros(), imperfections)
            .with_contact(Box::new(touch));
        let (indenter, reference) = Indenter::new(settings.gains, Reference::at_rest());
        Self::new(Parts {
            device: Box::new(device),
            controller: Box::new(indenter),
            reference,
            sensor: Source::of_virtual(tip_load, seed, &settings),
            header,
            breath_held,
            settings,
            clock,
        })
    }

    fn new(parts: Parts) -> Result<Self, Error> {
        let Parts {
            header, settings, ..
        } = parts;
        let of_loop = ServoSettings {
            period: settings.period,
            limits: Some(limits(&settings)),
            log: LOG,
            ..ServoSettings::default()
        };
        let (servo, reader) = ServoLoop::new(parts.device, parts.controller, of_loop)?;
        let axis = settings.indenter_axis.normalize();
        let mut sensing = Sensing::new(parts.sensor, &axis);
        sensing.begin_zero((ZEROING / settings.period) as usize);
        let header = RecordingHeader {
            force_sensor: Some(sensing.name()),
            indenter_axis: Some(axis.into()),
            tip_distance_m: sensing.tip_distance(),
            ..header
        };
        Ok(Self {
            settings,
            header,
            servo: SteppedLoop::new(servo, reader.log, parts.clock)?,
            clock: parts.clock,
            reference: parts.reference,
            sensing,
            breath_held: parts.breath_held,
            time: 0.0,
            line: Line {
                normal: Vec3::z(),
                side: Vec3::zeros(),
            },
            aim: 0.0,
            contact: None,
            retreat: 0.0,
            breath_since: None,
            stage: Stage::Off,
            supervisor: reader.supervisor,
            waited: 0.0,
            is_real: false,
            rest: Arc::default(),
            pulse: reader.pulse,
        })
    }

    /// Header of its recordings on specimen, indenter and sensor.
    pub fn header(&self) -> &RecordingHeader {
        &self.header
    }

    /// Whether its sensor has six axes.
    pub fn has_six_axes(&self) -> bool {
        self.sensing.has_six_axes()
    }

    /// What a recording of `course` says at its top.
    pub fn describe(&self, trajectory: &DepthTrajectory, repeat: u64) -> RecordingHeader {
        RecordingHeader {
            approach_normal: Some(self.line.normal.into()),
            ..self.settings.describe(&self.header, trajectory, repeat)
        }
    }

    /// The largest force that its sensor shows along its axis [N].
    pub fn sensor_range(&self) -> f64 {
        self.sensing.axial_range()
    }

    /// Asks for real-time priority for the thread that calls, which shall be the one that runs the rig.
    pub fn raise_priority(&mut self) {
        self.servo.raise_priority();
    }

    /// Supervisor that takes every force off, from any thread, and arms again.
    pub fn supervisor(&self) -> Supervisor {
        self.supervisor.clone()
    }

    /// Whether its device is real; a hand may be on it.
    pub fn is_real(&self) -> bool {
        self.is_real
    }

    /// The clock that it runs on.
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// When it ticks, for a watch; a rig without a device never hangs.
    pub fn monitored_loop(&self) -> MonitoredLoop {
        MonitoredLoop {
            name: "the device of the rig".to_owned(),
            pulse: match self.is_real {
                true => self.pulse.clone(),
                false => Heartbeat::default(),
            },
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

    /// One tick toward a height [m] and speed [m/s] of the tip along the normal.
    fn tick(&mut self, phase: Phase, [height, speed]: [f64; 2]) -> Result<RigSample, Error> {
        self.tick_with(phase, height, self.line.normal * speed)
    }

    /// One tick toward a height [m] on its line with a velocity [m/s].
    fn tick_with(&mut self, phase: Phase, height: f64, velocity: Vec3) -> Result<RigSample, Error> {
        self.aim = height;
        let reference = Reference {
            position: self.line.at(height),
            velocity,
            driven: true,
        };
        let sample = self.exchange(phase, reference)?;
        if let Some(fault) = self.fault() {
            return Err(fault.into());
        }
        if phase == Phase::Withdrawing {
            return Ok(sample);
        }
        if let Some(fault) = sample.sensor_fault {
            return Err(fault.into());
        }
        let force = sample.largest_force();
        if force > self.settings.force_limit {
            return Err(Error::TooMuchForce {
                force,
                limit: self.settings.force_limit,
            });
        }
        match self.settings.breath {
            Some(breath) if sample.breath.is_some_and(|held| held > breath) => {
                Err(Error::BreathHoldEnded { breath })
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
        self.time += self.settings.period;
        let seen = seen.inspect_err(|fault| self.stage = Stage::Faulted(*fault))?;
        self.stage = seen.stage;
        self.sensing.read();
        let position = match self.is_real {
            true => on_device::upright(
                &(seen.state.position - self.rest.get().copied().unwrap_or_default()),
            ),
            false => seen.state.position,
        };
        let height = self.line.height(&position);
        Ok(RigSample {
            time,
            phase,
            height,
            depth: self.contact.map(|contact| contact - height),
            force: self.sensing.force_in_rig().dot(&self.line.normal),
            position,
            normal: self.line.normal,
            axes: self.sensing.has_six_axes().then_some(self.sensing.last),
            sensor_fault: self.sensing.fault,
            breath: self.breath_since.map(|since| time - since),
            waited: self.waited,
        })
    }

    /// Waits until the next tick is due, and returns how late it is [s]. In simulation, a delay of more than a
    /// period stops device, tissue and rig together: no force acts for longer than a tick. Missed ticks are not made up,
    /// and the loop of a real device has its own limits for late ticks.
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

/// What a rig is made of.
struct Parts {
    device: Box<dyn Device>,
    controller: Box<dyn Controller>,
    reference: latest::Sender<Reference>,
    sensor: Source,
    /// Header of recordings on the specimen and the indenter.
    header: RecordingHeader,
    breath_held: Arc<AtomicBool>,
    settings: RigSettings,
    clock: Clock,
}

/// Time over which the zero of the sensor is taken [s].
const ZEROING: f64 = 0.5;

fn limits(settings: &RigSettings) -> Limits {
    Limits {
        // What the device needs for itself and its friction comes on top of what tissue may feel.
        force: settings.force_limit + 2.0,
        speed: 2.0 * settings.speed_limit,
        ..Limits::without_hand()
    }
}
