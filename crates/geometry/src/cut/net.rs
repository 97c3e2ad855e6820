use super::{MIN_CAPACITY, SPARE};
use crate::{NodeId, Surface, TriangleId, TriangleMesh, Vec3};

/// A side of a cut, seen along the way of the blade from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Left of the blade.
    Left,
    /// Right of the blade: the side of (7.7).
    Right,
}

impl Side {
    fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// The place of a vertex on the uncut surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Origin {
    /// A triangle of that surface.
    pub triangle: TriangleId,
    /// Weights of its corners [-].
    pub barycentric: [f64; 3],
}

/// Data of a vertex apart from its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub(super) origin: Origin,
    /// Direction in which an opening pulls it: a unit vector, or zero where nothing opens [-].
    pub(super) opening: Vec3,
    pub(super) side: Option<Side>,
}

/// Data of a triangle apart from its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Facet {
    /// The triangle across each edge, whether the edge is open or not.
    pub(super) across: [TriangleId; 3],
    /// On which side of an opening this triangle lies, at each edge.
    pub(super) open: [Option<Side>; 3],
    /// The triangle of the surface that it is part of.
    pub(super) parent: TriangleId,
}

/// A vertex seen from one of its triangles. All vertices into which a cut has parted one are reached
/// by going around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) triangle: TriangleId,
    pub(super) place: usize,
}

/// The state before a change.
#[derive(Debug, Clone, Copy)]
enum UndoEntry {
    Triangle(TriangleId, [NodeId; 3], Facet),
    Node(NodeId, Vec3, Node),
}

/// Counts at the beginning of a cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark {
    changes: usize,
    nodes: usize,
    triangles: usize,
}

/// The mesh, its neighbours and an undo log. All changes go through `set_triangle` and `set_node`,
/// so that all can be undone.
#[derive(Debug, Clone)]
pub(super) struct Net {
    pub(super) mesh: TriangleMesh,
    pub(super) facets: Vec<Facet>,
    pub(super) nodes: Vec<Node>,
    undo_log: Vec<UndoEntry>,
}

impl Net {
    pub(super) fn new(surface: &Surface) -> Self {
        let mut mesh = surface.mesh().clone();
        let facets = mesh.triangle_ids().map(|triangle| Facet {
            across: surface
                .adjacency()
                .across(triangle)
                .map(|other| other.expect("a surface is closed")),
            open: [None; 3],
            parent: triangle,
        });
        let nodes = (0..mesh.vertices().len()).map(|number| {
            let node = NodeId(number as u32);
            let triangle = surface.adjacency().around(node)[0];
            let weight = |corner| f64::from(u8::from(corner == node));
            Node {
                origin: Origin {
                    triangle,
                    barycentric: mesh.corners(triangle).map(weight),
                },
                opening: Vec3::zeros(),
                side: None,
            }
        });
        let (mut facets, mut nodes): (Vec<Facet>, Vec<Node>) = (facets.collect(), nodes.collect());
        let more = |count: usize| ((SPARE * count as f64) as usize).max(MIN_CAPACITY);
        let [more_nodes, more_facets] = [more(nodes.len()), more(facets.len())];
        nodes.reserve(more_nodes);
        facets.reserve(more_facets);
        mesh.reserve(more_nodes, more_facets);
        Self {
            // A new triangle changes itself and its neighbours, some of them twice.
            undo_log: Vec::with_capacity(8 * more_facets),
            facets,
            nodes,
            mesh,
        }
    }

    pub(super) fn facet(&self, triangle: TriangleId) -> &Facet {
        &self.facets[triangle.index()]
    }

    pub(super) fn node_at(&self, corner: Corner) -> NodeId {
        self.mesh.corners(corner.triangle)[corner.place]
    }

    pub(super) fn position(&self, corner: Corner) -> Vec3 {
        self.mesh.positions(corner.triangle)[corner.place]
    }

    pub(super) fn set_triangle(&mut self, id: TriangleId, corners: [NodeId; 3], facet: Facet) {
        let before = UndoEntry::Triangle(id, self.mesh.corners(id), *self.facet(id));
        self.undo_log.push(before);
        self.mesh.replace_corners(id, corners);
        self.facets[id.index()] = facet;
    }

    pub(super) fn set_node(&mut self, id: NodeId, position: Vec3, node: Node) {
        let (place, before) = (self.mesh.vertices()[id.index()], self.nodes[id.index()]);
        if place != position || before != node {
            self.undo_log.push(UndoEntry::Node(id, place, before));
            self.mesh.move_vertex(id, position);
            self.nodes[id.index()] = node;
        }
    }

    pub(super) fn push_node(&mut self, position: Vec3, node: Node) -> NodeId {
        self.nodes.push(node);
        self.mesh.push_vertex(position)
    }

    pub(super) fn push_triangle(&mut self, corners: [NodeId; 3], facet: Facet) -> TriangleId {
        self.facets.push(facet);
        self.mesh.push_triangle(corners)
    }

    pub(super) fn mark(&self) -> Mark {
        Mark {
            changes: self.undo_log.len(),
            nodes: self.nodes.len(),
            triangles: self.facets.len(),
        }
    }

    /// Makes everything as it was at `mark`.
    pub(super) fn restore(&mut self, mark: Mark) {
        while self.undo_log.len() > mark.changes {
            match self.undo_log.pop() {
                Some(UndoEntry::Triangle(id, corners, facet)) => {
                    self.mesh.replace_corners(id, corners);
                    self.facets[id.index()] = facet;
                }
                Some(UndoEntry::Node(id, position, node)) => {
                    self.mesh.move_vertex(id, position);
                    self.nodes[id.index()] = node;
                }
                None => break,
            }
        }
        self.mesh.truncate(mark.nodes, mark.triangles);
        self.nodes.truncate(mark.nodes);
        self.facets.truncate(mark.triangles);
    }

    /// The next corner of the same vertex, counter-clockwise.
    pub(super) fn next(&self, corner: Corner) -> Corner {
        let edge = (corner.place + 2) % 3;
        let triangle = self.facet(corner.triangle).across[edge];
        Corner {
            triangle,
            place: self.edge_towards(triangle, corner.triangle),
        }
    }

    /// The next corner of the same vertex, clockwise.
    pub(super) fn previous(&self, corner: Corner) -> Corner {
        let triangle = self.facet(corner.triangle).across[corner.place];
        Corner {
            triangle,
            place: (self.edge_towards(triangle, corner.triangle) + 1) % 3,
        }
    }

    /// The edge of `triangle` beyond which `other` lies.
    pub(super) fn edge_towards(&self, triangle: TriangleId, other: TriangleId) -> usize {
        let across = self.facet(triangle).across;
        across
            .iter()
            .position(|&there| there == other)
            .expect("neighbours know one another")
    }

    /// All corners of a vertex, counter-clockwise, over openings too.
    pub(super) fn around(&self, start: Corner) -> impl Iterator<Item = Corner> {
        std::iter::successors(Some(start), move |&corner| {
            Some(self.next(corner)).filter(|&next| next != start)
        })
    }

    /// How many open edges end in a vertex.
    pub(super) fn openings_at(&self, corner: Corner) -> usize {
        self.around(corner).filter(|&c| self.starts_fan(c)).count()
    }

    fn starts_fan(&self, corner: Corner) -> bool {
        self.facet(corner.triangle).open[corner.place].is_some()
    }

    /// Opens the edge of a triangle that lies on `side` of it. One end must be open already or
    /// become so before anyone looks: else both sides would share both ends.
    pub(super) fn open(&mut self, triangle: TriangleId, edge: usize, side: Side) {
        let mate = self.facet(triangle).across[edge];
        let back = self.edge_towards(mate, triangle);
        for (id, edge, side) in [(triangle, edge, side), (mate, back, side.other())] {
            let mut facet = *self.facet(id);
            facet.open[edge] = Some(side);
            self.set_triangle(id, self.mesh.corners(id), facet);
        }
        let (right, edge) = match side {
            Side::Right => (triangle, edge),
            Side::Left => (mate, back),
        };
        for place in [edge, (edge + 1) % 3] {
            self.part(Corner {
                triangle: right,
                place,
            });
        }
    }

    /// Gives each fan of triangles between open edges a vertex of its own; the fan of `keeper` keeps
    /// the one that is there.
    pub(super) fn part(&mut self, keeper: Corner) {
        let count = self.openings_at(keeper);
        if count == 0 {
            return;
        }
        let mut start = keeper;
        while !self.starts_fan(start) {
            start = self.previous(start);
        }
        for turn in 0..count {
            let taken = turn > 0 && self.is_taken(start, turn);
            start = self.assign_fan(start, taken, count > 1);
        }
    }

    /// Whether one of the `before` fans before this one has its vertex.
    fn is_taken(&self, start: Corner, before: usize) -> bool {
        let node = self.node_at(start);
        let (mut corner, mut fans) = (start, 0);
        while fans < before {
            corner = self.previous(corner);
            if self.starts_fan(corner) {
                fans += 1;
                if self.node_at(corner) == node {
                    return true;
                }
            }
        }
        false
    }

    /// Sets the vertex of the fan that begins at `start`. The beginning of the next fan.
    fn assign_fan(&mut self, start: Corner, taken: bool, opens: bool) -> Corner {
        let here = self.position(start);
        let towards = |net: &Self, corner: Corner, step: usize| {
            let end = net.mesh.positions(corner.triangle)[(corner.place + step) % 3];
            (end - here).try_normalize(0.0).unwrap_or_default()
        };
        let first = towards(self, start, 1);
        let (mut normal, mut corner) = (Vec3::zeros(), start);
        let last = loop {
            normal += self.mesh.area_vector(corner.triangle);
            let last = towards(self, corner, 2);
            corner = self.next(corner);
            if self.starts_fan(corner) {
                break last;
            }
        };
        // (7.7), read as a cross product: the fan left of a cutting vector c lies along n × c.
        let along = (first - last).try_normalize(1e-9).unwrap_or_default();
        let mut node = self.nodes[self.node_at(start).index()];
        node.opening = match normal.cross(&along).try_normalize(0.0) {
            Some(direction) if opens => direction,
            _ => Vec3::zeros(),
        };
        node.side = self.facet(start.triangle).open[start.place].filter(|_| opens);
        if taken {
            let own = self.push_node(here, node);
            self.give(start, own);
        } else {
            self.set_node(self.node_at(start), here, node);
        }
        corner
    }

    /// Gives the fan that begins at `start` another vertex.
    fn give(&mut self, start: Corner, own: NodeId) {
        let mut corner = start;
        loop {
            let mut corners = self.mesh.corners(corner.triangle);
            corners[corner.place] = own;
            self.set_triangle(corner.triangle, corners, *self.facet(corner.triangle));
            corner = self.next(corner);
            if self.starts_fan(corner) {
                return;
            }
        }
    }
}
