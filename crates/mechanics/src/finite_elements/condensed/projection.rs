//! P: from the boundary of the tetrahedra to the triangles of the surface, and back.

use palpate_geometry::{AabbTree, Nearest, Surface, TetrahedronMesh, TriangleId, TriangleMesh};

use super::super::solid::{Face, faces};
use crate::{Error, Vec3};

/// A triangle is taken at the centroids of its equal parts, in so many rows.
const ROWS: usize = 4;

/// The boundary of tetrahedra, on which points are put.
pub(super) struct Boundary {
    faces: Vec<Face>,
    mesh: TriangleMesh,
    tree: AabbTree,
}

impl Boundary {
    pub(super) fn new(solid: &TetrahedronMesh) -> Result<Self, Error> {
        let faces = faces(solid);
        let corners = faces.iter().map(|face| face.corners).collect();
        let mesh = TriangleMesh::new(solid.vertices().to_vec(), corners);
        let mesh = mesh.map_err(|_| Error::NoElements)?;
        let tree = AabbTree::new(&mesh);
        Ok(Self { faces, mesh, tree })
    }

    /// All of its nodes, corners and middles, some more than once.
    pub(super) fn nodes(&self) -> impl Iterator<Item = usize> {
        self.faces.iter().flat_map(|face| face.nodes)
    }

    /// Nodes and shape functions [-] at the place nearest to `point` [m].
    fn shares(&self, point: &Vec3) -> [(usize, f64); 6] {
        let Nearest { triangle, on, .. } = self.tree.nearest(&self.mesh, point);
        let nodes = self.faces[triangle.index()].nodes;
        let [a, b, c] = on.barycentric;
        let corner = |l: f64| l * (2.0 * l - 1.0);
        let middles = [4.0 * a * b, 4.0 * b * c, 4.0 * c * a];
        let shape = [corner(a), corner(b), corner(c)].into_iter().chain(middles);
        let mut shape = nodes.into_iter().zip(shape);
        std::array::from_fn(|_| shape.next().expect("six nodes have six functions"))
    }
}

/// Parts of nodes in the mean displacement of each triangle, and of a force on it.
pub(super) struct Projection {
    /// Where the shares of each triangle begin, and where the last ones end.
    starts: Vec<usize>,
    /// Nodes and their parts [-].
    shares: Vec<(usize, f64)>,
}

impl Projection {
    /// Of all triangles of `surface`.
    pub(super) fn new(surface: &Surface, boundary: &Boundary) -> Self {
        let mesh = surface.mesh();
        let places = parts_of_a_triangle();
        let part = 1.0 / places.len() as f64;
        let (mut starts, mut shares) = (vec![0], Vec::new());
        let mut own: Vec<(usize, f64)> = Vec::new();
        for triangle in mesh.triangle_ids() {
            let [a, b, c] = mesh.positions(triangle);
            own.clear();
            for [u, v, w] in &places {
                let found = boundary.shares(&(a * *u + b * *v + c * *w));
                own.extend(found.map(|(node, shape)| (node, part * shape)));
            }
            own.sort_by_key(|(node, _)| *node);
            let alike = own.chunk_by(|a, b| a.0 == b.0);
            shares.extend(alike.map(|alike| (alike[0].0, alike.iter().map(|(_, s)| s).sum())));
            starts.push(shares.len());
        }
        Self { starts, shares }
    }

    /// Weights of the nodes in the mean of a triangle.
    pub(super) fn of(&self, triangle: TriangleId) -> &[(usize, f64)] {
        let triangle = triangle.index();
        &self.shares[self.starts[triangle]..self.starts[triangle + 1]]
    }

    /// Puts a unit force on `triangle` along each axis into the sides `first` and the next two of `width`
    /// ones. `rows` are those of the nodes, none where they are fixed.
    pub(super) fn load(
        &self,
        triangle: TriangleId,
        rows: &[Option<[usize; 3]>],
        sides: &mut [f64],
        width: usize,
        first: usize,
    ) {
        for &(node, share) in self.of(triangle) {
            for (axis, row) in rows[node].into_iter().flatten().enumerate() {
                sides[row * width + first + axis] += share;
            }
        }
    }

    /// Puts the mean displacement of `triangle` along each axis into the rows of `means`, of the `width` of
    /// `sides`.
    pub(super) fn mean(
        &self,
        triangle: TriangleId,
        rows: &[Option<[usize; 3]>],
        sides: &[f64],
        means: &mut [f64],
    ) {
        let width = means.len() / 3;
        means.fill(0.0);
        for &(node, share) in self.of(triangle) {
            for (row, mean) in rows[node]
                .iter()
                .flatten()
                .zip(means.chunks_exact_mut(width))
            {
                for (mean, value) in mean.iter_mut().zip(&sides[row * width..][..width]) {
                    *mean += share * value;
                }
            }
        }
    }
}

/// Barycentric coordinates of the centroids of a triangle's equal parts.
fn parts_of_a_triangle() -> Vec<[f64; 3]> {
    let mut places = Vec::with_capacity(ROWS * ROWS);
    // In thirds of a row, parts that stand upright have theirs at (3 i + 1, 3 j + 1), those upside down at
    // (3 i + 2, 3 j + 2).
    for off in [1, 2] {
        for i in 0..=ROWS - off {
            for j in 0..=ROWS - off - i {
                let [u, v] = [i, j].map(|n| (3 * n + off) as f64 / (3 * ROWS) as f64);
                places.push([u, v, 1.0 - u - v]);
            }
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use palpate_geometry::{FillSettings, Organ, fill};

    use super::super::super::mesh::ElementMesh;
    use super::*;

    /// Judge: integrals over a triangle, 1/3 and, up to the square of a part's size, 1/12 of products.
    #[test]
    fn parts_cover_a_triangle() {
        let places = parts_of_a_triangle();
        assert_eq!(places.len(), ROWS * ROWS);
        let mean = |f: fn(&[f64; 3]) -> f64| places.iter().map(f).sum::<f64>() / 16.0;
        assert!((mean(|l| l[0]) - 1.0 / 3.0).abs() < 1e-12);
        assert!((mean(|l| l[1]) - 1.0 / 3.0).abs() < 1e-12);
        assert!((mean(|l| l[1] * l[2]) - 1.0 / 12.0).abs() < 1.0 / 12.0 / 16.0);
    }

    /// Judge: motions of a rigid body. A shift is exact, so that forces balance; a turn is that of the
    /// nearest places.
    #[test]
    fn rigid_motions_are_kept() {
        let surface = Surface::new(Organ::Hemisphere.surface_mesh(500).unwrap()).unwrap();
        let mesh = surface.mesh();
        let edge = 0.01;
        let filling = fill(&surface, &FillSettings::new(edge)).unwrap();
        let nodes = ElementMesh::from_tetrahedra(&filling).nodes;
        let boundary = Boundary::new(&filling).unwrap();
        let projection = Projection::new(&surface, &boundary);
        let (mut off, mut count) = (0.0, 0.0);
        for triangle in mesh.triangle_ids() {
            let own = projection.of(triangle);
            let sum: f64 = own.iter().map(|(_, share)| share).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
            let place: Vec3 = own.iter().map(|&(node, share)| nodes[node] * share).sum();
            let centroid = mesh.positions(triangle).iter().sum::<Vec3>() / 3.0;
            // Away from the base, whose sharp rim the tetrahedra cut off.
            if centroid.z > edge {
                off += (place - centroid).norm_squared();
                count += 1.0;
            }
        }
        let off = f64::sqrt(off / count);
        println!("off by {off:.1e} m");
        // The bow of an edge over the radius of 50 mm, of tetrahedra and of triangles alike.
        assert!(off < edge.powi(2) / (8.0 * 0.05), "{off}");
    }
}
