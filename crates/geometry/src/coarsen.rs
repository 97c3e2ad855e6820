//! Fewer tetrahedra in the same body: edges collapse, the shortest first, until few enough nodes of quadratic elements
//! are left.
//!
//! A collapse must keep the body what it is: the links of the two ends meet in the link of their edge alone [Dey,
//! Edelsbrunner, Guha and Nekhayev 1999], no tetrahedron becomes flat, and no face of the boundary turns far. A vertex of the
//! boundary goes where the squared distances to the planes of the faces that it stands for are least [Garland and
//! Heckbert 1997]. Flat faces between few vertices lie inside of a convex body, and it would lose volume; in the end the
//! boundary moves outward until the volume is the one that is asked for.
//!
//! A wall needs no more than one element through its thickness, which no lattice gives ([`fill`](crate::fill)).
//!
//! *How we know*: `coarsen::…`.
//!
//! *Limits*: the number of nodes is a goal: where no edge may collapse, more are left.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::mesh::tetrahedra::six_fold_volume;
use crate::simplify::Quadric;
use crate::{NodeId, TetrahedronError, TetrahedronMesh, Vec3};

/// Volume over that of a regular tetrahedron with the same mean square edge [-]: none below this is made, unless one
/// beside it is worse.
const FLATTEST: f64 = 0.2;

/// Cosine of the angle by which a face of the boundary may turn at once [-].
const MOST_TURNED: f64 = 0.5;

/// What a distance from the planes of the boundary counts beside the same length of an edge [-].
const OFF_SURFACE: f64 = 5.0;

/// How often the boundary moves outward; each time it comes a hundred times nearer to the volume.
const INFLATIONS: usize = 4;

/// `mesh` with about as many nodes of quadratic elements as `nodes`, its vertices and edges, and the `volume` [m³]; its edges
/// are shorter where `detail` [-] at a place [m] is above one, by this factor.
///
/// # Errors
/// When what is left is no mesh, which does not happen to a sound one.
pub fn coarsen(
    mesh: &TetrahedronMesh,
    nodes: usize,
    volume: f64,
    detail: impl Fn(&Vec3) -> f64,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let mut net = Net::new(mesh);
    net.collapse_until(nodes, &detail);
    for _ in 0..INFLATIONS {
        net.inflate(volume);
    }
    net.into_mesh()
}

/// Tetrahedra that change.
struct Net {
    vertices: Vec<Vec3>,
    /// Of the boundary around each vertex.
    quadrics: Vec<Quadric>,
    /// Area that each quadric stands for, three times [m²].
    areas: Vec<f64>,
    is_boundary: Vec<bool>,
    tetrahedra: Vec<[u32; 4]>,
    /// The tetrahedra around each vertex; none around one that is gone.
    around: Vec<Vec<u32>>,
    /// How often a vertex has changed.
    versions: Vec<u32>,
    left: Left,
}

/// Numbers of what is left.
struct Left {
    vertices: usize,
    boundary: usize,
    tetrahedra: usize,
}

impl Left {
    /// Vertices and edges, but for a constant: Euler's formula.
    fn nodes(&self) -> usize {
        2 * self.vertices + self.boundary + self.tetrahedra
    }
}

/// An edge in the queue: the square of its length with what else counts [m²], its ends and their versions.
type Entry = Reverse<(ordered::Length, [u32; 2], [u32; 2])>;

mod ordered {
    /// A finite number in its order.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub(super) struct Length(pub(super) f64);

    impl Eq for Length {}

    impl PartialOrd for Length {
        fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
            Some(self.cmp(other))
        }
    }

    impl Ord for Length {
        fn cmp(&self, other: &Self) -> std::cmp::Ordering {
            self.0.total_cmp(&other.0)
        }
    }
}

impl Net {
    fn new(mesh: &TetrahedronMesh) -> Self {
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
        for (corners, _) in mesh.boundary() {
            let [a, b, c] = corners.map(|node| mesh.vertices()[node.index()]);
            let normal = (b - a).cross(&(c - a));
            let double = normal.norm();
            let plane = Quadric::of_plane(&a, &(normal / double), 0.5 * double);
            for node in corners {
                let node = node.index();
                net.is_boundary[node] = true;
                net.areas[node] += 0.5 * double;
                net.quadrics[node] = net.quadrics[node].plus(&plane);
            }
        }
        net.left.boundary = net.is_boundary.iter().filter(|&&on| on).count();
        net
    }

    fn collapse_until(&mut self, nodes: usize, detail: &dyn Fn(&Vec3) -> f64) {
        let mut queue = BinaryHeap::new();
        for vertex in 0..self.vertices.len() as u32 {
            let neighbours = self.neighbours(vertex).into_iter();
            queue.extend(
                neighbours
                    .filter(|&other| other > vertex)
                    .map(|other| self.entry([vertex, other], detail)),
            );
        }
        while self.left.nodes() > nodes {
            let Some(Reverse((_, edge, versions))) = queue.pop() else {
                return;
            };
            if edge.map(|end| self.versions[end as usize]) != versions {
                continue;
            }
            if self.try_collapse(edge) {
                let kept = edge[0];
                for other in self.neighbours(kept) {
                    // What could not collapse may now.
                    self.versions[other as usize] += 1;
                }
                for vertex in self.neighbours(kept) {
                    let neighbours = self.neighbours(vertex).into_iter();
                    queue.extend(neighbours.map(|other| self.entry([vertex, other], detail)));
                }
            }
        }
    }

    fn entry(&self, edge: [u32; 2], detail: &dyn Fn(&Vec3) -> f64) -> Entry {
        let [a, b] = edge.map(|end| end as usize);
        let [from, to] = [self.vertices[a], self.vertices[b]];
        let squared = (from - to).norm_squared() * detail(&(0.5 * (from + to))).powi(2);
        let off = match self.is_boundary[a] && self.is_boundary[b] {
            true => self.off_surface(edge, &self.places(edge)[0]),
            false => 0.0,
        };
        Reverse((
            ordered::Length(squared + OFF_SURFACE.powi(2) * off),
            edge,
            edge.map(|end| self.versions[end as usize]),
        ))
    }

    /// Mean square of the distances to the planes that both ends stand for [m²].
    fn off_surface(&self, edge: [u32; 2], place: &Vec3) -> f64 {
        let [a, b] = edge.map(|end| end as usize);
        let quadric = self.quadrics[a].plus(&self.quadrics[b]);
        quadric.at(place) / (self.areas[a] + self.areas[b])
    }

    /// Where the ends of an edge may go together, the best place first.
    fn places(&self, edge: [u32; 2]) -> [Vec3; 3] {
        let [a, b] = edge.map(|end| end as usize);
        let [from, to] = [self.vertices[a], self.vertices[b]];
        let middle = 0.5 * (from + to);
        match [self.is_boundary[a], self.is_boundary[b]] {
            [true, false] => [from; 3],
            [false, true] => [to; 3],
            [false, false] => [middle, from, to],
            [true, true] => {
                let best = self.quadrics[a].plus(&self.quadrics[b]).least_near(&middle);
                [best, from, to]
            }
        }
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
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
    fn boundary_at(&self, vertex: u32) -> Vec<[u32; 2]> {
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

    /// Whether the collapse of `edge` keeps the body what it is.
    fn keeps_topology(&self, [a, b]: [u32; 2]) -> bool {
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

    /// Collapses `edge` into its first end, if it may.
    fn try_collapse(&mut self, edge: [u32; 2]) -> bool {
        let [a, b] = edge;
        if !self.keeps_topology(edge) {
            return false;
        }
        let places = self.places(edge);
        let Some(place) = places.into_iter().find(|place| self.is_sound(edge, place)) else {
            return false;
        };
        self.vertices[a as usize] = place;
        let gone: Vec<u32> = self.around[b as usize].clone();
        for t in gone {
            let nodes = self.tetrahedra[t as usize];
            if nodes.contains(&a) {
                for node in nodes {
                    self.around[node as usize].retain(|&other| other != t);
                }
                self.left.tetrahedra -= 1;
            } else {
                self.tetrahedra[t as usize] = nodes.map(|node| if node == b { a } else { node });
                self.around[a as usize].push(t);
            }
        }
        self.around[b as usize].clear();
        let [a, b] = edge.map(|end| end as usize);
        self.left.vertices -= 1;
        if self.is_boundary[a] && self.is_boundary[b] {
            self.left.boundary -= 1;
        }
        self.is_boundary[a] |= self.is_boundary[b];
        self.quadrics[a] = self.quadrics[a].plus(&self.quadrics[b]);
        self.areas[a] += self.areas[b];
        for end in [a, b] {
            self.versions[end] += 1;
        }
        true
    }

    /// Whether the tetrahedra and the boundary around `edge` are well shaped when its ends are at `place`.
    fn is_sound(&self, [a, b]: [u32; 2], place: &Vec3) -> bool {
        let now = |node: u32| self.vertices[node as usize];
        let then = |node: u32| {
            if node == a || node == b {
                *place
            } else {
                now(node)
            }
        };
        let (mut before, mut after) = (f64::INFINITY, f64::INFINITY);
        let around = [a, b].map(|end| self.around[end as usize].iter());
        for &t in around.into_iter().flatten() {
            let nodes = self.tetrahedra[t as usize];
            before = before.min(shape(&nodes.map(now)));
            if !(nodes.contains(&a) && nodes.contains(&b)) {
                after = after.min(shape(&nodes.map(then)));
            }
        }
        if after < FLATTEST.min(before) {
            return false;
        }
        let faces = [a, b].map(|end| {
            let faces = self.boundary_at(end).into_iter();
            faces.map(move |[x, y]| [end, x, y])
        });
        faces
            .into_iter()
            .flatten()
            .filter(|face| !(face.contains(&a) && face.contains(&b)))
            .all(|face| {
                let normal = |[x, y, z]: [Vec3; 3]| (y - x).cross(&(z - x));
                let (old, new) = (normal(face.map(now)), normal(face.map(then)));
                old.dot(&new) > MOST_TURNED * old.norm() * new.norm()
            })
    }

    /// Faces of the boundary, counter-clockwise seen from outside.
    fn boundary(&self) -> Vec<[u32; 3]> {
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

    /// Moves the boundary outward, or inward, for the body to have the `volume` [m³].
    fn inflate(&mut self, volume: f64) {
        let mut normals = vec![Vec3::zeros(); self.vertices.len()];
        let (mut area, mut own) = (0.0, 0.0);
        for face in self.boundary() {
            let [a, b, c] = face.map(|node| self.vertices[node as usize]);
            let normal = 0.5 * (b - a).cross(&(c - a));
            area += normal.norm();
            own += a.dot(&normal) / 3.0;
            for node in face {
                normals[node as usize] += normal;
            }
        }
        let by = (volume - own) / area;
        for (vertex, normal) in normals.iter().enumerate() {
            let Some(outward) = normal.try_normalize(0.0) else {
                continue;
            };
            let before = self.vertices[vertex];
            self.vertices[vertex] += by * outward;
            let around = self.around[vertex].iter();
            let flat = around.map(|&t| {
                shape(&self.tetrahedra[t as usize].map(|node| self.vertices[node as usize]))
            });
            if flat.fold(f64::INFINITY, f64::min) < 0.5 * FLATTEST {
                self.vertices[vertex] = before;
            }
        }
    }

    fn into_mesh(self) -> Result<TetrahedronMesh, TetrahedronError> {
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

/// Volume over that of a regular tetrahedron with the same mean square edge [-].
fn shape(corners: &[Vec3; 4]) -> f64 {
    let [a, b, c, d] = corners;
    let edges = [b - a, c - a, d - a, c - b, d - b, d - c];
    let square = edges.iter().map(Vec3::norm_squared).sum::<f64>() / 6.0;
    std::f64::consts::SQRT_2 * six_fold_volume(corners) / square.powf(1.5)
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

/// What stands in both of two ascending lists.
fn common<T: Ord + Copy>(a: &[T], b: &[T]) -> Vec<T> {
    let both = a.iter().filter(|one| b.binary_search(one).is_ok());
    both.copied().collect()
}
