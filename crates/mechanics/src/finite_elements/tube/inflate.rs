//! Inflation. The inner corner of a fixed end creases under large strain: with elements of a fiftieth of
//! the wall that crease is resolved, without the contact of its two sides, and ends the path too early (2.7
//! % below the limit of 60 mm of the source's tube). Meshes stop before that, with a warning.

use super::super::cavity::Cavity;
use super::super::estimate::{Estimated, Meshes, Progress, Quantity, refine};
use super::super::model::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
};
use super::super::newton::equilibrate;
use super::super::path::{Path, PathPoint};
use super::super::supports::Supports;
use super::{Ends, TubeProblem, check_pressure, mesh};
use crate::{Error, FibreFrame, Strain, Vec3};

/// An inflated tube.
#[derive(Debug, Clone, PartialEq)]
pub struct Inflated {
    /// Outward displacement of the inner wall at mid-length [m], one for each pressure; `None` where
    /// the pressure is past the limit.
    pub inner_displacements: Vec<Option<f64>>,
    /// The greatest pressure of a stable tube [Pa]; `None` when there is none up to a stretch of
    /// [`WIDEST`], or ten times the pressure at which an endless neo-Hookean tube would burst.
    pub limit_pressure: Option<f64>,
    /// Displacement of the inner wall at the limit [m].
    pub limit_displacement: Option<f64>,
    /// From this pressure on [Pa] the tube could wrinkle without a change of pressure, at a length of
    /// waves that the mesh decides; the answers are those of a smooth one.
    pub wrinkles_from: Option<f64>,
    /// Number of unknowns of the finest mesh.
    pub unknowns: usize,
    /// Warnings, in sentences.
    pub warnings: Vec<String>,
}

/// Hoop stretch of the inner wall up to which a limit is looked for [-].
pub const WIDEST: f64 = 4.0;

/// Elements of the meshes that are tried [-], in the place of one of the usual mesh, along each edge.
const PARTS: [f64; 4] = [0.75, 1.0, 2.0, 4.0];
/// A pressure beyond so many limits of the coarsest mesh is past the limit on every mesh [-].
const PAST: f64 = 1.1;
const MAX_STEPS: usize = 500;

/// What no mesh here shows.
const CREASE: &str = "the inner corner of the fixed ends creases near the limit pressure, and the contact of \
                      the crease's sides is left out: a mesh so fine that it resolves the crease (elements \
                      of a fiftieth of the wall) ended 2.7 % below this limit on a tube of 60 mm, and the \
                      estimated error does not know that";

/// Power of the element size with which errors fall [-]: all is smooth between guided ends. The corners at
/// fixed ones leave less, the more so near the limit, where every small change of them counts.
fn order(problem: &TubeProblem) -> f64 {
    match (problem.ends, problem.law.volume().strain) {
        (Ends::Guided, _) => 4.0,
        (Ends::Fixed, Strain::Small) => 2.0,
        (Ends::Fixed, Strain::Finite) => 1.0,
    }
}

/// The tube under each of `pressures` [Pa], with an error of at most `accuracy` [-] if four meshes
/// give it, and the limit of the pressure.
///
/// # Errors
/// When the tube has no wall, a pressure is negative, or the path cancels.
pub fn inflate(
    problem: &TubeProblem,
    pressures: &[f64],
    accuracy: f64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Estimated<Inflated>, Error> {
    problem.tube.check()?;
    pressures.iter().try_for_each(|&p| check_pressure(p))?;
    let meshes = Meshes {
        sizes: &PARTS.map(f64::recip),
        order: order(problem),
    };
    let mut highest = None;
    refine(&meshes, accuracy, |mesh| {
        let answer = on_mesh(problem, pressures, mesh, progress)?;
        let limit = answer.limit_pressure.unwrap_or(f64::INFINITY);
        let highest = *highest.get_or_insert(PAST * limit);
        let past = answer.limit_displacement.unwrap_or(0.0);
        let each = pressures.iter().zip(&answer.inner_displacements);
        let displacements = each
            .filter(|(pressure, _)| **pressure <= highest)
            .map(|(_, u)| u.unwrap_or(past));
        let quantities = vec![
            Quantity::new("displacement", displacements.collect()),
            Quantity::new(
                "limit pressure",
                answer.limit_pressure.into_iter().collect(),
            ),
        ];
        Ok(Some((answer, quantities)))
    })
}

/// On the mesh of this number, the coarsest being 0.
pub(super) fn on_mesh(
    problem: &TubeProblem,
    pressures: &[f64],
    mesh: usize,
    progress: &mut dyn FnMut(Progress),
) -> Result<Inflated, Error> {
    let (elements, cavity) = mesh::half(&problem.tube, PARTS[mesh]);
    // The third direction is the hoop. The two families mirror one another, so that the tube does not twist.
    let frame = FibreFrame::new(&Vec3::z(), &Vec3::y()).expect("they are at right angles");
    let model = FiniteElementModel::new(elements, problem.law.clone(), Formulation::Mixed)?
        .in_frames(|_| frame);
    let inner = problem.tube.inner_radius;
    let middle = model
        .mesh()
        .nodes_where(|x| x.x <= inner * (1.0 + 1e-12) && x.y == 0.0)[0];
    let mut inflation = Inflation {
        problem,
        model: &model,
        cavity: &cavity,
        middle,
        mesh,
    };
    if model.law.volume().strain == Strain::Small {
        inflation.small(pressures)
    } else {
        inflation.along_the_path(pressures, progress)
    }
}

struct Inflation<'a> {
    problem: &'a TubeProblem,
    model: &'a FiniteElementModel,
    cavity: &'a Cavity,
    /// The node of the inner wall at mid-length.
    middle: usize,
    mesh: usize,
}

impl Inflation<'_> {
    fn supports(&self, pressure: f64) -> Supports<'_> {
        let half = 0.5 * self.problem.tube.length;
        let nodes = |z: f64| self.model.mesh().nodes_where(|x| x.y == z);
        let mut supports = Supports::none(self.model)
            .fix(self.model, nodes(0.0), 1, 0.0)
            .fix(self.model, nodes(half), 1, 0.0)
            .press(self.cavity, pressure);
        if self.problem.ends == Ends::Fixed {
            supports = supports.fix(self.model, nodes(half), 0, 0.0);
        }
        supports
    }

    fn displacement(&self, state: &FiniteElementState) -> f64 {
        state.displacement(self.model, self.middle).x
    }

    fn small(&self, pressures: &[f64]) -> Result<Inflated, Error> {
        let mut workspace = FiniteElementWorkspace::new(self.model)?;
        let mut state = FiniteElementState::at_rest(self.model);
        equilibrate(self.model, &self.supports(1.0), &mut state, &mut workspace).map_err(
            |failure| Error::NoPath {
                factor: 0.0,
                failure,
            },
        )?;
        let per_pascal = self.displacement(&state);
        Ok(Inflated {
            inner_displacements: pressures.iter().map(|p| Some(p * per_pascal)).collect(),
            limit_pressure: None,
            limit_displacement: None,
            wrinkles_from: None,
            unknowns: self.model.size(),
            warnings: Vec::new(),
        })
    }

    fn along_the_path(
        &mut self,
        pressures: &[f64],
        progress: &mut dyn FnMut(Progress),
    ) -> Result<Inflated, Error> {
        let tube = self.problem.tube;
        // Where an endless neo-Hookean tube bursts.
        let full = self.model.shear_modulus * (tube.outer_radius / tube.inner_radius).ln();
        let mut path = Path::new(self.model, self.supports(full), 0.05)?;
        let mut answer = Inflated {
            inner_displacements: vec![None; pressures.len()],
            limit_pressure: None,
            limit_displacement: None,
            wrinkles_from: None,
            unknowns: self.model.size(),
            warnings: Vec::new(),
        };
        for (u, _) in self.waiting(&mut answer, pressures, |p| p == 0.0) {
            *u = Some(0.0);
        }
        let highest = pressures.iter().fold(0.0, |a: f64, &b| a.max(b)) / full;
        for _ in 0..MAX_STEPS {
            path.advance()?;
            let limit = path.limit()?;
            let low = path.before().cloned().unwrap_or_else(|| path.now().clone());
            let high = limit.clone().unwrap_or_else(|| path.now().clone());
            let reached = |p: f64| p <= high.factor * full;
            for (u, pressure) in self.waiting(&mut answer, pressures, reached) {
                let point = path.between(&low, &high, pressure / full)?;
                *u = Some(self.displacement(&point.state));
            }
            if let Some(limit) = limit {
                answer.limit_pressure = Some(limit.factor * full);
                answer.limit_displacement = Some(self.displacement(&limit.state));
                if self.problem.ends == Ends::Fixed {
                    answer.warnings.push(CREASE.to_owned());
                }
                return Ok(answer);
            }
            if high.unstable > 0 {
                answer.wrinkles_from.get_or_insert(low.factor * full);
            }
            let part = self.part(&high, highest);
            progress(Progress {
                part,
                mesh: self.mesh,
            });
            if part >= 1.0 {
                return Ok(answer);
            }
        }
        Err(Error::NoPath {
            factor: path.now().factor * full / highest.max(full),
            failure: super::super::Failure::NotConverged,
        })
    }

    /// Part of the path that is done [-]: all requested pressures, and far enough to show that there
    /// is no limit.
    fn part(&self, point: &PathPoint, highest: f64) -> f64 {
        let inner = self.problem.tube.inner_radius;
        let widened = self.displacement(&point.state) / (inner * (WIDEST - 1.0));
        let pressed = point.factor / 10.0;
        let of_requested = if highest > 0.0 {
            point.factor / highest
        } else {
            1.0
        };
        widened.max(pressed).min(of_requested)
    }

    /// Displacements that are not known yet, with their pressures, where `reached`.
    fn waiting<'b>(
        &self,
        answer: &'b mut Inflated,
        pressures: &'b [f64],
        reached: impl Fn(f64) -> bool + 'b,
    ) -> impl Iterator<Item = (&'b mut Option<f64>, f64)> {
        answer
            .inner_displacements
            .iter_mut()
            .zip(pressures.iter().copied())
            .filter(move |(u, p)| u.is_none() && reached(*p))
    }
}
