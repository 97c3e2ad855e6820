//! The default placement of a real device in a scene, aligned with the view: right, up and toward the user for a hand
//! are the same in the view that the scene states (`view`), or else in the front view: x, z and −y.
//!
//! The middle of the device's workspace is in front of the organ, above the target of the view, or where the organ is
//! highest.
//!
//! *How we know*: `haptic_devices::…` in the tests.
//!
//! *Limits*: turning the view does not change the placement.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use palpate_files::Scene;
use palpate_files::scene::View;
use palpate_geometry::{AabbTree, Vec3};

use super::DevicePlacement;
use crate::{Simulation, Tool};

/// Distance of the tip from the organ when the handle is in its middle [m].
const CLEAR: f64 = 0.015;

/// Distance of each of two hands from the middle [m].
const APART: f64 = 0.015;

/// Step size of the search for a clear location [m], and largest number of steps [-].
const STEP: f64 = 0.005;
const STEPS: usize = 100;

/// The placement of the device of `tool`.
pub(super) fn placement_of(scene: &Scene, simulation: &Simulation, tool: &Tool) -> DevicePlacement {
    let axes = axes(&scene.view);
    let side = match tool.name.as_str() {
        _ if simulation.tools().len() < 2 => 0.0,
        "left" => -APART,
        "right" => APART,
        _ => 0.0,
    };
    let offset = axes.column(0) * side;
    let tip = clear_place(scene, simulation, &axes) + offset;
    DevicePlacement {
        origin: tool.fulcrum.map_or(tip, |trocar| trocar.hand(&tip)),
        rotation: UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes)),
        scale: 1.0,
        trocar: tool.fulcrum,
    }
}

/// Right, up and toward the user, as columns.
fn axes(view: &View) -> Matrix3<f64> {
    let up = view.up.map_or_else(Vec3::z, Vec3::from);
    let view_direction = view.eye_m.zip(view.target_m);
    let back = view_direction.and_then(|(eye, target)| {
        let back = Vec3::from(eye) - Vec3::from(target);
        back.try_normalize(1e-9)
    });
    let back = back.unwrap_or(-Vec3::y());
    let right = up.cross(&back).try_normalize(1e-6);
    // For a view along the up direction, any other will do.
    let right = right.unwrap_or_else(|| {
        back.cross(&Vec3::y())
            .try_normalize(1e-6)
            .unwrap_or(Vec3::x())
    });
    Matrix3::from_columns(&[right, back.cross(&right), back])
}

/// A location of a tip outside the organ [m].
fn clear_place(scene: &Scene, simulation: &Simulation, axes: &Matrix3<f64>) -> Vec3 {
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let (from, outward) = match scene.view.target_m {
        Some(target) => (Vec3::from(target), axes.column(2).into_owned()),
        None => {
            let places = surface.mesh().vertices().iter();
            let highest = places.max_by(|one, other| one.z.total_cmp(&other.z));
            (highest.copied().unwrap_or_default(), Vec3::z())
        }
    };
    let places = (0..STEPS).map(|number| from + outward * (STEP * number as f64));
    // From the far side on, to skip hollows of the organ.
    let clear = |place: &Vec3| surface.signed_distance(&tree, place).1 > CLEAR;
    let blocked = places.clone().rposition(|place| !clear(&place));
    let first = blocked.map_or(0, |last| last + 1).min(STEPS - 1);
    from + outward * (STEP * first as f64)
}
