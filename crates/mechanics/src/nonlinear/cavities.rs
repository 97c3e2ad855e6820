//! Cavities of a body, and the pressure on their walls, which follows these.
//!
//! ```text
//! forces p ∂V/∂u,   tangent p ∂²V/∂u²
//! ```
//!
//! V is the volume within the wall (`finite_elements::cavity`). A fluid keeps its volume V₁, as a condition of the step together with those
//! of the tools and contacts: with the area A of the wall, the force p A acts along ∂V/∂u/A until
//!
//! ```text
//! (V − V₁)/A = 0
//! ```
//!
//! which costs one solution with the factors at rest in a step, and a column in each projection. A stiff but compressible fluid
//! would cost the same, for it makes the preconditioner useless unless that is corrected by the same column; so the fluid is
//! incompressible. What a step leaves of V − V₁ is of the second order in its motion, and the next step makes up for it.
//!
//! *How we know*: `nonlinear_cavities::…`.

use palpate_files::scene::CavityContent;
use palpate_geometry::NodeId;

use super::constraints::Turned;
use super::model::NonlinearModel;
use super::step::dot;
use crate::Vec3;
use crate::finite_elements::TRIANGLE_PAIRS;
use crate::finite_elements::solid::Face;

/// Nodes of a side of a wall, and pairs of them.
const NODES: usize = 6;
const PAIRS: usize = NODES * (NODES - 1) / 2;

/// A cavity in a mesh.
#[derive(Debug, Clone)]
pub struct BodyCavity {
    /// The triangles around it, as [`palpate_geometry::HollowMesh`] has them.
    pub wall: Vec<[NodeId; 3]>,
    /// Its content.
    pub content: CavityContent,
    /// The volume of its fluid over that of the cavity at rest [-]; none where the pressure of the fluid
    /// determines it.
    pub filling: Option<f64>,
}

/// The load on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WallLoad {
    /// A constant pressure [Pa].
    Pressure(f64),
    /// A fluid of this volume [m³].
    Volume(f64),
}

/// The wall of a cavity.
#[derive(Debug, Clone)]
pub(super) struct Wall {
    /// Nodes of its sides, as `Cavity` has them.
    sides: Vec<[u32; NODES]>,
    pub(super) content: CavityContent,
    pub(super) filling: Option<f64>,
    pub(super) load: WallLoad,
    /// Volume [m³] and area [m²] at rest.
    pub(super) at_rest: f64,
    area: f64,
}

impl Wall {
    pub(super) fn new(
        faces: &[Face],
        nodes: &[Vec3],
        content: CavityContent,
        filling: Option<f64>,
    ) -> Self {
        let places = |face: &Face| [0, 1, 2].map(|k| nodes[face.nodes[k]]);
        let areas = faces.iter().map(|face| {
            let [a, b, c] = places(face);
            0.5 * (b - a).cross(&(c - a)).norm()
        });
        let mut wall = Self {
            sides: faces.iter().map(Face::seen_from_inside).collect(),
            content,
            filling,
            load: WallLoad::Pressure(0.0),
            at_rest: 0.0,
            area: areas.sum(),
        };
        wall.at_rest = wall.volume(nodes, &vec![0.0; 3 * nodes.len()]);
        wall.load = match content {
            CavityContent::Pressure(pressure) => WallLoad::Pressure(pressure),
            CavityContent::Fluid(_) => WallLoad::Volume(filling.unwrap_or(1.0) * wall.at_rest),
        };
        wall
    }

    /// The volume within it [m³] where the nodes have the displacements `u` [m].
    pub(super) fn volume(&self, nodes: &[Vec3], u: &[f64]) -> f64 {
        let mut volume = 0.0;
        for side in &self.sides {
            volume += deform(&places(side, nodes, u), |_, _| ()).1;
        }
        volume
    }
}

/// Positions of the nodes of a side [m].
#[inline(always)]
fn places(side: &[u32; NODES], nodes: &[Vec3], u: &[f64]) -> [Vec3; NODES] {
    side.map(|node| {
        let u = &u[3 * node as usize..][..3];
        nodes[node as usize] + Vec3::new(u[0], u[1], u[2])
    })
}

/// c_ab of a side for a < b [m], and its part of the volume [m³]; `visit` gets ∂V/∂x of each node [m²].
#[inline(always)]
fn deform(places: &[Vec3; NODES], mut visit: impl FnMut(usize, Vec3)) -> ([Vec3; PAIRS], f64) {
    let constants = &*TRIANGLE_PAIRS;
    let mut pairs = [Vec3::zeros(); PAIRS];
    let mut gradients = [Vec3::zeros(); NODES];
    for (pair, (a, b)) in pairs.iter_mut().zip(each_pair()) {
        for (t, x) in constants[a][b].iter().zip(places) {
            *pair += *t * x;
        }
        gradients[a] += 0.5 * places[b].cross(pair);
        gradients[b] -= 0.5 * places[a].cross(pair);
    }
    let mut volume = 0.0;
    for (k, (x, gradient)) in places.iter().zip(gradients).enumerate() {
        volume += x.dot(&gradient) / 3.0;
        visit(k, gradient);
    }
    (pairs, volume)
}

#[inline(always)]
fn each_pair() -> impl Iterator<Item = (usize, usize)> {
    (0..NODES).flat_map(|a| (a + 1..NODES).map(move |b| (a, b)))
}

/// The walls of a body in a step. Scratch.
#[derive(Debug, Clone)]
pub(super) struct WallsInStep {
    /// c_ab of every side of all walls [m].
    pairs: Vec<[Vec3; PAIRS]>,
    /// Of each wall: ∂V/∂u/A of all nodes [-], V [m³], and p where the tangent is taken [Pa].
    gradients: Vec<f32>,
    volumes: Vec<f64>,
    pressures: Vec<f64>,
    /// The walls of fluids, and Z = Q K⁻¹ Qᵀ ∂V/∂u/A of each [m/N].
    pub(super) fluids: Vec<usize>,
    influences: Vec<f32>,
    size: usize,
}

impl WallsInStep {
    pub(super) fn new(model: &NonlinearModel) -> Self {
        let (walls, size) = (model.walls.len(), 3 * model.nodes().len());
        let sides = model.walls.iter().map(|wall| wall.sides.len()).sum();
        Self {
            pairs: vec![[Vec3::zeros(); PAIRS]; sides],
            gradients: vec![0.0; walls * size],
            volumes: vec![0.0; walls],
            pressures: vec![0.0; walls],
            fluids: Vec::with_capacity(walls),
            influences: vec![0.0; walls * size],
            size,
        }
    }

    /// Finds the volumes and their derivatives where the nodes have the displacements `u` [m], and takes the constant
    /// pressures off the `forces` by which the body resists [N].
    #[inline(always)]
    pub(super) fn deform(&mut self, model: &NonlinearModel, u: &[f64], forces: &mut [f32]) {
        let gradients = self.gradients.chunks_exact_mut(self.size);
        let mut pairs = self.pairs.iter_mut();
        for ((wall, gradient), volume) in model.walls.iter().zip(gradients).zip(&mut self.volumes) {
            gradient.fill(0.0);
            *volume = 0.0;
            let each_area = 1.0 / wall.area;
            for (side, pairs) in wall.sides.iter().zip(&mut pairs) {
                let deformed = deform(&places(side, model.nodes(), u), |k, by| {
                    let own = &mut gradient[3 * side[k] as usize..][..3];
                    for (own, by) in own.iter_mut().zip(by.iter()) {
                        *own += (each_area * by) as f32;
                    }
                });
                *pairs = deformed.0;
                *volume += deformed.1;
            }
            if let WallLoad::Pressure(pressure) = wall.load {
                let force = (pressure * wall.area) as f32;
                for (own, by) in forces.iter_mut().zip(&*gradient) {
                    *own -= force * by;
                }
            }
        }
    }

    /// Takes the `pressures` [Pa] of the tangent, and makes Z of the fluids.
    #[inline(always)]
    pub(super) fn prepare(
        &mut self,
        body: Turned<'_>,
        pressures: impl Iterator<Item = f64>,
        scratch: &mut [f32],
    ) {
        let Turned { model, rotations } = body;
        self.fluids.clear();
        for (number, (wall, pressure)) in model.walls.iter().zip(pressures).enumerate() {
            self.pressures[number] = match wall.load {
                WallLoad::Pressure(pressure) => pressure,
                WallLoad::Volume(_) => {
                    let place = self.fluids.len() * self.size;
                    let gradient = &self.gradients[number * self.size..][..self.size];
                    let influence = &mut self.influences[place..][..self.size];
                    model.rest.apply(rotations, gradient, influence, scratch);
                    self.fluids.push(number);
                    pressure
                }
            };
        }
    }

    /// Adds the part of the pressures to the product of the tangent with `du` [m].
    #[inline(always)]
    pub(super) fn add_product(&self, model: &NonlinearModel, du: &[f32], product: &mut [f32]) {
        let mut pairs = self.pairs.iter();
        for (wall, &pressure) in model.walls.iter().zip(&self.pressures) {
            for (side, pairs) in wall.sides.iter().zip(&mut pairs) {
                let own = side.map(|node| {
                    let du = &du[3 * node as usize..][..3];
                    Vec3::new(du[0].into(), du[1].into(), du[2].into())
                });
                let mut change = [Vec3::zeros(); NODES];
                for (pair, (a, b)) in pairs.iter().zip(each_pair()) {
                    change[a] += own[b].cross(pair);
                    change[b] -= own[a].cross(pair);
                }
                for (&node, change) in side.iter().zip(&change) {
                    let own = &mut product[3 * node as usize..][..3];
                    for (own, by) in own.iter_mut().zip(change.iter()) {
                        *own -= (pressure * by) as f32;
                    }
                }
            }
        }
    }

    /// (V − V₁)/A of a fluid [m].
    pub(super) fn violation(&self, model: &NonlinearModel, fluid: usize) -> f64 {
        let number = self.fluids[fluid];
        let wall = &model.walls[number];
        match wall.load {
            WallLoad::Volume(target) => (self.volumes[number] - target) / wall.area,
            WallLoad::Pressure(_) => 0.0,
        }
    }

    /// A of the wall around a fluid [m²].
    pub(super) fn area(&self, model: &NonlinearModel, fluid: usize) -> f64 {
        model.walls[self.fluids[fluid]].area
    }

    /// Z of a fluid [m/N].
    pub(super) fn influence(&self, fluid: usize) -> &[f32] {
        &self.influences[fluid * self.size..][..self.size]
    }

    /// How far `values` of all nodes move a fluid's row: ∂V/∂u/A of them.
    #[inline(always)]
    pub(super) fn along(&self, fluid: usize, values: &[f32]) -> f64 {
        dot(self.gradient(fluid), values)
    }

    fn gradient(&self, fluid: usize) -> &[f32] {
        &self.gradients[self.fluids[fluid] * self.size..][..self.size]
    }

    /// Zᵀ r.
    #[inline(always)]
    pub(super) fn project(&self, r: &[f32], projected: &mut [f64]) {
        for (fluid, own) in (0..self.fluids.len()).zip(projected) {
            *own = dot(self.influence(fluid), r);
        }
    }

    /// x ← x + Z t.
    #[inline(always)]
    pub(super) fn add_influence(&self, t: &[f64], x: &mut [f32]) {
        for (fluid, t) in (0..self.fluids.len()).zip(t) {
            add(self.influence(fluid), *t, x);
        }
    }

    /// r ← r + ∂V/∂u/A t.
    #[inline(always)]
    pub(super) fn add_load(&self, t: &[f64], r: &mut [f32]) {
        for (fluid, t) in (0..self.fluids.len()).zip(t) {
            add(self.gradient(fluid), *t, r);
        }
    }
}

#[inline(always)]
fn add(column: &[f32], factor: f64, x: &mut [f32]) {
    let factor = factor as f32;
    for (x, by) in x.iter_mut().zip(column) {
        *x += factor * by;
    }
}
