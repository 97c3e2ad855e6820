use palpate_files::Scene;
use palpate_files::scene::DeviceKind;
use palpate_geometry::Vec3;
use palpate_servo::{Pointer, PointerHand, Trajectory, VirtualDevice};

use super::Station;
use crate::{Error, Simulation, Tool};

/// What the tools of a scene are moved by, each in the scene's order.
pub struct SceneDevices {
    /// The devices; none for a tool that nothing moves.
    pub stations: Vec<Option<Station>>,
    /// The hands of the tools that a mouse moves.
    pub pointers: Vec<Option<PointerHand>>,
}

/// How deep a scripted hand goes without a motion, and how high [m].
const SCRIPTED_DEPTH: f64 = 4e-3;
/// How often [Hz].
const SCRIPTED_RATE: f64 = 0.5;

impl SceneDevices {
    /// Opens the devices that `scene` names for its tools. A virtual device without a motion palpates the
    /// organ where it is highest.
    ///
    /// # Errors
    /// When there is no driver for one of them.
    pub fn open(scene: &Scene, simulation: &Simulation) -> Result<Self, Error> {
        let (mut stations, mut pointers) = (Vec::new(), Vec::new());
        for (tool, model) in scene.tools.iter().zip(simulation.tools()) {
            let (station, pointer) = match tool.device {
                DeviceKind::None => (None, None),
                DeviceKind::Mouse => {
                    let (pointer, hand) = Pointer::new();
                    (Some(Station::new(pointer)), Some(hand))
                }
                DeviceKind::Virtual => (Some(Station::palpating(simulation, model)), None),
                kind => {
                    return Err(Error::NoDriver {
                        tool: tool.name.clone(),
                        device: kind.to_string(),
                    });
                }
            };
            stations.push(station);
            pointers.push(pointer);
        }
        Ok(Self { stations, pointers })
    }
}

impl Station {
    /// A scripted hand that moves `tool` on the organ where it is highest: from the surface to 4 mm below
    /// it, out to 4 mm above it, and so on, twice in four seconds. Through a trocar the hand goes straight, and
    /// the tip nearly.
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
        let mut station = Self::new(VirtualDevice::new(Trajectory::Sine {
            center,
            amplitude,
            frequency: SCRIPTED_RATE,
        }));
        station.mount.trocar = tool.fulcrum;
        station
    }
}
