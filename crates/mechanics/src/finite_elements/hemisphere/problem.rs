use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use super::super::estimate::{Estimated, Meshes, Progress, Quantity, refine};
use super::super::mismatch::Mismatch;
use super::super::model::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
};
use super::super::newton::equilibrate;
use super::super::supports::Supports;
use super::quarter_disc::{Lines, QuarterDisc};
use crate::{Error, LinearElastic};

/// How a rigid patch holds the surface that it moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Patch {
    /// Along its own direction only.
    Slip,
    /// In all directions.
    Bonded,
}

/// A hemisphere and the patch that is pushed into its pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HemisphereProblem {
    /// Radius [m].
    pub radius: f64,
    /// Largest arc from the pole that belongs to the patch [m].
    pub patch_radius: f64,
    /// The motion that the patch prescribes.
    pub patch: Patch,
    /// The law.
    pub law: LinearElastic,
    /// Displacement of the patch toward the base [m].
    pub depth: f64,
}

/// The force on the patch and the displacement of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct HemisphereAnswer {
    /// Force on the tissue along −z [N].
    pub force: f64,
    /// Force of the base on the tissue along z [N].
    pub base_force: f64,
    /// Arc from the pole [m] and displacement along the normal at rest, outward positive [m], from the
    /// pole to the equator.
    pub profile: Vec<(f64, f64)>,
    /// Root mean square of the profile over the arc [m].
    pub mean_displacement: f64,
    /// Nodes of the finest mesh.
    pub nodes: usize,
    /// Unknowns of the finest mesh.
    pub unknowns: usize,
}

/// Smallest elements of the second mesh, at the edge of the patch [-], in radii of it.
const EDGE: f64 = 0.1;
/// Stress is infinite at the edge, as the root of the distance, and force and profile are off by the size
/// of the elements there.
const MESHES: Meshes<'static> = Meshes {
    sizes: &[64.0, 32.0, 16.0, 8.0, 4.0, 2.0, 1.0],
    order: 1.0,
};
/// Fewest points of a profile.
const POINTS: usize = 200;

/// Solves on ever finer meshes until the force, and the profile in the root mean square over the arc, are
/// good to `accuracy` [-].
///
/// # Errors
/// When radius or patch are no lengths, the patch reaches the base, or memory does not suffice.
pub fn solve(
    problem: &HemisphereProblem,
    accuracy: f64,
    mut progress: impl FnMut(Progress),
) -> Result<Estimated<HemisphereAnswer>, Error> {
    problem.check()?;
    refine(&MESHES, accuracy, |mesh| {
        progress(Progress { part: 0.0, mesh });
        let answer = problem.solve_on(EDGE, mesh as i32 - 1)?;
        progress(Progress { part: 1.0, mesh });
        let quantities = vec![
            Quantity::new("force", vec![answer.force]),
            Quantity::new("profile", vec![answer.mean_displacement]),
        ];
        Ok(Some((answer, quantities)))
    })
}

/// Elements at the edge of a patch are no longer than it is wide.
pub(super) fn check_edge(edge: f64) -> Result<(), Mismatch> {
    if edge > 0.0 && edge <= 1.0 {
        Ok(())
    } else {
        Err(Mismatch::ElementSizeOutOfRange { edge })
    }
}

/// The equilibrium of a linear body from rest.
pub(super) fn solved(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
) -> Result<(FiniteElementState, FiniteElementWorkspace), Error> {
    let mut state = FiniteElementState::at_rest(model);
    let mut workspace = FiniteElementWorkspace::new(model)?;
    equilibrate(model, supports, &mut state, &mut workspace).map_err(|failure| {
        Error::NoEquilibrium {
            depth: 0.0,
            failure,
        }
    })?;
    Ok((state, workspace))
}

impl HemisphereProblem {
    /// Solves on one mesh whose elements at the edge of the patch are `edge` [-] of its radius, every
    /// element then halved `halvings` times, or doubled where that is −1.
    ///
    /// # Errors
    /// As for [`solve`], and when `edge` is no size of elements.
    pub fn solve_on(&self, edge: f64, halvings: i32) -> Result<HemisphereAnswer, Error> {
        self.check()?;
        check_edge(edge)?;
        let disc = QuarterDisc::new(
            self.radius,
            &Lines::at_pole(self.patch_radius / self.radius, edge, 1.25, halvings.min(0)),
            halvings.max(0).unsigned_abs(),
        );
        let model =
            FiniteElementModel::new(disc.mesh.clone(), Arc::new(self.law), Formulation::Mixed)?;
        let rim = self.patch_radius / self.radius * (1.0 + 1e-9);
        let touched = || disc.arc.iter().filter(|(_, angle)| *angle <= rim);
        let patch: Vec<usize> = touched().map(|&(node, _)| node).collect();
        let mut supports = Supports::none(&model)
            .fix(&model, patch.iter().copied(), 1, -self.depth)
            .fix(&model, disc.axis.iter().copied(), 0, 0.0)
            .fix(&model, disc.base.iter().copied(), 0, 0.0)
            .fix(&model, disc.base.iter().copied(), 1, 0.0);
        if self.patch == Patch::Bonded {
            supports = supports.fix(&model, patch.iter().copied(), 0, 0.0);
        }
        let (state, workspace) = solved(&model, &supports)?;
        let along = |nodes: &[usize]| -> f64 {
            nodes.iter().map(|&n| workspace.reaction(&model, n).y).sum()
        };
        Ok(HemisphereAnswer {
            force: -along(&patch),
            base_force: along(&disc.base),
            profile: self.profile(&disc, &model, &state),
            mean_displacement: mean_displacement(&disc, &model, &state),
            nodes: model.mesh().nodes.len(),
            unknowns: model.size(),
        })
    }

    fn check(&self) -> Result<(), Error> {
        for (name, found) in [
            ("the radius of the hemisphere", self.radius),
            ("the radius of the patch", self.patch_radius),
        ] {
            if !(found > 0.0 && found.is_finite()) {
                return Err(Error::NotALength { name, found });
            }
        }
        if !self.depth.is_finite() {
            return Err(Error::DepthIsNoNumber { depth: self.depth });
        }
        // The edge, as a node, must leave the base some room.
        let quarter = FRAC_PI_2 * self.radius;
        if self.patch_radius > 0.99 * quarter {
            return Err(Error::PatchReachesBase {
                patch_radius: self.patch_radius,
                quarter,
            });
        }
        Ok(())
    }

    /// Displacement along the normal, with as many points between the nodes as it takes.
    fn profile(
        &self,
        disc: &QuarterDisc,
        model: &FiniteElementModel,
        state: &FiniteElementState,
    ) -> Vec<(f64, f64)> {
        let sides = (disc.arc.len() - 1) / 2;
        let parts = POINTS.div_ceil(sides).max(2);
        let mut profile = Vec::with_capacity(sides * parts + 1);
        let mut put = |angle: f64, displacement: crate::Vec3| {
            let (sine, cosine) = angle.sin_cos();
            let normal = displacement.x * sine + displacement.y * cosine;
            profile.push((angle * self.radius, normal));
        };
        for side in 0..sides {
            let ends = &disc.arc[2 * side..2 * side + 3];
            let [first, middle, last] = [0, 1, 2].map(|i| state.displacement(model, ends[i].0));
            for part in 0..parts {
                let x = 2.0 * part as f64 / parts as f64 - 1.0;
                let angle = ends[0].1 + 0.5 * (x + 1.0) * (ends[2].1 - ends[0].1);
                put(
                    angle,
                    0.5 * x * (x - 1.0) * first
                        + (1.0 - x * x) * middle
                        + 0.5 * x * (x + 1.0) * last,
                );
            }
        }
        if let Some(&(node, angle)) = disc.arc.last() {
            put(angle, state.displacement(model, node));
        }
        profile
    }
}

/// Root mean square of the displacement along the normal over the arc [m], by Simpson's rule on each side.
fn mean_displacement(
    disc: &QuarterDisc,
    model: &FiniteElementModel,
    state: &FiniteElementState,
) -> f64 {
    let squared = |&(node, angle): &(usize, f64)| {
        let (sine, cosine) = angle.sin_cos();
        let displacement = state.displacement(model, node);
        (displacement.x * sine + displacement.y * cosine).powi(2)
    };
    let sides = disc.arc.windows(3).step_by(2);
    let sum: f64 = sides
        .map(|ends| {
            let [first, middle, last] = [0, 1, 2].map(|i| squared(&ends[i]));
            (ends[2].1 - ends[0].1) / 6.0 * (first + 4.0 * middle + last)
        })
        .sum();
    (sum / FRAC_PI_2).sqrt()
}
