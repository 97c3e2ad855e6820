//! The place that a task wants touched.

use palpate_files::Scene;
use palpate_files::scene::Goal;
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::{Error, organ};

/// Refuses a task of `scene` whose target no tip can touch: it lies on a neighbour that collides.
///
/// # Errors
/// When the target is farther from the neighbours than counts, or a neighbour cannot be read.
pub fn check_target(scene: &Scene) -> Result<(), Error> {
    let Goal::Touch(_) = scene.task.goal else {
        return Ok(());
    };
    let bodies = scene.neighbours.iter().filter(|own| own.collides);
    let surfaces = bodies.map(|own| Ok(organ::read_neighbour(own)?.0));
    let surfaces: Vec<Surface> = surfaces.collect::<Result<_, Error>>()?;
    check(&scene.task.goal, surfaces.iter())
}

/// As [`check_target`], where the neighbours that collide have these surfaces.
pub(crate) fn check<'s>(
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
