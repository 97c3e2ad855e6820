//! Nearest points, rays and boxes against an outside code and against searches without a tree.

use palpate_geometry::{AabbTree, Organ, Surface, TriangleId, TriangleMesh, Vec3};
use palpate_geometry::{read_mesh, repair};
use parry3d_f64::query::{PointQuery, Ray, RayCast};
use parry3d_f64::shape::{TriMesh, Triangle};

use crate::data;
use crate::shapes::{Random, from_parry, organ, parry_mesh, parry_vector, size, tries};

/// Judge: parry's projection on the same triangles.
#[test]
fn closest_point_is_that_of_parry() {
    for each in Organ::ALL {
        let (surface, tree) = organ(each, 2_000);
        let judge = parry_mesh(surface.mesh());
        let mut random = Random(1);
        for _ in 0..tries(20_000) {
            let point = random.around(surface.mesh());
            compare_nearest(&surface, &tree, &judge, &point);
        }
    }
}

/// Judge: parry's projection and its sign, on meshes with the triangles of real segmentations.
#[test]
fn real_organs_have_the_distances_of_parry() {
    for (name, surface) in real_surfaces() {
        let tree = AabbTree::new(surface.mesh());
        let judge = parry_mesh(surface.mesh());
        let mut random = Random(2);
        for _ in 0..tries(2_000) {
            let point = random.around(surface.mesh());
            compare_nearest(&surface, &tree, &judge, &point);
        }
        println!("{name}: {} triangles", surface.mesh().triangles().len());
    }
}

/// The nearest distance, its sign, and that the answer is consistent in itself.
fn compare_nearest(surface: &Surface, tree: &AabbTree, judge: &TriMesh, point: &Vec3) {
    let mesh = surface.mesh();
    let (nearest, signed) = surface.signed_distance(tree, point);
    let theirs = judge.project_local_point(parry_vector(point), false);
    let expected = (from_parry(theirs.point) - point).norm();
    // Rounding of a few operations on lengths of this size.
    let tolerance = 1e-12 * (size(mesh) + expected);
    let found = format!("{point}: {nearest:?} for {expected}");
    assert!((nearest.distance - expected).abs() < tolerance, "{found}");
    assert_eq!(signed < 0.0, theirs.is_inside, "{found}");
    assert_eq!(signed.abs(), nearest.distance);
    let corners = mesh.positions(nearest.triangle);
    let weighted: Vec3 = (0..3).map(|k| corners[k] * nearest.on.barycentric[k]).sum();
    assert!(
        (weighted - nearest.on.position).norm() < tolerance,
        "{found}"
    );
    assert!(((nearest.on.position - point).norm() - nearest.distance).abs() < tolerance);
}

/// Judge: for each triangle alone the least of parry's point distances along the segment, which is
/// convex there, by golden section.
#[test]
fn segment_is_as_near_as_its_nearest_point() {
    for each in [Organ::Liver, Organ::Esophagus, Organ::Cube] {
        let (surface, tree) = organ(each, 400);
        let mesh = surface.mesh();
        let mut random = Random(3);
        let (mut crossings, all) = (0, tries(300));
        for _ in 0..all {
            let (start, end) = (random.around(mesh), random.around(mesh));
            let expected = mesh
                .triangle_ids()
                .map(|t| least_along(&triangle_of(mesh, t), &start, &end))
                .fold(f64::INFINITY, f64::min);
            // Rounding; golden section stops at 1e-16 of the segment.
            let tolerance = 1e-12 * size(mesh);
            let [short, far] = [expected - tolerance, expected + tolerance]
                .map(|reach| tree.is_near_segment(mesh, [&start, &end], reach));
            assert!(!short && far, "{each}: {start} to {end}: {expected}");
            crossings += usize::from(expected < tolerance);
        }
        assert!(
            crossings > 0 && crossings < all,
            "{each}: {crossings} cross"
        );
    }
}

#[test]
fn a_segment_without_length_is_a_point() {
    let (surface, tree) = organ(Organ::Kidney, 1_000);
    let mut random = Random(4);
    for _ in 0..tries(1_000) {
        let point = random.around(surface.mesh());
        let alone = tree.nearest(surface.mesh(), &point);
        // Rounding.
        let tolerance = 1e-12 * size(surface.mesh());
        let [short, far] = [alone.distance - tolerance, alone.distance + tolerance]
            .map(|reach| tree.is_near_segment(surface.mesh(), [&point, &point], reach));
        assert!(!short && far, "{point}: {}", alone.distance);
    }
}

/// Judge: the search without a known triangle, bit for bit.
#[test]
fn a_known_triangle_changes_no_answer() {
    for each in [Organ::Esophagus, Organ::Cube] {
        let (surface, tree) = organ(each, 2_000);
        let mesh = surface.mesh();
        let triangles: Vec<_> = mesh.triangle_ids().collect();
        let mut random = Random(6);
        for _ in 0..tries(5_000) {
            let point = random.around(mesh);
            let known = triangles[(random.unit() * triangles.len() as f64) as usize];
            let alone = tree.nearest(mesh, &point);
            assert_eq!(tree.nearest_from(mesh, &point, Some(known)), alone);
            let same = tree.nearest_from(mesh, &point, Some(alone.triangle));
            assert_eq!(same, alone);
        }
    }
}

/// Judge: parry's ray cast, from either side.
#[test]
fn ray_hits_where_that_of_parry_does() {
    for each in Organ::ALL {
        let (surface, tree) = organ(each, 2_000);
        let mesh = surface.mesh();
        let judge = parry_mesh(mesh);
        let mut random = Random(5);
        let mut hits = 0;
        for _ in 0..tries(5_000) {
            let (origin, direction) = (random.around(mesh), random.direction());
            let reach = size(mesh) * random.unit();
            let ray = Ray::new(parry_vector(&origin), parry_vector(&direction));
            let expected = judge.cast_local_ray(&ray, reach, false);
            let found = tree.cast(mesh, &origin, &direction, reach);
            // Rounding of lengths of this size over the cosine of a grazing ray, which here stays
            // above a thousandth.
            let agree = match (found, expected) {
                (Some(hit), Some(distance)) => (hit.distance - distance).abs() < 1e-11 * size(mesh),
                (found, expected) => found.is_none() && expected.is_none(),
            };
            assert!(
                agree,
                "{each}: {origin} {direction}: {found:?} {expected:?}"
            );
            hits += usize::from(found.is_some());
        }
        assert!(hits > 20, "{each}: {hits} hits");
    }
}

/// Judge: the boxes of all triangles, one after the other.
#[test]
fn visit_box_finds_every_triangle_whose_box_it_meets() {
    for each in Organ::ALL {
        let (surface, tree) = organ(each, 2_000);
        let mesh = surface.mesh();
        let mut random = Random(6);
        for _ in 0..tries(500) {
            let (one, other) = (random.around(mesh), random.around(mesh));
            let middle = 0.5 * (one + other);
            let half = (one - other).abs() * (0.5 * random.unit());
            let (low, high) = (middle - half, middle + half);
            let mut found = Vec::new();
            tree.visit_box(&low, &high, |triangle| found.push(triangle));
            found.sort_unstable();
            let expected: Vec<_> = mesh
                .triangle_ids()
                .filter(|&t| {
                    let [a, b, c] = mesh.positions(t);
                    let (least, most) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
                    (0..3).all(|k| least[k] <= high[k] && most[k] >= low[k])
                })
                .collect();
            assert_eq!(found, expected, "{each}");
        }
    }
}

fn triangle_of(mesh: &TriangleMesh, triangle: TriangleId) -> Triangle {
    let [a, b, c] = mesh.positions(triangle).map(|p| parry_vector(&p));
    Triangle::new(a, b, c)
}

fn least_along(triangle: &Triangle, start: &Vec3, end: &Vec3) -> f64 {
    let at = |along: f64| {
        let point = start + (end - start) * along;
        let on = triangle.project_local_point(parry_vector(&point), false);
        (from_parry(on.point) - point).norm()
    };
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.0, 1.0);
    let mut inner = [high - golden * (high - low), low + golden * (high - low)];
    let mut values = inner.map(at);
    for _ in 0..80 {
        if values[0] < values[1] {
            high = inner[1];
            inner = [high - golden * (high - low), inner[0]];
            values = [at(inner[0]), values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + golden * (high - low)];
            values = [values[1], at(inner[1])];
        }
    }
    values[0].min(values[1]).min(at(0.0)).min(at(1.0))
}

/// The lent meshes that bound a solid, each once, as repaired on import.
pub(crate) fn real_surfaces() -> Vec<(String, Surface)> {
    let Some(folder) = data::folder() else {
        return Vec::new();
    };
    let entries = std::fs::read_dir(folder.join("meshes")).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "ply"));
    paths.sort();
    let mut surfaces = Vec::new();
    for path in paths {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let mesh = read_mesh(&path, None).unwrap().mesh;
        match repair(&mesh).and_then(|(repaired, _)| Surface::new(repaired)) {
            Ok(surface) => surfaces.push((name, surface)),
            Err(error) => println!("{name}: passed over, {error}"),
        }
    }
    assert!(surfaces.len() > 10, "{} real surfaces", surfaces.len());
    surfaces
}
