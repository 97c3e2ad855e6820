//! Stiff balls under the surface, as a finger finds them.
//!
//! A ball of volume V and modulus g E in incompressible tissue of modulus E, in a stress that is uniform around
//! it, makes the body stiffer by the energy −V A s²/(2E), A = (g − 1)/(1 + ⅖ (g − 1)), where s is a tension
//! along one axis [Eshelby 1957]. A force on the surface of an incompressible half-space makes such a stress,
//! s = 3 F cos θ/(2 π R²), everywhere [Johnson 1985, section 3.2]. So a tip of radius a yields less by
//!
//! ```text
//! x = ΔC/C = 8 a ρ³ A cos² θ/(π R⁴),   R² = r² + a²
//! ```
//!
//! with ρ the ball's radius and r the way to its middle. Where x is large the tip cannot be stiffer than the
//! ball: x is replaced by x q/(x + q), q = 1 − 1/g.
//!
//! *How we know*: `nodule::…`.
//!
//! *Limits*: a first-order answer, best for balls that are deeper than they are large; the same at every depth of
//! the tip, which does not feel itself pushed off to the side; the organ's shape is that without it.

use std::f64::consts::PI;

use palpate_files::scene::Nodule;
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::Error;

/// Refuses balls whose middle is not in the organ.
pub(crate) fn check(nodules: &[Nodule], surface: &Surface, tree: &AabbTree) -> Result<(), Error> {
    for (number, nodule) in nodules.iter().enumerate() {
        let (_, outside) = surface.signed_distance(tree, &Vec3::from(nodule.center_m));
        if outside > 0.0 {
            return Err(Error::NoduleOutside { number, outside });
        }
    }
    Ok(())
}

/// How many times stiffer a tip of radius `a` [m] finds the place with that point [m] and outward normal.
pub(crate) fn stiffening(nodules: &[Nodule], a: f64, (point, normal): (&Vec3, &Vec3)) -> f64 {
    let each = nodules.iter().map(|nodule| {
        let more = nodule.stiffness_ratio - 1.0;
        let share = more / (1.0 + 0.4 * more);
        let way = point - Vec3::from(nodule.center_m);
        let distance = way.norm();
        let cosine = if distance > 0.0 {
            way.dot(normal) / distance
        } else {
            1.0
        };
        let square = distance * distance + a * a;
        let x =
            8.0 * a * nodule.radius_m.powi(3) * share * cosine * cosine / (PI * square * square);
        let most = 1.0 - 1.0 / nodule.stiffness_ratio;
        1.0 / (1.0 - x * most / (x + most))
    });
    each.product()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(depth: f64, ratio: f64, aside: f64) -> f64 {
        let nodule = Nodule {
            center_m: [0.0, 0.0, -depth],
            radius_m: 0.005,
            stiffness_ratio: ratio,
        };
        let place = Vec3::new(aside, 0.0, 0.0);
        stiffening(&[nodule], 0.003, (&place, &Vec3::z()))
    }

    /// Judge: the energy of the closed stress field, integrated over the ball by a grid. Tolerance: over a ball
    /// that is a quarter of its depth the stress is uniform to some parts in ten.
    #[test]
    fn a_deep_ball_is_felt_by_its_energy() {
        let (rho, depth, a, ratio) = (0.005, 0.020, 0.001, 3.0);
        let nodule = Nodule {
            center_m: [0.0, 0.0, -depth],
            radius_m: rho,
            stiffness_ratio: ratio,
        };
        let cells = 40;
        let edge = 2.0 * rho / f64::from(cells);
        let at = |cell: i32| -rho + (f64::from(cell) + 0.5) * edge;
        let mut energy = 0.0;
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            for k in 0..cells {
                let place = Vec3::new(at(i), at(j), at(k));
                if place.norm() < rho {
                    let r = place + Vec3::new(0.0, 0.0, -depth);
                    let s = 3.0 * r.z.abs() / (2.0 * PI * r.norm().powi(3));
                    energy += s * s * edge.powi(3);
                }
            }
        }
        let softer = (ratio - 1.0) / (1.0 + 0.4 * (ratio - 1.0)) * energy;
        // 3/(8 a E) is the compliance of a flat punch.
        let expected = 1.0 / (1.0 - softer / (3.0 / (8.0 * a)));
        let found = stiffening(&[nodule], a, (&Vec3::zeros(), &Vec3::z()));
        let off = (found - 1.0) / (expected - 1.0) - 1.0;
        assert!(off.abs() < 0.2, "{found} {expected}");
    }

    #[test]
    fn what_is_felt_lies_between_the_tissue_and_the_ball() {
        assert!((found(0.2, 6.0, 0.0) - 1.0).abs() < 1e-3);
        assert!((found(0.008, 1.0 + 1e-9, 0.0) - 1.0).abs() < 1e-8);
        let over = found(0.008, 6.0, 0.0);
        assert!(over > 1.2 && found(0.0, 6.0, 0.0) < 6.0, "{over}");
        assert!(found(0.008, 6.0, 0.02) < 1.0 + 0.1 * (over - 1.0));
        assert!(found(0.0, 1e6, 0.0).is_finite());
    }
}
