use nalgebra::Matrix3;

use super::super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::super::rigid_tool::{ContactSurface, ToolLoad};
use super::frame::{Conditions, Frame};
use super::mesh::EDGES;
use super::solve::ToolIncrement;
use crate::{FibreField, Strain, Vec3};

/// A solid in equilibrium, in the frame of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidAnswer {
    /// Force on the tissue in the patch [N]; zero without a patch.
    pub force: Vec3,
    /// Its component along the displacement [N].
    pub force_along: f64,
    /// Force on the tissue at the fixed nodes [N].
    pub reaction: Vec3,
    /// Strain energy [J].
    pub energy: f64,
    /// Root mean square of the displacement over the body [m].
    pub mean_displacement: f64,
    /// Displacement of each requested point [m].
    pub points: Vec<Vec3>,
    /// The deformed cavities, in the order of the regions.
    pub cavities: Vec<CavityAnswer>,
    /// Force on each tool at each step on its path.
    pub tools: Vec<ToolIncrement>,
    /// Area of the patch at rest [m²].
    pub patch_area: f64,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Numbers in the factors; each has eight bytes.
    pub factor_entries: usize,
    /// Fields for display.
    pub fields: SolidFields,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// A cavity of a solid in equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CavityAnswer {
    /// Number of its region, from 0.
    pub region: usize,
    /// Pressure on its wall [Pa].
    pub pressure: f64,
    /// The volume that the wall encloses at rest [m³].
    pub volume_at_rest: f64,
    /// The same now [m³]; for small strain to the first order.
    pub volume: f64,
}

/// Fields of a grid of quadratic tetrahedra, at its nodes and in its cells.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidFields {
    /// Nodes at rest [m].
    pub positions: Vec<Vec3>,
    /// Ten nodes for each tetrahedron: corners, then the middles of 01, 12, 02, 03, 13, 23.
    pub cells: Vec<u32>,
    /// Corners of the outer boundary, ascending; walls of cavities are not of it.
    pub surface: Vec<usize>,
    /// The region of each tetrahedron: 0, or one of the problem from 1.
    pub regions: Vec<u32>,
    /// Displacement of each node [m].
    pub displacements: Vec<Vec3>,
    /// Mean stress at each node, tension positive [Pa]; on a border that of one of the regions.
    pub pressures: Vec<f64>,
    /// Von Mises' equivalent stress of each tetrahedron, of its mean Cauchy stress [Pa].
    pub equivalent_stresses: Vec<f64>,
    /// Pressure of tools on the boundary at each node [Pa]; empty without tools.
    pub contact_pressures: Vec<f64>,
    /// Reference axis of the fibres in the middle of each tetrahedron, of length one [-]; empty without fibres.
    pub fibre_axes: Vec<Vec3>,
}

impl SolidAnswer {
    pub(super) fn new(
        model: &FiniteElementModel,
        state: &FiniteElementState,
        workspace: &FiniteElementWorkspace,
        conditions: &Conditions<'_>,
        along: Option<&Vec3>,
    ) -> Self {
        let Conditions {
            frame, prescribed, ..
        } = conditions;
        let sum = |nodes: &[usize]| -> Vec3 {
            let forces = nodes.iter().map(|&node| workspace.reaction(model, node));
            frame.in_scene(&forces.sum())
        };
        let force = sum(&prescribed.moved);
        Self {
            force,
            force_along: along.map_or(0.0, |along| force.dot(&along.normalize())),
            reaction: sum(&prescribed.anchored),
            energy: workspace.energy(),
            mean_displacement: mean_displacement(model, state),
            points: Vec::new(),
            cavities: Vec::new(),
            tools: Vec::new(),
            patch_area: prescribed.area,
            unknowns: model.size(),
            factor_entries: workspace.factor_entries(),
            fields: SolidFields::new(model, state, frame),
            warnings: Vec::new(),
        }
    }
}

impl SolidAnswer {
    /// Force on each tool at the end of each part of its path.
    pub fn waypoints(&self) -> Vec<&[ToolLoad]> {
        let ends = self.tools.iter();
        let ends = ends.filter(|step| step.along >= 1.0 && step.along.fract() == 0.0);
        ends.map(|step| step.loads.as_slice()).collect()
    }

    /// Root mean square over the ends of the parts of its path of the force on a tool [N]; where it touches nothing, the least
    /// positive number, which has a relative change.
    pub(super) fn force_on_tool(&self, tool: usize) -> f64 {
        let ends = self.waypoints();
        let squares = ends.iter().map(|loads| loads[tool].force.norm_squared());
        let mean = squares.sum::<f64>() / ends.len().max(1) as f64;
        mean.sqrt().max(f64::MIN_POSITIVE)
    }
}

impl SolidFields {
    fn new(model: &FiniteElementModel, state: &FiniteElementState, frame: &Frame) -> Self {
        let nodes = &model.mesh.nodes;
        let displacement = |node| frame.in_scene(&state.displacement(model, node));
        Self {
            positions: nodes.iter().map(|x| frame.in_scene(x)).collect(),
            cells: model.mesh.elements.clone(),
            surface: Vec::new(),
            regions: Vec::new(),
            displacements: (0..nodes.len()).map(displacement).collect(),
            pressures: pressures(model, state),
            equivalent_stresses: (0..model.mesh.len())
                .map(|element| equivalent_stress(model, state, element))
                .collect(),
            contact_pressures: Vec::new(),
            fibre_axes: Vec::new(),
        }
    }

    /// Puts the pressures [Pa] at the corners of `surface` in; in the middles of edges they are the mean.
    pub(super) fn set_contact_pressures(&mut self, surface: &ContactSurface, pressures: &[f64]) {
        let mut at_nodes = vec![0.0; self.positions.len()];
        for (node, pressure) in surface.nodes().zip(pressures) {
            at_nodes[node] = *pressure;
        }
        for cell in self.cells.chunks_exact(10) {
            for (middle, ends) in cell[4..].iter().zip(EDGES) {
                let [from, to] = ends.map(|end| at_nodes[cell[end] as usize]);
                at_nodes[*middle as usize] = 0.5 * (from + to);
            }
        }
        self.contact_pressures = at_nodes;
    }

    /// Puts the axes of these fibres in.
    pub(super) fn set_fibres(&mut self, fibres: &FibreField) {
        let middle = |cell: &[u32]| {
            let corners = cell[..4].iter();
            corners
                .map(|&node| self.positions[node as usize])
                .sum::<Vec3>()
                / 4.0
        };
        let cells = self.cells.chunks_exact(10);
        let axes = cells.map(|cell| *fibres.at(&middle(cell)).axis());
        self.fibre_axes = axes.collect();
    }
}

/// Root mean square over the volume [m].
fn mean_displacement(model: &FiniteElementModel, state: &FiniteElementState) -> f64 {
    let (mapping, kind) = (&model.mapping, model.mesh.kind);
    let shapes = mapping.at.iter().map(|at| {
        let mut shape = vec![0.0; kind.nodes()];
        kind.shape(*at, &mut shape);
        shape
    });
    let shapes: Vec<Vec<f64>> = shapes.collect();
    let (mut squares, mut volume) = (0.0, 0.0);
    for (element, weights) in mapping.weights.chunks_exact(mapping.points).enumerate() {
        let nodes = model.mesh.element(element).iter();
        let moved: Vec<Vec3> = nodes
            .map(|&node| state.displacement(model, node as usize))
            .collect();
        for (shape, weight) in shapes.iter().zip(weights) {
            let here: Vec3 = shape.iter().zip(&moved).map(|(n, u)| *n * u).sum();
            squares += weight * here.norm_squared();
            volume += weight;
        }
    }
    (squares / volume).sqrt()
}

/// At the corners the unknowns, between them their mean.
fn pressures(model: &FiniteElementModel, state: &FiniteElementState) -> Vec<f64> {
    let mut at_nodes = vec![0.0; model.mesh.nodes.len()];
    let local = model.local_unknowns();
    for element in 0..model.mesh.len() {
        let numbers = &model.unknowns[element * local..][30..34];
        let corners: Vec<f64> = numbers
            .iter()
            .map(|&number| state.unknowns[number as usize])
            .collect();
        let nodes = model.mesh.element(element);
        for (node, pressure) in nodes.iter().zip(&corners) {
            at_nodes[*node as usize] = *pressure;
        }
        for (node, [a, b]) in nodes[4..].iter().zip(EDGES) {
            at_nodes[*node as usize] = 0.5 * (corners[a] + corners[b]);
        }
    }
    at_nodes
}

fn equivalent_stress(
    model: &FiniteElementModel,
    state: &FiniteElementState,
    element: usize,
) -> f64 {
    let mapping = &model.mapping;
    let (mut mean, mut volume) = (Matrix3::zeros(), 0.0);
    for point in element * mapping.points..(element + 1) * mapping.points {
        let mut f = Matrix3::identity();
        let gradients = mapping.gradients[30 * point..30 * (point + 1)].chunks_exact(3);
        for (node, g) in model.mesh.element(element).iter().zip(gradients) {
            let u = state.displacement(model, *node as usize);
            f += u * Vec3::from_column_slice(g).transpose();
        }
        let law = model.law_at(point);
        let stress = law.distortion_stress(&f);
        let cauchy = match law.volume().strain {
            Strain::Small => stress,
            Strain::Finite => stress * f.transpose() / f.determinant(),
        };
        mean += mapping.weights[point] * cauchy;
        volume += mapping.weights[point];
    }
    mean /= volume;
    let deviator = mean - mean.trace() / 3.0 * Matrix3::identity();
    (1.5 * deviator.norm_squared()).sqrt()
}
