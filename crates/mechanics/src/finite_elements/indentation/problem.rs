use crate::contact::FrictionLaw;
use std::sync::Arc;

use super::super::estimate::{Estimated, Meshes, Progress, Quantity, refine};
use super::indenter::{Indenter, IndenterShape, Side};
use super::mesh::Block;
use super::run::{IndentationPoint, IndentationRun, IndentationSettings};
use crate::material::law::Law;
use crate::{Error, IndentationCurve, PronySeries};

/// Tissue and indenter.
#[derive(Debug, Clone)]
pub struct IndentationProblem {
    /// The tissue.
    pub block: Block,
    /// The indenter.
    pub indenter: Indenter,
    /// Its instantaneous law.
    pub law: Arc<dyn Law>,
}

/// Depth over time, linear between the given times; the indenter just touches before the first.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Times [s], ascending from 0 or later.
    pub times: Vec<f64>,
    /// Depths [m], one for each time.
    pub depths: Vec<f64>,
}

/// How relaxation is taken into account.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RelaxationMethod {
    /// The elastic curve, convolved with the relaxation function; fast, and the same to small strain.
    Convolution,
    /// Internal variables at every point of integration.
    Full,
}

/// Forces of an indentation.
#[derive(Debug, Clone, PartialEq)]
pub struct IndentationAnswer {
    /// At the requested depths or times, in their order.
    pub points: Vec<IndentationPoint>,
    /// The elastic curve through all depths that were solved.
    pub curve: IndentationCurve,
    /// Number of unknowns.
    pub unknowns: usize,
}

/// The meshes of a sphere, a cone or a rounded punch: elements of a tenth of the contact's radius at its edge, doubled first, then halved. The
/// stress of a cone's apex is infinite, and a contact's end lies between nodes, which leaves the first power of the
/// size of these elements.
const ROUND: Meshes<'static> = Meshes {
    sizes: &[2.0, 1.0, 0.5, 0.25],
    order: 1.0,
};

/// The meshes of a flat punch: elements along half the width of the rings around its edge, and the sizes of all
/// elements. Stress at the edge is infinite as the root of the distance, which leaves the first power of the size of
/// the smallest elements, and that is the second of the others'.
const FLAT_PARTS: [usize; 5] = [1, 2, 3, 5, 8];
const FLAT: Meshes<'static> = Meshes {
    sizes: &[1.0, 0.5, 1.0 / 3.0, 0.2, 0.125],
    order: 2.0,
};

/// Deeper than this under a side that slides, in radii [-], tissue at the edge gives way element by element, and the last mesh
/// would take most of an hour: it is left out.
const DEEP: f64 = 5.0;
const DEEP_MESHES: usize = 4;

/// Elastic forces at `depths` [m], to the relative `accuracy` [-].
///
/// # Errors
/// When a depth is negative or deeper than the block, or see [`IndentationRun::press`].
pub fn solve(
    problem: &IndentationProblem,
    depths: &[f64],
    accuracy: f64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Estimated<IndentationAnswer>, Error> {
    problem.check_depths(depths)?;
    let mut found = refine(problem.meshes(), accuracy, |mesh| {
        if !problem.is_in_reach(depths, mesh) {
            return Ok(None);
        }
        let answer = problem.elastic(depths, mesh, progress)?;
        let forces = answer.forces();
        Ok(Some((answer, forces)))
    })?;
    found.warnings.extend(found.answer.fall(accuracy));
    Ok(found)
}

/// Forces over the times of `history` of a tissue that relaxes by `prony`, to the relative `accuracy`
/// [-].
///
/// # Errors
/// As [`solve`], and when times do not ascend.
pub fn solve_history(
    problem: &IndentationProblem,
    prony: &PronySeries,
    relaxing: RelaxationMethod,
    history: &History,
    accuracy: f64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Estimated<IndentationAnswer>, Error> {
    history.check()?;
    problem.check_depths(&history.depths)?;
    let mut found = refine(problem.meshes(), accuracy, |mesh| {
        if !problem.is_in_reach(&history.depths, mesh) {
            return Ok(None);
        }
        let answer = match relaxing {
            RelaxationMethod::Convolution => problem.convolved(prony, history, mesh, progress)?,
            RelaxationMethod::Full => problem.relaxed(prony, history, mesh, progress)?,
        };
        let forces = answer.forces();
        Ok(Some((answer, forces)))
    })?;
    found.warnings.extend(found.answer.fall(accuracy));
    Ok(found)
}

impl IndentationAnswer {
    /// A warning where a greater depth has a smaller elastic force, by more than the relative `accuracy` [-]: it falls
    /// by less where tissue at an edge yields element by element.
    fn fall(&self, accuracy: f64) -> Option<String> {
        let known: Vec<_> = self.curve.points().collect();
        let fall = known
            .windows(2)
            .find(|two| two[1].1 < (1.0 - accuracy) * two[0].1)?;
        let [above, below] = [fall[0].0, fall[1].0].map(|depth| 1e3 * depth);
        Some(format!(
            "the elastic force falls between depths of {above:.4} and {below:.4} mm: there the tissue leaves its equilibrium \
             for another, as where it closes over a sphere without friction; a shaft prevents that, so do not use the \
             forces beyond"
        ))
    }

    fn forces(&self) -> Vec<Quantity> {
        let forces = self.points.iter().map(|point| point.force);
        vec![Quantity::new("force", forces.collect())]
    }
}

impl History {
    fn check(&self) -> Result<(), Error> {
        let ascend = self.times.windows(2).all(|w| w[1] >= w[0]);
        let start = self.times.first().is_none_or(|&t| t >= 0.0);
        if ascend && start && self.times.len() == self.depths.len() {
            Ok(())
        } else {
            Err(Error::TimesDoNotAscend)
        }
    }
}

impl IndentationProblem {
    fn check_depths(&self, depths: &[f64]) -> Result<(), Error> {
        let possible = |&d: &f64| d >= 0.0 && d < self.block.height;
        match depths.iter().find(|d| !possible(d)) {
            Some(&depth) => Err(Error::ImpossibleDepth {
                depth,
                height: self.block.height,
            }),
            None => Ok(()),
        }
    }

    fn meshes(&self) -> &'static Meshes<'static> {
        match self.indenter.shape {
            IndenterShape::Flat { .. } => &FLAT,
            IndenterShape::RoundedPunch { .. }
            | IndenterShape::Sphere
            | IndenterShape::Cone { .. } => &ROUND,
        }
    }

    /// Whether the mesh of this number is solved within minutes to `depths` [m].
    fn is_in_reach(&self, depths: &[f64], mesh: usize) -> bool {
        let deepest = depths.iter().copied().fold(0.0, f64::max);
        let slides = matches!(
            self.indenter.shape,
            IndenterShape::Flat {
                side: Side::Touches(FrictionLaw::Frictionless)
            }
        );
        let most = if slides && deepest > DEEP * self.indenter.radius {
            DEEP_MESHES
        } else {
            FLAT_PARTS.len()
        };
        mesh < most
    }

    /// The run to the depth `deepest` [m] on the mesh of this number, from the coarsest, which is 0, of a tissue that relaxes
    /// by `prony`.
    ///
    /// # Errors
    /// See [`IndentationRun::new`].
    pub fn run(
        &self,
        prony: &PronySeries,
        deepest: f64,
        mesh: usize,
    ) -> Result<IndentationRun, Error> {
        let settings = IndentationSettings {
            block: self.block,
            indenter: self.indenter,
            law: self.law.clone(),
            prony: prony.clone(),
            deepest,
            halvings: mesh as i32 - 1,
        };
        match self.indenter.shape {
            IndenterShape::Flat { .. } => {
                let last = FLAT_PARTS.len() - 1;
                IndentationRun::around_edge(&settings, FLAT_PARTS[mesh.min(last)])
            }
            IndenterShape::RoundedPunch { .. }
            | IndenterShape::Sphere
            | IndenterShape::Cone { .. } => IndentationRun::new(&settings),
        }
    }

    /// Forces at `depths` on one mesh.
    fn elastic(
        &self,
        depths: &[f64],
        mesh: usize,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<IndentationAnswer, Error> {
        let mut order: Vec<usize> = (0..depths.len()).collect();
        order.sort_by(|&a, &b| depths[a].total_cmp(&depths[b]));
        let deepest = order.last().map_or(0.0, |&last| depths[last]);
        let mut run = self.run(&PronySeries::default(), deepest, mesh)?;
        let mut curve = IndentationCurve::zero();
        let mut points = vec![run.point(); depths.len()];
        for &place in &order {
            let depth = depths[place];
            if depth > run.point().depth {
                run.press(depth, depth, |point| {
                    curve.extend(point.depth, point.force);
                    let part = point.depth / deepest;
                    progress(Progress { part, mesh });
                })?;
            }
            points[place] = run.point();
        }
        Ok(IndentationAnswer {
            points,
            curve,
            unknowns: run.model().size(),
        })
    }

    /// Forces over `history` by convolution of the elastic curve.
    fn convolved(
        &self,
        prony: &PronySeries,
        history: &History,
        mesh: usize,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<IndentationAnswer, Error> {
        let deepest = history.depths.iter().copied().fold(0.0, f64::max);
        let elastic = self.elastic(&curve_depths(deepest), mesh, progress)?;
        let forces = elastic
            .curve
            .relaxed(prony, &history.times, &history.depths);
        let each = history.times.iter().zip(&history.depths).zip(forces);
        let points = each.map(|((&time, &depth), force)| IndentationPoint {
            time,
            depth,
            force,
            energy: 0.0,
            sensitivities: Vec::new(),
            friction: None,
        });
        Ok(IndentationAnswer {
            points: points.collect(),
            ..elastic
        })
    }

    /// Forces over `history` by internal variables.
    fn relaxed(
        &self,
        prony: &PronySeries,
        history: &History,
        mesh: usize,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<IndentationAnswer, Error> {
        let last = history.times.last().copied().unwrap_or(0.0);
        let deepest = history.depths.iter().copied().fold(0.0, f64::max);
        let mut run = self.run(prony, deepest, mesh)?;
        let mut points = Vec::with_capacity(history.times.len());
        for (&time, &depth) in history.times.iter().zip(&history.depths) {
            points.push(run.press(time, depth, |point| {
                let part = if last > 0.0 { point.time / last } else { 1.0 };
                progress(Progress { part, mesh });
            })?);
        }
        let elastic = self.elastic(&curve_depths(deepest), mesh, &mut |_| {})?;
        Ok(IndentationAnswer { points, ..elastic })
    }
}

/// Depths [m] at which a curve is solved up to `deepest`.
fn curve_depths(deepest: f64) -> Vec<f64> {
    (1..=24).map(|i| deepest * f64::from(i) / 24.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the numbers.
    #[test]
    fn a_fall_of_the_force_is_told_where_it_is() {
        let warning = |forces: &[f64]| {
            let depths = [1e-3, 2e-3, 3e-3];
            IndentationAnswer {
                points: Vec::new(),
                curve: IndentationCurve::through(&depths, forces),
                unknowns: 0,
            }
            .fall(0.01)
        };
        assert_eq!(warning(&[1.0, 2.0, 1.99]), None);
        let fall = warning(&[1.0, 2.0, 0.5]).unwrap();
        assert!(
            fall.contains("between depths of 2.0000 and 3.0000 mm"),
            "{fall}"
        );
    }
}
