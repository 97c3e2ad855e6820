//! Finite elements with a slit, to judge `surface_response::Slit` by: a grid of hexahedra in six tetrahedra
//! each, whose nodes on the slit are doubled.

use std::sync::Arc;

use palpate_geometry::{NodeId, Surface, TetrahedronMesh, TriangleMesh};
use palpate_mechanics::finite_elements::{
    ElementMesh, FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
    LinearSystem, Supports,
};
use palpate_mechanics::{LinearElastic, Vec3};

/// A body between lines of a grid [m]; the top is at z = 0, and a straight slit at x = 0.
#[derive(Clone)]
pub(crate) struct Grid {
    pub(crate) lines: [Vec<f64>; 3],
    /// Whether x goes around a tube whose outside has this radius [m].
    pub(crate) around: Option<f64>,
    pub(crate) poissons_ratio: f64,
}

/// A slit down to `depth` [m].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut {
    pub(crate) length: f64,
    pub(crate) depth: f64,
    pub(crate) shape: CutShape,
}

/// How a slit runs over the top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CutShape {
    /// From −`length`/2 to `length`/2 along y.
    Straight,
    /// Around a square with sides of `length` about the origin.
    Square,
}

impl Cut {
    /// Whether a point of the top is on it, away from its ends.
    fn is_on(&self, at: &Vec3) -> bool {
        let half = 0.5 * self.length;
        match self.shape {
            CutShape::Straight => at.x.abs() < NEAR && at.y.abs() < half - NEAR,
            CutShape::Square => (at.x.abs().max(at.y.abs()) - half).abs() < NEAR,
        }
    }

    /// Whether a point is on the side of it whose nodes are doubled.
    fn is_beyond(&self, at: &Vec3) -> bool {
        match self.shape {
            CutShape::Straight => at.x > 0.0,
            CutShape::Square => at.x.abs().max(at.y.abs()) > 0.5 * self.length,
        }
    }
}

/// An even traction on a rectangle of the top: lowest and highest x and y [m].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Square {
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

impl Square {
    pub(crate) fn middle(&self) -> [f64; 2] {
        [0, 1].map(|k| 0.5 * (self.low[k] + self.high[k]))
    }

    /// Of a disc of the same area [m].
    pub(crate) fn radius(&self) -> f64 {
        let area = (self.high[0] - self.low[0]) * (self.high[1] - self.low[1]);
        (area / std::f64::consts::PI).sqrt()
    }
}

const NEAR: f64 = 1e-9;

impl Grid {
    /// Where a point of the grid is.
    pub(crate) fn place(&self, at: &Vec3) -> Vec3 {
        match self.around {
            None => *at,
            Some(radius) => {
                let (sine, cosine) = (at.x / radius).sin_cos();
                let r = radius + at.z;
                Vec3::new(r * sine, at.y, r * cosine)
            }
        }
    }

    /// Normal, across the slit and along it, at a point.
    pub(crate) fn axes(&self, at: &Vec3) -> [Vec3; 3] {
        let angle = self.around.map_or(0.0, |radius| at.x / radius);
        let (sine, cosine) = angle.sin_cos();
        [
            Vec3::new(sine, 0.0, cosine),
            Vec3::new(cosine, 0.0, -sine),
            Vec3::y(),
        ]
    }

    fn node(&self, [i, j, k]: [usize; 3]) -> usize {
        let [nx, ny, _] = self.sizes();
        let i = if self.around.is_some() && i == nx - 1 {
            0
        } else {
            i
        };
        i + nx * (j + ny * k)
    }

    fn sizes(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.lines[axis].len())
    }

    fn at(&self, ijk: [usize; 3]) -> Vec3 {
        Vec3::from_fn(|axis, _| self.lines[axis][ijk[axis]])
    }

    /// The boundary of the grid.
    pub(crate) fn surface(&self) -> Surface {
        let (mesh, _) = self.tetrahedra(None);
        let triangles = mesh
            .boundary()
            .iter()
            .map(|(corners, _)| *corners)
            .collect();
        let mesh = TriangleMesh::new(mesh.vertices().to_vec(), triangles).unwrap();
        let mut used = vec![None; mesh.vertices().len()];
        let mut kept = Vec::new();
        let mut number = |node: NodeId| {
            *used[node.index()].get_or_insert_with(|| {
                kept.push(mesh.vertices()[node.index()]);
                NodeId(kept.len() as u32 - 1)
            })
        };
        let triangles: Vec<_> = mesh
            .triangles()
            .iter()
            .map(|t| t.map(&mut number))
            .collect();
        Surface::new(TriangleMesh::new(kept, triangles).unwrap()).unwrap()
    }

    /// Tetrahedra, and where each vertex is on the grid.
    fn tetrahedra(&self, cut: Option<Cut>) -> (TetrahedronMesh, Vec<Vec3>) {
        let [nx, ny, nz] = self.sizes();
        let mut vertices = vec![Vec3::zeros(); nx * ny * nz];
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    vertices[self.node([i, j, k])] = self.at([i, j, k]);
                }
            }
        }
        let bottom = self.lines[2][0];
        let mut twins = vec![None; vertices.len()];
        if let Some(cut) = cut {
            for node in 0..vertices.len() {
                let at = vertices[node];
                let through = cut.depth >= -bottom - NEAR;
                let inside = cut.is_on(&at) && (through || at.z > -cut.depth + NEAR);
                if inside {
                    twins[node] = Some(vertices.len());
                    vertices.push(at);
                }
            }
        }
        let mut tetrahedra = Vec::new();
        for k in 0..nz - 1 {
            for j in 0..ny - 1 {
                for i in 0..nx - 1 {
                    let middle = 0.5 * (self.at([i, j, k]) + self.at([i + 1, j + 1, k + 1]));
                    let is_beyond = cut.is_some_and(|cut| cut.is_beyond(&middle));
                    // Six paths along the axes from the lowest corner to the highest.
                    for path in [
                        [0, 1, 2],
                        [1, 2, 0],
                        [2, 0, 1],
                        [1, 0, 2],
                        [0, 2, 1],
                        [2, 1, 0],
                    ] {
                        let mut corner = [i, j, k];
                        let mut corners = [0; 4];
                        for (step, place) in corners.iter_mut().enumerate() {
                            if step > 0 {
                                corner[path[step - 1]] += 1;
                            }
                            let node = self.node(corner);
                            *place = match twins[node] {
                                Some(twin) if is_beyond => twin,
                                _ => node,
                            };
                        }
                        let even = matches!(path, [0, 1, 2] | [1, 2, 0] | [2, 0, 1]);
                        if !even {
                            corners.swap(2, 3);
                        }
                        tetrahedra.push(corners.map(|node| NodeId(node as u32)));
                    }
                }
            }
        }
        let mut used = vec![false; vertices.len()];
        for node in tetrahedra.iter().flatten() {
            used[node.index()] = true;
        }
        let kept: Vec<Vec3> = vertices
            .iter()
            .zip(&used)
            .filter_map(|(at, used)| used.then_some(*at))
            .collect();
        let places = vertices.iter().map(|at| self.place(at)).collect();
        let mesh = TetrahedronMesh::new(places, tetrahedra).unwrap();
        assert_eq!(mesh.vertices().len(), kept.len());
        (mesh, kept)
    }

    /// Compliances [m/N] times E = 1 of evenly loaded squares: along the normal, across the slit and along it. `holds`
    /// says of a point of the grid whether it is held.
    pub(crate) fn compliances(
        &self,
        cut: Option<Cut>,
        holds: impl Fn(&Vec3) -> bool,
        squares: &[Square],
    ) -> Vec<[f64; 3]> {
        let (mesh, grid_places) = self.tetrahedra(cut);
        let held: Vec<bool> = grid_places.iter().map(&holds).collect();
        let elements = ElementMesh::from_tetrahedra(&mesh);
        let edges = mesh.edges();
        let mut held_nodes: Vec<usize> = (0..held.len()).filter(|&n| held[n]).collect();
        held_nodes.extend(edges.iter().enumerate().filter_map(|(number, ends)| {
            (held[ends[0].index()] && held[ends[1].index()]).then_some(held.len() + number)
        }));
        let law = Arc::new(LinearElastic::new(1.0, self.poissons_ratio).unwrap());
        let loads: Vec<Vec<(usize, f64)>> = squares
            .iter()
            .map(|square| load(&mesh, &grid_places, square))
            .collect();
        let model = FiniteElementModel::new(elements, law, Formulation::Mixed).unwrap();
        let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
        let mut supports = Supports::none(&model);
        for axis in 0..3 {
            supports = supports.fix(&model, held_nodes.iter().copied(), axis, 0.0);
        }
        let rest = FiniteElementState::at_rest(&model);
        let mut system = LinearSystem::assemble(&model, &supports, &rest, &mut workspace).unwrap();
        system.factor().unwrap();
        println!(
            "  {} tetrahedra, {} unknowns",
            mesh.tetrahedra().len(),
            model.size()
        );
        let mut answers = Vec::new();
        for (square, load) in squares.iter().zip(&loads) {
            let [x, y] = square.middle();
            let axes = self.axes(&Vec3::new(x, y, 0.0));
            answers.push(axes.map(|axis| {
                let mut right = vec![0.0; model.size()];
                for (node, part) in load {
                    for k in 0..3 {
                        right[3 * node + k] += part * axis[k];
                    }
                }
                let forces = right.clone();
                system.solve(&mut right).unwrap();
                right.iter().zip(&forces).map(|(u, f)| u * f).sum()
            }));
        }
        answers
    }
}

/// Parts of nodes in a unit force that is spread evenly over a square of the top.
fn load(mesh: &TetrahedronMesh, places: &[Vec3], square: &Square) -> Vec<(usize, f64)> {
    let edges = mesh.edges();
    let middle = |a: NodeId, b: NodeId| {
        let found = edges.binary_search(&[a.min(b), a.max(b)]).unwrap();
        mesh.vertices().len() + found
    };
    let mut load = Vec::new();
    let mut sum = 0.0;
    for (corners, _) in mesh.boundary() {
        let at = corners.map(|node| places[node.index()]);
        let centroid = at.iter().sum::<Vec3>() / 3.0;
        let inside = at.iter().all(|at| at.z.abs() < NEAR)
            && (0..2)
                .all(|k| centroid[k] > square.low[k] - NEAR && centroid[k] < square.high[k] + NEAR);
        if !inside {
            continue;
        }
        let [p, q, r] = corners.map(|node| mesh.vertices()[node.index()]);
        let area = 0.5 * (q - p).cross(&(r - p)).norm();
        sum += area;
        let [a, b, c] = corners;
        // Of quadratic triangles the middles alone bear an even traction.
        load.extend([[a, b], [b, c], [c, a]].map(|[a, b]| (middle(a, b), area / 3.0)));
    }
    let area = (square.high[0] - square.low[0]) * (square.high[1] - square.low[1]);
    assert!((sum / area - 1.0).abs() < 0.01, "{sum} {area}");
    load.iter()
        .map(|(node, part)| (*node, part / sum))
        .collect()
}

/// Sorted lines: `fine` ones and their mirror images, with a line at 0.
pub(crate) fn mirrored(positive: &[f64]) -> Vec<f64> {
    let mut lines: Vec<f64> = positive.iter().rev().map(|x| -x).collect();
    lines.push(0.0);
    lines.extend(positive);
    lines
}
