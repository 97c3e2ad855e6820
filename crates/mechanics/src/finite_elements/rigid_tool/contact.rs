//! Forces between rigid tools and a boundary, by the augmented Lagrangian method [Simo and Laursen 1992].
//!
//! At each corner of the boundary the mean distance g to the tool and the mean slip s since the last increment give
//!   p = max(0, λ − ε g),  t = λₜ − ε s, cut to |t| ≤ μ λ,
//! a pressure and a traction with the multipliers λ, λₜ of the last equilibrium and a penalty ε. They replace the multipliers
//! until they agree with them: then g = 0 where tissue presses, s = 0 where it sticks, and |t| = μ p along the slip where it
//! slips. With the multiplier in the cone of friction the tangent of each equilibrium is symmetric, and exact from the second
//! augmentation on; the direction of the normal in t is that of the last one too.
//!
//! *How we know*: `tests::the_tangent_is_the_derivative_of_the_forces`, `rigid_tools::…`.

use nalgebra::Matrix3;

use super::super::model::FiniteElementModel;
use super::shape::{RigidDistance, RigidTool};
use super::surface::{ContactCorner, ContactSurface};
use crate::Vec3;
use crate::contact::FrictionLaw;

/// ε in shear moduli over the size of the faces at a corner [-]. An augmentation leaves about this part of what was left.
const PENALTY: f64 = 1000.0;

/// Contact of tools, each at a place of its own, with a boundary.
#[derive(Debug, Clone)]
pub(in super::super) struct Contacts<'a> {
    pub(in super::super) surface: &'a ContactSurface,
    tools: &'a [RigidTool],
    /// Positions of the tools [m].
    positions: Vec<Vec3>,
    /// For each tool and, within it, each corner.
    contacts: Vec<CornerContact>,
}

/// The penalty on slip in that on distance [-]. Newton's method finds from sticking to slipping more easily where it is softer.
const TANGENTIAL: f64 = 0.05;

/// Of the force that makes tissue slip, the part from which it counts as slipping [-].
const SLIPPING: f64 = 0.999;

/// Cosines between the inward normals of a face and of the tool's surface up to which the tool does not press the face, and from
/// which it does [-]. Beyond a sharp edge tissue is near the tool, and is not under it.
const FACING: [f64; 2] = [0.3, 0.7];

/// The largest pressure over its multiplier with which the curvature of a tool enters the tangent [-]. Beyond it is the penalty
/// of a trial that went too far, with which the tangent would be indefinite.
const MAX_BENDING: f64 = 2.0;

/// A corner of the boundary at a tool.
#[derive(Debug, Clone, PartialEq)]
struct CornerContact {
    /// Weights in the mean distance of the points that face the tool [-]; empty where none does.
    weights: Vec<f64>,
    /// The area that these stand for [m²].
    area: f64,
    /// λ [Pa].
    pressure: f64,
    /// λₜ, on the tissue [Pa].
    traction: Vec3,
    /// Away from the tool [-].
    normal: Vec3,
    /// Its place relative to the tool at the last increment, if it touched [m].
    from: Option<Vec3>,
}

/// The force of the tissue on a tool.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToolLoad {
    /// Position of the tool [m].
    pub position: Vec3,
    /// The force of the tissue on it [N].
    pub force: Vec3,
    /// The moment of that about its position [N m].
    pub moment: Vec3,
    /// Force normal to its surface [N], summed over the contact.
    pub normal_force: f64,
    /// Area of the boundary at rest that touches it [m²].
    pub area: f64,
    /// The part of that which slips [m²].
    pub slipping_area: f64,
}

/// A corner of the boundary, and its contact with a tool.
#[derive(Clone, Copy)]
struct ToolCorner<'a> {
    /// Number of the tool.
    tool: usize,
    corner: &'a ContactCorner,
    contact: &'a CornerContact,
}

/// A corner at a tool in a deformed body.
struct Evaluated {
    /// Mean distance [m].
    gap: f64,
    /// Gap per displacement of each node of the corner [-].
    slopes: Vec<Vec3>,
    /// The same of the mean position [-].
    shares: Vec<f64>,
    /// Mean position [m].
    mean: Vec3,
    normal: Vec3,
    distances: Vec<RigidDistance>,
}

/// Pressure and traction at a corner.
struct Forces {
    /// [Pa]
    pressure: f64,
    /// On the tissue [Pa].
    traction: Vec3,
    /// −∂p/∂g [Pa/m].
    per_gap: f64,
    /// −∂t/∂s [Pa/m].
    per_slip: Matrix3<f64>,
    slips: bool,
}

impl<'a> Contacts<'a> {
    /// Tools at the beginning of their paths, which touch nothing yet.
    pub(in super::super) fn new(surface: &'a ContactSurface, tools: &'a [RigidTool]) -> Self {
        let none = CornerContact {
            weights: Vec::new(),
            area: 0.0,
            pressure: 0.0,
            traction: Vec3::zeros(),
            normal: Vec3::zeros(),
            from: None,
        };
        Self {
            surface,
            tools,
            positions: tools.iter().map(|tool| tool.position(0.0)).collect(),
            contacts: vec![none; tools.len() * surface.corners.len()],
        }
    }

    /// The same with all tools at this place of their paths.
    pub(in super::super) fn moved(&self, along: f64) -> Self {
        let positions = self.tools.iter().map(|tool| tool.position(along));
        Self {
            positions: positions.collect(),
            ..self.clone()
        }
    }

    /// How many parts the longest path of a tool has.
    pub(in super::super) fn parts(&self) -> usize {
        let paths = self.tools.iter().map(|tool| tool.path.len());
        paths.max().unwrap_or(0).saturating_sub(1)
    }

    /// All corners, tool by tool.
    fn each(&self) -> impl Iterator<Item = ToolCorner<'_>> {
        let count = self.surface.corners.len().max(1);
        let contacts = self.contacts.chunks(count).enumerate();
        contacts.flat_map(|(tool, contacts)| {
            let corners = self.surface.corners.iter().zip(contacts);
            corners.map(move |(corner, contact)| ToolCorner {
                tool,
                corner,
                contact,
            })
        })
    }

    fn evaluate(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        at: ToolCorner<'_>,
    ) -> Evaluated {
        let places = at.corner.places(&model.mesh.nodes, unknowns);
        let (tool, position) = (&self.tools[at.tool], &self.positions[at.tool]);
        let weights = at
            .contact
            .weights
            .iter()
            .copied()
            .chain(std::iter::repeat(0.0));
        let mut found = Evaluated {
            gap: 0.0,
            slopes: vec![Vec3::zeros(); places.len()],
            shares: vec![0.0; places.len()],
            mean: Vec3::zeros(),
            normal: Vec3::zeros(),
            distances: Vec::with_capacity(at.corner.points.len()),
        };
        for (point, weight) in at.corner.points.iter().zip(weights) {
            let place = point.position(&places);
            let separation = tool.signed_distance(&place, position);
            found.gap += weight * separation.distance;
            found.mean += point.weight * place;
            found.normal += weight * separation.normal;
            for (&node, share) in point.nodes.iter().zip(point.shares) {
                found.slopes[node] += weight * share * separation.normal;
                found.shares[node] += point.weight * share;
            }
            found.distances.push(separation);
        }
        found
    }

    /// Pressure and traction at a corner, if any.
    fn forces(
        &self,
        model: &FiniteElementModel,
        ToolCorner {
            tool,
            corner,
            contact,
        }: ToolCorner<'_>,
        found: &Evaluated,
    ) -> Option<Forces> {
        // As stiff where a small part of the faces is under the tool as where all is.
        let part = (contact.area / corner.area).max(f64::MIN_POSITIVE);
        let penalty = PENALTY * model.shear_modulus / (corner.area.sqrt() * part);
        let pressure = contact.pressure - penalty * found.gap;
        // The criteria of friction stay the same until the next augmentation.
        let pressed_before = contact.pressure > 0.0;
        if contact.area == 0.0 || (pressure <= 0.0 && !pressed_before) {
            return None;
        }
        let mut forces = Forces {
            pressure: pressure.max(0.0),
            per_gap: if pressure > 0.0 { penalty } else { 0.0 },
            traction: Vec3::zeros(),
            per_slip: Matrix3::zeros(),
            slips: false,
        };
        let most = match self.tools[tool].friction {
            FrictionLaw::Frictionless => return Some(forces),
            FrictionLaw::Bonded => f64::INFINITY,
            FrictionLaw::Coulomb(coefficient) => coefficient * contact.pressure,
        };
        let Some(from) = contact.from.filter(|_| pressed_before) else {
            return Some(forces);
        };
        let plane = Matrix3::identity() - contact.normal * contact.normal.transpose();
        let penalty = penalty * TANGENTIAL;
        let slip = plane * (found.mean - self.positions[tool] - from);
        let trial = contact.traction - penalty * slip;
        let size = trial.norm();
        if size <= most {
            forces.traction = trial;
            forces.per_slip = penalty * plane;
            forces.slips = size > SLIPPING * most;
        } else {
            let along = trial / size;
            forces.traction = most * along;
            forces.per_slip = most / size * penalty * (plane - along * along.transpose());
            forces.slips = true;
        }
        Some(forces)
    }

    /// Corners with a pressure or a traction, and these.
    fn acting<'s>(
        &'s self,
        model: &'s FiniteElementModel,
        unknowns: &'s [f64],
    ) -> impl Iterator<Item = (ToolCorner<'s>, Evaluated, Forces)> {
        self.each().filter_map(move |at| {
            let found = self.evaluate(model, unknowns, at);
            let forces = self.forces(model, at, &found)?;
            Some((at, found, forces))
        })
    }

    /// Finds which parts of the boundary face the tools, with these displacements.
    pub(in super::super) fn update_facing(&mut self, model: &FiniteElementModel, unknowns: &[f64]) {
        let each = self.each().map(|at| {
            let places = at.corner.places(&model.mesh.nodes, unknowns);
            let (tool, position) = (&self.tools[at.tool], &self.positions[at.tool]);
            let weights = at.corner.points.iter().map(|point| {
                let separation = tool.signed_distance(&point.position(&places), position);
                let cosine = -separation.normal.dot(&point.normal(&places));
                let part = ((cosine - FACING[0]) / (FACING[1] - FACING[0])).clamp(0.0, 1.0);
                point.weight * part * part * (3.0 - 2.0 * part)
            });
            let mut weights: Vec<f64> = weights.collect();
            let part: f64 = weights.iter().sum();
            if part > 0.0 {
                weights.iter_mut().for_each(|weight| *weight /= part);
            } else {
                weights.clear();
            }
            CornerContact {
                weights,
                area: part * at.corner.area,
                ..at.contact.clone()
            }
        });
        let contacts = each.collect();
        self.contacts = contacts;
    }

    /// Adds the forces on the nodes, `factor` times, to `out` [N].
    pub(in super::super) fn add_forces(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        for (at, found, forces) in self.acting(model, unknowns) {
            at.add_forces(&found, &forces, factor, out);
        }
    }

    /// Adds the forces with the sign of a residual, and the tangent, which is symmetric, and exact where no pressure is more than
    /// [`MAX_BENDING`] multipliers.
    pub(in super::super) fn assemble(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        residual: &mut [f64],
        tangent: &mut [f64],
    ) {
        for (at, found, forces) in self.acting(model, unknowns) {
            let ToolCorner {
                corner, contact, ..
            } = at;
            at.add_forces(&found, &forces, -1.0, residual);
            let count = corner.nodes.len();
            let mut blocks = vec![Matrix3::zeros(); count * count];
            for (a, b) in (0..count).flat_map(|a| (0..count).map(move |b| (a, b))) {
                blocks[a * count + b] = contact.area
                    * (forces.per_gap * found.slopes[a] * found.slopes[b].transpose()
                        + found.shares[a] * found.shares[b] * forces.per_slip);
            }
            let weighted = corner.points.iter().zip(&contact.weights);
            for ((point, weight), separation) in weighted.zip(&found.distances) {
                let pressure = forces.pressure.min(MAX_BENDING * contact.pressure);
                let bend = -contact.area * pressure * *weight * separation.curvature;
                for (&a, share) in point.nodes.iter().zip(point.shares) {
                    for (&b, other) in point.nodes.iter().zip(point.shares) {
                        blocks[a * count + b] += share * other * bend;
                    }
                }
            }
            for (a, b) in (0..count).flat_map(|a| (0..count).map(move |b| (a, b))) {
                let block = &blocks[a * count + b];
                for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
                    let row = 3 * corner.nodes[a] as usize + i;
                    let column = 3 * corner.nodes[b] as usize + k;
                    if row >= column {
                        tangent[model.pattern.index(row, column)] += block[(i, k)];
                    }
                }
            }
        }
    }

    /// Puts the pressures and tractions of an equilibrium in the places of the multipliers. The sum of all changes over the
    /// sum of the pressures [-], both weighted by area.
    pub(in super::super) fn augment(
        &mut self,
        model: &FiniteElementModel,
        unknowns: &[f64],
    ) -> f64 {
        let (mut changes, mut pressures) = (0.0, 0.0);
        let each = self.each().map(|at| {
            let found = self.evaluate(model, unknowns, at);
            let contact = at.contact;
            let forces = self.forces(model, at, &found);
            let (pressure, mut traction) =
                forces.map_or((0.0, Vec3::zeros()), |own| (own.pressure, own.traction));
            let normal = found.normal.try_normalize(0.0).unwrap_or(contact.normal);
            let change = (pressure - contact.pressure).abs() + (traction - contact.traction).norm();
            changes += contact.area * change;
            pressures += contact.area * pressure;
            traction -= traction.dot(&normal) * normal;
            CornerContact {
                pressure,
                traction,
                normal,
                ..contact.clone()
            }
        });
        let contacts = each.collect();
        self.contacts = contacts;
        if changes == 0.0 {
            0.0
        } else {
            changes / pressures
        }
    }

    /// Notes where tissue touches: from there it slips in the next increment. Call it after [`Self::augment`].
    pub(in super::super) fn close_increment(
        &mut self,
        model: &FiniteElementModel,
        unknowns: &[f64],
    ) {
        let each = self.each().map(|at| {
            let ToolCorner {
                tool,
                corner,
                contact,
            } = at;
            let found = self.evaluate(model, unknowns, at);
            // A corner that just touches without a pressure sticks from the beginning.
            let touches = found.gap <= 1e-9 * corner.area.sqrt();
            CornerContact {
                from: (contact.pressure > 0.0 || touches)
                    .then(|| found.mean - self.positions[tool]),
                normal: found.normal.try_normalize(0.0).unwrap_or(contact.normal),
                ..contact.clone()
            }
        });
        let contacts = each.collect();
        self.contacts = contacts;
    }

    /// The load on each tool.
    pub(in super::super) fn loads(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
    ) -> Vec<ToolLoad> {
        let start = self.positions.iter().map(|&position| ToolLoad {
            position,
            ..ToolLoad::default()
        });
        let mut loads: Vec<ToolLoad> = start.collect();
        for (at, found, forces) in self.acting(model, unknowns) {
            let ToolCorner {
                tool,
                corner,
                contact,
            } = at;
            let places = corner.places(&model.mesh.nodes, unknowns);
            let load = &mut loads[tool];
            load.area += contact.area;
            load.normal_force += contact.area * forces.pressure;
            if forces.slips {
                load.slipping_area += contact.area;
            }
            let weighted = corner.points.iter().zip(&contact.weights);
            for ((point, weight), separation) in weighted.zip(&found.distances) {
                let on_tissue = contact.area
                    * (*weight * forces.pressure * separation.normal
                        + point.weight * forces.traction);
                load.force -= on_tissue;
                load.moment -= (point.position(&places) - load.position).cross(&on_tissue);
            }
        }
        loads
    }

    /// The pressure at each corner of the surface, of all tools [Pa].
    pub(in super::super) fn pressures(&self) -> Vec<f64> {
        let count = self.surface.corners.len();
        let mut pressures = vec![0.0; count];
        for (contact, place) in self.contacts.iter().zip((0..count).cycle()) {
            pressures[place] += contact.pressure;
        }
        pressures
    }
}

impl ToolCorner<'_> {
    /// Adds the forces on the nodes, `factor` times, to `out` [N].
    fn add_forces(&self, found: &Evaluated, forces: &Forces, factor: f64, out: &mut [f64]) {
        let slopes = found.slopes.iter().zip(&found.shares);
        for (&node, (slope, share)) in self.corner.nodes.iter().zip(slopes) {
            let size = factor * self.contact.area;
            let force = size * (forces.pressure * slope + *share * forces.traction);
            for axis in 0..3 {
                out[3 * node as usize + axis] += force[axis];
            }
        }
    }
}

#[cfg(test)]
mod tests;
