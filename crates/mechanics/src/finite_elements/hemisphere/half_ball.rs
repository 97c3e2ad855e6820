use std::sync::Arc;

use super::super::graded::Grading;
use super::super::mismatch::Mismatch;
use super::super::model::{FiniteElementModel, Formulation};
use super::super::supports::Supports;
use super::problem::{Patch, check_edge, solved};
use super::quarter_disc::{Lines, QuarterDisc, SQUARE};
use crate::{Error, LinearElastic};

/// Half a ball under a flat punch in the middle of its flat side, fixed on its round one: a
/// half-space that is rigid beyond some distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfBall {
    /// Radius in radii of the punch [-], at least 3.
    pub radius: f64,
    /// The motion that the punch prescribes.
    pub patch: Patch,
    /// The law.
    pub law: LinearElastic,
}

impl HalfBall {
    /// Force per depth and radius of the punch [Pa] on a mesh whose elements at its edge are `edge` [-]
    /// of its radius, every element then halved `halvings` times.
    ///
    /// # Errors
    /// When the ball is too small, `edge` is no size of elements, or memory does not suffice.
    pub fn stiffness(&self, edge: f64, halvings: u32) -> Result<f64, Error> {
        check_edge(edge)?;
        if !(self.radius >= 3.0 && self.radius.is_finite()) {
            return Err(Mismatch::HalfBallTooSmall {
                radius: self.radius,
            }
            .into());
        }
        let disc = QuarterDisc::new(self.radius, &self.lines(edge), halvings);
        let model =
            FiniteElementModel::new(disc.mesh.clone(), Arc::new(self.law), Formulation::Mixed)?;
        let touched = |node: &&usize| disc.mesh.nodes[**node].x <= 1.0 + 1e-9;
        let patch: Vec<usize> = disc.base.iter().filter(touched).copied().collect();
        let round = || disc.arc.iter().map(|&(node, _)| node);
        let mut supports = Supports::none(&model)
            .fix(&model, patch.iter().copied(), 1, 1.0)
            .fix(&model, disc.axis.iter().copied(), 0, 0.0)
            .fix(&model, round(), 0, 0.0)
            .fix(&model, round(), 1, 0.0);
        if self.patch == Patch::Bonded {
            supports = supports.fix(&model, patch.iter().copied(), 0, 0.0);
        }
        let (_, workspace) = solved(&model, &supports)?;
        Ok(patch.iter().map(|&n| workspace.reaction(&model, n).y).sum())
    }

    /// Lines that are fine around the edge of the punch.
    fn lines(&self, edge: f64) -> Lines {
        let grading = Grading {
            first: edge,
            growth: 1.25,
            near: 3.0,
            far_growth: 1.7,
        };
        let side = SQUARE * self.radius;
        let mut across: Vec<f64> = grading.line(1.0, 0).iter().rev().map(|x| 1.0 - x).collect();
        across[0] = 0.0;
        across.extend(grading.line(side - 1.0, 0)[1..].iter().map(|x| 1.0 + x));
        Lines {
            across: across.iter().map(|x| x / side).collect(),
            up: grading.line(side, 0).iter().map(|x| x / side).collect(),
            out: [0.0, 0.2, 0.4, 0.6, 0.8, 1.0].to_vec(),
            seam: std::f64::consts::FRAC_PI_4,
        }
    }
}
