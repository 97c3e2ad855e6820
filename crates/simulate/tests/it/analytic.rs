//! Closed forms judge: the flat punch on a half-space with the organ's size, Hertz, relaxation.

use palpate_files::Event;
use palpate_geometry::Vec3;
use palpate_mechanics::contact::{
    Friction, half_space_stiffness, half_space_tangential_stiffness, hertz_force,
};
use palpate_mechanics::finite_spheres::EXTERIOR_CONSTANTS;
use palpate_mechanics::{LinearElastic, PronySeries};
use palpate_simulate::Simulation;

use crate::scenes::{Hand, Setting, YOUNGS_MODULUS, motion, played};

/// Radius of the built-in hemisphere [m].
const ORGAN: f64 = 0.05;

const POLE: Vec3 = Vec3::new(0.0, 0.0, ORGAN);

fn below_pole(depth: f64) -> Vec3 {
    POLE - Vec3::z() * depth
}

fn law(poissons_ratio: f64) -> LinearElastic {
    LinearElastic::new(YOUNGS_MODULUS, poissons_ratio).unwrap()
}

/// Cosine of the angle between the pole's normal and that of the facets around it that lean most.
fn upright_at_pole(simulation: &Simulation) -> f64 {
    let mesh = simulation.surface().mesh();
    let at_pole = |corner: &Vec3| (corner - POLE).norm() < 1e-9;
    mesh.triangle_ids()
        .filter(|t| mesh.positions(*t).iter().any(at_pole))
        .map(|t| mesh.area_vector(t).normalize().z)
        .fold(1.0, f64::min)
}

/// The first term of the expansion in tip over organ, whose constant an axisymmetric finite-element
/// solution has given. 5 % is what a user is promised.
#[test]
#[ignore = "long"]
fn a_flat_tip_on_the_hemisphere_has_the_force_of_the_expansion() {
    on_hemispheres(&[768, 3072]);
}

/// The same on many triangles.
#[test]
#[ignore = "slow: half a minute"]
fn a_flat_tip_on_a_fine_hemisphere_has_the_force_of_the_expansion() {
    on_hemispheres(&[20_000]);
}

fn on_hemispheres(triangles: &[usize]) {
    let depth = 1e-3;
    let mut worst = (0.0_f64, String::new());
    for triangles in triangles {
        let organ = format!("builtin = \"hemisphere\"\ntriangles = {triangles}");
        for constants in EXTERIOR_CONSTANTS {
            for (contact, bond) in [
                ("slip", Friction::Frictionless),
                ("stick", Friction::Bonded),
            ] {
                for radius in [2e-3, 3e-3] {
                    let poissons_ratio = constants.poissons_ratio;
                    let simulation = Setting {
                        organ: &organ,
                        poissons_ratio,
                        radius,
                        contact,
                        ..Setting::default()
                    }
                    .simulation();
                    let mut hand = Hand::new(&simulation);
                    let force = hand.at(&below_pole(depth));
                    let half_space = half_space_stiffness(&law(poissons_ratio), radius, bond);
                    let size = 1.0 - constants.organ_size * radius / ORGAN;
                    let ratio = force.z / (half_space * depth / size);
                    let name = format!("{triangles} {poissons_ratio} {contact} {radius}: {ratio}");
                    println!("{name}");
                    assert!((ratio - 1.0).abs() < 0.05, "{name}");
                    if (ratio - 1.0).abs() > worst.0 {
                        worst = ((ratio - 1.0).abs(), name.clone());
                    }
                    // The facets at the pole lean, and the nearest is a little less than `depth` away.
                    let upright = upright_at_pole(&simulation);
                    let direction = force.z / force.norm();
                    assert!(direction >= upright - 1e-9, "{name}: {direction} along z");
                    let given = hand.row().depth_m / depth;
                    let range = upright - 1e-9..=1.0 + 1e-9;
                    assert!(range.contains(&given), "{name}: depth {given}");
                }
            }
        }
    }
    println!("worst {:.2} %: {}", 100.0 * worst.0, worst.1);
}

/// Hertz's two spheres. Tolerance: as of the flat punch.
#[test]
fn a_sphere_on_the_hemisphere_is_close_to_hertz() {
    for poissons_ratio in [0.3, 0.45] {
        let radius = 2e-3;
        let simulation = Setting {
            organ: "builtin = \"hemisphere\"\ntriangles = 20000",
            poissons_ratio,
            shape: "sphere",
            radius,
            ..Setting::default()
        }
        .simulation();
        for depth in [1e-4, 2e-4] {
            let mut hand = Hand::new(&simulation);
            let force = hand.at(&(POLE + Vec3::z() * (radius - depth)));
            let both = 1.0 / (1.0 / radius + 1.0 / ORGAN);
            let ratio = force.norm() / hertz_force(&law(poissons_ratio), both, depth);
            println!(
                "{poissons_ratio} {depth}: {ratio}, depth {}",
                hand.row().depth_m
            );
            assert!(
                (ratio - 1.0).abs() < 0.05,
                "{poissons_ratio} {depth}: {ratio}"
            );
        }
    }
}

/// A bonded circle moved sideways: 8 G a / (2 − ν), to the 5 % of the normal force. The organ, of a hundred times its radius, yields by
/// half of that in shear.
#[test]
fn a_stuck_tip_is_held_sideways() {
    let radius = 5e-4;
    let simulation = Setting {
        radius,
        contact: "stick",
        ..Setting::default()
    }
    .simulation();
    let mut hand = Hand::new(&simulation);
    let pressed = below_pole(radius);
    hand.at(&pressed);
    let aside = 0.1 * radius;
    for direction in [Vec3::x(), Vec3::y(), -Vec3::x()] {
        let before = hand.at(&pressed);
        let moved = hand.at(&(pressed + direction * aside)) - before;
        let stiffness = -moved.dot(&direction) / aside;
        let ratio = stiffness / half_space_tangential_stiffness(&law(0.45), radius);
        println!("{ratio}");
        assert!((ratio - 1.0).abs() < 0.05, "{direction:?}: {ratio}");
    }
}

#[test]
fn a_held_depth_relaxes_as_the_series_says() {
    let simulation = Setting {
        prony: "[{ g = 0.2866, tau_s = 1.537 }, { g = 0.2022, tau_s = 6.090 }]",
        ..Setting::default()
    }
    .simulation();
    let place = below_pole(2e-3).into();
    let (rows, _) = played(&simulation, &motion(&[(1.5, place), (21.5, place)]));
    assert_eq!(rows.len(), 4001);
    let series = PronySeries::new(&[(0.2866, 1.537), (0.2022, 6.090)]).unwrap();
    let first = rows[0].force_n[2];
    assert!(first > 0.0);
    for row in &rows {
        let expected = series.relaxation(row.time_s - 1.5);
        let found = row.force_n[2] / first;
        // Rounding of 4000 recursive steps.
        assert!((found - expected).abs() < 1e-9, "{}: {found}", row.time_s);
    }
}

#[test]
fn a_contact_begins_and_ends_where_the_depth_changes_sign() {
    let simulation = Setting::default().simulation();
    // Down through the pole after 0.1 s, 2 mm deep at 0.3 s, out again at 0.5 s.
    let motion = motion(&[
        (0.0, below_pole(-1e-3).into()),
        (0.3, below_pole(2e-3).into()),
        (0.6, below_pole(-1e-3).into()),
    ]);
    let (rows, summary) = played(&simulation, &motion);
    assert_eq!((summary.contacts, rows.len()), (1, 121));
    let mut touched = false;
    for row in &rows {
        let at = below_pole(0.0).z - row.position_m[2];
        // Rounding of a place on the surface itself.
        if at.abs() > 1e-12 {
            assert_eq!(row.contact, at > 0.0, "{}", row.time_s);
        }
        assert_eq!(row.events.contains(Event::Contact), row.contact && !touched);
        assert_eq!(row.events.contains(Event::Release), !row.contact && touched);
        touched = row.contact;
        if row.contact {
            assert!(row.force_n[2] > 0.0 && row.depth_m > 0.0);
        } else {
            assert_eq!((row.force_n, row.depth_m), ([0.0; 3], 0.0));
        }
    }
    assert!(!touched);
}

#[test]
fn a_tool_above_feels_exactly_nothing() {
    let simulation = Setting {
        contact: "stick",
        ..Setting::default()
    }
    .simulation();
    let motion = motion(&[(0.0, [0.0, 0.0, 0.06]), (0.5, [0.01, 0.0, 0.051])]);
    let (rows, summary) = played(&simulation, &motion);
    for row in &rows {
        assert_eq!((row.force_n, row.depth_m), ([0.0; 3], 0.0));
        assert!(!row.contact && row.events.is_empty());
    }
    assert_eq!((summary.contacts, summary.peak_force), (0, 0.0));
    assert!(
        summary
            .warnings
            .iter()
            .any(|w| w.contains("no tool touched"))
    );
}

#[test]
fn rows_run_evenly_from_the_first_time_to_the_last_with_places_between() {
    let simulation = Setting::default().simulation();
    // 12.5 ms: steps at 0, 5 and 10 ms, and the last time.
    let rows = [(2.0, [0.0, 0.0, 0.06]), (2.0125, [0.01, -0.02, 0.07])];
    let (rows, _) = played(&simulation, &motion(&rows));
    let times: Vec<_> = rows.iter().map(|row| row.time_s - 2.0).collect();
    assert_eq!(times.len(), 4);
    for (row, expected) in rows.iter().zip([0.0, 0.005, 0.010, 0.0125]) {
        // Rounding.
        assert!((row.time_s - 2.0 - expected).abs() < 1e-12, "{times:?}");
        let part = expected / 0.0125;
        let place = Vec3::new(0.01 * part, -0.02 * part, 0.06 + 0.01 * part);
        assert!((Vec3::from(row.position_m) - place).norm() < 1e-12);
    }
    assert_eq!(rows[3].position_m, [0.01, -0.02, 0.07]);
}
