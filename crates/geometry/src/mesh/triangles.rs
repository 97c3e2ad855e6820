use crate::{MeshError, Vec3};

/// Number of a vertex in its mesh, from zero. In memory it is the number alone, so that triangles can be drawn
/// as they are.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

/// Number of a triangle in its mesh, from zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TriangleId(pub u32);

impl NodeId {
    /// As an index into an array over vertices.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl TriangleId {
    /// As an index into an array over triangles.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A list of triangles over shared vertices. Coordinates are finite and indices are in range;
/// nothing else is promised (see [`crate::Surface`] for more).
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    vertices: Vec<Vec3>,
    triangles: Vec<[NodeId; 3]>,
}

impl TriangleMesh {
    /// A mesh of `vertices` [m] and `triangles` (vertex numbers, counter-clockwise seen from
    /// outside).
    ///
    /// # Errors
    /// When there is no triangle, a coordinate is not finite or an index is out of range.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[NodeId; 3]>) -> Result<Self, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if let Some(vertex) = vertices
            .iter()
            .position(|v| !v.iter().all(|c| c.is_finite()))
        {
            return Err(MeshError::NotFinite { vertex });
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(node) = corners.iter().find(|n| n.index() >= vertices.len()) {
                return Err(MeshError::IndexOutOfRange {
                    triangle,
                    vertex: node.index(),
                    vertices: vertices.len(),
                });
            }
        }
        Ok(Self {
            vertices,
            triangles,
        })
    }

    /// Some of the triangles of a mesh with these vertices, which has no others than they need, in their order, and
    /// which vertices these were.
    ///
    /// # Panics
    /// Without a triangle, or when a corner is none of the vertices.
    pub(crate) fn part_of(vertices: &[Vec3], triangles: &[[NodeId; 3]]) -> (Self, Vec<NodeId>) {
        let mut numbers = vec![None; vertices.len()];
        for node in triangles.iter().flatten() {
            numbers[node.index()] = Some(NodeId(0));
        }
        let mut originals = Vec::new();
        for (node, number) in (0..).map(NodeId).zip(&mut numbers) {
            if let Some(number) = number {
                *number = NodeId(originals.len() as u32);
                originals.push(node);
            }
        }
        let renamed = |node: NodeId| numbers[node.index()].expect("a corner is used");
        let part = Self {
            vertices: originals
                .iter()
                .map(|node| vertices[node.index()])
                .collect(),
            triangles: triangles
                .iter()
                .map(|corners| corners.map(renamed))
                .collect(),
        };
        (part, originals)
    }

    /// Positions of the vertices [m].
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// The triangles as vertex numbers.
    pub fn triangles(&self) -> &[[NodeId; 3]] {
        &self.triangles
    }

    /// Number of all triangles, in order.
    pub fn triangle_ids(&self) -> impl ExactSizeIterator<Item = TriangleId> + use<> {
        (0..self.triangles.len() as u32).map(TriangleId)
    }

    /// The three vertex numbers of a triangle.
    pub fn corners(&self, triangle: TriangleId) -> [NodeId; 3] {
        self.triangles[triangle.index()]
    }

    /// The three corner positions of a triangle [m].
    pub fn positions(&self, triangle: TriangleId) -> [Vec3; 3] {
        self.corners(triangle)
            .map(|node| self.vertices[node.index()])
    }

    /// Outward area vector of a triangle [m²]: half the cross product of its edges.
    pub fn area_vector(&self, triangle: TriangleId) -> Vec3 {
        let [a, b, c] = self.positions(triangle);
        0.5 * (b - a).cross(&(c - a))
    }

    /// Total area [m²].
    pub fn area(&self) -> f64 {
        self.triangle_ids()
            .map(|t| self.area_vector(t).norm())
            .sum()
    }

    /// Signed volume enclosed [m³]; positive when a closed mesh points outward.
    pub fn volume(&self) -> f64 {
        // Measured from the first vertex, so that a mesh far from the origin loses no digits.
        let origin = self.vertices[0];
        let six_fold: f64 = self
            .triangle_ids()
            .map(|t| {
                let [a, b, c] = self.positions(t).map(|p| p - origin);
                a.dot(&b.cross(&c))
            })
            .sum();
        six_fold / 6.0
    }

    /// Smallest and largest coordinates over the vertices that triangles use [m].
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut low = Vec3::repeat(f64::INFINITY);
        let mut high = Vec3::repeat(f64::NEG_INFINITY);
        for node in self.triangles.iter().flatten() {
            low = low.inf(&self.vertices[node.index()]);
            high = high.sup(&self.vertices[node.index()]);
        }
        (low, high)
    }

    /// Moves one vertex to `position` [m], to deform an organ. The caller refits trees over the
    /// mesh.
    ///
    /// # Panics
    /// When the position is not finite.
    pub fn move_vertex(&mut self, node: NodeId, position: Vec3) {
        assert!(
            position.iter().all(|c| c.is_finite()),
            "a vertex is moved to a place that is not finite"
        );
        self.vertices[node.index()] = position;
    }

    /// Moves every vertex to where it is in `other`, a mesh with as many vertices. It allocates nothing.
    ///
    /// # Panics
    /// When `other` has another number of vertices.
    pub fn move_vertices_to(&mut self, other: &Self) {
        self.vertices.copy_from_slice(&other.vertices);
    }

    /// Makes room for more vertices and triangles.
    pub(crate) fn reserve(&mut self, vertices: usize, triangles: usize) {
        self.vertices.reserve(vertices);
        self.triangles.reserve(triangles);
    }

    /// Adds a vertex at a finite `position` [m]; the caller then adds its triangles.
    pub(crate) fn push_vertex(&mut self, position: Vec3) -> NodeId {
        self.vertices.push(position);
        NodeId(self.vertices.len() as u32 - 1)
    }

    /// Adds a triangle of vertices that are there.
    pub(crate) fn push_triangle(&mut self, corners: [NodeId; 3]) -> TriangleId {
        self.triangles.push(corners);
        TriangleId(self.triangles.len() as u32 - 1)
    }

    /// Gives a triangle other vertices, which are there.
    pub(crate) fn replace_corners(&mut self, triangle: TriangleId, corners: [NodeId; 3]) {
        self.triangles[triangle.index()] = corners;
    }

    /// Removes vertices and triangles beyond these numbers.
    pub(crate) fn truncate(&mut self, vertices: usize, triangles: usize) {
        self.vertices.truncate(vertices);
        self.triangles.truncate(triangles);
    }

    /// The same mesh with every vertex moved by `map` [m].
    ///
    /// # Errors
    /// When a moved coordinate is not finite.
    pub fn map_vertices(&self, map: impl Fn(&Vec3) -> Vec3) -> Result<Self, MeshError> {
        Self::new(
            self.vertices.iter().map(map).collect(),
            self.triangles.clone(),
        )
    }
}
