//! The target point and the line of a task.

use palpate_files::Scene;
use palpate_files::scene::Goal;
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::polyline::Polyline;
use crate::{Error, organ};

/// A line is sampled in steps of this length, or of this part of it, whichever is longer [m], [-].
const STEP: f64 = 1e-3;
const OF_THE_LINE: f64 = 1e-3;

/// Rejects a task of `scene` that no tool can do: its target lies on no neighbour that collides, or its line lies away
/// from the organ.
///
/// # Errors
/// When the target or the line is farther from these surfaces than allowed, or one of them cannot be read.
pub fn check_target(scene: &Scene) -> Result<(), Error> {
    let goal = &scene.task.goal;
    match goal {
        Goal::Touch(_) => {
            let bodies = scene.neighbours.iter().filter(|own| own.collides);
            let surfaces = bodies.map(|own| Ok(organ::read_neighbour(own)?.0));
            let surfaces: Vec<Surface> = surfaces.collect::<Result<_, Error>>()?;
            check_touch(goal, surfaces.iter())
        }
        Goal::Cut { .. } => {
            let (surface, _) = organ::read_organ(&scene.organ.shape)?;
            check_line(scene, &surface, &AabbTree::new(surface.mesh()))
        }
        _ => Ok(()),
    }
}

/// Rejects a target that lies on none of the `surfaces` of the neighbours that collide.
pub(crate) fn check_touch<'s>(
    goal: &Goal,
    surfaces: impl Iterator<Item = &'s Surface>,
) -> Result<(), Error> {
    let Goal::Touch(touch) = goal else {
        return Ok(());
    };
    let target = Vec3::from(touch.target_m);
    let distances = surfaces.map(|surface| {
        let tree = AabbTree::new(surface.mesh());
        tree.nearest(surface.mesh(), &target).distance
    });
    let distance = distances.fold(f64::INFINITY, f64::min);
    match distance <= touch.tolerance_m {
        true => Ok(()),
        false => Err(Error::TargetOutOfReach {
            distance,
            tolerance: touch.tolerance_m,
        }),
    }
}

/// Rejects a line that is farther from the organ's `surface` than a cut along it may be: by the tolerance along the
/// surface, and by the depth of the layers below it, since a straight line over a curved organ lies inside.
pub(crate) fn check_line(scene: &Scene, surface: &Surface, tree: &AabbTree) -> Result<(), Error> {
    let Goal::Cut {
        line, tolerance_m, ..
    } = &scene.task.goal
    else {
        return Ok(());
    };
    let layers = scene.organ.layers.iter().map(|layer| layer.thickness_m);
    let tolerance = tolerance_m + layers.sum::<f64>();
    let line = Polyline::new(line).ok_or(Error::NoLine)?;
    let length = line.length();
    let steps = (length / STEP.max(OF_THE_LINE * length)).ceil() as u32;
    let places = (0..=steps).map(|step| line.at(length * f64::from(step) / f64::from(steps)));
    let distances = places.map(|place| tree.nearest(surface.mesh(), &place).distance);
    let distance = distances.fold(0.0, f64::max);
    match distance <= tolerance {
        true => Ok(()),
        false => Err(Error::LineOffOrgan {
            distance,
            tolerance,
        }),
    }
}
