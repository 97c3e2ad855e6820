//! A thin tube at large deformation under a ball that is as wide.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use palpate_geometry::{LengthUnit, NodeId, TriangleMesh, Vec3, WriteFormat};

use crate::nonlinear_shafts::with_friction;
use crate::scenes::{Hand, Setting};
use palpate_simulate::Simulation;

pub(crate) const RADIUS: f64 = 0.01;
pub(crate) const WALL: f64 = 2e-3;
pub(crate) const LENGTH: f64 = 0.08;

/// A closed surface of the tube along x, its top at z = 0: vertices in so many rows on either side, and columns around it.
pub(crate) fn tube(rows: usize, columns: usize) -> TriangleMesh {
    let along = |row: usize| LENGTH * (row as f64 / (rows - 1) as f64 - 0.5);
    let outside = (0..rows).map(|row| (along(row), RADIUS));
    let inside = (0..rows).rev().map(|row| (along(row), RADIUS - WALL));
    let profile: Vec<(f64, f64)> = outside.chain(inside).collect();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for (row, (x, radius)) in profile.iter().enumerate() {
        for column in 0..columns {
            let (sine, cosine) = (TAU * column as f64 / columns as f64).sin_cos();
            vertices.push(Vec3::new(*x, radius * sine, radius * cosine - RADIUS));
            let at = |row: usize, column: usize| {
                NodeId((row % profile.len() * columns + column % columns) as u32)
            };
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
            triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

/// Depth of the anchor at the ends of the tube [m].
const REACH: f64 = 1e-4;

/// The tube, fixed to the depth `reach` [m] at its ends, under the ball.
fn under_ball(folder: &Path, nodes: usize, reach: f64) -> (String, String) {
    let path = folder.join("tube.ply");
    fs::write(
        &path,
        WriteFormat::Ply.bytes(&tube(34, 26), LengthUnit::Metre),
    )
    .unwrap();
    held_tube(&path, nodes, reach)
}

/// The tube in a file, fixed to the depth `reach` [m] at its ends: lines of `[organ]` and of `[model]`.
pub(crate) fn held_tube(path: &Path, nodes: usize, reach: f64) -> (String, String) {
    let end = 0.5 * LENGTH - reach;
    let organ = format!(
        "mesh = {:?}\nmesh_unit = \"m\"\nanchor = {{ planes = [{{ point_m = [{end}, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }}, \
         {{ point_m = [-{end}, 0.0, 0.0], normal = [1.0, 0.0, 0.0] }}] }}",
        path.to_str().unwrap()
    );
    (organ, format!("nodes = {nodes}"))
}

fn ball<'a>(organ: &'a str, model: &'a str) -> Setting<'a> {
    Setting {
        model,
        organ,
        kind: "nonlinear",
        shape: "sphere",
        radius: RADIUS,
        ..Setting::default()
    }
}

/// Judges: Coulomb's law of the points of the wall that touch the ball, whose normals are up to 50° off the vertical: a ball that is
/// dragged along meets no more friction than 1.25 μ N, and μ N on average, but for 15 %: points that come into
/// contact first have to shear the wall. Symmetry: it is not pushed aside by more than a tenth. Little friction is none.
#[test]
#[ignore = "long"]
fn a_ball_dragged_along_a_thin_tube_slides_at_coulombs_force() {
    let folder = tempfile::tempdir().unwrap();
    let (organ, model) = under_ball(folder.path(), 1500, REACH);
    let dragged = |friction: Option<f64>| {
        let setting = ball(&organ, &model);
        let simulation = match friction {
            None => setting.simulation(),
            Some(friction) => with_friction(&setting, friction),
        };
        let mut hand = Hand::new(&simulation);
        let height = RADIUS - 3e-3;
        let mut at = |x: f64, lift: f64| hand.at(&Vec3::new(x, 0.0, height + lift));
        for step in (0..=60).rev() {
            at(-5e-3, 5e-5 * f64::from(step));
        }
        let along = (0..=100).map(|step| at(-5e-3 + 1e-4 * f64::from(step), 0.0));
        let forces: Vec<Vec3> = along.skip(20).collect();
        let mean = forces.iter().sum::<Vec3>() / forces.len() as f64;
        let ratios = forces.iter().map(|force| -force.x / force.z);
        (mean, ratios.fold(0.0, f64::max))
    };
    let [none, little, some] = [None, Some(1e-6), Some(0.3)].map(dragged);
    println!("{none:?} {little:?} {some:?}");
    let ((none, _), (little, _), (some, most)) = (none, little, some);
    assert!((none - little).norm() < 1e-3 * none.norm());
    let part = (none.x - some.x) / (0.3 * some.z);
    assert!((0.85..1.15).contains(&part), "{part}");
    assert!(most < 1.25 * 0.3, "{most}");
    assert!(some.y.abs() < 0.1 * some.z, "{some}");
}

/// Judge: tetrahedra of ten nodes by another code (FElupe, `benches/forces`), 4.75 mN at 2 mm and 10.15 mN at 5 mm. Tolerance: 5 %
/// with 3,000 nodes, as asked, where +1.6 and 0.0 % were found; with 1,500 edges are three times as long as the wall is thick (Limits
/// in `docs/theory/large_deformation.md`), and +17 and +18 % were found. The force neither leaps from step to step nor goes away: a
/// step of 50 µm adds 1.5 % of it.
#[test]
#[ignore = "long"]
fn a_ball_on_a_thin_tube_is_felt_smoothly() {
    let folder = tempfile::tempdir().unwrap();
    for (nodes, most) in [(1500, 0.2), (3000, 0.05)] {
        let (organ, model) = under_ball(folder.path(), nodes, REACH);
        let simulation = ball(&organ, &model).simulation();
        let mut hand = Hand::new(&simulation);
        let mut at = |depth: f64| hand.at(&Vec3::new(0.0, 0.0, RADIUS - depth)).z;
        let pressed: Vec<f64> = (1..=100).map(|step| at(5e-5 * f64::from(step))).collect();
        let held: Vec<f64> = (0..60).map(|_| at(5e-3)).collect();
        let deepest = held[59];
        println!("{nodes} nodes: {} and {deepest} N", pressed[39]);
        for (force, expected) in [(pressed[39], 4.75e-3), (deepest, 10.15e-3)] {
            let error = force / expected - 1.0;
            assert!(error.abs() < most, "{force} {expected}");
        }
        let all: Vec<f64> = pressed.into_iter().chain(held).collect();
        for pair in all.windows(2) {
            assert!((pair[1] - pair[0]).abs() < 0.05 * deepest, "{pair:?}");
        }
    }
}

/// Judges: the same tube with an anchor twice as deep, which fixes the same nodes: one that ends on a face of the organ
/// misses none. And a ring in the middle of the tube, narrower than the elements, between whose nodes it lies.
#[test]
#[ignore = "long"]
fn an_anchor_fixes_the_nodes_of_the_faces_that_it_holds() {
    let folder = tempfile::tempdir().unwrap();
    let said = |simulation: &Simulation| {
        let mut said = simulation.warnings().iter();
        said.any(|warning| warning.contains("the anchor fixes"))
    };
    let [thin, deep] = [REACH, 2.0 * REACH].map(|reach| {
        let (organ, model) = under_ball(folder.path(), 3000, reach);
        let simulation = ball(&organ, &model).simulation();
        assert!(!said(&simulation), "{reach}");
        let mut hand = Hand::new(&simulation);
        let each = (1..=20).map(|step| {
            hand.at(&Vec3::new(0.0, 0.0, RADIUS - 1e-4 * f64::from(step)))
                .z
        });
        each.last().unwrap()
    });
    println!("{thin} and {deep} N");
    assert!((thin / deep - 1.0).abs() < 1e-9, "{thin} {deep}");
    let (organ, model) = under_ball(folder.path(), 800, REACH);
    let (mesh, _) = organ.split_once('\n').unwrap();
    let ring = "boxes = [{ min_m = [-0.0013, -1.0, -1.0], max_m = [0.0013, 1.0, 1.0] }]";
    let organ = format!("{mesh}\nanchor = {{ {ring} }}");
    assert!(said(&ball(&organ, &model).simulation()));
}
