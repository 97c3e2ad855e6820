use crate::check::topology::fans;
use crate::mesh::edges::{by_edge, sides};
use crate::{Adjacency, NodeId, TriangleMesh, Vec3};

/// A removed triangle.
const GONE: [u32; 3] = [u32::MAX; 3];

/// A mesh whose edges can be collapsed and flipped. Numbers of vertices and triangles stay.
pub(super) struct Net {
    pub(super) positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    around: Vec<Vec<u32>>,
    /// On an edge with one triangle.
    pub(super) on_border: Vec<bool>,
    /// Where the surface branches or a triangle is a line; nothing there is changed.
    pinned: Vec<bool>,
    live: usize,
    /// The last query that marked each vertex.
    marks: Vec<u32>,
    question: u32,
}

impl Net {
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let vertices = mesh.vertices().len();
        let adjacency = Adjacency::new(mesh);
        let mut on_border = vec![false; vertices];
        let mut pinned = vec![false; vertices];
        for edge in by_edge(&sides(mesh.triangles())) {
            for end in [edge[0].low, edge[0].high] {
                on_border[end.index()] |= edge.len() == 1;
                pinned[end.index()] |= edge.len() > 2;
            }
        }
        for [a, b, c] in mesh.triangles() {
            if a == b || b == c || c == a {
                [a, b, c]
                    .iter()
                    .for_each(|node| pinned[node.index()] = true);
            }
        }
        for node in (0..vertices as u32).map(NodeId) {
            pinned[node.index()] |= fans(mesh, &adjacency, node) > 1;
        }
        let around = (0..vertices as u32)
            .map(|v| adjacency.around(NodeId(v)).iter().map(|t| t.0).collect())
            .collect();
        let triangles = mesh.triangles().iter();
        Self {
            positions: mesh.vertices().to_vec(),
            triangles: triangles.map(|t| t.map(|node| node.0)).collect(),
            around,
            on_border,
            pinned,
            live: mesh.triangles().len(),
            marks: vec![0; vertices],
            question: 0,
        }
    }

    /// The remaining mesh, in the order of the original.
    pub(super) fn mesh(&self) -> TriangleMesh {
        let left = self.triangles().map(|t| self.corners(t).map(NodeId));
        TriangleMesh::part_of(&self.positions, &left.collect::<Vec<_>>()).0
    }

    /// Nothing changes at the corners of this triangle.
    pub(super) fn pin(&mut self, triangle: u32) {
        for v in self.corners(triangle) {
            self.pinned[v as usize] = true;
        }
    }

    /// Whether a vertex must stay: on a border, or where the surface branches.
    pub(super) fn is_pinned(&self, vertex: u32) -> bool {
        self.pinned[vertex as usize] || self.on_border[vertex as usize]
    }

    /// How many triangles are left.
    pub(super) fn live(&self) -> usize {
        self.live
    }

    /// Numbers of the triangles that are left.
    pub(super) fn triangles(&self) -> impl Iterator<Item = u32> {
        (0..self.triangles.len() as u32).filter(|&t| self.is_live(t))
    }

    pub(super) fn is_live(&self, triangle: u32) -> bool {
        self.triangles[triangle as usize] != GONE
    }

    pub(super) fn corners(&self, triangle: u32) -> [u32; 3] {
        self.triangles[triangle as usize]
    }

    pub(super) fn placed(&self, triangle: u32) -> [Vec3; 3] {
        self.corners(triangle).map(|v| self.positions[v as usize])
    }

    /// The triangles that use a vertex; none when it was removed.
    pub(super) fn around(&self, vertex: u32) -> &[u32] {
        &self.around[vertex as usize]
    }

    /// The triangles at an edge.
    pub(super) fn at_edge(&self, a: u32, b: u32) -> impl Iterator<Item = u32> {
        let around = self.around[a as usize].iter().copied();
        around.filter(move |&t| self.corners(t).contains(&b))
    }

    /// All edges, once each, the lower number first.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let sides = self.triangles().flat_map(|t| {
            let corners = self.corners(t);
            [0, 1, 2].map(|k| (corners[k], corners[(k + 1) % 3]))
        });
        let mut edges: Vec<_> = sides.map(|(a, b)| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The vertices that share an edge with `vertex`, in ascending order.
    pub(super) fn neighbors(&self, vertex: u32) -> Vec<u32> {
        let corners = self.around(vertex).iter().flat_map(|&t| self.corners(t));
        let mut ring: Vec<_> = corners.filter(|&v| v != vertex).collect();
        ring.sort_unstable();
        ring.dedup();
        ring
    }

    /// Whether the surface stays of the same kind when the edge shrinks to a point: the link
    /// condition [Dey et al. 1999].
    pub(super) fn can_collapse(&mut self, a: u32, b: u32) -> bool {
        if self.pinned[a as usize] || self.pinned[b as usize] {
            return false;
        }
        let adjacent = self.at_edge(a, b).count();
        let inner = adjacent == 2;
        // An inner edge between two places of a border would pinch the surface.
        if adjacent == 0 || (inner && self.on_border[a as usize] && self.on_border[b as usize]) {
            return false;
        }
        // The last tetrahedron, and the last triangle of a piece.
        let fewest = if inner { 4 } else { 2 };
        let mut common = 0;
        let [theirs, both] = self.next_marks();
        let Self {
            around,
            triangles,
            marks,
            on_border,
            ..
        } = self;
        let corners = |v: u32| {
            let around = around[v as usize].iter();
            around.flat_map(|&t| triangles[t as usize])
        };
        for v in corners(b) {
            marks[v as usize] = theirs;
        }
        for v in corners(a).filter(|&v| v != a && v != b) {
            // Each of them once.
            let mark = &mut marks[v as usize];
            if *mark != theirs {
                continue;
            }
            *mark = both;
            let fewest = match on_border[v as usize] {
                true => 2,
                false => fewest,
            };
            common += 1;
            if common > adjacent || around[v as usize].len() < fewest {
                return false;
            }
        }
        common == adjacent
    }

    /// Two marks that no vertex has.
    fn next_marks(&mut self) -> [u32; 2] {
        if self.question > u32::MAX - 2 {
            self.marks.fill(0);
            self.question = 0;
        }
        self.question += 2;
        [self.question - 1, self.question]
    }

    /// Shrinks an edge to `position`; `kept` stays and `gone` is removed. The caller has checked
    /// [`Self::can_collapse`].
    pub(super) fn collapse(&mut self, kept: u32, gone: u32, position: Vec3) {
        let moved = std::mem::take(&mut self.around[gone as usize]);
        for triangle in moved {
            let corners = self.corners(triangle);
            if corners.contains(&kept) {
                for corner in corners {
                    self.around[corner as usize].retain(|&t| t != triangle);
                }
                self.triangles[triangle as usize] = GONE;
                self.live -= 1;
            } else {
                let renamed = corners.map(|v| if v == gone { kept } else { v });
                self.triangles[triangle as usize] = renamed;
                self.around[kept as usize].push(triangle);
            }
        }
        self.on_border[kept as usize] |= self.on_border[gone as usize];
        self.positions[kept as usize] = position;
    }

    /// The two triangles at an inner edge that may be flipped, with the vertices opposite of it:
    /// `[(left, apex), (right, opposite)]`, where `left` runs from `a` to `b`.
    pub(super) fn diamond(&self, a: u32, b: u32) -> Option<[(u32, u32); 2]> {
        let adjacent: Vec<u32> = self.at_edge(a, b).collect();
        let [one, other] = adjacent[..] else {
            return None;
        };
        let runs = |t: u32| {
            let corners = self.corners(t);
            (0..3).any(|k| corners[k] == a && corners[(k + 1) % 3] == b)
        };
        let (left, right) = if runs(one) {
            (one, other)
        } else {
            (other, one)
        };
        let apex = |t: u32| self.corners(t).into_iter().find(|&v| v != a && v != b);
        let (apex, opposite) = (apex(left)?, apex(right)?);
        let four = [a, b, apex, opposite];
        let free = !four.iter().any(|&v| self.pinned[v as usize])
            && runs(left)
            && !runs(right)
            && apex != opposite
            && self.at_edge(apex, opposite).next().is_none();
        free.then_some([(left, apex), (right, opposite)])
    }

    /// Replaces the edge of a diamond by the one across.
    pub(super) fn flip(&mut self, [a, b]: [u32; 2], diamond: [(u32, u32); 2]) {
        let [(left, apex), (right, opposite)] = diamond;
        self.triangles[left as usize] = [a, opposite, apex];
        self.triangles[right as usize] = [opposite, b, apex];
        self.around[b as usize].retain(|&t| t != left);
        self.around[a as usize].retain(|&t| t != right);
        self.around[opposite as usize].push(left);
        self.around[apex as usize].push(right);
    }
}
