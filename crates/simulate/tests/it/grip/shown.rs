//! Where held tissue is seen.

use nalgebra::UnitQuaternion;
use palpate_files::scene::{Enhancement, EnhancementArea, Jaws};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{EnhancedSurface, Simulation};

use super::{HEMISPHERE, Hands, POLE, around_the_pole, grasping, pose, with_jaws};
use crate::scenes::{Setting, nearest};

/// Judge: what is seen is where the jaws have it.
#[test]
fn held_tissue_is_shown_between_the_jaws() {
    let simulation = with_jaws(&HEMISPHERE, |plain| around_the_pole(plain).0);
    let mut hands = Hands::new(&simulation);
    hands.at(&POLE, 0.0);
    hands.at(&POLE, 1.0);
    let by = Vec3::new(2e-3, 1e-3, 5e-3);
    hands.at(&(POLE + by), 1.0);
    let rest = simulation.surface().mesh().vertices();
    let pole = rest
        .iter()
        .position(|place| (place - POLE).norm() < 1e-9)
        .unwrap();
    let shown = hands.state.deformed.vertices()[pole] - rest[pole];
    println!("{shown:?} beside {by:?}");
    assert!((shown - by).norm() < 0.01 * by.norm(), "{shown}");
    let farthest = rest.iter().position(|place| place.z == 0.0).unwrap();
    assert!((hands.state.deformed.vertices()[farthest] - rest[farthest]).norm() < 1e-4);
}

/// Judge: where the jaws are, on a surface whose triangles are made finer around them.
#[test]
fn a_finer_surface_goes_with_the_jaws() {
    let setting = Setting {
        organ: "builtin = \"kidney\"\ntriangles = 2000",
        model: "response = \"boundary_elements\"\nmechanical_triangles = 500",
        ..HEMISPHERE
    };
    let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 1)).unwrap();
    let finer = Enhancement {
        area: EnhancementArea::Vertex,
        levels: 2,
        ..*simulation.enhancement().unwrap()
    };
    let mut surface = EnhancedSurface::new(&simulation, finer).unwrap().unwrap();
    let tree = AabbTree::new(simulation.surface().mesh());
    let (point, normal) = nearest(&simulation, &tree, &Vec3::new(0.0, 0.0, 1.0));
    let turned = UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap();
    let mut hands = Hands::new(&simulation);
    let place = |up: f64| point + normal * up;
    hands.go(&[pose(&place(-1e-3), &turned, 0.0)]);
    hands.go(&[pose(&place(-1e-3), &turned, 1.0)]);
    hands.go(&[pose(&place(4e-3), &turned, 1.0)]);
    assert!(hands.tool().is_grasping());
    assert!(surface.follow(hands.state.organ_field.as_ref().unwrap()));
    let tip = place(4e-3);
    let shown = surface.places().iter().map(|vertex| (vertex - tip).norm());
    let nearest_to_tip = shown.fold(f64::INFINITY, f64::min);
    println!(
        "the nearest vertex is {:.2} mm from the tip",
        1e3 * nearest_to_tip
    );
    // The size of the finer triangles.
    assert!(nearest_to_tip < 1e-3, "{nearest_to_tip}");
}
