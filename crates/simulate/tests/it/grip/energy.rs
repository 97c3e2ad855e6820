//! Friction and work.

use palpate_files::Event;
use palpate_files::scene::{EstimatedInclusion, InclusionShape, Jaws};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::Simulation;

use super::{HEMISPHERE, Hands, POLE, grasping, with_jaws};
use crate::scenes::{Random, Setting, nearest};

/// Judge: friction. Tissue that relaxes is pulled out of its jaws.
#[test]
fn a_slip_keeps_the_pull_at_its_limit() {
    for (kind, prony) in [
        ("hybrid", "[]"),
        ("hybrid", "[{ g = 0.4, tau_s = 0.1 }]"),
        ("local", "[{ g = 0.4, tau_s = 0.1 }]"),
    ] {
        let model = if kind == "local" {
            ""
        } else {
            HEMISPHERE.model
        };
        let setting = Setting {
            kind,
            model,
            prony,
            ..HEMISPHERE
        };
        let jaws = Jaws {
            force_n: 0.3,
            ..Jaws::GRASPER
        };
        let simulation = Simulation::new(&grasping(&setting, jaws, 1)).unwrap();
        let mut hands = Hands::new(&simulation);
        hands.at(&POLE, 0.0);
        hands.at(&POLE, 1.0);
        let (mut at_limit, mut before, mut steps) = (0, 0.0, 0);
        while hands.tool().is_grasping() && steps < 4000 {
            steps += 1;
            let force = hands.at(&(POLE + Vec3::z() * (2e-5 * f64::from(steps))), 1.0);
            if !hands.tool().is_grasping() {
                assert_eq!(force, Vec3::zeros());
                break;
            }
            let limit = 2.0 * jaws.friction * hands.tool().grip_force;
            assert_eq!(hands.tool().grip_force, 0.3);
            let pull = force.yz().norm();
            assert!(
                pull <= limit * (1.0 + 1e-6),
                "{kind} {prony}: {pull} {limit}"
            );
            if pull > limit * (1.0 - 1e-6) {
                at_limit += 1;
            } else {
                // Once it slips it goes on to slip while it is pulled on.
                assert!(
                    at_limit == 0 && pull > before,
                    "{kind} {prony}: {pull} after {before}"
                );
            }
            before = pull;
        }
        assert!(hands.did(Event::GripRelease) && hands.did(Event::Release));
        assert!(hands.is_at_rest() && !hands.tool().row.contact);
        // 12 mm out of the jaws.
        println!("{kind} {prony}: {steps} steps of 0.02 mm, {at_limit} at the limit");
        assert!(
            at_limit > 500 && f64::from(steps) * 2e-5 > 0.012,
            "{at_limit} {steps}"
        );
    }
}

/// Judge: elasticity. Work done on jaws along a closed way that does not slip is none; 1 % of what was stored
/// is allowed.
#[test]
fn a_closed_way_gives_no_energy() {
    let simulation = with_jaws(&HEMISPHERE, |_| Jaws {
        friction: 1e6,
        ..Jaws::GRASPER
    });
    let mut hands = Hands::new(&simulation);
    hands.at(&(POLE - Vec3::z() * 1e-3), 0.0);
    hands.at(&(POLE - Vec3::z() * 1e-3), 1.0);
    let way = |part: f64| {
        let turn = std::f64::consts::TAU * part;
        let up = -1e-3 + 3e-3 * (1.0 - turn.cos());
        POLE + Vec3::new(2e-3 * turn.sin(), 1e-3 * (2.0 * turn).sin(), up)
    };
    let (mut work, mut stored) = (0.0, 0.0_f64);
    let mut last: Option<(Vec3, Vec3)> = None;
    for number in 0..=2000 {
        let tip = way(f64::from(number) / 2000.0);
        let force = hands.at(&tip, 1.0);
        if let Some((before, felt)) = last {
            work += 0.5 * (force + felt).dot(&(tip - before));
        }
        stored = stored.max(-work);
        last = Some((tip, force));
    }
    println!("{:.2e} of what was stored", work / stored);
    assert!(
        stored > 0.0 && work.abs() < 0.01 * stored,
        "{work} {stored}"
    );
}

/// Judge: energy. A tip that sticks is pressed in, dragged aside until the organ would pull on it, pressed in there, and
/// brought back: it gets out no more work than it puts in. 1 % of that is allowed, for a force that falls to zero within a
/// step.
#[test]
fn a_tip_that_is_dragged_loose_gives_no_energy() {
    let setting = Setting {
        organ: "builtin = \"liver\"\ntriangles = 400",
        model: "response = \"boundary_elements\"\nmechanical_triangles = 240",
        poissons_ratio: 0.49,
        radius: 4.8e-3,
        ..HEMISPHERE
    };
    let simulation = setting.simulation();
    let tree = AabbTree::new(simulation.surface().mesh());
    let (place, normal) = nearest(&simulation, &tree, &Vec3::new(0.0603, -0.0264, 0.0391));
    let along = normal.cross(&Vec3::x()).normalize();
    let mut loose = 0;
    for turn in 0..8 {
        let (sine, cosine) = (std::f64::consts::FRAC_PI_4 * f64::from(turn)).sin_cos();
        let aside = along * cosine + normal.cross(&along) * sine;
        let way = [
            (0.0, 1e-5),
            (0.0, -5e-5),
            (2e-3, -5e-5),
            (2e-3, -6e-4),
            (0.0, -6e-4),
            (0.0, 3e-3),
        ];
        let mut hands = Hands::new(&simulation);
        let (mut work, mut done, mut was_loose) = (0.0, 0.0_f64, false);
        let mut last: Option<(Vec3, Vec3)> = None;
        for leg in way.windows(2) {
            let [from, to] = [leg[0], leg[1]].map(|(far, up)| place + aside * far + normal * up);
            for number in 0..=200 {
                let tip = from + (to - from) * (f64::from(number) / 200.0);
                let force = hands.at(&tip, 0.0);
                was_loose |= hands.tool().row.contact && force == Vec3::zeros();
                if let Some((before, felt)) = last {
                    work -= 0.5 * (force + felt).dot(&(tip - before));
                }
                done = done.max(work);
                last = Some((tip, force));
            }
        }
        println!("towards {turn}: {work:.2e} J of {done:.2e} J, loose: {was_loose}");
        assert!(done > 0.0 && work > -0.01 * done, "{turn}: {work} {done}");
        loose += usize::from(was_loose);
    }
    assert!(loose > 0);
}

/// Judge: energy. Whatever slips on a way that comes back to where the tissue was taken hold of, the tool gets
/// out no more work than it puts in.
#[test]
fn what_slips_takes_energy() {
    let jaws = Jaws {
        force_n: 0.2,
        ..Jaws::GRASPER
    };
    let simulation = Simulation::new(&grasping(&HEMISPHERE, jaws, 1)).unwrap();
    let mut random = Random(3);
    let (mut most, mut least) = (f64::NEG_INFINITY, 0.0_f64);
    for _ in 0..20 {
        let mut hands = Hands::new(&simulation);
        hands.at(&POLE, 0.0);
        hands.at(&POLE, 1.0);
        // Above the organ, so that the tip never touches.
        let mut corners = vec![POLE];
        for _ in 0..4 {
            let up = 6e-3 * random.unit();
            let aside = [(); 2].map(|()| 6e-3 * (random.unit() - 0.5));
            corners.push(POLE + Vec3::new(aside[0], aside[1], up));
        }
        corners.push(POLE);
        let mut work = 0.0;
        let mut last = (POLE, Vec3::zeros());
        for ends in corners.windows(2) {
            for step in 1..=50 {
                let tip = ends[0].lerp(&ends[1], f64::from(step) / 50.0);
                let force = hands.at(&tip, 1.0);
                work += 0.5 * (force + last.1).dot(&(tip - last.0));
                last = (tip, force);
            }
        }
        most = most.max(work);
        least = least.min(work);
    }
    println!("{least:.1e} to {most:.1e} J");
    // A thousandth of what the worst way takes, for ways that do not slip.
    assert!(least < 0.0 && most < 1e-3 * -least, "{least} {most}");
}

/// Judge: energy. An organ that is stiffer when it is left than when it was pressed gives back what nobody did, and says
/// so, once for each touch; one that stays as it is does not.
#[test]
fn a_gain_of_energy_is_reported() {
    let setting = Setting {
        kind: "local",
        model: "",
        ..HEMISPHERE
    };
    let simulation = setting.simulation();
    let stiffer = [EstimatedInclusion {
        name: String::new(),
        shape: InclusionShape::Ball {
            center_m: [0.0, 0.0, 0.047],
            radius_m: 4e-3,
        },
        stiffness_ratio: 50.0,
    }];
    for becomes_stiffer in [false, true] {
        let mut hands = Hands::new(&simulation);
        let (mut gains, mut forces) = (0, [0.0; 2]);
        for _ in 0..2 {
            let depth = |step: i32| 2e-3 * (1.0 - f64::from(step).abs() / 20.0);
            for step in -20..=20 {
                let before = if becomes_stiffer && step > 0 {
                    &stiffer[..]
                } else {
                    &[]
                };
                hands
                    .state
                    .set_estimated_inclusions(&simulation, before)
                    .unwrap();
                let force = hands.at(&(POLE - Vec3::z() * depth(step)), 0.0);
                if step.abs() == 1 {
                    forces[usize::from(step > 0)] = force.z;
                }
                gains += u32::from(hands.did(Event::EnergyGain));
            }
        }
        let told = hands.state.warnings(&simulation);
        let told = told.iter().any(|text| text.contains("more work"));
        println!(
            "{} N before, {} N after: {gains} gains",
            forces[0], forces[1]
        );
        assert_eq!(
            (gains, told),
            if becomes_stiffer {
                (2, true)
            } else {
                (0, false)
            }
        );
    }
}
