//! What the stand-in says and understands.

use palpate_devices::haply::Generation;
use palpate_servo::Vec3;
use serde_json::{Value, json};

use super::{HaplyStandInSettings, StandInGrip};
use crate::Misbehaviour;
use crate::robot::Robot;

/// A message: everything at first, later what changes.
pub(super) fn frame(
    robots: &[Robot],
    settings: &HaplyStandInSettings,
    wrong: Option<&Misbehaviour>,
    is_first: bool,
) -> String {
    let vanished = wrong == Some(&Misbehaviour::DevicesMissing);
    let there = robots.iter().enumerate().filter(|_| !vanished);
    let inverse3: Vec<Value> = there
        .map(|(number, robot)| {
            let mut entry = robot_words(number, robot, wrong);
            if is_first {
                entry["config"] = config(settings.generation);
            }
            entry
        })
        .collect();
    let mut frame = json!({ "inverse3": inverse3, "verse_grip": [], "custom_verse_grip": [] });
    let grips: Vec<Value> = robots
        .iter()
        .enumerate()
        .map(|(number, robot)| grip_words(number, robot, settings.grip))
        .collect();
    match settings.grip {
        StandInGrip::None => {}
        StandInGrip::Wired => frame["verse_grip"] = grips.into(),
        StandInGrip::Wireless => frame["wireless_verse_grip"] = grips.into(),
    }
    if is_first {
        frame["session_id"] = 7.into();
    }
    if wrong == Some(&Misbehaviour::UnknownKeys) {
        frame["weather"] = json!({ "rain": [null, true, { "deep": [[[[]]]] }] });
        frame["inverse3"][0]["state"]["mood"] = json!("fine");
    }
    let text = frame.to_string();
    match wrong {
        // Not all of them are JSON, so it is put in as a text.
        Some(Misbehaviour::Coordinate(what)) => text.replace("\"COORDINATE\"", what),
        _ => text,
    }
}

fn robot_words(number: usize, robot: &Robot, wrong: Option<&Misbehaviour>) -> Value {
    let displayed = match wrong {
        Some(Misbehaviour::NoForce) => Vec3::zeros(),
        _ => robot.force,
    };
    let mut state = json!({
        "cursor_velocity": vector(&Vec3::zeros()),
        "angular_position": { "a0": 0.0, "a1": 0.0, "a2": 0.0 },
        "body_orientation": { "w": 1, "x": 0, "y": 0, "z": 0 },
        "current_cursor_force": vector(&device_axes(&displayed)),
        "control_domain": "cartesian",
        "transform": {},
    });
    if wrong != Some(&Misbehaviour::NoPosition) {
        state["cursor_position"] = vector(&device_place(&robot.state.position));
    }
    if let Some(Misbehaviour::Coordinate(_)) = wrong {
        state["cursor_position"]["x"] = "COORDINATE".into();
    }
    json!({
        "device_id": number.to_string(),
        "state": state,
        "status": {
            "calibrated": wrong != Some(&Misbehaviour::NoCalibration),
            "in_use": false,
            "power_supply": wrong != Some(&Misbehaviour::NoPower),
            "ready": wrong != Some(&Misbehaviour::NoPower),
            "started": true,
        },
    })
}

fn config(generation: Generation) -> Value {
    let mut config = json!({
        "type": "inverse3",
        "port": "/dev/ttyACM0",
        "device_info": { "major_version": 7, "minor_version": 4, "device_type": 4 },
        "gravity_compensation": { "enabled": true, "scaling_factor": 1.0 },
        "handedness": "right",
        "streaming_mode": "USB",
    });
    if generation == Generation::Vector {
        config["basis"] = json!({ "permutation": "XYZ" });
        config["filters"] = json!({ "force_gate": { "gain": 0.3 }, "damping": { "scalar": 0.0 } });
    }
    config
}

fn grip_words(number: usize, robot: &Robot, grip: StandInGrip) -> Value {
    let turned = robot.state.orientation.unwrap_or_default();
    // A turn of ours about an axis of ours is one of theirs about theirs.
    let axis = device_axes(&Vec3::new(turned.i, turned.j, turned.k));
    let orientation = json!({ "w": turned.w, "x": axis.x, "y": axis.y, "z": axis.z });
    let pressed = |bit: u32| robot.state.buttons & bit != 0;
    match grip {
        StandInGrip::Wired | StandInGrip::None => json!({
            "device_id": format!("grip {number}"),
            "state": { "button": pressed(1), "hall": 0, "orientation": orientation },
            "status": { "error": 0, "ready": true },
        }),
        StandInGrip::Wireless => json!({
            "device_id": format!("grip {number}"),
            "state": {
                "battery_level": 0.8,
                "buttons": { "a": pressed(1), "b": pressed(2), "c": pressed(4) },
                "hall": 16,
                "orientation": orientation,
            },
            "status": { "connected": true, "awake": true, "ready": true },
        }),
    }
}

/// The forces that a message commands, per device [N], in our axes; none of what is not understood.
pub(super) fn commands(text: &str, generation: Generation) -> Vec<(usize, Vec3)> {
    let message: Value = serde_json::from_str(text).unwrap_or_default();
    let robots = message["inverse3"].as_array();
    let commands = robots.into_iter().flatten().filter_map(|robot| {
        let number = robot["device_id"].as_str()?.parse().ok()?;
        let force = &robot["commands"]["set_cursor_force"][key(generation)];
        let [x, y, z] = ["x", "y", "z"].map(|axis| force[axis].as_f64());
        Some((number, Vec3::new(x?, z?, -y?)))
    });
    commands.collect()
}

/// From our axes (x right, y up, z toward the user) to the device's (x right, y away from the user, z up).
fn device_axes(vector: &Vec3) -> Vec3 {
    Vec3::new(vector.x, -vector.z, vector.y)
}

/// The same of a place [m]; its zero is on the mounting plate.
fn device_place(place: &Vec3) -> Vec3 {
    device_axes(place) + Vec3::new(0.0, -0.11, 0.175)
}

fn vector(vector: &Vec3) -> Value {
    json!({ "x": vector.x, "y": vector.y, "z": vector.z })
}

/// How forces are called.
fn key(generation: Generation) -> &'static str {
    match generation {
        Generation::Values => "values",
        Generation::Vector => "vector",
    }
}
