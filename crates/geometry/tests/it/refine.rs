//! Refinement of tetrahedra.

use std::f64::consts::PI;

use palpate_geometry::{
    FillSettings, Focus, Organ, Surface, TetrahedronError, TetrahedronMesh, Vec3, fill,
    refine_near, refine_to, refine_uniformly, resolve_sphere,
};

use crate::shapes::{organ, tries};
use crate::tetrahedra::{assert_sound, report};
use crate::{data, fill::real};

/// The vertex of the surface that lies farthest along `direction`.
fn top(surface: &Surface, direction: Vec3) -> Vec3 {
    let vertices = surface.mesh().vertices().iter().copied();
    vertices
        .max_by(|a, b| a.dot(&direction).total_cmp(&b.dot(&direction)))
        .unwrap()
}

/// The longest edge of those that touch the ball in a vertex.
fn longest_edge_in(mesh: &TetrahedronMesh, center: &Vec3, radius: f64) -> f64 {
    let mut longest: f64 = 0.0;
    for number in 0..mesh.tetrahedra().len() {
        let positions = mesh.positions(number);
        if positions.iter().any(|p| (p - center).norm() <= radius) {
            for (k, p) in positions.iter().enumerate() {
                for q in &positions[..k] {
                    longest = longest.max((p - q).norm());
                }
            }
        }
    }
    longest
}

/// Fills, refines around a place of the surface, resolves a circle there; looks at everything.
fn refined(name: &str, surface: &Surface, center: Vec3, levels: i32) {
    let settings = FillSettings::with_about(surface, 10_000);
    let filled = fill(surface, &settings).unwrap();
    let focus = Focus {
        center,
        radius: 4.0 * settings.edge * 0.5f64.powi(levels),
        edge: settings.edge * 0.5f64.powi(levels),
    };
    let started = std::time::Instant::now();
    let mesh = refine_near(&filled, Some(surface), &focus).unwrap();
    let seconds = started.elapsed().as_secs_f64();
    println!("{name}: {} before", report(&filled));
    println!("  {}, {seconds:.3} s, {levels} levels", report(&mesh));
    assert_sound(&mesh);
    assert!(longest_edge_in(&mesh, &center, focus.radius) <= focus.edge);
    // What was seen, on all organs at every level, was 10° and more.
    assert!(mesh.quality().least_dihedral.to_degrees() > 8.0);
    let circle = 0.6 * focus.radius;
    let (resolved, how) = resolve_sphere(&mesh, Some(surface), &center, circle).unwrap();
    println!("  {}, {how:?}", report(&resolved));
    assert_sound(&resolved);
    assert_eq!(
        (how.crossing, crossings(&resolved, &center, circle)),
        (0, 0)
    );
    assert!(resolved.quality().least_dihedral.to_degrees() > 5.0);
}

#[test]
fn stays_sound_and_well_shaped() {
    for kind in Organ::ALL {
        if [Organ::Esophagus, Organ::Diaphragm].contains(&kind) {
            // Their walls need more tetrahedra than this test has time for.
            continue;
        }
        let (surface, _) = organ(kind, 4_000);
        let places = [Vec3::z(), Vec3::new(1.0, 1.0, 0.3), -Vec3::x()];
        for direction in &places[..tries(30).min(3)] {
            refined(kind.name(), &surface, top(&surface, *direction), 4);
        }
    }
}

#[test]
fn real_organs_are_refined() {
    let Some(folder) = data::folder() else { return };
    for name in [
        "vhm_kidney_left_5146.ply",
        "vhm_liver_20000.ply",
        "bp3d_stomach_3000.ply",
    ] {
        let surface = real(&folder, name);
        refined(name, &surface, top(&surface, Vec3::z()), 5);
        refined(name, &surface, top(&surface, Vec3::x()), 4);
    }
}

/// Judge: the block itself. Without a surface its boundary stays where it is.
#[test]
fn a_block_keeps_its_volume() {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [3, 3, 3]).unwrap();
    let focus = Focus {
        center: Vec3::new(0.5, 0.5, 1.0),
        radius: 0.1,
        edge: 0.02,
    };
    let mesh = refine_near(&block, None, &focus).unwrap();
    println!("{}", report(&mesh));
    assert_sound(&mesh);
    assert!((mesh.volume() - 1.0).abs() < 1e-12);
    assert!(longest_edge_in(&mesh, &focus.center, focus.radius) <= focus.edge);
    // Far away nothing is refined.
    assert!(longest_edge_in(&mesh, &Vec3::zeros(), 0.01) > 0.3);
    let again = refine_near(&block, None, &focus).unwrap();
    assert_eq!(mesh, again);
    let eight = refine_uniformly(&block, None).unwrap();
    assert_sound(&eight);
    assert_eq!(eight.tetrahedra().len(), 8 * block.tetrahedra().len());
    assert!((eight.volume() - 1.0).abs() < 1e-12);
}

/// Judge: the rule itself, at every corner and centroid. Edges grow with the distance from a segment.
#[test]
fn edges_are_as_long_as_is_asked_for() {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [2, 2, 2]).unwrap();
    let longest = |p: &Vec3| {
        let on = Vec3::new(p.x.clamp(0.3, 0.7), 0.5, 1.0);
        (0.5 * (p - on).norm()).max(0.02)
    };
    let mesh = refine_to(&block, None, longest).unwrap();
    println!("{}", report(&mesh));
    assert_sound(&mesh);
    for number in 0..mesh.tetrahedra().len() {
        let positions = mesh.positions(number);
        let centroid = positions.iter().sum::<Vec3>() / 4.0;
        let allowed = positions
            .iter()
            .map(longest)
            .fold(longest(&centroid), f64::min);
        for (k, p) in positions.iter().enumerate() {
            assert!(positions[..k].iter().all(|q| (p - q).norm() <= allowed));
        }
    }
}

/// Judge: the volume of the surface; vertices of the boundary lie on it, so that what is missing
/// falls to a quarter each time.
#[test]
fn eight_for_one_converges_to_the_surface() {
    let (surface, _) = organ(Organ::Kidney, 100_000);
    let mut mesh = fill(&surface, &FillSettings::with_about(&surface, 1_000)).unwrap();
    let missing = [(); 3].map(|()| {
        mesh = refine_uniformly(&mesh, Some(&surface)).unwrap();
        let missing = 1.0 - mesh.volume() / surface.mesh().volume();
        println!("{}, {missing:e} missing", report(&mesh));
        assert_sound(&mesh);
        missing
    });
    let order = (missing[0] / missing[2]).log2() / 2.0;
    assert!((1.8..2.2).contains(&order), "order {order}");
}

/// Edges of the boundary with one end inside of the sphere and one outside.
fn crossings(mesh: &TetrahedronMesh, center: &Vec3, radius: f64) -> usize {
    let side = |node: &palpate_geometry::NodeId| {
        let height = (mesh.vertices()[node.index()] - center).norm() / radius - 1.0;
        if height.abs() < 1e-8 { 0.0 } else { height }
    };
    let boundary = mesh.boundary();
    boundary
        .iter()
        .filter(|(corners, _)| {
            let sides = corners.each_ref().map(side);
            sides.iter().any(|&s| s < 0.0) && sides.iter().any(|&s| s > 0.0)
        })
        .count()
}

/// Judge: the area of a spherical cap of chord radius r, π r², whatever the ball. Flat triangles
/// miss parts of it with the square of the edge over the radius of the circle.
#[test]
fn a_circle_is_resolved() {
    let (surface, _) = organ(Organ::Hemisphere, 100_000);
    let center = Vec3::z() * 0.05;
    let filled = fill(&surface, &FillSettings::new(0.006)).unwrap();
    for radius in [0.004, 0.005, 0.0063] {
        let focus = Focus {
            center,
            radius: 0.01,
            edge: radius / 4.0,
        };
        let mesh = refine_near(&filled, Some(&surface), &focus).unwrap();
        let (mesh, how) = resolve_sphere(&mesh, Some(&surface), &center, radius).unwrap();
        assert_sound(&mesh);
        assert_eq!((how.crossing, crossings(&mesh, &center, radius)), (0, 0));
        let inside = |corners: &[palpate_geometry::NodeId; 3]| {
            let positions = corners.map(|node| mesh.vertices()[node.index()]);
            let within = |p: &Vec3| (p - center).norm() <= radius * (1.0 + 1e-8);
            positions.iter().all(within).then_some(positions)
        };
        let area: f64 = mesh
            .boundary()
            .iter()
            .filter_map(|(corners, _)| inside(corners))
            .map(|[a, b, c]| 0.5 * (b - a).cross(&(c - a)).norm())
            .sum();
        let part = area / (PI * radius * radius);
        println!("{}, {how:?}, area {part}", report(&mesh));
        assert!((0.98..1.001).contains(&part), "{part}");
    }
}

#[test]
fn lengths_that_are_none_are_refused() {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [1, 1, 1]).unwrap();
    let center = Vec3::zeros();
    for bad in [0.0, -1.0, f64::NAN] {
        for (radius, edge) in [(bad, 0.1), (0.1, bad)] {
            let focus = Focus {
                center,
                radius,
                edge,
            };
            let error = refine_near(&block, None, &focus).unwrap_err();
            assert!(matches!(error, TetrahedronError::NotALength { .. }));
        }
        assert!(resolve_sphere(&block, None, &center, bad).is_err());
    }
    let (radius, edge) = (1.0, 1e-3);
    let error = refine_near(
        &block,
        None,
        &Focus {
            center,
            radius,
            edge,
        },
    )
    .unwrap_err();
    assert!(error.to_string().contains("at most 4000000"), "{error}");
}

/// A speck in a corner that no hundred rounds resolve: three halve an edge.
#[test]
fn an_edge_that_is_not_reached_is_refused() {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [1, 1, 1]).unwrap();
    let focus = Focus {
        center: Vec3::zeros(),
        radius: 1e-14,
        edge: 1e-13,
    };
    let error = refine_near(&block, None, &focus).unwrap_err();
    assert!(
        matches!(error, TetrahedronError::NotRefined { rounds: 100, edge_m } if edge_m > 1e-13),
        "{error}"
    );
    let reached = Focus {
        edge: 1e-6,
        ..focus
    };
    assert!(refine_near(&block, None, &reached).is_ok());
}
