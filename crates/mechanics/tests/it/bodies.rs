//! Blocks of finite elements, distorted or not, and their faces.

use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_geometry::TetrahedronMesh;
use palpate_mechanics::finite_elements::{
    ElementKind, ElementMesh, FiniteElementModel, FiniteElementState, FiniteElementWorkspace,
    Formulation, Supports, equilibrate,
};
use palpate_mechanics::{Error, Law, Vec3};

use crate::contacts::Random;

pub(crate) const KINDS: [ElementKind; 3] =
    [ElementKind::Quad9, ElementKind::Hex27, ElementKind::Tet10];

/// From the origin to (1, 1, 1), or r and z from 0 to 1, with `cells` along each axis; inner nodes are
/// shaken by up to `shake` of a cell.
pub(crate) fn block(kind: ElementKind, cells: usize, shake: f64) -> ElementMesh {
    let line: Vec<f64> = (0..=cells).map(|i| i as f64 / cells as f64).collect();
    let mut mesh = match kind {
        ElementKind::Quad9 => ElementMesh::grid(&line, &line, |r, z| [r, z]),
        ElementKind::Hex27 => hexahedra(cells),
        ElementKind::Tet10 => tetrahedra(cells, shake),
    };
    // Edges of tetrahedra stay straight: their vertices were shaken.
    if kind != ElementKind::Tet10 {
        shake_inside(
            &mut mesh.nodes,
            shake / (2 * cells) as f64,
            kind.dimension(),
        );
    }
    mesh
}

fn shake_inside(nodes: &mut [Vec3], by: f64, dimension: usize) {
    let mut random = Random(11);
    for node in nodes {
        let inside = |x: &f64| *x > 1e-9 && *x < 1.0 - 1e-9;
        let shake = by * random.vector();
        if node.iter().take(dimension).all(inside) {
            for i in 0..dimension {
                node[i] += shake[i];
            }
        }
    }
}

fn hexahedra(cells: usize) -> ElementMesh {
    let width = 2 * cells + 1;
    let place = |n: usize| n as f64 / (2 * cells) as f64;
    let mut nodes = Vec::new();
    for n in 0..width.pow(3) {
        nodes.push(Vec3::new(
            place(n % width),
            place(n / width % width),
            place(n / width.pow(2)),
        ));
    }
    let mut elements = Vec::new();
    for cell in 0..cells.pow(3) {
        let first = [cell % cells, cell / cells % cells, cell / cells.pow(2)].map(|i| 2 * i);
        elements.extend((0..27).map(|n| {
            let at = [n % 3, n / 3 % 3, n / 9];
            let [i, j, k] = [0, 1, 2].map(|d| first[d] + at[d]);
            (i + j * width + k * width * width) as u32
        }));
    }
    ElementMesh {
        kind: ElementKind::Hex27,
        nodes,
        elements,
    }
}

fn tetrahedra(cells: usize, shake: f64) -> ElementMesh {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [cells; 3]).unwrap();
    let mut nodes = block.vertices().to_vec();
    shake_inside(&mut nodes, 0.5 * shake / cells as f64, 3);
    let edges = block.edges();
    let vertices = nodes.len();
    for edge in &edges {
        let [a, b] = edge.map(|node| nodes[node.index()]);
        nodes.push(0.5 * (a + b));
    }
    let mut elements = Vec::new();
    for corners in block.tetrahedra() {
        elements.extend(corners.map(|node| node.0));
        for [a, b] in [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]] {
            let ends = [corners[a].min(corners[b]), corners[a].max(corners[b])];
            let found = edges.binary_search(&ends).unwrap();
            elements.push((vertices + found) as u32);
        }
    }
    ElementMesh {
        kind: ElementKind::Tet10,
        nodes,
        elements,
    }
}

/// Nodes where the coordinate `axis` is `at`.
pub(crate) fn face(mesh: &ElementMesh, axis: usize, at: f64) -> Vec<usize> {
    mesh.nodes_where(|x| (x[axis] - at).abs() < 1e-9)
}

/// All nodes of the block's boundary; in an axisymmetric body with those of the axis.
pub(crate) fn boundary(mesh: &ElementMesh) -> Vec<usize> {
    let dimension = mesh.kind.dimension();
    mesh.nodes_where(|x| {
        x.iter()
            .take(dimension)
            .any(|x| x.abs() < 1e-9 || (x - 1.0).abs() < 1e-9)
    })
}

/// A body, its state and what it takes to solve it.
pub(crate) struct Body {
    pub(crate) model: FiniteElementModel,
    pub(crate) state: FiniteElementState,
    pub(crate) workspace: FiniteElementWorkspace,
}

impl Body {
    pub(crate) fn new(mesh: ElementMesh, law: Arc<dyn Law>, formulation: Formulation) -> Self {
        let model = FiniteElementModel::new(mesh, law, formulation).unwrap();
        Self {
            state: FiniteElementState::at_rest(&model),
            workspace: FiniteElementWorkspace::new(&model).unwrap(),
            model,
        }
    }

    pub(crate) fn solve(
        &mut self,
        supports: impl FnOnce(&FiniteElementModel) -> Supports<'static>,
    ) -> Result<(), Error> {
        let supports = supports(&self.model);
        equilibrate(&self.model, &supports, &mut self.state, &mut self.workspace).map(drop)
    }

    /// Force of the supports along `axis` over `nodes` [N].
    pub(crate) fn force(&self, nodes: &[usize], axis: usize) -> f64 {
        let each = |&node: &usize| self.workspace.reaction(&self.model, node)[axis];
        nodes.iter().map(each).sum()
    }

    /// Largest distance of a node from where `f` (of x) puts it [m].
    pub(crate) fn off(&self, place: impl Fn(&Vec3) -> Vec3) -> f64 {
        let nodes = self.model.mesh().nodes.iter().enumerate();
        nodes
            .map(|(node, x)| (x + self.state.displacement(&self.model, node) - place(x)).norm())
            .fold(0.0, f64::max)
    }
}

/// `nodes` held where the deformation gradient `f` puts them.
pub(crate) fn at_map(
    model: &FiniteElementModel,
    nodes: &[usize],
    f: &Matrix3<f64>,
) -> Supports<'static> {
    let mut supports = Supports::none(model);
    for &node in nodes {
        let x = model.mesh().nodes[node];
        let moved = f * x - x;
        for axis in 0..model.dimension() {
            supports = supports.fix(model, [node], axis, moved[axis]);
        }
    }
    supports
}
