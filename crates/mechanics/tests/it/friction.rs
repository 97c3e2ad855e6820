//! Coulomb friction under an indenter.

mod rings;

use std::sync::Arc;

use palpate_mechanics::contact::FrictionLaw;
use palpate_mechanics::finite_elements::Mismatch;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, ContactNode, IndentationPoint, IndentationProblem, IndentationRun, Indenter,
    IndenterShape, Side,
};
use palpate_mechanics::{Error, Law, LinearElastic, NeoHookean, PronySeries};

use rings::{Rings, uncoupled};

const RADIUS: f64 = 1e-3;
const YOUNG: f64 = 6000.0;

/// Its ends take less than 0.05 % of the compliance.
const HALF_SPACE: Block = Block {
    radius: 2000.0 * RADIUS,
    height: 2000.0 * RADIUS,
    base: Base::Bonded,
};

fn problem(
    shape: IndenterShape,
    face: FrictionLaw,
    law: Arc<dyn Law>,
    block: Block,
) -> IndentationProblem {
    IndentationProblem {
        block,
        indenter: Indenter {
            shape,
            radius: RADIUS,
            face,
        },
        law,
    }
}

fn linear(nu: f64) -> Arc<dyn Law> {
    Arc::new(LinearElastic::new(YOUNG, nu).unwrap())
}

fn flat(side: FrictionLaw) -> IndenterShape {
    IndenterShape::Flat {
        side: Side::Touches(side),
    }
}

/// On the mesh of this number, pressed to `depth` [m] in steps.
fn pressed(problem: &IndentationProblem, depth: f64, mesh: usize) -> IndentationRun {
    let mut run = problem.run(&PronySeries::default(), depth, mesh).unwrap();
    run.press(depth, depth, |_| {}).unwrap();
    run
}

fn point(problem: &IndentationProblem, depth: f64, mesh: usize) -> IndentationPoint {
    pressed(problem, depth, mesh).point()
}

const NO_SIDE: IndenterShape = IndenterShape::Flat { side: Side::Absent };

/// Judge of the judge: the closed form without the coupling that it neglects, to the width of a ring; and with it both
/// limits of the force, of which the bonded one is 4 G a ln(3 − 4ν)/(1 − 2ν) [Spence 1968], to what singular edges leave
/// of so many rings.
#[test]
fn rings_meet_closed_forms() {
    for nu in [0.0, 0.3] {
        let mut rings = Rings::new(nu, 120);
        let bonded = (3.0 - 4.0 * nu).ln() * (1.0 - nu) / (1.0 - 2.0 * nu);
        assert!((rings.solve(10.0).1 / bonded - 1.0).abs() < 1e-3);
        assert!((rings.solve(1e-6).1 - 1.0).abs() < 1e-3);
        rings.uncouple();
        for mu in [0.1, 0.2, 0.3] {
            let (stick, _) = rings.solve(mu);
            let exact = uncoupled(mu, nu);
            println!("nu {nu}, mu {mu}: {stick} {exact}");
            assert!((stick - exact).abs() < 1.0 / 60.0, "{mu}: {stick} {exact}");
        }
    }
}

/// Judges: the rings, and at ν = 0.45, where β μ is small, the closed form without coupling. Tolerance: 3 %, of which the
/// distance of nodes takes 2.5 %; of the force 0.2 %, twice the error without friction on this mesh.
#[test]
#[ignore = "long"]
fn a_flat_punch_sticks_as_far_as_spence_says() {
    sticks_as_spence_says(3, 0.03, 2e-3);
}

/// The same on the finest mesh. Tolerance: 2 %, of which the distance of nodes takes 1.6 %; of the force 0.1 %.
#[test]
#[ignore = "slow: a minute"]
fn the_finest_punch_sticks_as_far_as_spence_says() {
    sticks_as_spence_says(4, 0.02, 1e-3);
}

fn sticks_as_spence_says(mesh: usize, tolerance: f64, of_force: f64) {
    let depth = 1e-2 * RADIUS;
    for (nu, mu) in [(0.0, 0.3), (0.3, 0.2), (0.45, 0.05)] {
        let (stick, factor) = Rings::new(nu, 120).solve(mu);
        let law = FrictionLaw::Coulomb(mu);
        let found = point(&problem(NO_SIDE, law, linear(nu), HALF_SPACE), depth, mesh);
        let force = 2.0 * YOUNG * RADIUS * depth / (1.0 - nu * nu) * factor;
        let contact = found.friction.unwrap();
        let part = contact.stick_radius / contact.contact_radius;
        println!(
            "nu {nu}, mu {mu}: {part} {stick}, force {}",
            found.force / force
        );
        assert!(
            (part / stick - 1.0).abs() < tolerance,
            "{nu} {mu}: {part} {stick}"
        );
        assert!((found.force / force - 1.0).abs() < of_force, "{nu} {mu}");
        if nu == 0.45 {
            assert!((part / uncoupled(mu, nu) - 1.0).abs() < tolerance, "{part}");
        }
    }
}

/// Judge: the same rings, since a sphere is a sum of flat punches whose radius grows, all with the same c/a [Spence 1968]:
/// with u(x) of a punch of radius x outside it, d = κ a²/R, κ = 1/(2 − 4 ∫ u x dx), and F is Hertz' times the factor of the
/// punch over √κ. The contact grows node by node, so the part that sticks is the mean over the second half of the way.
/// The force has 0.1 %, as mesh and block are in both runs.
fn sphere(mesh: usize, tolerance: f64) {
    let depth = 1e-4 * RADIUS;
    let block = Block {
        radius: 10.0 * RADIUS,
        height: 10.0 * RADIUS,
        base: Base::Bonded,
    };
    for (nu, mu) in [(0.0, 0.3), (0.3, 0.2)] {
        let rings = Rings::new(nu, 120);
        let (stick, factor) = rings.solve(mu);
        let kappa = rings.kappa(mu);
        let run = |face| {
            let problem = problem(IndenterShape::Sphere, face, linear(nu), block);
            let mut run = problem.run(&PronySeries::default(), depth, mesh).unwrap();
            let mut parts = Vec::new();
            let end = run.press(depth, depth, |point| {
                if let (Some(friction), true) = (point.friction, point.depth > 0.4 * depth) {
                    parts.push(friction.stick_radius / friction.contact_radius);
                }
            });
            (end.unwrap().force, parts)
        };
        let (force, parts) = run(FrictionLaw::Coulomb(mu));
        let (without, _) = run(FrictionLaw::Frictionless);
        let mean = parts.iter().sum::<f64>() / parts.len() as f64;
        let exact = factor / kappa.sqrt();
        println!(
            "nu {nu}, mu {mu}: {mean} {stick}, force {} {exact}",
            force / without
        );
        assert!(parts.len() > 15, "{parts:?}");
        assert!((mean / stick - 1.0).abs() < tolerance, "{mean} {stick}");
        assert!((force / without / exact - 1.0).abs() < 1e-3, "{force}");
    }
}

/// Tolerance: half the distance of nodes, a fortieth of the radius of contact where that is largest; what sticks is a half
/// to three quarters of it.
#[test]
#[ignore = "long"]
fn a_sphere_sticks_as_far_as_a_punch() {
    sphere(1, 0.05);
}

/// Tolerance: half of that.
#[test]
#[ignore = "slow: a minute"]
fn a_sphere_sticks_as_far_as_a_punch_on_a_finer_mesh() {
    sphere(2, 0.025);
}

/// Judges: runs without friction and bonded ones, in the same steps. Tolerance: that of an equilibrium, whose force is
/// good to about the square of 10⁻⁷, and what a step that is good to that leaves on the way.
#[test]
#[ignore = "long"]
fn the_limits_are_no_friction_and_a_bond() {
    let soft: Arc<dyn Law> = Arc::new(NeoHookean::compressible(1000.0, 8000.0).unwrap());
    let block = Block {
        radius: 20.0 * RADIUS,
        height: 20.0 * RADIUS,
        base: Base::Bonded,
    };
    for (shape, law, deepest) in [
        (NO_SIDE, linear(0.3), 0.01),
        (IndenterShape::Sphere, linear(0.3), 0.2),
        (IndenterShape::Sphere, soft.clone(), 0.2),
        (flat(FrictionLaw::Bonded), soft, 0.3),
    ] {
        let force = |face| {
            let problem = problem(shape, face, law.clone(), block);
            let mut run = problem
                .run(&PronySeries::default(), deepest * RADIUS, 0)
                .unwrap();
            let mut last = 0.0;
            for step in 1..=64 {
                let depth = deepest * RADIUS * f64::from(step) / 64.0;
                last = run.press(depth, depth, |_| {}).unwrap().force;
            }
            last
        };
        let slips = force(FrictionLaw::Coulomb(0.0)) / force(FrictionLaw::Frictionless) - 1.0;
        let sticks = force(FrictionLaw::Coulomb(1e6)) / force(FrictionLaw::Bonded) - 1.0;
        println!("{shape:?} {law:?}: {slips} {sticks}");
        assert!(
            slips.abs() < 1e-9 && sticks.abs() < 1e-9,
            "{shape:?}: {slips} {sticks}"
        );
    }
}

/// Judge: the cone |T| ≤ μ N at every node after every step of random ways in and out. Tolerance: the stated one, a
/// millionth of the largest normal force.
#[test]
#[ignore = "long"]
fn no_node_leaves_the_cone_of_friction() {
    let mut random = Random(11);
    let block = Block {
        radius: 10.0 * RADIUS,
        height: 10.0 * RADIUS,
        base: Base::Bonded,
    };
    let mut slipped = 0;
    for case in 0..12 {
        let mu = 0.4 * random.next();
        let law: Arc<dyn Law> = match case % 3 {
            0 => linear(0.4 * random.next()),
            1 => Arc::new(NeoHookean::compressible(1000.0, 5000.0 + 5e4 * random.next()).unwrap()),
            _ => Arc::new(NeoHookean::incompressible(1000.0).unwrap()),
        };
        let half_angle = 1.1 + 0.3 * random.next();
        let shape = match (case / 3) % 4 {
            0 => IndenterShape::Sphere,
            1 => flat(FrictionLaw::Coulomb(mu)),
            2 => IndenterShape::Cone {
                half_angle,
                apex_radius: 0.0,
            },
            _ => NO_SIDE,
        };
        let deepest = 0.2 * RADIUS;
        let problem = problem(shape, FrictionLaw::Coulomb(mu), law, block);
        let mut run = problem.run(&PronySeries::default(), deepest, 0).unwrap();
        let targets = (1..=6).chain((2..6).rev()).chain(3..=6);
        for target in targets {
            let depth = (f64::from(target) - 0.9 * random.next()) / 6.0 * deepest;
            let end = run.press(depth, depth, |_| {});
            end.unwrap_or_else(|error| panic!("case {case}, {shape:?}, mu {mu}: {error}"));
            let nodes = run.contact_nodes();
            let most = nodes
                .iter()
                .map(|node| node.normal_force)
                .fold(0.0, f64::max);
            for node in &nodes {
                let ContactNode {
                    normal_force,
                    tangential_force,
                    coefficient: Some(mu),
                    ..
                } = *node
                else {
                    continue;
                };
                let beyond = tangential_force.abs() - mu * normal_force.max(0.0);
                assert!(
                    beyond <= 1e-6 * most,
                    "case {case}, {shape:?}, mu {mu}: {node:?} of {most}"
                );
                slipped += usize::from(!node.sticks);
            }
        }
    }
    println!("{slipped} slipped");
    assert!(slipped > 100, "{slipped}");
}

/// Judge: energy. What a way in and out takes is what friction has spent, and without friction nothing; the trapezoidal
/// rule over 64 steps knows it to a thousandth of what goes in.
#[test]
fn a_cycle_costs_what_slips() {
    let block = Block {
        radius: 10.0 * RADIUS,
        height: 10.0 * RADIUS,
        base: Base::Bonded,
    };
    let spent = |face| {
        let problem = problem(IndenterShape::Sphere, face, linear(0.0), block);
        let deepest = 0.01 * RADIUS;
        let mut run = problem.run(&PronySeries::default(), deepest, 0).unwrap();
        let to = |step: i32| deepest * f64::from(step) / 64.0;
        let mut before = run.press(0.0, to(4), |_| {}).unwrap();
        let (mut work, mut most) = (0.0, 0.0_f64);
        for step in (5..=64).chain((4..64).rev()) {
            let now = run.press(0.0, to(step), |_| {}).unwrap();
            work += 0.5 * (now.force + before.force) * (now.depth - before.depth);
            most = most.max(work);
            before = now;
        }
        work / most
    };
    let [without, with, more] = [0.0, 0.15, 0.3].map(|mu| spent(FrictionLaw::Coulomb(mu)));
    println!("{without} {with} {more}");
    assert!(without.abs() < 1e-3);
    assert!(with > 5e-3 && more > 5e-3, "{with} {more}");
}

/// Judge: the sentence.
#[test]
fn impossible_coefficients_are_refused() {
    for mu in [-0.1, f64::NAN, f64::INFINITY] {
        let problem = problem(NO_SIDE, FrictionLaw::Coulomb(mu), linear(0.3), HALF_SPACE);
        let refused = problem.run(&PronySeries::default(), RADIUS, 0).unwrap_err();
        assert!(refused.is_input());
        assert!(matches!(
            refused,
            Error::Mismatch(Mismatch::FrictionOutOfRange { .. })
        ));
        assert!(refused.to_string().contains("not negative"), "{refused}");
    }
}

struct Random(u64);

impl Random {
    /// Even in [0, 1), by Knuth's constants.
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
