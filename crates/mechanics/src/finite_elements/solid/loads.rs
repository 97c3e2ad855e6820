//! Dead loads on the boundary as forces at nodes, and points of the body as shares of nodes.

use palpate_geometry::{TetrahedronMesh, closest_on_triangle};

use super::super::element::ElementKind;
use super::super::mesh::ElementMesh;
use super::error::SolidError;
use super::mesh::Face;
use super::problem::{DeadLoad, LoadPlace, Loads};
use crate::Vec3;

/// A line or a point this far off the body is an error [parts of its longest extent]. The corners of a filled surface are
/// cut off by up to a third of an edge, which is less.
const OFF: f64 = 0.05;

/// Points along a line between which its force is divided.
const ALONG: usize = 256;

/// Shares [-] of nodes in a place of the body.
pub(super) type Place = Vec<(usize, f64)>;

impl Loads {
    /// Whether there is any, where nothing else moves the body, and all are loads.
    pub(super) fn check(&self, is_moved: bool) -> Result<(), SolidError> {
        if !is_moved && self.weight.is_none() && self.forces.is_empty() {
            return Err(SolidError::NothingLoads);
        }
        let direction = |name, found: &Vec3| match found.norm() {
            size if size > 0.0 && size.is_finite() => Ok(()),
            _ => Err(SolidError::NoDirection {
                name,
                found: (*found).into(),
            }),
        };
        if let Some(weight) = &self.weight {
            direction("the acceleration of gravity", &weight.gravity)?;
            check_densities([weight.density])?;
        }
        for (load, DeadLoad { place, force }) in self.forces.iter().enumerate() {
            direction("a force", force)?;
            if let LoadPlace::Line([from, to]) = place
                && from == to
            {
                return Err(SolidError::NoLine { load });
            }
        }
        Ok(())
    }
}

/// Densities [kg/m³] have to be positive.
pub(super) fn check_densities(densities: impl IntoIterator<Item = f64>) -> Result<(), SolidError> {
    let is_one = |density: &f64| *density > 0.0 && density.is_finite();
    let bad = densities.into_iter().find(|density| !is_one(density));
    bad.map_or(Ok(()), |density| {
        Err(SolidError::DensityOutOfRange { density })
    })
}

/// Forces at nodes [N].
pub(super) fn of_boundary(
    loads: &[DeadLoad],
    mesh: &TetrahedronMesh,
    faces: &[Face],
) -> Result<Vec<(usize, Vec3)>, SolidError> {
    let mut forces = Vec::new();
    for (load, DeadLoad { place, force }) in loads.iter().enumerate() {
        match place {
            LoadPlace::Faces(region) => {
                let within = |face: &&Face| region.holds(face.centroid(mesh).into());
                let within: Vec<&Face> = faces.iter().filter(within).collect();
                let areas: Vec<f64> = within.iter().map(|face| area(face, mesh)).collect();
                let whole: f64 = areas.iter().sum();
                if within.is_empty() {
                    return Err(SolidError::EmptyLoad { load });
                }
                for (face, area) in within.iter().zip(areas) {
                    // An even traction on a quadratic triangle is carried by the middles of its edges.
                    let part = area / whole / 3.0 * force;
                    forces.extend(face.nodes[3..].iter().map(|&node| (node, part)));
                }
            }
            LoadPlace::Line([from, to]) => {
                let mut distance: f64 = 0.0;
                for point in 0..ALONG {
                    let part = (point as f64 + 0.5) / ALONG as f64;
                    let place = from + part * (to - from);
                    let (off, shares) = on_boundary(&place, mesh, faces);
                    distance = distance.max(off);
                    let force = force / ALONG as f64;
                    forces.extend(shares.iter().map(|&(node, share)| (node, share * force)));
                }
                if distance > OFF * extent(mesh) {
                    return Err(SolidError::LineOffSurface { load, distance });
                }
            }
        }
    }
    Ok(forces)
}

/// The places of `points` [m] in a mesh, at its boundary where they lie a little outside.
pub(super) fn places(
    points: &[Vec3],
    mesh: &TetrahedronMesh,
    faces: &[Face],
) -> Result<Vec<Place>, SolidError> {
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let elements = ElementMesh::from_tetrahedra(mesh);
    let place = |(point, at): (usize, &Vec3)| {
        if let Some(place) = inside(at, mesh, &elements) {
            return Ok(place);
        }
        let (distance, place) = on_boundary(at, mesh, faces);
        if distance > OFF * extent(mesh) {
            return Err(SolidError::PointOutside { point, distance });
        }
        Ok(place)
    };
    points.iter().enumerate().map(place).collect()
}

fn inside(at: &Vec3, mesh: &TetrahedronMesh, elements: &ElementMesh) -> Option<Place> {
    (0..mesh.tetrahedra().len()).find_map(|element| {
        let [a, b, c, d] = mesh.positions(element);
        let axes = nalgebra::Matrix3::from_columns(&[b - a, c - a, d - a]);
        let own: [f64; 3] = (axes.try_inverse()? * (at - a)).into();
        let least = own
            .into_iter()
            .fold(1.0 - own.iter().sum::<f64>(), f64::min);
        if least < 0.0 {
            return None;
        }
        let mut shares = vec![0.0; ElementKind::Tet10.nodes()];
        ElementKind::Tet10.shape(own, &mut shares);
        let nodes = elements.element(element).iter().map(|&node| node as usize);
        Some(nodes.zip(shares).collect())
    })
}

/// The nearest point of the boundary: its distance [m] and its place.
fn on_boundary(at: &Vec3, mesh: &TetrahedronMesh, faces: &[Face]) -> (f64, Place) {
    let mut nearest = (f64::INFINITY, Vec::new());
    for face in faces {
        let found = closest_on_triangle(&face.positions(mesh), at);
        let distance = (found.position - at).norm();
        if distance < nearest.0 {
            let [a, b, c] = found.barycentric;
            let corners = [a, b, c].map(|l| l * (2.0 * l - 1.0));
            let middles = [a * b, b * c, c * a].map(|product| 4.0 * product);
            let shares = corners.into_iter().chain(middles);
            nearest = (distance, face.nodes.into_iter().zip(shares).collect());
        }
    }
    nearest
}

fn area(face: &Face, mesh: &TetrahedronMesh) -> f64 {
    let [a, b, c] = face.positions(mesh);
    0.5 * (b - a).cross(&(c - a)).norm()
}

/// Longest extent of a mesh [m].
fn extent(mesh: &TetrahedronMesh) -> f64 {
    let none = Vec3::repeat(f64::INFINITY);
    let vertices = mesh.vertices().iter();
    let (low, high) = vertices.fold((none, -none), |(low, high), v| (low.inf(v), high.sup(v)));
    (high - low).max()
}
