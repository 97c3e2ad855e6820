//! Light on tissue, measured in pictures.

use palpate_files::{Pose, Scene};
use palpate_geometry::Vec3;
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};
use palpate_viewer::{Camera, Lamp, Looks, RgbaImage, Studio};

use crate::{TURN, gpu};

/// Light of a display's byte: the inverse of the curve of [Narkowicz 2016] and of the gamma, by bisection.
fn light(byte: u8) -> f64 {
    let curve = |x: f64| (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    let wanted = (f64::from(byte) / 255.0).powf(2.2);
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if curve(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Judge: the law of a point's light. Of the light of the lamp and that from all sides, which is the same at every
/// distance, the first falls with the squared distance: the differences between three distances have one ratio. A
/// level of 255 is up to 3 % of the light here, and a difference has two.
#[test]
fn the_light_of_an_endoscope_falls_with_the_squared_distance() {
    if gpu().is_none() {
        return;
    }
    let _turn = TURN.lock();
    let text = "format = 1\n[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n\
                [view]\nshading = \"plain\"\n";
    let scene = Scene::parse(text, "scene.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    let state = SimulationState::new(&simulation);
    let mut studio = Studio::new(&scene, &simulation, (64, 64)).unwrap();
    studio.view.looks = Looks::NONE;
    let distances = [0.10, 0.14, 0.20];
    let seen = distances.map(|distance| {
        let target = Vec3::new(0.0, 0.0, 0.05);
        studio.view.camera = Camera {
            eye: target + distance * Vec3::z(),
            target,
            up: Vec3::y(),
            field_of_view: 0.8,
            lamp: Some(Lamp {
                distance: 0.24,
                brightness: 1.0,
            }),
        };
        // Blue is the darkest and does not saturate.
        light(studio.picture(&state).unwrap().get_pixel(32, 32).0[2])
    });
    let falls = distances.map(|d: f64| 1.0 / (d * d));
    let found = (seen[0] - seen[1]) / (seen[1] - seen[2]);
    let expected = (falls[0] - falls[1]) / (falls[1] - falls[2]);
    assert!(
        (found / expected - 1.0).abs() < 0.12,
        "{seen:?}: {found} {expected}"
    );
}

/// A probe above the hemisphere, with its shadow and without.
fn under_a_probe() -> [RgbaImage; 2] {
    let text = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n\
                [[tool]]\nname = \"right\"\ntip = { shape = \"sphere\", radius_m = 0.004 }\n";
    let scene = Scene::parse(text, "scene.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    let mut state = SimulationState::new(&simulation);
    let mut workspace = SimulationWorkspace::new(&simulation);
    let pose = Pose {
        position_m: [0.0, -0.020, 0.060],
        orientation: None,
        grip: 0.0,
        cut: false,
    };
    let poses = [Some(pose)];
    step(&simulation, 0.0, 0.0, &poses, &mut state, &mut workspace);
    let mut studio = Studio::new(&scene, &simulation, (320, 200)).unwrap();
    [true, false].map(|shadows| {
        studio.view.looks.shadows = shadows;
        studio.picture(&state).unwrap()
    })
}

/// Judge: the picture without the shadow. A shadow makes nothing brighter beyond rounding, darkens a part of the tissue
/// by more than the 10 levels that figure 7-12 counts as seen, and ends softly: around it less is missing. The probe's
/// tip covers some 200 pixels, so 50 are a quarter of its own shadow.
#[test]
fn the_shadow_of_a_tool_darkens_tissue() {
    if gpu().is_none() {
        return;
    }
    let _turn = TURN.lock();
    let [with, without] = under_a_probe();
    let (mut dark, mut between) = (0, 0);
    for (a, b) in with.pixels().zip(without.pixels()) {
        assert!((0..3).all(|c| a.0[c] <= b.0[c].saturating_add(1)));
        match b.0[0] - a.0[0].min(b.0[0]) {
            11.. => dark += 1,
            3..=10 => between += 1,
            _ => {}
        }
    }
    assert!(dark > 50 && between > 50, "{dark} {between}");
}
