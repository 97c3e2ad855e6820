//! Stiff inclusions that are in no prepared model; their effect on the force is estimated.
//!
//! Inclusions reduce the displacement of a tip by L F, where L follows in closed form from the stress under the tip and
//! the energy that the inclusion takes from it (`palpate_mechanics::inclusion`): the tip's force F₀(δ) becomes the F
//! with F = F₀(δ + L F).
//!
//! *How we know*: `regions::estimated_inclusions_press_back_as_finite_elements`, `estimated_inclusions::…`.
//!
//! *Limits*: the surface is flat there and the same at every depth; the effect on a tangential force is that on a
//! normal one; the organ's shape is that without inclusions.

use palpate_files::Scene;
use palpate_files::scene::EstimatedInclusion;
use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::inclusion::InclusionField;
use palpate_mechanics::{Limit, LinearElastic, Reached};

use crate::Error;
use crate::regions::TipExchange;
use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// Iterations, of which a few are needed: where a sphere touches nearly only stiff tissue, each leaves 0.9 of the
/// change.
const MAX_ROUNDS: usize = 40;

/// Relative change of the force that ends the iterations: a hundredth of the accuracy of the estimate [-].
const SETTLED: f64 = 5e-4;

/// Rounds of Newton's method, each of which leaves the square of the error: of a root of 0.1 a thousandth.
const NEWTON_ROUNDS: usize = 6;

/// Smallest remaining part of a tip's compliance, which is positive except for rounding [-].
const MIN_REMAINING: f64 = 0.01;

/// Rejects inclusions of `scene` that lie outside its organ with this `surface`.
///
/// # Errors
/// When the centre of one is not in the organ.
pub fn check_estimated_inclusions(scene: &Scene, surface: &Surface) -> Result<(), Error> {
    let tree = AabbTree::new(surface.mesh());
    check(&scene.organ.estimated_inclusions, surface, &tree)
}

/// The inclusions in tissue of the law `around`, for compliances that are scaled to the Young's modulus `unit` [Pa].
///
/// # Errors
/// When the centre of one is not in the organ.
pub(crate) fn field(
    inclusions: &[EstimatedInclusion],
    surface: &Surface,
    tree: &AabbTree,
    around: &LinearElastic,
    unit: f64,
) -> Result<InclusionField, Error> {
    check(inclusions, surface, tree)?;
    let shapes = inclusions.iter();
    let shapes = shapes.map(|inclusion| (&inclusion.shape, inclusion.stiffness_ratio));
    Ok(InclusionField::of_shapes(shapes, around, unit))
}

fn check(
    inclusions: &[EstimatedInclusion],
    surface: &Surface,
    tree: &AabbTree,
) -> Result<(), Error> {
    for inclusion in inclusions {
        let (_, outside) = surface.signed_distance(tree, &Vec3::from(inclusion.middle()));
        if outside > 0.0 {
            let name = inclusion.name.clone();
            return Err(Error::EstimatedOutside { name, outside });
        }
    }
    Ok(())
}

/// Corrects the force and stiffness of a tip in contact for the inclusions of the `field`.
pub(crate) fn stiffen(
    simulation: &Simulation,
    field: &InclusionField,
    tool: &Tool,
    state: &mut ToolState,
) {
    let Some(contact) = state.contact.filter(|_| !state.is_grasping()) else {
        return;
    };
    let law = &simulation.material.at_rest;
    let alone = state.elastic.dot(&contact.normal()).max(0.0);
    let touching = |force: f64| tool.touching_radius(law, force);
    let radius = touching(alone);
    if radius <= 0.0 {
        return;
    }
    let (point, normal) = (contact.point(), contact.rest_normal());
    let exchange = TipExchange::unsolved(field, tool.tip, &point, &normal);
    // The rest beyond a linear tip comes from a nonlinear law, which the inclusion has as well.
    let most = 2.0 * radius * law.youngs_modulus() / (1.0 - law.poissons_ratio().powi(2));
    let stiffness = normal.dot(&(state.stiffness * normal)).clamp(0.0, most);
    let yields = |ratio: f64| {
        let own = exchange.compliance(touching(ratio * alone));
        own.map(|own| -own * stiffness / law.youngs_modulus())
    };
    let (ratio, of_tangent) = match tool.tip {
        Tip::Flat { .. } => (1.0 / (1.0 - yields(1.0)[0]), 1.0),
        Tip::Sphere { .. } => {
            let (mut ratio, mut change) = (1.0_f64, 1.0);
            for _ in 0..MAX_ROUNDS {
                let next = force_ratio_of_sphere(yields(ratio)[0], ratio);
                change = (next / ratio - 1.0).abs();
                ratio = next;
                if change <= SETTLED {
                    break;
                }
            }
            if change > SETTLED {
                let reached = Reached {
                    unbounded: change,
                    used: SETTLED,
                };
                state.limited.add(Limit::Coupling, reached);
            }
            (ratio, ratio.cbrt())
        }
    };
    // L F grows with the force by L and by what L itself does.
    let [less, growth] = yields(ratio);
    state.elastic *= ratio;
    state.stiffness *= of_tangent / (1.0 - of_tangent * (less + growth)).max(MIN_REMAINING);
}

/// The force under a sphere over that without inclusions, where these take the part x of the tangent compliance: the solution of
/// t = (1 + ⅔ x t)^(3/2). Where x is positive, one round from `ratio` towards it.
fn force_ratio_of_sphere(part: f64, ratio: f64) -> f64 {
    let share = part / 1.5;
    if share >= 0.0 {
        return (1.0 + share * ratio).powf(1.5);
    }
    // t^(2/3) by Newton's method, which comes from above.
    let mut root = 1.0_f64;
    for _ in 0..NEWTON_ROUNDS {
        let off = root - share * root.powf(1.5) - 1.0;
        root -= off / (1.0 - 1.5 * share * root.sqrt());
    }
    root.powf(1.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the equation.
    #[test]
    fn a_sphere_on_what_is_softer_has_the_root() {
        for part in [-0.01, -0.5, -5.0, -50.0] {
            let ratio = force_ratio_of_sphere(part, 1.0);
            let expected = (1.0 + part / 1.5 * ratio).powf(1.5);
            assert!(
                (ratio / expected - 1.0).abs() < 1e-2,
                "{part}: {ratio} {expected}"
            );
        }
    }
}
