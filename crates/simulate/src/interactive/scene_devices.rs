use palpate_devices::{Kind, Places};
use palpate_files::Scene;
use palpate_files::scene::DeviceKind;
use palpate_geometry::Vec3;
use palpate_servo::{Device, Pointer, PointerHand, Trajectory, VirtualDevice};

use super::PlacedDevice;
use super::placement::placement_of;
use crate::{Error, Simulation, Tool};

/// The devices of a scene's tools, each in the scene's order.
pub struct SceneDevices {
    /// The devices; none for a tool without one.
    pub devices: Vec<Option<PlacedDevice>>,
    /// The pointer hands of the tools that a mouse moves.
    pub pointers: Vec<Option<PointerHand>>,
}

/// Depth and height of a scripted hand without a motion [m].
const SCRIPTED_DEPTH: f64 = 4e-3;
/// Its frequency [Hz].
const SCRIPTED_RATE: f64 = 0.5;

/// The driver of a scene's device; none for a device without a driver.
fn driver(device: DeviceKind) -> Option<Kind> {
    match device {
        DeviceKind::Haply => Some(Kind::Haply),
        DeviceKind::OpenHaptics => Some(Kind::OpenHaptics),
        DeviceKind::ForceDimension => Some(Kind::ForceDimension),
        DeviceKind::Mouse | DeviceKind::Virtual | DeviceKind::None => None,
    }
}

/// The real device of each tool.
fn real_devices(scene: &Scene, places: &Places) -> Result<Vec<Option<Box<dyn Device>>>, Error> {
    let mut opened: Vec<Kind> = Vec::new();
    let tools = scene.tools.iter().map(|tool| {
        let Some(kind) = driver(tool.device) else {
            return Ok(None);
        };
        let number = opened.iter().filter(|other| **other == kind).count();
        opened.push(kind);
        let device = kind.open(number, places).map_err(|why| Error::NoDevice {
            tool: tool.name.clone(),
            why,
        })?;
        Ok(Some(device))
    });
    tools.collect()
}

impl SceneDevices {
    /// Opens the devices that `scene` names for its tools, looking for real ones at `places`: the first tool with a
    /// kind of device gets the first device of that kind, the next the next. A virtual device without a motion palpates
    /// the organ at its highest point.
    ///
    /// # Errors
    /// When a device is missing.
    pub fn open(scene: &Scene, simulation: &Simulation, places: &Places) -> Result<Self, Error> {
        let (mut devices, mut pointers) = (Vec::new(), Vec::new());
        let mut real = real_devices(scene, places)?.into_iter();
        for (tool, model) in scene.tools.iter().zip(simulation.tools()) {
            let device = real.next().flatten();
            let (device, pointer) = match (tool.device, device) {
                (DeviceKind::Mouse, _) => {
                    let (pointer, hand) = Pointer::new();
                    (Some(PlacedDevice::new(pointer)), Some(hand))
                }
                (DeviceKind::Virtual, _) => {
                    (Some(PlacedDevice::palpating(simulation, model)), None)
                }
                (_, Some(device)) => {
                    let placement = placement_of(scene, simulation, model);
                    (Some(PlacedDevice { device, placement }), None)
                }
                (_, None) => (None, None),
            };
            devices.push(device);
            pointers.push(pointer);
        }
        Ok(Self { devices, pointers })
    }

    /// Checks that the real devices that `scene` names are connected; closes them again.
    ///
    /// # Errors
    /// When one is missing.
    pub fn check(scene: &Scene, places: &Places) -> Result<(), Error> {
        real_devices(scene, places).map(|_| ())
    }

    /// Whether a real device moves a tool of `scene`.
    pub fn any(scene: &Scene) -> bool {
        scene.tools.iter().any(|tool| tool.device.is_haptic())
    }
}

impl PlacedDevice {
    /// A scripted hand that moves `tool` at the highest point of the organ: from the surface to 4 mm below it, out to 4
    /// mm above it, and so on, twice in four seconds. With a trocar the hand moves straight, and the tip nearly so.
    pub fn palpating(simulation: &Simulation, tool: &Tool) -> Self {
        let surface = simulation.surface();
        let vertices = surface.mesh().vertices().iter().enumerate();
        let highest = vertices.max_by(|(_, a), (_, b)| a.z.total_cmp(&b.z));
        let (place, outward) = highest.map_or((Vec3::zeros(), Vec3::z()), |(number, place)| {
            (*place, surface.vertex_normals()[number])
        });
        let (mut center, mut amplitude) =
            (place + outward * tool.overhang(), -outward * SCRIPTED_DEPTH);
        if let Some(trocar) = &tool.fulcrum {
            let ends = [center - amplitude, center + amplitude].map(|tip| trocar.hand(&tip));
            center = 0.5 * (ends[0] + ends[1]);
            amplitude = ends[1] - center;
        }
        let mut device = Self::new(VirtualDevice::new(Trajectory::Sine {
            center,
            amplitude,
            frequency: SCRIPTED_RATE,
        }));
        device.placement.trocar = tool.fulcrum;
        device
    }
}
