//! Tips on a cube, a slab and a hemisphere, for every model, against finite elements.

use std::sync::Arc;

use palpate_files::Scene;
use palpate_geometry::Vec3;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, Grip, IndentationRun, IndentationSettings, Indenter, IndenterShape, Side,
};
use palpate_mechanics::{Law, LinearElastic, NeoHookean, PronySeries};
use palpate_simulate::Simulation;

use crate::scenes::{Hand, Setting, YOUNGS_MODULUS};

/// What is asked of the models [-]; the elements err by less than 0.5 % of it.
const PROMISED: f64 = 0.03;

/// Bodies whose highest point is on the z axis.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Body {
    /// 100 mm.
    Cube,
    /// The cube, pressed flat to 20 mm.
    Slab,
    /// Radius 50 mm.
    Hemisphere,
}

impl Body {
    /// Height of its highest point [m].
    fn top(self) -> f64 {
        match self {
            Self::Cube => 0.05,
            Self::Slab => 0.02,
            Self::Hemisphere => 0.05,
        }
    }

    /// The lines of `[organ]`.
    fn organ(self) -> String {
        match self {
            Self::Cube => "builtin = \"cube\"".to_owned(),
            Self::Hemisphere => "builtin = \"hemisphere\"".to_owned(),
            Self::Slab => {
                let path =
                    std::env::temp_dir().join(format!("palpate_slab_{}.obj", std::process::id()));
                std::fs::write(&path, slab()).unwrap();
                format!("mesh = {:?}\nmesh_unit = \"m\"", path.display().to_string())
            }
        }
    }

    /// The force of finite elements without friction, on a mesh made for this depth.
    fn judged(self, law: Arc<dyn Law>, (shape, radius): (IndenterShape, f64), depth: f64) -> f64 {
        // A cylinder of the area of the cube's face: 0.1 % of the force apart in three dimensions.
        let (wide, height) = match self {
            Self::Cube => (0.056_42, 0.1),
            Self::Slab => (0.056_42, 0.02),
            Self::Hemisphere => (0.05, 0.05),
        };
        let settings = IndentationSettings {
            block: Block {
                radius: wide,
                height,
                base: Base::Bonded,
            },
            indenter: Indenter {
                shape,
                radius,
                face: Grip::Slide,
            },
            law,
            prony: PronySeries::default(),
            deepest: depth,
            halvings: 0,
        };
        let run = match self {
            Self::Hemisphere => IndentationRun::on_hemisphere(&settings),
            Self::Cube | Self::Slab => IndentationRun::new(&settings),
        };
        run.unwrap().press(0.0, depth, |_| ()).unwrap().force
    }
}

/// The slab as a Wavefront file: the cube's own surface, five times as flat.
fn slab() -> String {
    let cube = Setting {
        organ: "builtin = \"cube\"",
        ..Setting::default()
    }
    .simulation();
    let mesh = cube.surface().mesh();
    let mut text = String::new();
    for place in mesh.vertices() {
        text += &format!(
            "v {:?} {:?} {:?}\n",
            place.x,
            place.y,
            0.2 * (place.z + 0.05)
        );
    }
    for [a, b, c] in mesh.triangles() {
        text += &format!("f {} {} {}\n", a.index() + 1, b.index() + 1, c.index() + 1);
    }
    text
}

/// A tip over the highest point of `body`.
fn felt(simulation: &Simulation, body: Body, overhang: f64, depth: f64) -> f64 {
    let mut hand = Hand::new(simulation);
    let above = |depth: f64| Vec3::new(0.0, 0.0, body.top() + overhang - depth);
    hand.at(&above(0.0));
    hand.at(&above(depth)).z
}

/// Down to a sphere's radius, where Hertz's paraboloid is 25 to 60 % too stiff.
#[test]
fn spheres_on_a_cube_are_those_of_finite_elements() {
    for poissons_ratio in [0.3, 0.45, 0.49] {
        for (kind, depth, off) in spheres(Body::Cube, 0.01, poissons_ratio, &[0.2, 0.5, 1.0]) {
            assert!(
                off.abs() < PROMISED,
                "{kind} {poissons_ratio} {depth}: {off}"
            );
        }
    }
}

/// At once on a body that is round itself, and that Hertz's plane misses by a tenth.
#[test]
fn spheres_on_a_hemisphere_are_those_of_finite_elements() {
    for (kind, depth, off) in spheres(Body::Hemisphere, 0.01, 0.45, &[0.1, 0.2]) {
        assert!(off.abs() < PROMISED, "{kind} {depth}: {off}");
    }
}

/// Model, depth [m] and error [-] of spheres of `radius` [m], at `depths` [in radii]; prints them.
fn spheres(
    body: Body,
    radius: f64,
    poissons_ratio: f64,
    depths: &[f64],
) -> Vec<(&'static str, f64, f64)> {
    errors(
        body,
        ("sphere", radius),
        poissons_ratio,
        depths,
        &["local", "hybrid", "nonlinear"],
    )
}

fn errors(
    body: Body,
    (shape, radius): (&str, f64),
    poissons_ratio: f64,
    depths: &[f64],
    kinds: &[&'static str],
) -> Vec<(&'static str, f64, f64)> {
    let law = Arc::new(LinearElastic::new(YOUNGS_MODULUS, poissons_ratio).unwrap());
    let (judged, overhang) = match shape {
        "sphere" => (IndenterShape::Sphere, radius),
        _ => (IndenterShape::Flat { side: Side::Absent }, 0.0),
    };
    let exact: Vec<f64> = depths
        .iter()
        .map(|depth| body.judged(law.clone(), (judged, radius), depth * radius))
        .collect();
    let organ = body.organ();
    let mut found = Vec::new();
    for &kind in kinds {
        let simulation = Setting {
            organ: &organ,
            kind,
            poissons_ratio,
            shape,
            radius,
            ..Setting::default()
        }
        .simulation();
        for (part, exact) in depths.iter().zip(&exact) {
            let depth = part * radius;
            let force = felt(&simulation, body, overhang, depth);
            let off = force / exact - 1.0;
            println!(
                "| {shape} {:.0} | {body:?} | {poissons_ratio} | {:.2} | {kind} | {:.2} | {:.2} | {:+.1} |",
                1e3 * radius,
                1e3 * depth,
                1e3 * force,
                1e3 * exact,
                100.0 * off
            );
            found.push((kind, depth, off));
        }
    }
    found
}

/// Neo-Hookean tissue, incompressible.
#[test]
fn spheres_on_a_neo_hookean_cube_are_those_of_finite_elements() {
    let radius = 0.01;
    let law: Arc<dyn Law> = Arc::new(NeoHookean::incompressible(YOUNGS_MODULUS / 6.0).unwrap());
    let depths = [0.002, 0.005, 0.01];
    let exact =
        depths.map(|depth| Body::Cube.judged(law.clone(), (IndenterShape::Sphere, radius), depth));
    for kind in ["local", "hybrid"] {
        let text = format!(
            "format = 1\n[organ]\nbuiltin = \"cube\"\n[organ.tissue]\nlaw = \"neo_hookean\"\nc10_pa = {}\n\
             [model]\nkind = \"{kind}\"\n[[tool]]\nname = \"right\"\n\
             tip = {{ shape = \"sphere\", radius_m = {radius}, contact = \"slip\" }}\n",
            YOUNGS_MODULUS / 6.0
        );
        let simulation = Simulation::new(&Scene::parse(&text, "scene.toml").unwrap()).unwrap();
        for (depth, exact) in depths.into_iter().zip(exact) {
            let off = felt(&simulation, Body::Cube, radius, depth) / exact - 1.0;
            println!("{kind}, {depth} m: {:+.1} %", 100.0 * off);
            assert!(off.abs() < PROMISED, "{kind} {depth}: {off}");
        }
    }
}

/// Flat tips at small depth, where they are linear.
#[test]
fn flat_tips_are_those_of_finite_elements() {
    for body in [Body::Cube, Body::Hemisphere] {
        for (kind, depth, off) in errors(body, ("flat", 0.005), 0.45, &[0.02], &["local", "hybrid"])
        {
            assert!(off.abs() < PROMISED, "{kind} {body:?} {depth}: {off}");
        }
    }
}

/// Prints the table of docs/theory/tips.md.
#[test]
#[ignore = "slow: a table"]
fn tips_on_every_body_are_those_of_finite_elements() {
    println!(
        "| tip, mm | body | nu | depth, mm | model | force, mN | finite elements, mN | error, % |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for body in [Body::Cube, Body::Slab, Body::Hemisphere] {
        for poissons_ratio in [0.3, 0.45, 0.49] {
            for radius in [0.001, 0.005, 0.01, 0.015] {
                spheres(body, radius, poissons_ratio, &[0.2, 0.5, 1.0]);
                errors(
                    body,
                    ("flat", radius),
                    poissons_ratio,
                    &[0.01],
                    &["local", "hybrid"],
                );
            }
        }
    }
}
