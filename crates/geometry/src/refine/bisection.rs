use std::collections::HashMap;

use crate::mesh::tetrahedra::{between_regions, faces, longest_edge, matched};
use crate::{NodeId, TetrahedronError, TetrahedronMesh, Vec3};

pub(super) type Edge = [u32; 2];

/// A tetrahedron with the edges at which it and its descendants are bisected.
#[derive(Debug, Clone, Copy)]
struct Marked {
    nodes: [u32; 4],
    /// The edge that is cut next.
    cut: Edge,
    /// The marked edge of the face that leaves out each corner.
    marks: [Edge; 4],
    /// Set for the children of an unflagged planar one.
    flag: bool,
    /// Whether the face that leaves out each corner lies on the boundary.
    boundary: [bool; 4],
    region: u32,
}

/// Tetrahedra under bisection. One child replaces its parent, the other is appended.
pub(super) struct Bisection {
    pub(super) vertices: Vec<Vec3>,
    tetrahedra: Vec<Marked>,
    /// Tetrahedra around each vertex.
    pub(super) around: Vec<Vec<u32>>,
    /// The vertex in the middle of an edge that was cut. Never walked over.
    middles: HashMap<Edge, u32>,
    /// Boundary vertices made since the last query, each with the ends of its edge.
    pub(super) new_on_boundary: Vec<(u32, Edge)>,
    pending: Vec<u32>,
}

impl Bisection {
    pub(super) fn new(mesh: &TetrahedronMesh) -> Self {
        let vertices = mesh.vertices().to_vec();
        let mut around = vec![Vec::new(); vertices.len()];
        let mut tetrahedra = Vec::with_capacity(mesh.tetrahedra().len());
        for (number, nodes) in mesh.tetrahedra().iter().enumerate() {
            let nodes = nodes.map(|node| node.0);
            for node in nodes {
                around[node as usize].push(number as u32);
            }
            tetrahedra.push(marked(&vertices, nodes, mesh.region(number)));
        }
        let sorted = faces(mesh.tetrahedra());
        for alike in matched(&sorted).filter(|alike| alike.len() == 1) {
            tetrahedra[alike[0].tetrahedron as usize].boundary[alike[0].opposite as usize] = true;
        }
        Self {
            vertices,
            tetrahedra,
            around,
            middles: HashMap::new(),
            new_on_boundary: Vec::new(),
            pending: Vec::new(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.tetrahedra.len()
    }

    pub(super) fn nodes(&self, tetrahedron: u32) -> [u32; 4] {
        self.tetrahedra[tetrahedron as usize].nodes
    }

    pub(super) fn positions(&self, tetrahedron: u32) -> [Vec3; 4] {
        self.nodes(tetrahedron)
            .map(|node| self.vertices[node as usize])
    }

    pub(super) fn longest_edge(&self, tetrahedron: u32) -> f64 {
        longest_edge(&self.positions(tetrahedron))
    }

    /// Whether each vertex lies on the boundary.
    pub(super) fn on_boundary(&self) -> Vec<bool> {
        let mut on_boundary = vec![false; self.vertices.len()];
        for tetrahedron in &self.tetrahedra {
            for face in (0..4).filter(|&k| tetrahedron.boundary[k]) {
                for corner in (0..4).filter(|&k| k != face) {
                    on_boundary[tetrahedron.nodes[corner] as usize] = true;
                }
            }
        }
        on_boundary
    }

    /// Whether several regions meet in each vertex.
    pub(super) fn between_regions(&self) -> Vec<bool> {
        let each = self.tetrahedra.iter().map(|one| (one.nodes, one.region));
        between_regions(self.vertices.len(), each)
    }

    /// Bisects each of `chosen` once, and then others until no vertex lies in the middle of an edge.
    pub(super) fn bisect(&mut self, chosen: &[u32]) {
        for &tetrahedron in chosen {
            self.bisect_one(tetrahedron);
        }
        while let Some(tetrahedron) = self.pending.pop() {
            if self.hangs(tetrahedron) {
                self.bisect_one(tetrahedron);
            }
        }
    }

    pub(super) fn into_mesh(self) -> Result<TetrahedronMesh, TetrahedronError> {
        let corners = self.tetrahedra.iter().map(|t| t.nodes.map(NodeId));
        let regions = self.tetrahedra.iter().map(|t| t.region);
        TetrahedronMesh::new(self.vertices, corners.collect())?.with_regions(regions.collect())
    }

    fn hangs(&self, tetrahedron: u32) -> bool {
        let [a, b, c, d] = self.nodes(tetrahedron);
        [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]
            .into_iter()
            .any(|edge| self.middles.contains_key(&sorted(edge)))
    }

    fn bisect_one(&mut self, number: u32) {
        let parent = self.tetrahedra[number as usize];
        let [a, b] = parent.cut;
        let middle = self.middle(a, b);
        let place = |node| parent.nodes.iter().position(|&n| n == node);
        let (Some(at_a), Some(at_b)) = (place(a), place(b)) else {
            return;
        };
        let mut rest = (0..4).filter(|&k| k != at_a && k != at_b);
        let (Some(at_c), Some(at_d)) = (rest.next(), rest.next()) else {
            return;
        };
        let (c, d) = (parent.nodes[at_c], parent.nodes[at_d]);
        // Planar: the marks of the two uncut faces meet in a corner.
        let meeting = [c, d].into_iter().find(|&x| {
            sorted([a, x]) == sorted(parent.marks[at_b])
                && sorted([b, x]) == sorted(parent.marks[at_a])
        });
        let between = match meeting {
            Some(x) if parent.flag => [middle, x],
            _ => [c, d],
        };
        let child = |kept: u32, at_kept: usize, at_lost: usize| {
            let mut child = parent;
            child.nodes[at_lost] = middle;
            child.cut = parent.marks[at_lost];
            child.marks[at_kept] = between;
            child.marks[at_c] = [kept, d];
            child.marks[at_d] = [kept, c];
            child.flag = meeting.is_some() && !parent.flag;
            child.boundary[at_kept] = false;
            child
        };
        let second = self.tetrahedra.len() as u32;
        self.tetrahedra[number as usize] = child(a, at_a, at_b);
        self.tetrahedra.push(child(b, at_b, at_a));
        for entry in &mut self.around[b as usize] {
            if *entry == number {
                *entry = second;
            }
        }
        for node in [c, d] {
            self.around[node as usize].push(second);
        }
        self.around[middle as usize].extend([number, second]);
        self.pending.extend([number, second]);
    }

    /// The vertex in the middle of an edge. When it is new, all who have the edge must be cut.
    fn middle(&mut self, a: u32, b: u32) -> u32 {
        if let Some(&middle) = self.middles.get(&sorted([a, b])) {
            return middle;
        }
        let middle = self.vertices.len() as u32;
        self.middles.insert(sorted([a, b]), middle);
        let [low, high] = sorted([a, b]).map(|node| self.vertices[node as usize]);
        self.vertices.push(0.5 * (low + high));
        self.around.push(Vec::new());
        let mut on_boundary = false;
        for &number in &self.around[a as usize] {
            let tetrahedron = &self.tetrahedra[number as usize];
            if !tetrahedron.nodes.contains(&b) {
                continue;
            }
            self.pending.push(number);
            on_boundary |=
                (0..4).any(|k| tetrahedron.boundary[k] && ![a, b].contains(&tetrahedron.nodes[k]));
        }
        if on_boundary {
            self.new_on_boundary.push((middle, [a, b]));
        }
        middle
    }
}

fn sorted([a, b]: Edge) -> Edge {
    [a.min(b), a.max(b)]
}

/// Marked by longest edges, ties settled by numbers: neighbours agree about their face.
fn marked(vertices: &[Vec3], nodes: [u32; 4], region: u32) -> Marked {
    let key = |edge: Edge| {
        let [low, high] = sorted(edge);
        let squared = (vertices[high as usize] - vertices[low as usize]).norm_squared();
        (squared, low, high)
    };
    let longest = |corners: &[u32]| {
        let mut best = [corners[0], corners[1]];
        for (k, &a) in corners.iter().enumerate() {
            for &b in &corners[..k] {
                let (one, other) = (key([a, b]), key(best));
                let order = one.0.total_cmp(&other.0);
                if order.then((one.1, one.2).cmp(&(other.1, other.2))).is_gt() {
                    best = [a, b];
                }
            }
        }
        best
    };
    let [a, b, c, d] = nodes;
    Marked {
        nodes,
        cut: longest(&nodes),
        marks: [[b, c, d], [a, c, d], [a, b, d], [a, b, c]].map(|face| longest(&face)),
        flag: false,
        boundary: [false; 4],
        region,
    }
}
