//! Messages of ROS 2 as JSON.

use std::time::{Duration, SystemTime};

use palpate_servo::Vec3;
use serde_json::{Value, json};

use crate::publisher::{PublishedState, ShownSurface, ShownTool};

/// The frame of all messages: the axes of the scene.
pub const FRAME: &str = "scene";

/// The topic of the organ's surface.
pub const ORGAN: &str = "/palpate/organ";

/// The topic of the state of the simulation.
pub const STATUS: &str = "/palpate/status";

/// The content of a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// The pose of the tool with this number.
    Pose(usize),
    /// The force on the tool with this number.
    Wrench(usize),
    /// The surface of the organ.
    Organ,
    /// Whether it runs.
    Status,
}

impl Content {
    /// The type of its messages.
    pub fn kind(self) -> &'static str {
        match self {
            Self::Pose(_) => "geometry_msgs/msg/PoseStamped",
            Self::Wrench(_) => "geometry_msgs/msg/WrenchStamped",
            Self::Organ => "shape_msgs/msg/Mesh",
            Self::Status => "std_msgs/msg/String",
        }
    }
}

/// All topics.
pub fn topics(state: &PublishedState) -> Vec<(String, Content)> {
    let tools = state.tools.iter().enumerate();
    let of_tools = tools.flat_map(|(number, tool)| {
        let name = ros_name(&tool.name);
        [
            (format!("/palpate/{name}/pose"), Content::Pose(number)),
            (format!("/palpate/{name}/wrench"), Content::Wrench(number)),
        ]
    });
    let others = [
        (ORGAN.to_owned(), Content::Organ),
        (STATUS.to_owned(), Content::Status),
    ];
    of_tools.chain(others).collect()
}

/// A name that ROS accepts: letters, digits and underscores, none of which is a digit at first.
fn ros_name(name: &str) -> String {
    let plain = |letter: char| match letter.is_ascii_alphanumeric() {
        true => letter,
        false => '_',
    };
    let name: String = name.chars().map(plain).collect();
    match name.starts_with(|first: char| first.is_ascii_digit()) {
        true => format!("_{name}"),
        false => name,
    }
}

fn header(time: SystemTime) -> Value {
    let since = time.duration_since(SystemTime::UNIX_EPOCH);
    let since = since.unwrap_or(Duration::ZERO);
    let stamp = json!({"sec": since.as_secs(), "nanosec": since.subsec_nanos()});
    json!({"stamp": stamp, "frame_id": FRAME})
}

fn vector(of: &Vec3) -> Value {
    json!({"x": of.x, "y": of.y, "z": of.z})
}

/// `geometry_msgs/PoseStamped`: the tip [m] and the rotation from tool to scene; none while no hand holds the tool.
pub fn pose(tool: &ShownTool, time: SystemTime) -> Option<Value> {
    let turned = &tool.orientation;
    let orientation = json!({"x": turned.i, "y": turned.j, "z": turned.k, "w": turned.w});
    let pose = json!({"position": vector(&tool.place?), "orientation": orientation});
    Some(json!({"header": header(time), "pose": pose}))
}

/// `geometry_msgs/WrenchStamped`: the force on the tool [N] at its tip, and the torque about it [N m].
pub fn wrench(tool: &ShownTool, time: SystemTime) -> Value {
    let wrench = json!({"force": vector(&tool.force), "torque": vector(&tool.torque)});
    json!({"header": header(time), "wrench": wrench})
}

/// `shape_msgs/Mesh`: the surface [m], triangles outward.
pub fn mesh(surface: &ShownSurface) -> Value {
    let triangles = surface.triangles.iter();
    let triangles = triangles.map(|corners| json!({"vertex_indices": corners}));
    let vertices = surface.vertices.iter();
    let vertices = vertices.map(|[x, y, z]| json!({"x": x, "y": y, "z": z}));
    json!({"triangles": triangles.collect::<Value>(), "vertices": vertices.collect::<Value>()})
}

/// `std_msgs/String`: `ok`, `paused`, or the tool whose device has no force, and why.
pub fn status(state: &PublishedState) -> Value {
    let fault = |tool: &ShownTool| Some(format!("{}: {}", tool.name, tool.fault?));
    let paused = || state.paused.then(|| "paused".to_owned());
    let fault = state.tools.iter().find_map(fault);
    json!({"data": fault.or_else(paused).unwrap_or_else(|| "ok".to_owned())})
}
