//! The forces of all tips on one organ: each has its own law, and all share the organ's compliance.
//!
//! With d_i the displacement of tip i and C_ij the compliance in series between tips, d_i = own law(F_i) + Σ_j C_ij
//! F_j. Held parts are linear, and eliminated: with T_i their compliance to a force on tip i, the tips meet an organ
//! with fixed held parts, C_ij − T_iᵀ E Ξ_hh⁻¹ T_j, displaced by the jaws alone. One tip next to jaws is then solved at
//! once, however far the jaws have moved. (Alternating between tips and jaws diverges: under a deep sphere the own law
//! is stiffer than C allows for.) Several tips are solved in turn (Gauss and Seidel), and two that are some radii apart
//! need a few sweeps.
//!
//! An elastic organ moves nowhere as far as under the tip that presses on it. C of constant triangles and a stiffening
//! tip law violate that for tips on one spot, so it is enforced: another tip displaces a tip by at most
//! [`MAX_CARRIED`] of its displacement under itself. So the motions of the tools bound every displacement of a tip,
//! and every force. The coupling of a tip with held parts is bounded likewise, see `held`.
//!
//! *How we know*: `hybrid::…`, `grip::jumps::…`, `random_scenes::…`.

use nalgebra::Matrix3;
use palpate_geometry::{ContactPoint, Vec3, closest_on_triangle, project_contact_point};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::enhance::SurfacePoint;
use palpate_mechanics::surface_response::TipLoad;
use palpate_mechanics::{Limit, Limits, Reached};

use super::{GlobalModel, GlobalWorkspace};
use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// Largest number of sweeps, most of which are never needed.
const MAX_SWEEPS: usize = 60;

/// Relative change of a force that ends the sweeps [-].
const SETTLED: f64 = 1e-10;

/// Largest displacement of a tip due to another, relative to that other's displacement under itself [-]: the motions of
/// two tools cause displacements larger by 1/(1 − this) at most.
pub(super) const MAX_CARRIED: f64 = 0.99;

impl GlobalModel {
    /// The contact point on the mechanical surface.
    pub(crate) fn locate(
        &self,
        simulation: &Simulation,
        state: &ToolState,
    ) -> Option<SurfacePoint> {
        let contact = state.contact.as_ref()?;
        let place = contact.place;
        if !self.enhancement.has_finer_display() {
            let corners = simulation.surface.mesh().positions(place.triangle);
            return Some(SurfacePoint {
                triangle: place.triangle,
                barycentric: closest_on_triangle(&corners, &place.point).barycentric,
            });
        }
        let interpolation = self.enhancement.interpolation();
        let near = interpolation.nearest_facing(&self.tree, &place.point, &contact.rest_normal());
        // The closest point of a mesh jumps at its edges; the point below the averaged normal does not.
        let from = ContactPoint {
            triangle: near.triangle,
            barycentric: near.barycentric,
            point: interpolation.place(&near),
            normal: interpolation.normal(&near),
            depth: 0.0,
        };
        let surface = interpolation.surface();
        let under = project_contact_point(surface, surface.vertex_normals(), &from, &place.point);
        Some(under.map_or(near, |under| SurfacePoint {
            triangle: under.triangle,
            barycentric: under.barycentric,
        }))
    }

    /// The load of a tool at a site on the organ; none without a site.
    pub(crate) fn load<'a>(&self, tool: &'a Tool, state: &ToolState) -> Option<TipLoad<'a>> {
        let (field, site) = (tool.field.as_ref()?, state.site?);
        let surface = self.enhancement.interpolation().surface();
        Some(field.at(surface, site.triangle, &site.barycentric))
    }

    /// Computes the elastic force and the stiffness of every tool in contact.
    pub(crate) fn press(
        &self,
        simulation: &Simulation,
        tools: &mut [ToolState],
        workspace: &mut GlobalWorkspace,
    ) {
        let softness = 1.0 / simulation.material.at_rest.youngs_modulus();
        for state in tools.iter_mut() {
            state.site = self.locate(simulation, state);
            state.elastic = Vec3::zeros();
            state.own = Vec3::zeros();
            state.displaced = Vec3::zeros();
            state.self_displacement = 0.0;
            state.stiffness = Matrix3::zeros();
            state.limited = Limits::NONE;
        }
        if let Some(slit) = &mut workspace.slit {
            slit.put_tips(self, simulation, tools);
        }
        self.couple(simulation, tools, softness, workspace);
        let holds = self.prepare_grasps(simulation, tools, workspace);
        if holds {
            // Due to the jaws alone: no tip has a force yet.
            self.solve_grasped_forces(simulation, tools, workspace);
        }
        let tips = tools.iter().filter(|state| state.contact.is_some()).count();
        for sweep in 1..=MAX_SWEEPS {
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            for number in 0..tools.len() {
                let before = tools[number].elastic;
                self.answer(simulation, number, tools, softness, workspace);
                let force = tools[number].elastic;
                change = change.max((force - before).norm());
                largest = largest.max(force.norm());
            }
            // A single tip is done after the first.
            if tips < 2 || change <= SETTLED * largest {
                break;
            }
            if sweep == MAX_SWEEPS {
                let reached = Reached {
                    unbounded: change / largest,
                    used: SETTLED,
                };
                for tool in tools.iter_mut() {
                    tool.limited.add(Limit::Coupling, reached);
                }
            }
        }
        if holds {
            self.solve_grasped_forces(simulation, tools, workspace);
        }
    }

    /// The compliances [m/N] between tips that touch at the same time.
    fn couple(
        &self,
        simulation: &Simulation,
        tools: &[ToolState],
        softness: f64,
        workspace: &mut GlobalWorkspace,
    ) {
        let count = tools.len();
        for (i, moved) in tools.iter().enumerate() {
            for (j, loaded) in tools.iter().enumerate().take(i) {
                let loads = (
                    self.load(&simulation.tools[i], moved),
                    self.load(&simulation.tools[j], loaded),
                );
                let between = match loads {
                    (Some(moved), Some(loaded)) => {
                        let slit = workspace.slit.as_ref();
                        let more = slit.map_or(Matrix3::zeros(), |slit| slit.between_tips(i, j));
                        (self.response.between(&moved, &loaded) + more) * softness
                    }
                    _ => Matrix3::zeros(),
                };
                workspace.between[i * count + j] = between;
                workspace.between[j * count + i] = between.transpose();
            }
        }
    }

    /// The force of one tool, given those of the others.
    fn answer(
        &self,
        simulation: &Simulation,
        number: usize,
        tools: &mut [ToolState],
        softness: f64,
        workspace: &GlobalWorkspace,
    ) {
        let tool = &simulation.tools[number];
        let (Some(contact), Some(pose)) = (tools[number].contact, tools[number].pose) else {
            return;
        };
        let GlobalWorkspace { held, between, .. } = workspace;
        let mut carried = held.tip_displacement(number, tools.len());
        let mut bounded = held.bounded(number);
        for (other, state) in tools
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != number)
        {
            let place = number * tools.len() + other;
            let by = (between[place] - held.reduction(number, other, tools.len())) * state.elastic;
            let most = MAX_CARRIED * state.self_displacement;
            if by.norm() <= most {
                carried -= by;
                continue;
            }
            carried -= by * (most / by.norm());
            bounded = Some(Reached {
                unbounded: by.norm() / state.self_displacement,
                used: MAX_CARRIED,
            });
        }
        let frame = contact.place.frame;
        let own = contact.displacement(tool, &Vec3::from(pose.position_m));
        let moved = own - frame.tr_mul(&carried);
        let load = self.load(tool, &tools[number]);
        let compliance = load.map_or(Matrix3::zeros(), |load| {
            let slit = workspace.slit.as_ref();
            let more = slit.map_or(Matrix3::zeros(), |slit| slit.further(number));
            let free = (load.structural_compliance() + more) * softness;
            frame.tr_mul(&(free - held.reduction(number, number, tools.len()))) * frame
        });
        let exchange = load.and_then(|load| {
            let place = &contact.place;
            let mesh = simulation.surface.mesh();
            let inclusions = &tool.inclusions;
            inclusions.exchange(mesh, place.triangle, &place.point, load.reach())
        });
        let state = &mut tools[number];
        let touched = state
            .site
            .and_then(|site| self.response.find(site.triangle));
        state.off_model = touched.is_none();
        let law = tool.law.on_curved_surface(contact.place.mean_curvature());
        let over = exchange.map(|exchange| (exchange, &simulation.material.at_rest));
        let (answer, compliance) = tool.force_in_series(&law, &moved, &compliance, over);
        let mut own = moved + compliance * answer.force;
        if tool.tip_friction == Friction::Frictionless {
            own = Vec3::new(0.0, 0.0, own.z);
        }
        state.self_displacement = moved.norm();
        state.own = frame * own;
        // The organ moves a slipping tip along its surface.
        state.displaced = frame * (own - compliance * answer.force) + carried;
        state.elastic = frame * answer.force;
        state.stiffness = frame * answer.stiffness * frame.transpose();
        state.limited = answer.limits;
        if let Some(reached) = bounded {
            state.limited.add(Limit::Carried, reached);
        }
    }
}
