use palpate_files::Scene;
use palpate_geometry::AabbTree;
use palpate_simulate::{Simulation, SimulationState};
use palpate_viewer::{Studio, pick};

use crate::{TURN, gpu};

/// Where rays from the camera meet the organ the picture is bright tissue, and dark elsewhere: two ways to
/// the same outline, of which one is the adapter's and one the tree of boxes'. A pixel of the outline may
/// fall to either side.
#[test]
fn the_picture_is_where_the_camera_says() {
    if gpu().is_none() {
        return;
    }
    let _turn = TURN.lock();
    let text = "format = 1\n[organ]\nbuiltin = \"stomach\"\nbuiltin_tissue = \"pig-liver\"\n\
                [view]\nshading = \"plain\"\n";
    let scene = Scene::parse(text, "scene.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    let (width, height) = (200, 120);
    let mut studio = Studio::new(&scene, &simulation, (width, height)).unwrap();
    let state = SimulationState::new(&simulation);
    let picture = studio.picture(&state).unwrap();
    let tree = AabbTree::new(simulation.surface().mesh());
    let camera = studio.view.camera;
    let (mut same, mut inside) = (0, 0);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let place = (
            (f64::from(x) + 0.5) / f64::from(width),
            (f64::from(y) + 0.5) / f64::from(height),
        );
        let aspect = f64::from(width) / f64::from(height);
        let hit = pick(simulation.surface(), &tree, &camera, place, aspect).is_some();
        let bright = pixel[0] > pixel[2].saturating_add(12);
        same += u32::from(hit == bright);
        inside += u32::from(hit);
    }
    let pixels = width * height;
    assert!(inside > pixels / 8, "{inside}");
    // The outline is some 400 pixels of 24,000.
    assert!(same > pixels * 98 / 100, "{same} of {pixels}");
}

/// Vertices that move are drawn where they are: an organ lifted out of the picture leaves the background.
#[test]
fn deformed_vertices_are_drawn_where_they_are() {
    if gpu().is_none() {
        return;
    }
    let _turn = TURN.lock();
    let text = "format = 1\n[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n";
    let scene = Scene::parse(text, "scene.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    let mut studio = Studio::new(&scene, &simulation, (64, 64)).unwrap();
    let mut state = SimulationState::new(&simulation);
    let middle = |studio: &mut Studio, state: &SimulationState| {
        studio.picture(state).unwrap().get_pixel(32, 32).0
    };
    let there = middle(&mut studio, &state);
    state.deformed = state
        .deformed
        .map_vertices(|v| v + 10.0 * nalgebra::Vector3::z())
        .unwrap();
    let gone = middle(&mut studio, &state);
    state.deformed = simulation.surface().mesh().clone();
    assert!(there[0] > gone[0] + 40, "{there:?} {gone:?}");
    assert_eq!(middle(&mut studio, &state), there);
}
