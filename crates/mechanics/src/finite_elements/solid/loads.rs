//! Forces and pressures on the boundary, and points of the body as shares of nodes.

use palpate_files::scene::Region;
use palpate_geometry::{TetrahedronMesh, closest_on_triangle};

use super::super::element::ElementKind;
use super::super::mesh::ElementMesh;
use super::super::pressed_faces::PressedFaces;
use super::error::SolidError;
use super::mesh::{Face, turned_over};
use super::problem::{LoadPlace, Loads, SurfaceLoad};
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
        if !is_moved && self.weight.is_none() && self.on_surface.is_empty() {
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
        for (load, own) in self.on_surface.iter().enumerate() {
            match own {
                SurfaceLoad::Force { place, force } => {
                    direction("a force", force)?;
                    if let LoadPlace::Line([from, to]) = place
                        && from == to
                    {
                        return Err(SolidError::NoLine { load });
                    }
                }
                SurfaceLoad::Pressure { pressure, .. } => {
                    if *pressure == 0.0 || !pressure.is_finite() {
                        return Err(SolidError::NoPressure {
                            load,
                            found: *pressure,
                        });
                    }
                }
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

/// Loads on the boundary of a mesh.
#[derive(Default)]
pub(super) struct BoundaryLoads {
    /// Forces at nodes [N].
    pub(super) forces: Vec<(usize, Vec3)>,
    /// Pressures towards the inside [Pa].
    pub(super) pressures: Vec<(PressedFaces, f64)>,
}

impl BoundaryLoads {
    pub(super) fn new(
        loads: &[SurfaceLoad],
        mesh: &TetrahedronMesh,
        faces: &[Face],
    ) -> Result<Self, SolidError> {
        let mut all = Self::default();
        for (load, own) in loads.iter().enumerate() {
            match own {
                SurfaceLoad::Force { place, force } => match place {
                    LoadPlace::Faces(region) => {
                        let (whole, parts) = within(faces, mesh, Some(region), load)?;
                        all.forces.extend(parts.flat_map(|(face, part)| {
                            let each = face.nodes.into_iter().zip(part);
                            let each = each.filter(|(_, area)| *area != 0.0);
                            each.map(move |(node, area)| (node, area / whole * force))
                        }));
                    }
                    LoadPlace::Line(ends) => {
                        all.forces.extend(along(ends, force, mesh, faces, load)?);
                    }
                },
                SurfaceLoad::Pressure { region, pressure } => {
                    let (_, parts) = within(faces, mesh, region.as_ref(), load)?;
                    let mut pressed = PressedFaces::default();
                    for (face, part) in parts.filter(|(_, part)| part.iter().any(|a| *a != 0.0)) {
                        pressed.add(face.seen_from_inside(), turned_over(part), face.area(mesh));
                    }
                    all.pressures.push((pressed, *pressure));
                }
            }
        }
        Ok(all)
    }
}

/// The parts of `faces` in a `region`, or all of them, of the load of this number: their area [m²], and the integrals over
/// each.
fn within<'a>(
    faces: &'a [Face],
    mesh: &TetrahedronMesh,
    region: Option<&Region>,
    load: usize,
) -> Result<(f64, impl Iterator<Item = (&'a Face, [f64; 6])>), SolidError> {
    let part = |face: &Face| match region {
        Some(region) => part_within(face, mesh, region),
        None => {
            // The shape functions of corners integrate to nothing.
            let third = face.area(mesh) / 3.0;
            [0.0, 0.0, 0.0, third, third, third]
        }
    };
    let parts: Vec<[f64; 6]> = faces.iter().map(part).collect();
    let whole: f64 = parts.iter().flatten().sum();
    if whole <= 0.0 {
        return Err(SolidError::EmptyLoad { load });
    }
    Ok((whole, faces.iter().zip(parts)))
}

/// The `force` of the load of this number, evenly along a line, at nodes [N].
fn along(
    [from, to]: &[Vec3; 2],
    force: &Vec3,
    mesh: &TetrahedronMesh,
    faces: &[Face],
    load: usize,
) -> Result<Vec<(usize, Vec3)>, SolidError> {
    let mut forces = Vec::new();
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

/// How often a triangle at the border of a region is divided into four.
const DIVISIONS: u32 = 6;

/// The integrals of the shape functions of a face's nodes [m²] over its part in a region: what of an even traction each
/// carries. The force so does not jump with the triangles, and may act on less than one.
fn part_within(face: &Face, mesh: &TetrahedronMesh, region: &Region) -> [f64; 6] {
    let corners = face.positions(mesh);
    let mut part = Part {
        region,
        corners,
        integrals: [0.0; 6],
    };
    let whole = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    part.add(whole, face.area(mesh), DIVISIONS);
    part.integrals
}

/// The part of a triangle in a region.
struct Part<'r> {
    region: &'r Region,
    corners: [Vec3; 3],
    integrals: [f64; 6],
}

impl Part<'_> {
    /// Adds the part of a triangle between three points, given by their barycentric coordinates [-], of this area [m²].
    fn add(&mut self, points: [[f64; 3]; 3], area: f64, divisions: u32) {
        let places = points.map(|point| self.place(point));
        let middle = |i: usize, j: usize| [0, 1, 2].map(|k| 0.5 * (points[i][k] + points[j][k]));
        let [ab, bc, ca] = [middle(0, 1), middle(1, 2), middle(2, 0)];
        let is_within = match (overlap(self.region, &places), divisions) {
            (Overlap::None, _) => false,
            (Overlap::Whole, _) => true,
            (Overlap::Part, 0) => {
                let centroid = places.iter().sum::<Vec3>() / 3.0;
                self.region.contains(centroid.into())
            }
            (Overlap::Part, _) => {
                let [a, b, c] = points;
                for quarter in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
                    self.add(quarter, 0.25 * area, divisions - 1);
                }
                false
            }
        };
        if is_within {
            // The middles of the edges integrate what is quadratic.
            for [a, b, c] in [ab, bc, ca] {
                let corners = [a, b, c].map(|l| l * (2.0 * l - 1.0));
                let middles = [a * b, b * c, c * a].map(|product| 4.0 * product);
                let shares = corners.into_iter().chain(middles);
                for (integral, share) in self.integrals.iter_mut().zip(shares) {
                    *integral += area / 3.0 * share;
                }
            }
        }
    }

    fn place(&self, barycentric: [f64; 3]) -> Vec3 {
        let each = self.corners.iter().zip(barycentric);
        each.map(|(corner, part)| corner * part).sum()
    }
}

/// How much of a triangle lies in a region.
enum Overlap {
    None,
    Part,
    Whole,
}

fn overlap(region: &Region, triangle: &[Vec3; 3]) -> Overlap {
    let corners = triangle.map(<[f64; 3]>::from);
    // Each of them is convex, and a plane leaves out what all corners are beyond.
    let planes = region.planes.iter();
    let planes = planes.map(|plane| {
        let inside = corners.map(|corner| plane.contains(corner));
        (inside == [true; 3], inside != [false; 3])
    });
    let boxes = region.boxes.iter().map(|own| {
        let meets = (0..3).all(|axis| {
            let along = corners.map(|corner| corner[axis]);
            let least = along.into_iter().fold(f64::INFINITY, f64::min);
            let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
            least <= own.max_m[axis] && most >= own.min_m[axis]
        });
        (corners.iter().all(|corner| own.contains(*corner)), meets)
    });
    let spheres = region.spheres.iter().map(|sphere| {
        let nearest = closest_on_triangle(triangle, &sphere.center_m.into()).position;
        let meets = sphere.contains(nearest.into());
        (corners.iter().all(|corner| sphere.contains(*corner)), meets)
    });
    let each = planes.chain(boxes).chain(spheres);
    each.fold(Overlap::None, |so_far, of_one| match (so_far, of_one) {
        (Overlap::Whole, _) | (_, (true, _)) => Overlap::Whole,
        (Overlap::None, (_, false)) => Overlap::None,
        _ => Overlap::Part,
    })
}

/// Longest extent of a mesh [m].
fn extent(mesh: &TetrahedronMesh) -> f64 {
    let none = Vec3::repeat(f64::INFINITY);
    let vertices = mesh.vertices().iter();
    let (low, high) = vertices.fold((none, -none), |(low, high), v| (low.inf(v), high.sup(v)));
    (high - low).max()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use palpate_files::scene::{RegionBox, RegionSphere};

    use super::super::mesh::faces;
    use super::*;

    /// Area [m²] and centroid [m] of what a region takes of the boundary of a tetrahedron with legs of 1 m.
    fn taken(region: &Region) -> (f64, Vec3) {
        let vertices = vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
        let corners = [0, 1, 2, 3].map(palpate_geometry::NodeId);
        let mesh = TetrahedronMesh::new(vertices, vec![corners]).unwrap();
        let (mut area, mut moment) = (0.0, Vec3::zeros());
        for face in faces(&mesh) {
            let [a, b, c] = face.positions(&mesh);
            let nodes = [a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
            for (node, share) in nodes.iter().zip(part_within(&face, &mesh, region)) {
                area += share;
                moment += share * node;
            }
        }
        (area, moment / area)
    }

    /// Judge: the areas and centres of a disc and a rectangle, which are smaller than the triangle that they lie in.
    #[test]
    fn a_load_acts_on_parts_of_triangles() {
        let sphere = RegionSphere {
            center_m: [0.3, 0.3, 0.0],
            radius_m: 0.2,
        };
        let ball = Region {
            spheres: vec![sphere],
            ..Region::default()
        };
        // A leaf is 1/64 of a leg wide, and those around the circle count whole or not.
        let (area, centroid) = taken(&ball);
        assert!((area / (0.04 * PI) - 1.0).abs() < 0.01, "{area}");
        assert!(
            (centroid - Vec3::new(0.3, 0.3, 0.0)).norm() < 0.002,
            "{centroid}"
        );
        let flat = RegionBox {
            min_m: [0.125, 0.25, 0.0],
            max_m: [0.375, 0.5, 0.0],
        };
        let flat = Region {
            boxes: vec![flat],
            ..Region::default()
        };
        let (area, centroid) = taken(&flat);
        // Its sides are those of leaves.
        assert!((area / 0.0625 - 1.0).abs() < 1e-12, "{area}");
        assert!(
            (centroid - Vec3::new(0.25, 0.375, 0.0)).norm() < 0.01,
            "{centroid}"
        );
    }
}
