//! The running simulation in the form that servers send to other programs.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{Quaternion, UnitQuaternion};
use palpate_devices::publisher::{PublishedState, Publisher, ShownSurface, ShownTool};
use palpate_geometry::Vec3;
use palpate_servo::latest::{Receiver, Sender, channel};

use super::{Snapshot, ToolSnapshot};
use crate::Simulation;

/// Publishes the output of this simulation through `publisher` from now on.
pub(super) fn published_by(
    publisher: &Publisher,
    simulation: &Arc<Simulation>,
) -> Sender<Snapshot> {
    let (snapshots, seen) = channel(&Snapshot::new(simulation));
    // Only the server's own thread calls this.
    let seen = Arc::new(Mutex::new(seen));
    let (of_tools, of_organ) = (seen.clone(), seen);
    let tools = simulation.tools().iter();
    let names: Vec<String> = tools.map(|tool| tool.name.clone()).collect();
    let organ = simulation.clone();
    publisher.show(
        move |picture| with_latest(&of_tools, |snapshot| fill(picture, snapshot, &names)),
        move || with_latest(&of_organ, |snapshot| surface(&organ, snapshot)),
    );
    snapshots
}

fn with_latest<T>(seen: &Mutex<Receiver<Snapshot>>, read: impl FnOnce(&Snapshot) -> T) -> T {
    let mut seen = seen.lock().unwrap_or_else(PoisonError::into_inner);
    read(seen.latest())
}

fn fill(picture: &mut PublishedState, snapshot: &Snapshot, names: &[String]) {
    picture.paused = snapshot.paused;
    picture.tools.clear();
    let tools = names.iter().zip(&snapshot.tools);
    picture
        .tools
        .extend(tools.map(|(name, tool)| shown(name, tool)));
}

fn shown(name: &str, tool: &ToolSnapshot) -> ShownTool {
    let [x, y, z, w] = tool.orientation;
    ShownTool {
        name: name.to_owned(),
        place: tool.pose.map(|pose| Vec3::from(pose.position_m)),
        orientation: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
        force: tool.force,
        torque: tool.torque,
        fault: tool.fault,
    }
}

/// The deformed organ with its cuts.
fn surface(simulation: &Simulation, snapshot: &Snapshot) -> ShownSurface {
    if let Some(opened) = snapshot.opened.as_ref().filter(|opened| opened.version > 0) {
        return ShownSurface {
            vertices: opened.places.clone(),
            triangles: opened.triangles.clone(),
        };
    }
    let mesh = simulation.surface().mesh();
    let ids = mesh.triangle_ids();
    ShownSurface {
        vertices: snapshot.vertices.clone(),
        triangles: ids.map(|id| mesh.corners(id).map(|node| node.0)).collect(),
    }
}
