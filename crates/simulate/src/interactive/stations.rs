use palpate_servo::latest::{Receiver, Sender, channel};
use palpate_servo::watch::Watched;
use palpate_servo::{
    AffineForce, Device, Extrapolator, LoopReport, Sample, ServoLoop, ServoSettings, Supervisor,
    log,
};

use super::Mount;
use super::force_renderer::{ForceRenderer, hand_over};
use crate::{Error, Simulation};

/// The device of a tool and where it stands.
pub struct Station {
    /// The device.
    pub device: Box<dyn Device>,
    /// Where it stands.
    pub mount: Mount,
}

impl Station {
    /// A `device` whose frame is the scene's.
    pub fn new(device: impl Device + 'static) -> Self {
        Self {
            device: Box::new(device),
            mount: Mount::default(),
        }
    }
}

/// What the model has of a station: its end of both channels.
pub(super) struct Line {
    pub(super) samples: Receiver<Option<Sample>>,
    pub(super) answers: Sender<AffineForce>,
    pub(super) mount: Mount,
}

/// What is watched of a station.
pub(super) struct Watch {
    pub(super) samples: log::Reader<Sample>,
    pub(super) report: Receiver<LoopReport>,
}

/// A station with its loop, taken apart for those who run it.
pub(super) struct Parts {
    pub(super) servo: ServoLoop,
    pub(super) line: Line,
    pub(super) watch: Watch,
    /// Who its loop is, and when it ticks.
    pub(super) watched: Watched,
    /// Whether its forces reach a hand.
    pub(super) displays_force: bool,
}

/// The parts of every station, none for a tool without a device.
pub(super) fn take_apart(
    simulation: &Simulation,
    stations: Vec<Option<Station>>,
    settings: ServoSettings,
    supervisor: &Supervisor,
) -> Result<Vec<Option<Parts>>, Error> {
    if stations.len() != simulation.tools().len() {
        return Err(Error::OtherDevices {
            tools: simulation.tools().len(),
            stations: stations.len(),
        });
    }
    let tools = simulation.tools().iter().zip(stations);
    let parts = tools.map(|(tool, station)| {
        let parts = |station| Parts::new((simulation, &tool.name), station, settings, supervisor);
        station.map(parts).transpose()
    });
    parts.collect()
}

impl Parts {
    fn new(
        (simulation, tool): (&Simulation, &str),
        station: Station,
        settings: ServoSettings,
        supervisor: &Supervisor,
    ) -> Result<Self, Error> {
        let Station { device, mount } = station;
        let (answers, heard) = channel(&AffineForce::none(f64::NEG_INFINITY));
        let hand_over = hand_over(simulation.hand_over());
        let extrapolator = Extrapolator::new(hand_over, simulation.step(), settings.period);
        let scale = simulation.force_scale();
        let renderer = ForceRenderer::new(heard, extrapolator, mount, scale);
        let capabilities = device.capabilities();
        let (name, displays_force) = (capabilities.name.clone(), capabilities.displays_force);
        let (servo, reader) =
            ServoLoop::supervised(device, Box::new(renderer), settings, supervisor.clone())?;
        Ok(Self {
            watched: Watched {
                name: format!("the device of the tool {tool:?} ({name})"),
                pulse: reader.pulse,
            },
            displays_force,
            servo,
            line: Line {
                samples: reader.latest,
                answers,
                mount,
            },
            watch: Watch {
                samples: reader.log,
                report: reader.report,
            },
        })
    }
}
