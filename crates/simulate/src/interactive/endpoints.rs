use palpate_servo::latest::{Receiver, Sender, channel};
use palpate_servo::monitor::MonitoredLoop;
use palpate_servo::{
    AffineForce, Device, Extrapolator, LoopReport, Sample, ServoLoop, ServoSettings, Supervisor,
    log,
};

use super::DevicePlacement;
use super::force_renderer::{ForceRenderer, hand_over};
use crate::{Error, Simulation};

/// The device of a tool and its placement.
pub struct PlacedDevice {
    /// The device.
    pub device: Box<dyn Device>,
    /// Its placement.
    pub placement: DevicePlacement,
}

impl PlacedDevice {
    /// A `device` whose frame is the scene's.
    pub fn new(device: impl Device + 'static) -> Self {
        Self {
            device: Box::new(device),
            placement: DevicePlacement::default(),
        }
    }
}

/// The model's ends of a device's channels.
pub(super) struct ModelEndpoint {
    pub(super) samples: Receiver<Option<Sample>>,
    pub(super) answers: Sender<AffineForce>,
    pub(super) placement: DevicePlacement,
}

/// The readers' ends of a device's loop.
pub(super) struct LoopReaders {
    pub(super) samples: log::Reader<Sample>,
    pub(super) report: Receiver<LoopReport>,
}

/// A device with its loop, split into its endpoints for the threads that run it.
pub(super) struct DeviceEndpoints {
    pub(super) servo: ServoLoop,
    pub(super) endpoint: ModelEndpoint,
    pub(super) watch: LoopReaders,
    /// Name of its loop, and time of its last tick.
    pub(super) watched: MonitoredLoop,
    /// Whether its forces reach a hand.
    pub(super) displays_force: bool,
}

/// The endpoints of every device, none for a tool without a device.
pub(super) fn device_endpoints(
    simulation: &Simulation,
    devices: Vec<Option<PlacedDevice>>,
    settings: ServoSettings,
    supervisor: &Supervisor,
) -> Result<Vec<Option<DeviceEndpoints>>, Error> {
    if devices.len() != simulation.tools().len() {
        return Err(Error::OtherDevices {
            tools: simulation.tools().len(),
            devices: devices.len(),
        });
    }
    let tools = simulation.tools().iter().zip(devices);
    let parts = tools.map(|(tool, device)| {
        let parts =
            |device| DeviceEndpoints::new(simulation, &tool.name, device, settings, supervisor);
        device.map(parts).transpose()
    });
    parts.collect()
}

impl DeviceEndpoints {
    fn new(
        simulation: &Simulation,
        tool: &str,
        device: PlacedDevice,
        settings: ServoSettings,
        supervisor: &Supervisor,
    ) -> Result<Self, Error> {
        let PlacedDevice { device, placement } = device;
        let (answers, heard) = channel(&AffineForce::none(f64::NEG_INFINITY));
        let hand_over = hand_over(simulation.hand_over());
        let extrapolator = Extrapolator::new(hand_over, simulation.step(), settings.period);
        let scale = simulation.force_scale();
        let renderer = ForceRenderer::new(heard, extrapolator, placement, scale);
        let capabilities = device.capabilities();
        let (name, displays_force) = (capabilities.name.clone(), capabilities.displays_force);
        let (servo, reader) =
            ServoLoop::supervised(device, Box::new(renderer), settings, supervisor.clone())?;
        Ok(Self {
            watched: MonitoredLoop {
                name: format!("the device of the tool {tool:?} ({name})"),
                pulse: reader.pulse,
            },
            displays_force,
            servo,
            endpoint: ModelEndpoint {
                samples: reader.latest,
                answers,
                placement,
            },
            watch: LoopReaders {
                samples: reader.log,
                report: reader.report,
            },
        })
    }
}
