//! A flat round punch on the side of a tube, at mid-length and along a radius, after the pressure.
//!
//! *Limits*: the punch has a face but no side. Deeper than its radius, tissue around it may be where
//! its side would be; the answer then carries a warning. The tube is fixed at its ends only.

use super::super::estimate::{Estimated, Meshes, Progress, Quantity, refine};
use super::punching::Punching;
use super::{Ends, TubeProblem, check_pressure, inflate, solid};
use crate::contact::Friction;
use crate::{Error, Strain};

/// A punch on the tube.
#[derive(Debug, Clone, PartialEq)]
pub struct TubePunch {
    /// Radius of its flat face [m].
    pub radius: f64,
    /// Whether tissue sticks to the face or slides on it.
    pub face: Friction,
    /// Pressure in the tube [Pa]; it stays while the punch goes in.
    pub pressure: f64,
    /// Depths [m] below the outermost point of the tube under pressure, in any order.
    pub depths: Vec<f64>,
}

/// An indented tube.
#[derive(Debug, Clone, PartialEq)]
pub struct Indented {
    /// Force on the tissue at each depth [N].
    pub forces: Vec<f64>,
    /// Outward displacement of the outer surface by the pressure alone, where the punch meets it
    /// [m].
    pub outer_displacement: f64,
    /// Number of unknowns of the finest mesh.
    pub unknowns: usize,
    /// Warnings, in sentences.
    pub warnings: Vec<String>,
}

/// Parts of the coarse elements' edges on the meshes that are tried, in turn.
const PARTS: [usize; 3] = [1, 2, 3];

/// The pressure at the punch's edge is infinite as the root of the distance.
const MESHES: Meshes<'static> = Meshes {
    sizes: &[1.0, 1.0 / 2.0, 1.0 / 3.0],
    order: 1.0,
};

/// Depth [-], in radii, at which an axisymmetric block folds under a face without friction.
const FOLDS: f64 = 1.3;

/// Forces of `punch` on the tube, with an error of at most `accuracy` [-] if three meshes give it; the
/// first two take seconds, the third minutes.
///
/// # Errors
/// When the tube, the punch or a depth is impossible, the tube balloons, or no equilibrium is found.
pub fn indent(
    problem: &TubeProblem,
    punch: &TubePunch,
    accuracy: f64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Estimated<Indented>, Error> {
    check(problem, punch)?;
    let mut order: Vec<usize> = (0..punch.depths.len()).collect();
    order.sort_by(|&a, &b| punch.depths[a].total_cmp(&punch.depths[b]));
    let deepest = order.last().map_or(0.0, |&last| punch.depths[last]);
    refine(&MESHES, accuracy, |mesh| {
        let mut report = |part: f64| progress(Progress { part, mesh });
        let mut run = Punching::new(problem, punch, PARTS[mesh])?;
        run.pressurise()?;
        let mut forces = vec![0.0; punch.depths.len()];
        for &place in &order {
            let depth = punch.depths[place];
            forces[place] = run.press_to(depth, |at| report(at / deepest))?;
        }
        let answer = Indented {
            outer_displacement: run.rise(problem.tube.outer_radius),
            unknowns: run.unknowns(),
            warnings: warnings(punch, deepest, &run),
            forces: forces.clone(),
        };
        Ok(Some((answer, vec![Quantity::new("force", forces)])))
    })
}

fn warnings(punch: &TubePunch, deepest: f64, run: &Punching<'_>) -> Vec<String> {
    let mut warnings = Vec::new();
    if deepest > punch.radius {
        warnings.push(format!(
            "only the face of the punch is modelled, and at {deepest} m, deeper than its radius of {} m, its side may touch as well",
            punch.radius
        ));
    }
    if deepest > FOLDS * punch.radius && punch.face == Friction::Frictionless {
        warnings.push(format!(
            "a face without friction folds the tissue under it near {FOLDS} of its radius, and {deepest} m is more"
        ));
    }
    if run.is_shut() {
        warnings.push(format!(
            "at {deepest} m the walls of the tube meet under the punch, and their contact is left out"
        ));
    }
    warnings
}

fn check(problem: &TubeProblem, punch: &TubePunch) -> Result<(), Error> {
    let tube = &problem.tube;
    tube.check()?;
    check_pressure(punch.pressure)?;
    let largest = solid::largest_punch(tube);
    if !(punch.radius > 0.0 && punch.radius <= largest) {
        return Err(Error::PunchOutOfRange {
            radius: punch.radius,
            largest,
        });
    }
    if problem.ends == Ends::Guided {
        return Err(Error::GuidedEnds);
    }
    // To the far side of the outer wall there is nothing left to press on.
    let bad = |depth: &&f64| !(**depth >= 0.0 && **depth < 2.0 * tube.inner_radius);
    if let Some(&depth) = punch.depths.iter().find(bad) {
        return Err(Error::TubeDepthOutOfRange {
            depth,
            bore: 2.0 * tube.inner_radius,
        });
    }
    if punch.pressure > 0.0 && problem.law.volume().strain == Strain::Finite {
        let inflated = inflate::on_mesh(problem, &[], 2, &mut |_| {})?;
        if let Some(limit) = inflated.limit_pressure.filter(|&p| p < punch.pressure) {
            return Err(Error::LimitPointExceeded {
                pressure: punch.pressure,
                limit,
            });
        }
    }
    Ok(())
}
