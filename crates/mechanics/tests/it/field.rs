//! The displacement that is shown around a contact.

use nalgebra::Vector3;
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{
    Assembly, FiniteSphereModel, FiniteSphereSettings, FiniteSphereWorkspace, Form, LocalContact,
    Response,
};

use crate::contacts::{RADIUS, Random, bare_contact, model, tries};

const TIP: f64 = 2e-3;

struct Shown {
    model: FiniteSphereModel,
    contact: LocalContact,
    response: Response,
    workspace: FiniteSphereWorkspace,
}

impl Shown {
    fn new(settings: FiniteSphereSettings, nu: f64, bond: Friction, curvature: f64) -> Self {
        let model = model(settings, nu, bond);
        let contact = bare_contact(Vector3::new(curvature, 0.0, curvature), TIP, RADIUS);
        let mut workspace = model.workspace();
        let response = model.respond(&contact, &mut workspace);
        Self {
            model,
            contact,
            response,
            workspace,
        }
    }

    fn at(&mut self, tip: &Vec3, x: &Vec3) -> Vec3 {
        self.model
            .displacement(&self.contact, &self.response, &mut self.workspace, tip, x)
    }

    /// The point of the surface at `distance` [m] along the azimuth `turn`.
    fn on_surface(&self, distance: f64, turn: f64) -> Vec3 {
        let sine = 0.5 * self.contact.curvature[0] * distance;
        let across = distance * (1.0 - sine * sine).sqrt();
        Vec3::new(across * turn.cos(), across * turn.sin(), -distance * sine)
    }
}

fn every_kind() -> Vec<FiniteSphereSettings> {
    let settings = FiniteSphereSettings::default();
    vec![
        settings,
        FiniteSphereSettings {
            form: Form::Strong,
            ..settings
        },
        FiniteSphereSettings {
            assembly: Assembly::Reused,
            ..settings
        },
        FiniteSphereSettings {
            particles: 93,
            ..settings
        },
    ]
}

#[test]
fn at_the_contact_it_is_the_displacement_of_the_tip() {
    let mut random = Random(1);
    for settings in every_kind() {
        for bond in [Friction::Frictionless, Friction::Bonded] {
            let mut shown = Shown::new(settings, 0.45, bond, 15.0);
            for _ in 0..tries(50) {
                let tip = 1e-3 * random.vector();
                let carried = match bond {
                    Friction::Bonded => tip,
                    Friction::Frictionless => Vec3::z() * tip.z,
                };
                let found = shown.at(&tip, &Vec3::zeros());
                // Rounding.
                assert!((found - carried).norm() < 1e-15, "{settings:?} {bond:?}");
            }
        }
    }
}

/// The normal displacement falls along the surface and is nothing beyond the shown radius. Judge up to
/// the first shell: the flat punch's (2/π) asin(a/r).
#[test]
fn it_falls_along_the_surface_and_ends() {
    for settings in every_kind() {
        for nu in [0.3, 0.45] {
            let mut shown = Shown::new(settings, nu, Friction::Frictionless, 1.0 / RADIUS);
            let end = shown.model.shown_radius(TIP);
            let tip = -1e-3 * Vec3::z();
            let mut profile = Vec::new();
            for step in 0..=60 {
                let distance = end * f64::from(step) / 60.0;
                let mean: f64 = (0..12)
                    .map(|k| {
                        let x =
                            shown.on_surface(distance, std::f64::consts::TAU * f64::from(k) / 12.0);
                        -shown.at(&tip, &x).z / (12.0 * 1e-3)
                    })
                    .sum();
                profile.push((distance, mean));
            }
            let punch = |r: f64| std::f64::consts::FRAC_2_PI * (TIP / r.max(TIP)).asin();
            let near = shown.model.spacing(TIP);
            let off = profile
                .iter()
                .filter(|(r, _)| *r < near)
                .map(|(r, u)| (u - punch(*r)).abs())
                .fold(0.0, f64::max);
            let rise = profile
                .windows(2)
                .map(|pair| pair[1].1 - pair[0].1)
                .fold(0.0, f64::max);
            let particles = settings.particles;
            println!(
                "{particles}, {:?}, {:?}, nu {nu}: off the punch by {off:.3}, rises by {rise:.4}",
                settings.form, settings.assembly
            );
            // Against finite elements the profile of the weak form's 34 particles is within 0.06 of the
            // depth; the strong form's, shown only, is a quarter too low between edge and shell.
            let bound = if settings.form == Form::Weak {
                0.06
            } else {
                0.3
            };
            assert!(off < bound, "{off}: {profile:?}");
            assert!(rise < 0.02, "{rise}: {profile:?}");
            let least = profile.iter().map(|p| p.1).fold(f64::INFINITY, f64::min);
            assert!(least > -0.02, "{least}: {profile:?}");
            for beyond in [1.0, 1.001, 3.0] {
                let x = shown.on_surface(beyond * end, 0.3);
                assert_eq!(shown.at(&tip, &x), Vec3::zeros());
            }
        }
    }
}

/// Between the held particles the moving-least-squares field is not held exactly. What is left is the
/// leap over the held shell, in parts of the tip's displacement.
#[test]
fn it_goes_over_the_held_shell_without_a_visible_leap() {
    for settings in every_kind() {
        for nu in [0.3, 0.45] {
            let mut shown = Shown::new(settings, nu, Friction::Frictionless, 1.0 / RADIUS);
            let held = shown.model.fixed_radius(TIP);
            let tip = -1e-3 * Vec3::z();
            let mut leap: f64 = 0.0;
            for k in 0..360 {
                let turn = f64::from(k).to_radians();
                let inside = shown.on_surface(held * (1.0 - 1e-9), turn);
                let outside = shown.on_surface(held * (1.0 + 1e-9), turn);
                leap = leap.max((shown.at(&tip, &inside) - shown.at(&tip, &outside)).norm() / 1e-3);
            }
            println!(
                "{}, {:?}, {:?}, nu {nu}: leap {leap:.4} of the tip's displacement",
                settings.particles, settings.form, settings.assembly
            );
            // Measured 0.011 for the weak form, 0.03 for the strong one, which is wavier between
            // particles. Of a depth of 2 mm that is less than a tenth of a millimetre.
            let bound = if settings.form == Form::Weak {
                0.02
            } else {
                0.05
            };
            assert!(leap < bound, "{settings:?}: {leap}");
        }
    }
}

/// Judge: elasticity, in which nothing moves much farther than the tip that moves it. Under curvatures of both signs, at
/// places inside the organ and, where it is folded, above the surface that the particles are under. The strong form has
/// poles over the steepest saddles and no such bound: it was at most 6.3 times as far.
#[test]
fn nothing_is_shown_much_farther_than_its_tip() {
    let mut random = Random(4);
    for (form, most) in [(Form::Weak, 1.25), (Form::Strong, 8.0)] {
        let settings = FiniteSphereSettings {
            form,
            ..FiniteSphereSettings::default()
        };
        let model = model(settings, 0.45, Friction::Bonded);
        let mut workspace = model.workspace();
        let mut farthest = (0.0_f64, String::new());
        for _ in 0..50 {
            let contact = bare_contact(400.0 * random.vector(), TIP, 0.3 * RADIUS);
            let response = model.respond(&contact, &mut workspace);
            for _ in 0..100 {
                let tip = random.vector();
                let x = 2.0 * model.shown_radius(TIP) * random.vector();
                let moved = model.displacement(&contact, &response, &mut workspace, &tip, &x);
                let ratio = moved.norm() / tip.norm();
                if ratio > farthest.0 {
                    farthest = (ratio, format!("{tip:?} {x:?} {contact:?} {response:?}"));
                }
            }
        }
        println!("{form:?}: {:.3} times as far as the tip", farthest.0);
        assert!(farthest.0 < most, "{form:?}: {farthest:?}");
    }
}

/// Inside, neighbouring points move alike: halving the distance halves the difference.
#[test]
fn it_is_continuous_inside() {
    let mut shown = Shown::new(
        FiniteSphereSettings::default(),
        0.45,
        Friction::Bonded,
        10.0,
    );
    let held = shown.model.fixed_radius(TIP);
    let tip = Vec3::new(3e-4, -2e-4, -1e-3);
    let mut random = Random(2);
    let mut worst = [0.0f64; 2];
    for _ in 0..tries(5_000) {
        let x = shown.on_surface(
            0.99 * held * random.unit(),
            std::f64::consts::TAU * random.unit(),
        );
        let aside = random.vector().normalize();
        let here = shown.at(&tip, &x);
        for (k, step) in [1e-5, 5e-6].into_iter().enumerate() {
            let there = shown.at(&tip, &(x + step * aside));
            if (x + step * aside).norm() < held {
                worst[k] = worst[k].max((there - here).norm());
            }
        }
    }
    println!("largest difference over 10 and 5 micrometres: {worst:?} m");
    assert!(worst[1] < 0.6 * worst[0], "{worst:?}");
}
