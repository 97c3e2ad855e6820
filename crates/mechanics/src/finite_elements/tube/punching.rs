//! The load path of a tube on one mesh: pressure first, then the punch, step by step.
//!
//! The face is a plane across the punch's axis that moves inward from the outermost point of the
//! pressurised tube. A node that began within the punch's radius is activated when the plane passes it; it
//! then has the plane's x, and where it sticks also the y and z at which it was activated. A sliding node
//! under tension is released. Force on the tissue: four times the reactions' sum.

use crate::contact::Friction;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::super::cavity::Cavity;
use super::super::continuation::{Increments, Reached, Steps, continue_to, extrapolated};
use super::super::model::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
};
use super::super::newton::{Failure, equilibrate};
use super::super::supports::Supports;
use super::TubeProblem;
use super::indent::TubePunch;
use super::solid::{Quarter, quarter};
use crate::{Error, FibreField, Strain, Vec3};

/// Longest step of the depth, in radii of the punch [-].
const LONGEST_STEP: f64 = 0.5;
/// Changes of contact in a step; in the last of them nothing is let go any more.
const ROUNDS: usize = 12;

pub(super) struct Punching<'a> {
    model: FiniteElementModel,
    workspace: FiniteElementWorkspace,
    cavity: Arc<Cavity>,
    punch: &'a TubePunch,
    /// Nodes under the punch, ascending.
    face: Vec<usize>,
    /// Prescribed by ends and planes of symmetry.
    rest: Vec<Option<f64>>,
    now: ConvergedIncrement,
    before: Option<ConvergedIncrement>,
    /// Outermost place of the pressurised tube [m].
    top: f64,
    /// Step lengths [m].
    steps: Steps,
}

/// An equilibrium at a depth.
#[derive(Debug, Clone)]
struct ConvergedIncrement {
    depth: f64,
    state: FiniteElementState,
    /// Place at which each node of the face was activated [m], (y, z).
    activated: Vec<Option<[f64; 2]>>,
}

impl ConvergedIncrement {
    fn reached(&self) -> Reached<'_> {
        Reached {
            place: self.depth,
            unknowns: &self.state.unknowns,
        }
    }
}

impl<'a> Punching<'a> {
    /// A tube at rest.
    pub(super) fn new(
        problem: &TubeProblem,
        punch: &'a TubePunch,
        parts: usize,
    ) -> Result<Self, Error> {
        let Quarter { body, cavity } = quarter(&problem.tube, punch.radius, parts)?;
        let face = body.face;
        let fibres = FibreField::around(Vec3::zeros(), Vec3::z()).expect("the axis has a length");
        let model = FiniteElementModel::new(body.mesh, problem.law.clone(), Formulation::Mixed)?
            .in_frames(|place| fibres.at(place));
        let half = 0.5 * problem.tube.length;
        let tiny = 1e-9 * problem.tube.outer_radius;
        let on = |axis: usize, at: f64| {
            model
                .mesh()
                .nodes_where(|x| (x[axis] - at).abs() <= tiny)
                .into_iter()
        };
        let mut supports =
            Supports::none(&model)
                .fix(&model, on(1, 0.0), 1, 0.0)
                .fix(&model, on(2, 0.0), 2, 0.0);
        for axis in 0..3 {
            supports = supports.fix(&model, on(2, half), axis, 0.0);
        }
        Ok(Self {
            workspace: FiniteElementWorkspace::new(&model)?,
            now: ConvergedIncrement {
                depth: 0.0,
                state: FiniteElementState::at_rest(&model),
                activated: vec![None; face.len()],
            },
            before: None,
            top: problem.tube.outer_radius,
            steps: Steps {
                next: 0.1 * punch.radius,
                longest: LONGEST_STEP * punch.radius,
                shortest: 0.02 * punch.radius,
                easy: 10,
                hard: usize::MAX,
            },
            rest: supports.prescribed,
            cavity: Arc::new(cavity),
            punch,
            face,
            model,
        })
    }

    pub(super) fn unknowns(&self) -> usize {
        self.model.size()
    }

    fn is_small(&self) -> bool {
        self.model.law.volume().strain == Strain::Small
    }

    /// Brings the pressure up.
    pub(super) fn pressurise(&mut self) -> Result<(), Error> {
        if self.punch.pressure > 0.0 {
            let first = if self.is_small() { 1.0 } else { 0.5 };
            let mut steps = Steps {
                next: first,
                longest: first,
                shortest: 1e-3,
                easy: 0,
                hard: usize::MAX,
            };
            let mut rising = Rising {
                tube: self,
                part: 0.0,
            };
            continue_to(&mut rising, &mut steps, 1.0, |_| ControlFlow::Continue(())).map_err(
                |failure| Error::NoPath {
                    factor: rising.part,
                    failure,
                },
            )?;
        }
        let place = |node: &usize| self.place(&self.now.state, *node).x;
        self.top = self.face.iter().map(place).fold(f64::MIN, f64::max);
        Ok(())
    }

    /// Displacement of the outermost point by the pressure [m].
    pub(super) fn rise(&self, outer_radius: f64) -> f64 {
        self.top - outer_radius
    }

    /// Force on the tissue [N] at `depth` [m], not less than the last one.
    pub(super) fn press_to(
        &mut self,
        depth: f64,
        mut at_step: impl FnMut(f64),
    ) -> Result<f64, Error> {
        let mut steps = self.steps;
        let pressed = continue_to(self, &mut steps, depth, |run| {
            at_step(run.now.depth);
            ControlFlow::Continue(())
        });
        self.steps = steps;
        pressed.map_err(|failure| Error::NoEquilibrium {
            depth: self.now.depth,
            failure,
        })?;
        if depth == 0.0 {
            return Ok(0.0);
        }
        // The last solution may be that of a step that failed.
        let cavity = self.cavity.clone();
        let supports = self.supports(&self.now.activated, self.now.depth);
        let supports = supports.press(&cavity, self.punch.pressure);
        let (state, workspace) = (&self.now.state.unknowns, &mut self.workspace);
        let assembled = super::super::newton::assemble(&self.model, &supports, state, workspace);
        debug_assert!(assembled.is_ok(), "an equilibrium was found here");
        let active = self.face.iter().zip(&self.now.activated);
        Ok(active
            .filter(|(_, activated)| activated.is_some())
            .map(|(&node, _)| -4.0 * self.workspace.reaction(&self.model, node).x)
            .sum())
    }

    /// Whether the inner wall under the punch has passed the wall on the far side.
    pub(super) fn is_shut(&self) -> bool {
        let tiny = 1e-9 * self.punch.radius;
        let nodes = self.model.mesh().nodes.iter().enumerate();
        let inner = nodes
            .filter(|(_, x)| x.y.abs() <= tiny && x.z == 0.0)
            .map(|(node, x)| (x.x, self.place(&self.now.state, node).x));
        let (mut near, mut far) = ((f64::MAX, 0.0), (f64::MIN, 0.0));
        for (rest, now) in inner {
            if rest > 0.0 && rest < near.0 {
                near = (rest, now);
            } else if rest < 0.0 && rest > far.0 {
                far = (rest, now);
            }
        }
        near.1 <= far.1
    }

    fn place(&self, state: &FiniteElementState, node: usize) -> Vec3 {
        self.model.mesh().nodes[node] + state.displacement(&self.model, node)
    }

    fn supports(&self, activated: &[Option<[f64; 2]>], depth: f64) -> Supports<'static> {
        let mut prescribed = self.rest.clone();
        for (&node, activated) in self.face.iter().zip(activated) {
            if let Some([y, z]) = activated {
                let rest = self.model.mesh().nodes[node];
                prescribed[3 * node] = Some(self.top - depth - rest.x);
                if self.punch.face == Friction::Bonded {
                    // A plane of symmetry holds at zero already.
                    prescribed[3 * node + 1].get_or_insert(y - rest.y);
                    prescribed[3 * node + 2].get_or_insert(z - rest.z);
                }
            }
        }
        Supports {
            prescribed,
            ..Supports::none(&self.model)
        }
    }

    /// An equilibrium at `depth`, contacts included, and the number of solutions that it took.
    fn increment_at(&mut self, depth: f64) -> Result<(ConvergedIncrement, usize), Failure> {
        let mut next = ConvergedIncrement {
            depth,
            state: self.predict(depth),
            activated: self.now.activated.clone(),
        };
        // The plane may already be past nodes that nothing has pushed yet.
        let state = self.now.state.clone();
        self.catch(&state, &mut next, false);
        let (mut controls, cavity) = (0, self.cavity.clone());
        for round in 0..ROUNDS {
            let supports = self.supports(&next.activated, depth);
            let supports = supports.press(&cavity, self.punch.pressure);
            let done = equilibrate(&self.model, &supports, &mut next.state, &mut self.workspace)?;
            controls += done.iterations;
            let state = next.state.clone();
            let more = self.catch(&state, &mut next, round + 2 < ROUNDS);
            if !more {
                return Ok((next, controls));
            }
        }
        Err(Failure::NotConverged)
    }

    /// The state extrapolated to `depth`.
    fn predict(&self, depth: f64) -> FiniteElementState {
        let before = self.before.as_ref().map(ConvergedIncrement::reached);
        FiniteElementState {
            unknowns: extrapolated(self.now.reached(), before, depth),
        }
    }

    /// Catches nodes that have passed the face of `next` in `state`, and lets go those that pull, if
    /// they `may`; answers whether there was one.
    fn catch(&self, state: &FiniteElementState, next: &mut ConvergedIncrement, may: bool) -> bool {
        let tiny = 1e-9 * self.punch.radius;
        let face = self.top - next.depth;
        let mut changed = false;
        for (place, &node) in self.face.iter().enumerate() {
            let now = self.place(state, node);
            let activated = &mut next.activated[place];
            if activated.is_none() && now.x > face + tiny {
                let then = self.place(&self.now.state, node);
                let outside = (self.top - self.now.depth - then.x).max(0.0);
                let part = outside / (outside + (now.x - face));
                let [y, z] = [1, 2].map(|i| then[i] + part * (now[i] - then[i]));
                *activated = Some([y, z]);
                changed = true;
            } else if activated.is_some()
                && may
                && self.punch.face == Friction::Frictionless
                && self.workspace.reaction(&self.model, node).x > 0.0
            {
                *activated = None;
                changed = true;
            }
        }
        changed
    }
}

/// A tube whose pressure rises to a part of the whole [-].
struct Rising<'t, 'a> {
    tube: &'t mut Punching<'a>,
    part: f64,
}

impl Increments for Rising<'_, '_> {
    fn reached(&self) -> f64 {
        self.part
    }

    fn advance(&mut self, goal: f64) -> Result<usize, Failure> {
        let Punching {
            model,
            workspace,
            cavity,
            punch,
            rest,
            now,
            ..
        } = &mut *self.tube;
        let mut state = now.state.clone();
        let supports = Supports {
            prescribed: rest.clone(),
            ..Supports::none(model)
        }
        .press(cavity, goal * punch.pressure);
        let done = equilibrate(model, &supports, &mut state, workspace)?;
        now.state = state;
        self.part = goal;
        Ok(done.iterations)
    }
}

impl Increments for Punching<'_> {
    fn reached(&self) -> f64 {
        self.now.depth
    }

    fn advance(&mut self, goal: f64) -> Result<usize, Failure> {
        let (next, solutions) = self.increment_at(goal)?;
        self.before = Some(std::mem::replace(&mut self.now, next));
        Ok(solutions)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Ends, Tube, inflate};
    use super::*;
    use crate::{Fibres, HolzapfelGasserOgden, Law, LinearElastic, NeoHookean};

    fn problem(tube: [f64; 3], law: impl crate::Law + 'static) -> TubeProblem {
        TubeProblem {
            tube: Tube {
                length: tube[0],
                inner_radius: tube[1],
                outer_radius: tube[2],
            },
            law: Arc::new(law),
            ends: Ends::Fixed,
        }
    }

    fn punch(radius: f64, face: Friction, pressure: f64) -> TubePunch {
        TubePunch {
            radius,
            face,
            pressure,
            depths: Vec::new(),
        }
    }

    /// A wide thick tube is a half-space: 2 a E/(1 − ν²), 4 G a ln(3 − 4 ν)/(1 − 2 ν) [Spence 1968].
    #[test]
    fn a_wide_thick_tube_is_a_half_space() {
        let law = LinearElastic::new(1e3, 0.3).unwrap();
        let problem = problem([0.16, 0.02, 0.08], law);
        for (face, exact) in [
            (Friction::Frictionless, 2e3 / (1.0 - 0.09)),
            (Friction::Bonded, 2e3 / 1.3 * 1.8_f64.ln() / 0.4),
        ] {
            let punch = punch(1e-3, face, 0.0);
            let mut run = Punching::new(&problem, &punch, 1).unwrap();
            run.pressurise().unwrap();
            // Between two depths, as the curved surface meets the face bit by bit.
            let [one, two] = [1e-4, 2e-4].map(|d| run.press_to(d, |_| {}).unwrap());
            let ratio = (two - one) / (1e-4 * exact * 1e-3);
            println!("{} unknowns, {face:?}: {ratio}", run.unknowns());
            // Elements of half a radius add 3 %, the tube's finite size 1 or 2.
            assert!((0.98..1.06).contains(&ratio), "{ratio}");
        }
    }

    /// The axisymmetric tube, which has another mesh and other elements; also of fibres, which here turn with the wall.
    #[test]
    fn pressure_alone_widens_the_axisymmetric_tube() {
        let fibres = Fibres {
            k1: 2000.0,
            k2: 1.0,
            dispersion: 0.1,
            angle_deg: 35.0,
        };
        let laws: [Arc<dyn Law>; 2] = [
            Arc::new(NeoHookean::incompressible(5200.0 / 6.0).unwrap()),
            Arc::new(HolzapfelGasserOgden::incompressible(5200.0 / 6.0, fibres).unwrap()),
        ];
        for law in laws {
            let mut problem = problem([0.03, 0.005, 0.0075], LinearElastic::new(1.0, 0.3).unwrap());
            problem.law = law;
            let punch = punch(0.002, Friction::Bonded, 400.0);
            let mut run = Punching::new(&problem, &punch, 1).unwrap();
            run.pressurise().unwrap();
            let far = |x: &Vec3| (x.xy() - nalgebra::Vector2::new(-0.005, 0.0)).norm() < 1e-9;
            let node = run.model.mesh().nodes_where(|x| far(x) && x.z == 0.0)[0];
            let solid = -run.now.state.displacement(&run.model, node).x;
            let answer = inflate::on_mesh(&problem, &[400.0], 2, &mut |_| {}).unwrap();
            let flat = answer.inner_displacements[0].unwrap();
            println!("{} unknowns: {solid}, {flat}", run.unknowns());
            // The coarse solid, with elements as long as the wall is thick.
            assert!((solid / flat - 1.0).abs() < 0.01, "{solid} {flat}");
        }
    }

    /// F = d(E − p V)/dd, of the whole tube under pressure.
    #[test]
    fn force_is_the_derivative_of_the_energy() {
        let law = NeoHookean::incompressible(5200.0 / 6.0).unwrap();
        let problem = problem([0.02, 0.005, 0.0075], law);
        let punch = punch(0.002, Friction::Bonded, 300.0);
        let mut run = Punching::new(&problem, &punch, 1).unwrap();
        run.pressurise().unwrap();
        let mut at = |depth: f64| {
            let force = run.press_to(depth, |_| {}).unwrap();
            let volume = run
                .cavity
                .volume(&run.model, &run.now.state.unknowns)
                .unwrap();
            let work = run.workspace.energy() - punch.pressure * volume;
            (force, 4.0 * work)
        };
        let (low, middle, high) = (at(1.48e-3), at(1.5e-3), at(1.52e-3));
        let slope = (high.1 - low.1) / 4e-5;
        println!("{} {slope}", middle.0);
        // A difference of the second order over an eightieth of the depth.
        assert!((slope / middle.0 - 1.0).abs() < 1e-4);
    }
}
