//! The boundary of a body, which tools load.

use std::f64::consts::PI;

use palpate_geometry::{AabbTree, TetrahedronMesh, TriangleMesh};

use crate::finite_elements::solid::Face;
use crate::{Error, LinearElastic, Vec3};

/// A load takes a face at the centroids of its equal parts, in so many rows.
const ROWS: usize = 4;

/// R of a load over the length √(2 A) of the faces there [-]: less is not resolved by quadratic elements.
const REACH_IN_SIZES: f64 = 1.2;

/// R ⟨1/r⟩ of a load with the weights (1 − (r/R)²)² on itself [-], over all pairs of places: by Hankel's transform
/// 48 J₃(k R)/(k R)³ of the weights it is 48² ∫ J₃²(x) x⁻⁶ dx.
const MEAN_INVERSE_DISTANCE: f64 = 2.408_17;

/// The boundary of the tetrahedra of a body, without the walls of cavities.
#[derive(Debug, Clone)]
pub struct Boundary {
    faces: Vec<BoundaryFace>,
    mesh: TriangleMesh,
    tree: AabbTree,
    /// Mean of √(2 A) of the faces around each vertex [m]; zero inside.
    sizes: Vec<f64>,
    /// The faces around each vertex.
    around: Vec<Vec<u32>>,
}

#[derive(Debug, Clone)]
struct BoundaryFace {
    /// Corners, then the middles of 01, 12, 20.
    nodes: [u32; 6],
    corners: [Vec3; 3],
    centroid: Vec3,
    /// Largest distance of a corner from the centroid [m].
    extent: f64,
    /// Its area along its outward normal [m²].
    area: Vec3,
}

/// A load that is spread over the boundary around a place.
#[derive(Debug, Clone, PartialEq)]
pub struct SpreadLoad {
    /// Nodes with their weights [-], whose sum is one.
    pub nodes: Vec<(u32, f64)>,
    /// Its middle, at rest [m].
    pub place: Vec3,
    /// R, beyond which nothing is loaded [m].
    pub radius: f64,
    /// Outward normal at its middle, at rest [-].
    pub normal: Vec3,
    /// Place of each node in `nodes`; scratch.
    places: Vec<u32>,
    /// The faces that it takes, and marks while they are found; scratch.
    faces: Vec<u32>,
    is_reached: Vec<bool>,
}

const NOWHERE: u32 = u32::MAX;

impl Boundary {
    /// That of the faces with these `numbers` of nodes.
    pub(super) fn new(mesh: &TetrahedronMesh, numbers: &[Face]) -> Result<Self, Error> {
        let corners = numbers.iter().map(|face| face.corners).collect();
        let triangles = TriangleMesh::new(mesh.vertices().to_vec(), corners);
        let triangles = triangles.map_err(|_| Error::NoElements)?;
        let (mut sizes, mut counts) = (
            vec![0.0; mesh.vertices().len()],
            vec![0_u32; mesh.vertices().len()],
        );
        let mut around = vec![Vec::new(); mesh.vertices().len()];
        for (number, face) in numbers.iter().enumerate() {
            for node in face.corners {
                around[node.index()].push(number as u32);
            }
        }
        let faces = numbers.iter().map(|&Face { corners, nodes, .. }| {
            let places = corners.map(|node| mesh.vertices()[node.index()]);
            let [a, b, c] = places;
            let centroid = (a + b + c) / 3.0;
            let area = 0.5 * (b - a).cross(&(c - a));
            for node in corners {
                sizes[node.index()] += (2.0 * area.norm()).sqrt();
                counts[node.index()] += 1;
            }
            BoundaryFace {
                nodes: nodes.map(|node| node as u32),
                corners: places,
                centroid,
                extent: places
                    .iter()
                    .map(|corner| (corner - centroid).norm())
                    .fold(0.0, f64::max),
                area,
            }
        });
        let faces = faces.collect();
        for (size, count) in sizes.iter_mut().zip(counts) {
            *size /= f64::from(count.max(1));
        }
        Ok(Self {
            faces,
            tree: AabbTree::new(&triangles),
            mesh: triangles,
            sizes,
            around,
        })
    }

    /// Areas of its faces [m²], in their order.
    pub fn areas(&self) -> impl Iterator<Item = f64> {
        self.faces.iter().map(|face| face.area.norm())
    }

    /// Spreads a load around `place` [m], on the connected faces there that face as `normal` [-] does, such as one side of a slit:
    /// (1 − (r/R)²)² with R no less than `radius` [m] nor than the faces resolve.
    pub fn spread(&self, place: &Vec3, normal: &Vec3, radius: f64, load: &mut SpreadLoad) {
        let nearest = self.tree.nearest(&self.mesh, place);
        let corners = self.mesh.corners(nearest.triangle);
        let size: f64 = corners
            .iter()
            .zip(nearest.on.barycentric)
            .map(|(corner, weight)| weight * self.sizes[corner.index()])
            .sum();
        load.clear();
        load.radius = radius.max(REACH_IN_SIZES * size);
        load.normal = *normal;
        load.place = *place;
        let square = load.radius * load.radius;
        let mut all = 0.0;
        self.reach(nearest.triangle.0, place, load);
        for k in 0..load.faces.len() {
            let face = &self.faces[load.faces[k] as usize];
            let facing = face.area.dot(normal);
            let [a, b, c] = face.corners;
            for_each_part(ROWS, |[u, v, w]| {
                let near = 1.0 - (a * u + b * v + c * w - place).norm_squared() / square;
                if near <= 0.0 {
                    return;
                }
                let weight = near * near * facing;
                all += weight;
                for (node, shape) in face.nodes.into_iter().zip(shape_on_face([u, v, w])) {
                    load.add(node, weight * shape);
                }
            });
        }
        if all > 0.0 {
            for (_, weight) in &mut load.nodes {
                *weight /= all;
            }
        }
    }

    /// Finds the faces that a load takes, from `first` on over the corners of those that it takes, in their order.
    fn reach(&self, first: u32, place: &Vec3, load: &mut SpreadLoad) {
        let takes = |face: &BoundaryFace| {
            let apart = (face.centroid - place).norm();
            face.area.dot(&load.normal) > 0.0 && apart <= load.radius + face.extent
        };
        load.faces.clear();
        load.faces.push(first);
        load.is_reached[first as usize] = true;
        let mut next = 0;
        while let Some(&number) = load.faces.get(next) {
            next += 1;
            for node in self.mesh.triangles()[number as usize] {
                for &other in &self.around[node.index()] {
                    if !load.is_reached[other as usize] && takes(&self.faces[other as usize]) {
                        load.is_reached[other as usize] = true;
                        load.faces.push(other);
                    }
                }
            }
        }
        for &number in &load.faces {
            load.is_reached[number as usize] = false;
        }
        load.faces
            .retain(|&number| takes(&self.faces[number as usize]));
        load.faces.sort_unstable();
    }
}

impl SpreadLoad {
    /// Room for loads on any of `nodes` nodes and `faces` faces.
    pub(super) fn with_capacity(nodes: usize, faces: usize) -> Self {
        Self {
            nodes: Vec::with_capacity(nodes),
            place: Vec3::zeros(),
            radius: 0.0,
            normal: Vec3::z(),
            places: vec![NOWHERE; nodes],
            faces: Vec::with_capacity(faces),
            is_reached: vec![false; faces],
        }
    }

    /// Loads what `other` loads; nothing is allocated.
    pub fn copy(&mut self, other: &Self) {
        self.clear();
        for &(node, weight) in &other.nodes {
            self.add(node, weight);
        }
        (self.place, self.radius, self.normal) = (other.place, other.radius, other.normal);
    }

    fn clear(&mut self) {
        for (node, _) in self.nodes.drain(..) {
            self.places[node as usize] = NOWHERE;
        }
    }

    fn add(&mut self, node: u32, weight: f64) {
        let place = &mut self.places[node as usize];
        if *place == NOWHERE {
            *place = self.nodes.len() as u32;
            self.nodes.push((node, 0.0));
        }
        self.nodes[*place as usize].1 += weight;
    }

    /// Compliance of a half-space of `law` for the weighted mean of such a load [m/N]: along the surface, and along its
    /// normal.
    ///
    /// ```text
    /// c_n = (1 − ν²) J/(π E),   c_t = (1 + ν)(1 − ν/2) J/(π E),   J = 2.408/R
    /// ```
    pub fn own_compliance(&self, law: &LinearElastic) -> [f64; 2] {
        let nu = law.poissons_ratio();
        let mean = MEAN_INVERSE_DISTANCE / (self.radius * PI * law.youngs_modulus());
        [(1.0 + nu) * (1.0 - 0.5 * nu) * mean, (1.0 - nu * nu) * mean]
    }
}

/// Shape functions of the six nodes of a face, at barycentric coordinates.
pub(super) fn shape_on_face([u, v, w]: [f64; 3]) -> [f64; 6] {
    let corner = |l: f64| l * (2.0 * l - 1.0);
    [
        corner(u),
        corner(v),
        corner(w),
        4.0 * u * v,
        4.0 * v * w,
        4.0 * w * u,
    ]
}

/// The centroids of a triangle's equal parts in so many rows, as barycentric coordinates.
pub(super) fn for_each_part(rows: usize, mut visit: impl FnMut([f64; 3])) {
    for off in [1, 2] {
        for i in 0..=rows - off {
            for j in 0..=rows - off - i {
                let [u, v] = [i, j].map(|n| (3 * n + off) as f64 / (3 * rows) as f64);
                visit([u, v, 1.0 - u - v]);
            }
        }
    }
}
