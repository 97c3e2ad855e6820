//! What stands beside the organ. Judge: a cube that is scaled, turned and moved by hand.

use palpate_files::Scene;
use palpate_geometry::{Surface, Vec3};
use palpate_simulate::interactive::affine_force;
use palpate_simulate::{Simulation, read_neighbour};

use crate::scenes::Hand;

fn placed(keys: &str) -> Scene {
    let text = format!(
        "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n\
         [[neighbour]]\nbuiltin = \"cube\"\n{keys}\n"
    );
    Scene::parse(&text, "scene.toml").unwrap()
}

#[test]
fn a_neighbour_stands_where_it_is_placed() {
    let [plain, there] = [
        "",
        "at_m = [0.1, 0.2, 0.3]\nturn_deg = [90, 0, 30]\nscale = 0.5",
    ]
    .map(|keys| read_neighbour(&placed(keys).neighbours[0]).unwrap().0);
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let vertices = plain.mesh().vertices().iter().zip(there.mesh().vertices());
    for (from, to) in vertices {
        // A quarter about x takes y to z and z to -y; then 30° about z.
        let turned = Vec3::new(from.x, -from.z, from.y);
        let turned = Vec3::new(
            cos * turned.x - sin * turned.y,
            sin * turned.x + cos * turned.y,
            turned.z,
        );
        let expected = Vec3::new(0.1, 0.2, 0.3) + 0.5 * turned;
        assert!((to - expected).norm() < 1e-15, "{to} for {expected}");
    }
    // An edge of 0.05 m.
    assert!((there.mesh().volume() - 0.05_f64.powi(3)).abs() < 1e-12);
}

#[test]
fn a_neighbour_too_far_away_is_refused() {
    let text = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n\
                [[neighbour]]\nbuiltin = \"cube\"\nat_m = [1e300, 0, 0]\n";
    let message = Scene::parse(text, "scene.toml").unwrap_err().to_string();
    assert!(message.contains("at_m"), "{message}");
}

/// What is only seen is asked for when the scene is prepared, not when somebody looks.
#[test]
fn a_neighbour_that_is_not_there_is_refused() {
    let scene = |neighbour: &str| {
        let text = format!(
            "format = 1\n[organ]\nbuiltin = \"hemisphere\"\n[organ.tissue]\nlaw = \"linear\"\n\
             youngs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n[[neighbour]]\n{neighbour}\n"
        );
        palpate_files::Scene::parse(&text, "scene.toml").unwrap()
    };
    let missing = palpate_simulate::Simulation::new(&scene("mesh = \"nowhere.stl\""));
    let words = missing.err().unwrap().to_string();
    assert!(
        words.contains("nowhere.stl") && words.contains("no such file"),
        "{words}"
    );
}

/// A hemisphere under a tool beside `neighbour`, and the surface of that.
fn beside(contact: &str, neighbour: &str) -> (Simulation, Surface) {
    let text = format!(
        "format = 1\n[organ]\nbuiltin = \"hemisphere\"\n[organ.tissue]\nlaw = \"linear\"\n\
         youngs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n[[neighbour]]\n{neighbour}\ncollides = true\n\
         [[tool]]\nname = \"right\"\ntip = {{ shape = \"flat\", radius_m = 0.002, {contact} }}\n"
    );
    let scene = Scene::parse(&text, "scene.toml").unwrap();
    let body = read_neighbour(&scene.neighbours[0]).unwrap().0;
    (Simulation::new(&scene).unwrap(), body)
}

const CUBE: &str = "builtin = \"cube\"\ntriangles = 1200\nat_m = [0.0, 0.0, 0.1]";

/// The stiffness of a rigid body [N/m], as documented.
const STIFFNESS: f64 = 1000.0;

/// Judge: a spring along the normal, and Coulomb's law: a tip that is d deep sticks until it is μ d aside, and then
/// slides with μ times the normal force, back as well as forth.
#[test]
fn a_tool_stops_at_a_neighbour_and_slides_against_its_friction() {
    let (simulation, body) = beside("contact = \"stick\", friction = 0.4", CUBE);
    let (low, high) = body.mesh().bounds();
    let middle = 0.5 * (low + high);
    let at = |x: f64, depth: f64| Vec3::new(middle.x + x, middle.y, high.z - depth);
    let mut hand = Hand::new(&simulation);
    assert_eq!(hand.at(&at(0.0, -1e-3)), Vec3::zeros());
    let depth = 1e-3;
    for part in 1..=10 {
        let force = hand.at(&at(0.0, 0.1 * f64::from(part) * depth));
        let expected = Vec3::z() * (0.1 * f64::from(part) * depth * STIFFNESS);
        assert!((force - expected).norm() < 1e-9, "{force}");
    }
    let (mut aside, mut sheared) = (0.0, 0.0_f64);
    for step in 0..80 {
        let by = if step < 50 { 0.05e-3 } else { -0.05e-3 };
        aside += by;
        sheared = (sheared + by).clamp(-0.4 * depth, 0.4 * depth);
        let force = hand.at(&at(aside, depth));
        let expected = STIFFNESS * Vec3::new(-sheared, 0.0, depth);
        assert!(
            (force - expected).norm() < 1e-9,
            "{step}: {force} {expected}"
        );
    }
}

/// Judge: a spring of the stated stiffness.
#[test]
fn a_soft_neighbour_answers_with_its_stiffness() {
    let soft = format!("{CUBE}\nstiffness_n_per_m = 150.0");
    let (simulation, body) = beside("contact = \"slip\"", &soft);
    let (low, high) = body.mesh().bounds();
    let middle = 0.5 * (low + high);
    let mut hand = Hand::new(&simulation);
    for depth in [-1e-4, 5e-4, 1e-3] {
        let force = hand.at(&Vec3::new(middle.x, middle.y, high.z - depth));
        let expected = Vec3::z() * (150.0 * depth.max(0.0));
        assert!((force - expected).norm() < 1e-9, "{force}");
    }
    // Another stiffness is another scene; that of every earlier one keeps its digest.
    let digest = |neighbour: &str| {
        let (simulation, _) = beside("contact = \"slip\"", neighbour);
        simulation.session_header().scene_digest
    };
    let rigid = format!("{CUBE}\nstiffness_n_per_m = 1000.0");
    assert_eq!(digest(&rigid), digest(CUBE));
    assert_ne!(digest(&soft), digest(CUBE));
}

/// The servo loop is told of the neighbour, too: the force a little farther is that of the step there.
#[test]
fn the_slope_beside_a_neighbour_is_that_of_the_force() {
    let (simulation, body) = beside("contact = \"slip\"", CUBE);
    let (low, high) = body.mesh().bounds();
    let middle = 0.5 * (low + high);
    let at = |depth: f64| Vec3::new(middle.x, middle.y, high.z - depth);
    let mut hand = Hand::new(&simulation);
    hand.at(&at(-1e-4));
    hand.at(&at(5e-4));
    let told = affine_force(&simulation.tools()[0], &hand.state.tools[0], 0.0);
    assert!(told.contact && told.normal == Vec3::z());
    let force = told.force + told.gradient * (at(6e-4) - at(5e-4));
    assert!((force - hand.at(&at(6e-4))).norm() < 1e-9);
}

/// A hand that pushes on is held back by more and more, and never let out on the other side; what first appears within
/// a body is let out.
#[test]
fn a_tool_does_not_pass_through_a_neighbour() {
    let spleen = "builtin = \"spleen\"\nat_m = [0.0, 0.0, 0.2]";
    let (simulation, body) = beside("contact = \"slip\"", spleen);
    let (low, high) = body.mesh().bounds();
    let middle = 0.5 * (low + high);
    let mut hand = Hand::new(&simulation);
    let mut last = 0.0;
    let mut deep = 0;
    for step in 0..100 {
        let tip = Vec3::new(middle.x, middle.y, high.z + 5e-3 - 2e-4 * f64::from(step));
        let force = hand.at(&tip);
        assert!(force.z >= last - 1e-9, "{step}: {force}");
        last = force.z;
        deep += usize::from(force.z > 0.0);
    }
    assert!(deep > 30 && last > 5.0, "{deep} {last}");
    let mut hand = Hand::new(&simulation);
    assert_eq!(hand.at(&middle), Vec3::zeros());
    assert_eq!(hand.at(&(middle + Vec3::x() * 1e-3)), Vec3::zeros());
}
