//! What stands beside the organ. Judge: a cube that is scaled, turned and moved by hand.

use palpate_files::Scene;
use palpate_geometry::Vec3;
use palpate_simulate::read_neighbour;

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
    let hard = scene("builtin = \"spleen\"\ncollides = true");
    let hard = palpate_simulate::Simulation::new(&hard).unwrap();
    assert!(
        hard.doubts()
            .iter()
            .any(|doubt| doubt.contains("pass through neighbours"))
    );
}
