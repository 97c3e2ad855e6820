//! A binary tree of axis-aligned boxes over the triangles of a mesh (section 7.6).
//!
//! One triangle to a leaf, two boxes to the next higher one, as in the source. The tree contains
//! boxes only: every query takes the mesh, so that it can deform and the tree be refitted.
//!
//! *How we know*: `agreement::closest_point_is_that_of_parry`, `invariants::refit_is_rebuild`.

use crate::{TriangleId, TriangleMesh, Vec3};

mod query;

pub use query::{Hit, Nearest, ray_meets_triangle};

/// Depth of the traversal stack: a balanced tree of 2³² leaves needs 33.
const STACK: usize = 64;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Aabb {
    low: Vec3,
    high: Vec3,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Below {
    /// Two boxes, at this index and the next.
    Boxes(u32),
    Triangle(TriangleId),
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct TreeNode {
    aabb: Aabb,
    below: Below,
    parent: u32,
}

/// The bounding-box tree of a [`TriangleMesh`].
#[derive(Debug, Clone, PartialEq)]
pub struct AabbTree {
    nodes: Vec<TreeNode>,
    leaf_of: Vec<u32>,
    /// Squared distances closer than this are ties, settled by the lower number [m²].
    tie: f64,
}

impl Aabb {
    /// The box of nothing.
    const EMPTY: Self = Self {
        low: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    fn of(mesh: &TriangleMesh, triangle: TriangleId) -> Self {
        let [a, b, c] = mesh.positions(triangle);
        Self {
            low: a.inf(&b).inf(&c),
            high: a.sup(&b).sup(&c),
        }
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    fn squared_distance(&self, point: &Vec3) -> f64 {
        (self.low - point)
            .sup(&(point - self.high))
            .sup(&Vec3::zeros())
            .norm_squared()
    }
}

impl AabbTree {
    /// The tree over all triangles of `mesh`.
    pub fn new(mesh: &TriangleMesh) -> Self {
        let mut items: Vec<_> = mesh
            .triangle_ids()
            .map(|id| (id, Aabb::of(mesh, id)))
            .collect();
        let (low, high) = mesh.bounds();
        let mut tree = Self {
            nodes: Vec::with_capacity(2 * items.len()),
            leaf_of: vec![0; items.len()],
            tie: 1e-14 * (high - low).norm_squared(),
        };
        tree.nodes.push(placeholder(0));
        tree.split(0, &mut items);
        tree
    }

    /// Fits the boxes around `moved` triangles and all above them; the rest of the tree stays.
    /// Costs the depth of the tree for each triangle.
    pub fn refit(&mut self, mesh: &TriangleMesh, moved: &[TriangleId]) {
        for &triangle in moved {
            let mut at = self.leaf_of[triangle.index()];
            self.nodes[at as usize].aabb = Aabb::of(mesh, triangle);
            while at != 0 {
                at = self.nodes[at as usize].parent;
                let Below::Boxes(first) = self.nodes[at as usize].below else {
                    break;
                };
                let fitted = self.nodes[first as usize]
                    .aabb
                    .union(&self.nodes[first as usize + 1].aabb);
                if self.nodes[at as usize].aabb == fitted {
                    break;
                }
                self.nodes[at as usize].aabb = fitted;
            }
        }
    }

    /// Fits all boxes, once each.
    pub fn refit_all(&mut self, mesh: &TriangleMesh) {
        self.refit_where(mesh, |_| true);
    }

    /// Fits all boxes, once each. No query finds the triangles that are not `included`, until they are fitted again.
    pub fn refit_where(&mut self, mesh: &TriangleMesh, included: impl Fn(TriangleId) -> bool) {
        // What is below a box stands after it.
        for at in (0..self.nodes.len()).rev() {
            self.nodes[at].aabb = match self.nodes[at].below {
                Below::Triangle(triangle) if !included(triangle) => Aabb::EMPTY,
                Below::Triangle(triangle) => Aabb::of(mesh, triangle),
                Below::Boxes(first) => {
                    let [left, right] = [0, 1].map(|k| &self.nodes[first as usize + k].aabb);
                    left.union(right)
                }
            };
        }
    }

    /// Takes over the boxes of `other`, a tree over as many triangles. It allocates nothing.
    ///
    /// # Panics
    /// When `other` is over another number of triangles.
    pub fn copy_boxes(&mut self, other: &Self) {
        self.nodes.copy_from_slice(&other.nodes);
        self.leaf_of.copy_from_slice(&other.leaf_of);
        self.tie = other.tie;
    }

    fn split(&mut self, at: usize, items: &mut [(TriangleId, Aabb)]) {
        if let [(triangle, aabb)] = items {
            self.nodes[at].aabb = *aabb;
            self.nodes[at].below = Below::Triangle(*triangle);
            self.leaf_of[triangle.index()] = at as u32;
            return;
        }
        let axis = longest_axis_of_centers(items);
        let middle = items.len() / 2;
        items.select_nth_unstable_by(middle, |(i, a), (j, b)| {
            let (a, b) = (a.low[axis] + a.high[axis], b.low[axis] + b.high[axis]);
            a.total_cmp(&b).then(i.cmp(j))
        });
        let first = self.nodes.len();
        self.nodes.push(placeholder(at as u32));
        self.nodes.push(placeholder(at as u32));
        let (left, right) = items.split_at_mut(middle);
        self.split(first, left);
        self.split(first + 1, right);
        self.nodes[at].aabb = self.nodes[first].aabb.union(&self.nodes[first + 1].aabb);
        self.nodes[at].below = Below::Boxes(first as u32);
    }
}

fn placeholder(parent: u32) -> TreeNode {
    TreeNode {
        aabb: Aabb {
            low: Vec3::zeros(),
            high: Vec3::zeros(),
        },
        below: Below::Boxes(0),
        parent,
    }
}

fn longest_axis_of_centers(items: &[(TriangleId, Aabb)]) -> usize {
    let mut low = Vec3::repeat(f64::INFINITY);
    let mut high = Vec3::repeat(f64::NEG_INFINITY);
    for (_, aabb) in items {
        let twice_center = aabb.low + aabb.high;
        low = low.inf(&twice_center);
        high = high.sup(&twice_center);
    }
    (high - low).imax()
}
