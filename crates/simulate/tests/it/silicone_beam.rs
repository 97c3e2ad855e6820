//! A clamped beam of silicone that hangs under its own weight, and under a weight at its tip, beside motion capture.

use std::path::Path;

use nalgebra::UnitQuaternion;
use palpate_files::Scene;
use palpate_geometry::{AabbTree, TriangleMesh, Vec3};
use palpate_simulate::Simulation;

use crate::data;
use crate::grip::{Hands, pose};

/// Load at the tip [N], as the authors of the measurement have it.
const LOAD: f64 = 0.510_12;

/// Places of the markers at rest on the surface, and what stands between them and it [m]: x is up, the tip is at z = 0.
const MARKERS: [([f64; 3], [f64; 3]); 3] = [
    ([0.030, 0.015, 0.0], [0.006, 0.0, 0.0]),
    ([0.024, 0.0, 0.0], [0.0, -0.006, 0.0]),
    ([0.006, 0.030, 0.0], [0.0, 0.006, 0.0]),
];

/// How far the markers go up [m]: mean of the last 50 frames less that of the first 20, over both repeats.
fn measured(folder: &Path, case: &str) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for repeat in ["a", "b"] {
        let path = folder.join(format!("beam_{case}_V2_{repeat}.csv"));
        let text = std::fs::read_to_string(path).unwrap();
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
            .collect();
        for (marker, sum) in sums.iter_mut().enumerate() {
            let mean = |rows: &[Vec<f64>]| {
                rows.iter().map(|row| row[1 + 3 * marker]).sum::<f64>() / rows.len() as f64
            };
            *sum += 0.5 * (mean(&rows[rows.len() - 50..]) - mean(&rows[..20]));
        }
    }
    sums
}

fn beam(folder: &Path, modulus: f64) -> Simulation {
    let text = format!(
        "format = 1\n[organ]\nmesh = {:?}\nmesh_unit = \"mm\"\n\
         anchor = {{ planes = [{{ point_m = [0.0, 0.0, 0.0995], normal = [0.0, 0.0, -1.0] }}] }}\n\
         [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = {modulus:?}\npoissons_ratio = 0.49\n\
         density_kg_m3 = 1070.0\n[model]\nkind = \"nonlinear\"\nnodes = 1500\ngravity_m_per_s2 = [-9.80709, 0.0, 0.0]\n\
         [[tool]]\nname = \"right\"\nkind = \"grasper\"\ntip = {{ shape = \"flat\", radius_m = 0.002 }}\n\
         jaws = {{ force_n = 100.0 }}\n",
        folder.join("beam_mm.stl").display().to_string()
    );
    Simulation::new(&Scene::parse(&text, "beam.toml").unwrap()).unwrap()
}

/// How far the markers are up from where they are on the straight beam [m].
fn markers(simulation: &Simulation, tree: &AabbTree, deformed: &TriangleMesh) -> [f64; 3] {
    let rest = simulation.surface().mesh();
    let now = |place: &Vec3| -> Vec3 {
        let near = tree.nearest(rest, place);
        let corners = rest.corners(near.triangle);
        let parts = corners.iter().zip(near.on.barycentric);
        parts
            .map(|(node, part)| deformed.vertices()[node.index()] * part)
            .sum()
    };
    // How the end has turned: its edge up.
    let up = now(&Vec3::new(0.03, 0.015, 0.0)) - now(&Vec3::new(0.0, 0.015, 0.0));
    MARKERS.map(|(place, off)| {
        let place = Vec3::from(place);
        now(&place).x - place.x + off[0] * (up.x / up.norm() - 1.0)
    })
}

/// How far the markers are up with the load at the tip [m]: a grasper holds the middle of the end's face, and is lowered until
/// it pulls with the load, while the end goes along the beam as it likes.
fn loaded(simulation: &Simulation, tree: &AabbTree) -> [f64; 3] {
    let mut hands = Hands::new(simulation);
    let turned = UnitQuaternion::from_axis_angle(&Vec3::y_axis(), std::f64::consts::PI);
    let near = tree.nearest(simulation.surface().mesh(), &Vec3::new(0.015, 0.015, 0.0));
    let corners = simulation.surface().mesh().corners(near.triangle);
    let hangs = &hands.state.deformed;
    let mut tip: Vec3 = corners
        .iter()
        .zip(near.on.barycentric)
        .map(|(node, part)| hangs.vertices()[node.index()] * part)
        .sum();
    for step in 0..=20 {
        let off = Vec3::z() * (1e-3 - 1e-4 * f64::from(step.min(12)));
        hands.go(&[pose(&(tip - off), &turned, 0.0)]);
    }
    tip.z += 2e-4;
    for step in 0..=10 {
        hands.go(&[pose(&tip, &turned, 0.1 * f64::from(step))]);
    }
    assert!(hands.state.tools[0].is_grasping());
    for _ in 0..300 {
        let force = -hands.state.tools[0].force;
        let lacks = Vec3::new(-LOAD - force.x, 0.0, -force.z);
        // A third of the way that a beam of this size needs, aside and along.
        let by = lacks.component_div(&Vec3::new(150.0, 1.0, 12_000.0));
        tip += by.map(|way| way.clamp(-1e-3, 1e-3));
        hands.go(&[pose(&tip, &turned, 1.0)]);
    }
    let force = -hands.state.tools[0].force;
    assert!((force.x + LOAD).abs() < 1e-3 * LOAD, "{force}");
    markers(simulation, tree, &hands.state.deformed)
}

/// Judge: six markers of a Qualisys system, two repeats. Young's modulus is fitted to the loaded beam and to nothing else; its
/// own weight is then foretold. Tolerance 1 mm in both, as asked; the repeats differ by 0.4 mm.
///
/// The other way round the loaded beam is 1.5 mm off: what was measured under its own weight is less than any beam's that
/// bends so under the load (Timoshenko's as well), for how straight it was held at first is not known.
#[test]
#[ignore = "slow: three beams, ten seconds"]
fn a_silicone_beam_hangs_as_measured() {
    let Some(folder) = data::folder() else { return };
    let folder = folder.join("validation/silicone_beam");
    let (own, load) = (measured(&folder, "gravity"), measured(&folder, "load52"));
    let mean = |each: &[f64; 3]| each.iter().sum::<f64>() / 3.0;
    let mut modulus = 2.5e5;
    let mut simulation = beam(&folder, modulus);
    let tree = AabbTree::new(simulation.surface().mesh());
    let mut found = loaded(&simulation, &tree);
    for _ in 0..2 {
        modulus *= mean(&found) / mean(&load);
        simulation = beam(&folder, modulus);
        found = loaded(&simulation, &tree);
    }
    println!("E = {modulus:.0} Pa: load {found:.5?} m, measured {load:.5?} m");
    for (found, load) in found.iter().zip(&load) {
        assert!((found - load).abs() < 1e-3, "{found} {load}");
    }
    let hands = Hands::new(&simulation);
    let found = markers(&simulation, &tree, &hands.state.deformed);
    println!("own weight {found:.5?} m, measured {own:.5?} m");
    for (found, own) in found.iter().zip(&own) {
        assert!((found - own).abs() < 1e-3, "{found} {own}");
    }
}
