//! Refinement of tetrahedra.

use std::f64::consts::PI;

use palpate_geometry::{
    FillSettings, Level, Organ, Resolved, Surface, TetrahedronError, TetrahedronMesh, Vec3, fill,
    refine_to, resolve_levels,
};

use crate::shapes::{organ, tries};
use crate::tetrahedra::{assert_sound, report};
use crate::{data, fill::real};

/// A ball in which edges are to be no longer than `edge` [m], from where they grow.
struct Focus {
    center: Vec3,
    radius: f64,
    edge: f64,
}

impl Focus {
    fn longest(&self, at: &Vec3) -> f64 {
        self.edge + 0.5 * ((at - self.center).norm() - self.radius).max(0.0)
    }
}

fn refine_near(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
    focus: &Focus,
) -> Result<TetrahedronMesh, TetrahedronError> {
    refine_to(mesh, surface, |at| focus.longest(at))
}

/// The boundary is not to cross a sphere.
fn resolve_circle(
    mesh: TetrahedronMesh,
    surface: &Surface,
    center: &Vec3,
    radius: f64,
) -> (TetrahedronMesh, Resolved) {
    let level = Level {
        height: &|at| (at - center).norm() - radius,
        boundary_only: true,
    };
    let (mesh, resolved) = resolve_levels(mesh, Some(surface), &[level]).unwrap();
    (mesh, resolved.into_iter().next().unwrap())
}

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
    let settings = FillSettings::with_tetrahedron_count(surface, 10_000);
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
    let (resolved, how) = resolve_circle(mesh, surface, &center, circle);
    println!(
        "  {}, {} moved, {} cut",
        report(&resolved),
        how.moved,
        how.cut
    );
    assert_sound(&resolved);
    assert_eq!(
        (how.crossing, crossings(&resolved, &center, circle)),
        (0, 0)
    );
    assert!(resolved.quality().least_dihedral.to_degrees() > 5.0);
}

#[test]
#[ignore = "long"]
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
#[ignore = "long"]
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
#[ignore = "long"]
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
        let (mesh, how) = resolve_circle(mesh, &surface, &center, radius);
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
        println!("{}, area {part}", report(&mesh));
        assert!((0.98..1.001).contains(&part), "{part}");
    }
}

/// Judge: volumes of balls in closed form. They are met by flat triangles, whose error falls with the square of the edge; a
/// level that another one crosses keeps its side.
#[test]
fn balls_become_sets_of_tetrahedra() {
    let (low, high) = (Vec3::zeros(), Vec3::new(1.0, 0.9, 0.8));
    let block = TetrahedronMesh::block(low, high, [6, 6, 6]).unwrap();
    let balls = [
        (Vec3::new(0.4, 0.45, 0.4), 0.25),
        (Vec3::new(0.6, 0.45, 0.8), 0.3),
    ];
    let heights = balls.map(|(center, radius)| move |at: &Vec3| (at - center).norm() - radius);
    let mut before: Option<f64> = None;
    for edge in [0.1, 0.05] {
        let near = |at: &Vec3| {
            heights
                .iter()
                .map(|h| h(at).abs())
                .fold(f64::INFINITY, f64::min)
        };
        let mesh = refine_to(&block, None, |at| edge + 0.5 * near(at)).unwrap();
        let levels = [0, 1].map(|k| Level {
            height: &heights[k],
            boundary_only: false,
        });
        let (mesh, how) = resolve_levels(mesh, None, &levels).unwrap();
        assert_sound(&mesh);
        println!("{}", report(&mesh));
        assert!((mesh.volume() - 0.72).abs() < 1e-12);
        assert!(mesh.quality().least_dihedral.to_degrees() > 2.8);
        let error = [0, 1].map(|k| {
            let mut inside = 0.0;
            for number in 0..mesh.tetrahedra().len() {
                let [a, b, c, d] = mesh.positions(number);
                if how[k].below[number] {
                    inside += (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
                }
            }
            let radius = balls[k].1;
            // The second is half a ball.
            inside / (4.0 / 3.0 * PI * radius.powi(3)) * [1.0, 2.0][k] - 1.0
        });
        let counts = [0, 1].map(|k: usize| [how[k].moved, how[k].cut, how[k].crossing]);
        println!("moved, cut, still crossing: {counts:?}, volumes off by {error:?}");
        // An edge stays where its cut would make an angle below 2.9°.
        assert!(
            counts
                .iter()
                .all(|[moved, cut, crossing]| 50 * crossing <= moved + cut)
        );
        let worst = error.into_iter().map(f64::abs).fold(0.0, f64::max);
        assert!(before.is_none_or(|before| worst < 0.4 * before), "{worst}");
        before = Some(worst);
    }
}

/// Judge: the volume of each region, which refinement and another level leave as it is.
#[test]
fn regions_keep_their_shapes() {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [2, 2, 2]).unwrap();
    let upper = |mesh: &TetrahedronMesh, t: usize| {
        let [a, b, c, d] = mesh.positions(t);
        u32::from(0.25 * (a + b + c + d).z > 0.5)
    };
    let regions = (0..block.tetrahedra().len()).map(|t| upper(&block, t));
    let block = block.clone().with_regions(regions.collect()).unwrap();
    let focus = Focus {
        center: Vec3::new(0.4, 0.5, 0.5),
        radius: 0.1,
        edge: 0.05,
    };
    let mesh = refine_near(&block, None, &focus).unwrap();
    let level = Level {
        height: &|at| (at - focus.center).norm() - 0.13,
        boundary_only: false,
    };
    let (mesh, how) = resolve_levels(mesh, None, &[level]).unwrap();
    println!("{}, {} cut", report(&mesh), how[0].cut);
    let mut volumes = [0.0; 2];
    for number in 0..mesh.tetrahedra().len() {
        assert_eq!(mesh.region(number), upper(&mesh, number));
        let [a, b, c, d] = mesh.positions(number);
        volumes[mesh.region(number) as usize] += (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
    }
    assert!(
        volumes.iter().all(|volume| (volume - 0.5).abs() < 1e-12),
        "{volumes:?}"
    );
    assert!(block.clone().with_regions(vec![0]).is_err());
}

#[test]
#[ignore = "long"]
fn too_many_tetrahedra_are_refused() {
    let block = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [1, 1, 1]).unwrap();
    let error = refine_to(&block, None, |_| 1e-3).unwrap_err();
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
