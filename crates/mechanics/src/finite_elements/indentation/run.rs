use std::sync::Arc;

use super::super::model::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
};
use super::super::newton::{self, Failure, equilibrate};
use super::super::supports::{OnSphere, Supports};
use super::indenter::{Grip, Indenter, IndenterShape, Side};
use super::mesh::{Block, graded_block};
use crate::material::law::Law;
use crate::{Error, Strain};

/// An indentation to be solved.
#[derive(Debug, Clone)]
pub struct IndentationSettings {
    /// The tissue.
    pub block: Block,
    /// What is pressed into it.
    pub indenter: Indenter,
    /// Its law; with [`Strain::Small`] all is linear and only the face touches.
    pub law: Arc<dyn Law>,
    /// Length of the smallest elements, at the edge of the contact [-], in radii of it.
    pub edge: f64,
    /// How often every element of that mesh is halved.
    pub halvings: u32,
}

/// What the indenter feels at a depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndentationPoint {
    /// Depth [m].
    pub depth: f64,
    /// Force on the tissue [N].
    pub force: f64,
    /// Strain energy [J].
    pub energy: f64,
}

/// An indentation in progress.
#[derive(Debug)]
pub struct IndentationRun {
    model: FiniteElementModel,
    workspace: FiniteElementWorkspace,
    indenter: Indenter,
    /// Nodes of the top, from the axis outward.
    top: Vec<usize>,
    /// Held whatever the indenter does: bottom and axis.
    rest: Vec<Option<f64>>,
    now: Standing,
    /// The standing before, from which the next is foreseen.
    before: Option<Standing>,
    step: f64,
}

/// An equilibrium at a depth.
#[derive(Debug, Clone)]
struct Standing {
    depth: f64,
    state: FiniteElementState,
    /// Contact of each node of the top.
    touch: Vec<Touch>,
}

/// Contact of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Touch {
    Free,
    /// Stays at this radius and height above the lowest point of the indenter [m].
    Stuck {
        radius: f64,
        above: f64,
    },
    OnFace,
    OnSide,
    OnSphere,
}

impl IndentationRun {
    /// An indenter that just touches.
    ///
    /// # Errors
    /// When the block is smaller than the indenter, or see [`FiniteElementModel::new`].
    pub fn new(settings: &IndentationSettings) -> Result<Self, Error> {
        let (block, indenter) = (&settings.block, settings.indenter);
        let contact = indenter.radius;
        let edge = settings.edge * contact;
        let mesh = graded_block(block, contact, edge, settings.halvings);
        let top = mesh.nodes_where(|x| x.y == 0.0);
        let bottom = mesh.nodes_where(|x| x.y == -block.height);
        let axis = mesh.nodes_where(|x| x.x == 0.0);
        let model = FiniteElementModel::new(mesh, settings.law.clone(), Formulation::Mixed)?;
        let rest = Supports::none(&model)
            .hold(&model, bottom.iter().copied(), 0, 0.0)
            .hold(&model, bottom, 1, 0.0)
            .hold(&model, axis, 0, 0.0)
            .held;
        let on_face = |node: &usize| model.mesh().nodes[*node].x <= contact * (1.0 + 1e-9);
        let touch = top
            .iter()
            .map(|node| match (indenter.shape, indenter.face) {
                (IndenterShape::Flat { .. }, Grip::Stick) if on_face(node) => Touch::Stuck {
                    radius: model.mesh().nodes[*node].x,
                    above: 0.0,
                },
                (IndenterShape::Flat { .. }, Grip::Slide) if on_face(node) => Touch::OnFace,
                _ => Touch::Free,
            })
            .collect();
        Ok(Self {
            workspace: FiniteElementWorkspace::new(&model)?,
            indenter,
            top,
            rest,
            now: Standing {
                depth: 0.0,
                state: FiniteElementState::at_rest(&model),
                touch,
            },
            before: None,
            step: 0.1 * contact,
            model,
        })
    }

    /// The body.
    pub fn model(&self) -> &FiniteElementModel {
        &self.model
    }

    /// Its state.
    pub fn state(&self) -> &FiniteElementState {
        &self.now.state
    }

    /// Presses on to `depth` [m], in as many steps as it takes; `at_step` hears of each.
    ///
    /// # Errors
    /// When no equilibrium is found beyond some depth.
    pub fn press_to(
        &mut self,
        depth: f64,
        mut at_step: impl FnMut(IndentationPoint),
    ) -> Result<IndentationPoint, Error> {
        let small = self.model.law.volume().strain == Strain::Small;
        if small {
            self.step = depth;
        }
        while self.now.depth < depth {
            let left = depth - self.now.depth;
            // Two equal steps rather than one and a crumb.
            let step = if left <= self.step {
                left
            } else if left < 2.0 * self.step {
                0.5 * left
            } else {
                self.step
            };
            let goal = if step == left {
                depth
            } else {
                self.now.depth + step
            };
            match self.stand_at(goal) {
                Ok((standing, effort)) => {
                    self.before = Some(std::mem::replace(&mut self.now, standing));
                    at_step(self.point());
                    if effort <= 6 {
                        self.step = (1.5 * step).max(self.step).min(0.5 * self.indenter.radius);
                    } else if effort > 12 {
                        self.step = 0.7 * step;
                    }
                    if small {
                        self.step = depth;
                    }
                }
                Err(_) if step > 1e-4 * self.indenter.radius && !small => self.step = 0.5 * step,
                Err(failure) => {
                    return Err(Error::NoEquilibrium {
                        depth: self.now.depth,
                        failure,
                    });
                }
            }
        }
        Ok(self.point())
    }

    /// What the indenter feels now.
    pub fn point(&mut self) -> IndentationPoint {
        let supports = self.supports(&self.now.touch, self.now.depth);
        let assembled = newton::assemble(
            &self.model,
            &supports,
            &self.now.state.unknowns,
            &mut self.workspace,
        );
        debug_assert!(assembled.is_ok(), "an equilibrium was found here");
        let force = self
            .top
            .iter()
            .zip(&self.now.touch)
            .filter(|(_, touch)| **touch != Touch::Free)
            .map(|(node, _)| -self.workspace.residual[2 * node + 1])
            .sum();
        IndentationPoint {
            depth: self.now.depth,
            force,
            energy: self.workspace.energy,
        }
    }

    /// An equilibrium at `depth`, contacts included, and the number of solutions that it took.
    fn stand_at(&mut self, depth: f64) -> Result<(Standing, usize), Failure> {
        let mut touch = self.now.touch.clone();
        let mut state = self.foresee(depth);
        let mut effort = 0;
        for _ in 0..12 {
            let supports = self.supports(&touch, depth);
            match equilibrate(&self.model, &supports, &mut state, &mut self.workspace) {
                Ok(done) => effort += done.iterations,
                Err(failure) => return Err(failure),
            }
            if !self.settle(depth, &state, &mut touch)? {
                return Ok((
                    Standing {
                        depth,
                        state,
                        touch,
                    },
                    effort,
                ));
            }
        }
        Err(Failure::NotConverged)
    }

    /// Where the body would be at `depth` if it went on as before.
    fn foresee(&mut self, depth: f64) -> FiniteElementState {
        let mut state = self.now.state.clone();
        if let Some(before) = &self.before {
            let ahead = (depth - self.now.depth) / (self.now.depth - before.depth);
            for (x, old) in state.unknowns.iter_mut().zip(&before.state.unknowns) {
                *x += ahead * (*x - old);
            }
            let supports = self.supports(&self.now.touch, depth);
            if newton::assemble(&self.model, &supports, &state.unknowns, &mut self.workspace)
                .is_err()
            {
                state = self.now.state.clone();
            }
        }
        state
    }

    fn supports(&self, touch: &[Touch], depth: f64) -> Supports<'static> {
        let mut supports = Supports {
            held: self.rest.clone(),
            sliding: Vec::new(),
            pressure: None,
        };
        for (&node, touch) in self.top.iter().zip(touch) {
            let at = self.model.mesh().nodes[node].x;
            let held = &mut supports.held[2 * node..2 * node + 2];
            match *touch {
                Touch::Free => {}
                Touch::Stuck { radius, above } => {
                    held[0] = Some(radius - at);
                    held[1] = Some(above - depth);
                }
                Touch::OnFace => held[1] = Some(-depth),
                Touch::OnSide => held[0] = Some(self.indenter.radius - at),
                // On the axis the sphere's normal is the axis.
                Touch::OnSphere if at == 0.0 => held[1] = Some(-depth),
                Touch::OnSphere => supports.sliding.push(OnSphere {
                    node,
                    center: self.indenter.radius - depth,
                    radius: self.indenter.radius,
                }),
            }
        }
        supports
    }

    /// Takes up contacts where tissue has entered the indenter and gives up those that pull; answers
    /// whether there was one. Fails when tissue went in too deep to know where it entered.
    fn settle(
        &self,
        depth: f64,
        state: &FiniteElementState,
        touch: &mut [Touch],
    ) -> Result<bool, Failure> {
        if self.model.law.volume().strain == Strain::Small
            && self.indenter.shape != IndenterShape::Sphere
        {
            return Ok(false);
        }
        let mut changed = false;
        for (&node, touch) in self.top.iter().zip(touch.iter_mut()) {
            let now = self.place(state, node, depth);
            match *touch {
                Touch::Free => {
                    let inside = self.inside(now);
                    if inside > 1e-9 * self.indenter.radius {
                        if inside > 0.1 * self.indenter.radius {
                            return Err(Failure::NotConverged);
                        }
                        let then = self.place(&self.now.state, node, self.now.depth);
                        *touch = self.touching(then, now);
                        changed |= *touch != Touch::Free;
                    }
                }
                Touch::OnSide | Touch::OnSphere => {
                    let force = &self.workspace.residual[2 * node..2 * node + 2];
                    let (r, z) = now;
                    let push = if *touch == Touch::OnSide {
                        force[0]
                    } else {
                        force[0] * r + force[1] * (z - self.indenter.radius)
                    };
                    if push < 0.0 || (*touch == Touch::OnSide && z < 0.0) {
                        *touch = Touch::Free;
                        changed = true;
                    }
                }
                Touch::Stuck { .. } | Touch::OnFace => {}
            }
        }
        Ok(changed)
    }

    /// Radius and height above the indenter's lowest point [m].
    fn place(&self, state: &FiniteElementState, node: usize, depth: f64) -> (f64, f64) {
        let at = self.model.mesh().nodes[node] + state.displacement(&self.model, node);
        (at.x, at.y + depth)
    }

    /// How deep a place is inside the indenter [m].
    fn inside(&self, (r, z): (f64, f64)) -> f64 {
        let a = self.indenter.radius;
        match self.indenter.shape {
            IndenterShape::Flat { side: Side::Absent } => 0.0,
            IndenterShape::Flat { .. } if z > 0.0 => a - r,
            IndenterShape::Flat { .. } => 0.0,
            IndenterShape::Sphere => a - r.hypot(z - a),
        }
    }

    /// The contact of a node that came from `then`, outside, to `now`, inside.
    fn touching(&self, then: (f64, f64), now: (f64, f64)) -> Touch {
        let sticks = match self.indenter.shape {
            IndenterShape::Flat { side } => side == Side::Touches(Grip::Stick),
            IndenterShape::Sphere => self.indenter.face == Grip::Stick,
        };
        match (sticks, self.indenter.shape) {
            (true, _) => {
                let (outside, inside) = (-self.inside(then), self.inside(now));
                let part = (outside / (outside + inside)).clamp(0.0, 1.0);
                let (r, z) = (
                    then.0 + part * (now.0 - then.0),
                    then.1 + part * (now.1 - then.1),
                );
                Touch::Stuck {
                    radius: r,
                    above: z,
                }
            }
            (false, IndenterShape::Flat { .. }) => Touch::OnSide,
            (false, IndenterShape::Sphere) => Touch::OnSphere,
        }
    }
}
