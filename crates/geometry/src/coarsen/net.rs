//! Tetrahedra under edge collapse, and their connectivity.

use super::planes;
use crate::simplify::Quadric;
use crate::{NodeId, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Tetrahedra that change.
pub(super) struct Net {
    pub(super) vertices: Vec<Vec3>,
    /// Of the boundary around each vertex.
    pub(super) quadrics: Vec<Quadric>,
    /// Area of each quadric [m²].
    pub(super) areas: Vec<f64>,
    pub(super) is_boundary: Vec<bool>,
    pub(super) tetrahedra: Vec<[u32; 4]>,
    /// The tetrahedra around each vertex; none around a removed one.
    pub(super) around: Vec<Vec<u32>>,
    /// How often a vertex has changed.
    pub(super) versions: Vec<u32>,
    pub(super) left: Left,
}

/// Counts of the remaining mesh.
pub(super) struct Left {
    pub(super) vertices: usize,
    pub(super) boundary: usize,
    pub(super) tetrahedra: usize,
}

impl Left {
    /// Vertices and edges, but for a constant: Euler's formula.
    pub(super) fn nodes(&self) -> usize {
        2 * self.vertices + self.boundary + self.tetrahedra
    }
}

impl Net {
    pub(super) fn new(mesh: &TetrahedronMesh, surface: &Surface) -> Self {
        let count = mesh.vertices().len();
        let mut net = Self {
            vertices: mesh.vertices().to_vec(),
            quadrics: vec![Quadric::zero(); count],
            areas: vec![0.0; count],
            is_boundary: vec![false; count],
            tetrahedra: mesh
                .tetrahedra()
                .iter()
                .map(|nodes| nodes.map(|node| node.0))
                .collect(),
            around: vec![Vec::new(); count],
            versions: vec![0; count],
            left: Left {
                vertices: count,
                boundary: 0,
                tetrahedra: mesh.tetrahedra().len(),
            },
        };
        for (number, nodes) in net.tetrahedra.iter().enumerate() {
            for &node in nodes {
                net.around[node as usize].push(number as u32);
            }
        }
        let known = planes::of_surface(mesh, surface.mesh());
        for (vertex, (quadric, area)) in known.iter().enumerate() {
            (net.quadrics[vertex], net.areas[vertex]) = (*quadric, *area);
        }
        for (corners, _) in mesh.boundary() {
            let [a, b, c] = corners.map(|node| mesh.vertices()[node.index()]);
            let normal = (b - a).cross(&(c - a));
            let double = normal.norm();
            for node in corners.map(|node| node.index()) {
                if known[node].1 == 0.0 {
                    let plane = Quadric::of_plane(&a, &(normal / double), double / 6.0);
                    net.quadrics[node] = net.quadrics[node].plus(&plane);
                    net.areas[node] += double / 6.0;
                }
                net.is_boundary[node] = true;
            }
        }
        net.left.boundary = net.is_boundary.iter().filter(|&&on| on).count();
        net
    }

    pub(super) fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let around = self.around[vertex as usize].iter();
        let mut all: Vec<u32> = around
            .flat_map(|&t| self.tetrahedra[t as usize])
            .filter(|&other| other != vertex)
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Faces of the tetrahedra around `vertex` opposite to it, ascending, each with its corners ascending.
    fn link(&self, vertex: u32) -> Vec<[u32; 3]> {
        let around = self.around[vertex as usize].iter();
        let mut faces: Vec<[u32; 3]> = around
            .map(|&t| without(&self.tetrahedra[t as usize], vertex))
            .collect();
        faces.sort_unstable();
        faces
    }

    /// Faces of the boundary at `vertex`: their other two corners, ascending.
    pub(super) fn boundary_at(&self, vertex: u32) -> Vec<[u32; 2]> {
        let mut edges: Vec<[u32; 2]> = self
            .link(vertex)
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [a, c], [b, c]])
            .collect();
        edges.sort_unstable();
        let alike = edges.chunk_by(|a, b| a == b);
        alike
            .filter(|alike| alike.len() == 1)
            .map(|alike| alike[0])
            .collect()
    }

    /// Whether the collapse of `edge` preserves the topology of the body.
    pub(super) fn keeps_topology(&self, [a, b]: [u32; 2]) -> bool {
        let (link_a, link_b) = (self.link(a), self.link(b));
        // With a vertex outside that is joined to all of the boundary.
        let outside = u32::MAX;
        let close = |mut link: Vec<[u32; 3]>, vertex: u32| {
            link.extend(
                self.boundary_at(vertex)
                    .iter()
                    .map(|&[x, y]| [x, y, outside]),
            );
            link.sort_unstable();
            link
        };
        let (link_a, link_b) = (close(link_a, a), close(link_b, b));
        let of_edge: Vec<[u32; 2]> = link_a
            .iter()
            .filter(|face| face.contains(&b))
            .map(|face| two_without(face, b))
            .collect();
        let vertices = |faces: &[[u32; 3]]| sorted(faces.iter().flatten().copied().collect());
        let edges = |faces: &[[u32; 3]]| {
            let pairs = faces.iter().flat_map(|&face| {
                let mut face = face;
                face.sort_unstable();
                let [a, b, c] = face;
                [[a, b], [a, c], [b, c]]
            });
            sorted(pairs.collect())
        };
        let both_vertices = common(&vertices(&link_a), &vertices(&link_b));
        let both_edges = common(&edges(&link_a), &edges(&link_b));
        let ends = sorted(of_edge.iter().flatten().copied().collect());
        let sides = sorted(
            of_edge
                .iter()
                .map(|&[x, y]| [x.min(y), x.max(y)])
                .collect::<Vec<_>>(),
        );
        both_vertices == ends && both_edges == sides && common(&link_a, &link_b).is_empty()
    }

    /// Faces of the boundary, counter-clockwise seen from outside.
    pub(super) fn boundary(&self) -> Vec<[u32; 3]> {
        let mut faces = Vec::new();
        for vertex in (0..self.vertices.len() as u32).filter(|&v| self.is_boundary[v as usize]) {
            for [x, y] in self.boundary_at(vertex) {
                // Each once.
                if vertex < x {
                    faces.push(self.turned_outward([vertex, x, y]));
                }
            }
        }
        faces
    }

    fn turned_outward(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        let inside = self.around[a as usize].iter().find_map(|&t| {
            let nodes = self.tetrahedra[t as usize];
            let others = nodes
                .iter()
                .filter(|&&node| node != a && node != b && node != c);
            (nodes.contains(&b) && nodes.contains(&c))
                .then(|| others.copied().next())
                .flatten()
        });
        let [x, y, z] = [a, b, c].map(|node| self.vertices[node as usize]);
        let outward = inside.is_none_or(|inside| {
            (y - x)
                .cross(&(z - x))
                .dot(&(x - self.vertices[inside as usize]))
                > 0.0
        });
        if outward { [a, b, c] } else { [a, c, b] }
    }

    pub(super) fn into_mesh(self) -> Result<TetrahedronMesh, TetrahedronError> {
        let alive = self
            .tetrahedra
            .iter()
            .enumerate()
            .filter(|(number, nodes)| {
                let around = &self.around[nodes[0] as usize];
                around.contains(&(*number as u32))
            });
        let tetrahedra = alive.map(|(_, nodes)| nodes.map(NodeId)).collect();
        TetrahedronMesh::new(self.vertices, tetrahedra)
    }
}

fn without(nodes: &[u32; 4], vertex: u32) -> [u32; 3] {
    let mut others = nodes.iter().copied().filter(|&node| node != vertex);
    let mut face = std::array::from_fn(|_| others.next().unwrap_or(vertex));
    face.sort_unstable();
    face
}

fn two_without(nodes: &[u32; 3], vertex: u32) -> [u32; 2] {
    let mut others = nodes.iter().copied().filter(|&node| node != vertex);
    std::array::from_fn(|_| others.next().unwrap_or(vertex))
}

fn sorted<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    list.sort_unstable();
    list.dedup();
    list
}

/// Common entries of two ascending lists.
fn common<T: Ord + Copy>(a: &[T], b: &[T]) -> Vec<T> {
    let both = a.iter().filter(|one| b.binary_search(one).is_ok());
    both.copied().collect()
}
