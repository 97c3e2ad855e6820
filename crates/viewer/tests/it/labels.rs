//! Depths and labels of a picture, by rays through its pixels.

use palpate_files::Scene;
use palpate_geometry::AabbTree;
use palpate_simulate::{Simulation, SimulationState};
use palpate_viewer::{Label, Studio};

use crate::{TURN, gpu};

const SIZE: (u32, u32) = (64, 48);

/// Judge: a ray from the eye through the middle of each pixel, cast at the organ by the tree of its triangles.
#[test]
fn depths_and_labels_are_those_of_rays() {
    let text = "format = 1\n[organ]\nbuiltin = \"liver\"\ntriangles = 3000\nbuiltin_tissue = \"pig-liver\"\n\
                [model]\nkind = \"local\"\n";
    let Some(gpu) = gpu() else { return };
    let _turn = TURN.lock();
    let scene = Scene::parse(text, "scene.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    let mut studio = Studio::with_gpu(gpu, &scene, &simulation, SIZE).unwrap();
    let measured = studio.labels(&SimulationState::new(&simulation)).unwrap();
    assert_eq!(measured.size, SIZE);
    let mesh = simulation.surface().mesh();
    let tree = AabbTree::new(mesh);
    let camera = studio.view.camera;
    let [_, _, back] = camera.axes();
    let aspect = f64::from(SIZE.0) / f64::from(SIZE.1);
    let (mut alike, mut seen) = (0, 0);
    let pixels = measured.depths.iter().zip(&measured.labels);
    for (number, (&depth, &label)) in (0u32..).zip(pixels) {
        let place = (
            (f64::from(number % SIZE.0) + 0.5) / f64::from(SIZE.0),
            (f64::from(number / SIZE.0) + 0.5) / f64::from(SIZE.1),
        );
        let ray = camera.ray(place, aspect);
        let hit = tree.cast(mesh, &camera.eye, &ray, 2.0);
        let (expected, wanted) = match &hit {
            Some(hit) => (-hit.distance * ray.dot(&back), Label::Organ),
            None => (0.0, Label::Background),
        };
        assert_eq!(depth > 0.0, label != 0);
        seen += usize::from(hit.is_some());
        // Single precision in metres, through a projection: a micrometre.
        alike +=
            usize::from(label == wanted.number() && (f64::from(depth) - expected).abs() < 2e-6);
    }
    let all = (SIZE.0 * SIZE.1) as usize;
    assert!(seen > all / 10);
    // Rays that pass an edge of the outline within rounding may go either way.
    assert!(alike >= all - 3, "{alike} of {all}");
}
