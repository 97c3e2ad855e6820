//! Our side of the comparison with CalculiX; `compare.py` runs it.
//!
//! `cube LAW stretch|shear AMOUNT` prints forces on a unit cube, `punch LAW HALVINGS DEPTH` the force of a
//! bonded punch at a depth in radii, `tube LAW PRESSURE ACCURACY` the widening of a tube with held ends. A
//! law is `linear:E:NU`, `neo_hookean:C10:KAPPA` or `mooney_rivlin:C10:C01:KAPPA`, in Pa: the command
//! `palpate solve` knows no finite bulk modulus, without which CalculiX cannot do.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a script that fails to unwrap has failed, and tells results"
)]

use std::sync::Arc;

use palpate_mechanics::contact::FrictionLaw;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationRun, IndentationSettings, Indenter, IndenterShape, Side,
};
use palpate_mechanics::finite_elements::tube::{Ends, Tube, TubeProblem, inflate};
use palpate_mechanics::finite_elements::{
    ElementKind, ElementMesh, FiniteElementModel, FiniteElementState, FiniteElementWorkspace,
    Formulation, Supports, equilibrate,
};
use palpate_mechanics::{Law, LinearElastic, MooneyRivlin, NeoHookean, Strain, Vec3};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["cube", law, how, amount] => cube(law_of(law), how, number(amount)),
        ["punch", law, halvings, depth] => {
            punch(law_of(law), halvings.parse().unwrap(), number(depth));
        }
        ["tube", law, pressure, accuracy] => tube(law_of(law), number(pressure), number(accuracy)),
        _ => println!("peer_calculix cube|punch|tube LAW ..."),
    }
}

fn number(word: &str) -> f64 {
    word.parse().unwrap()
}

fn law_of(words: &str) -> Arc<dyn Law> {
    let (name, numbers) = words.split_once(':').unwrap();
    let numbers: Vec<f64> = numbers.split(':').map(number).collect();
    match (name, numbers.as_slice()) {
        ("linear", &[e, nu]) => Arc::new(LinearElastic::new(e, nu).unwrap()),
        ("neo_hookean", &[c10, kappa]) => Arc::new(NeoHookean::compressible(c10, kappa).unwrap()),
        ("mooney_rivlin", &[c10, c01, kappa]) => {
            Arc::new(MooneyRivlin::compressible(c10, c01, kappa).unwrap())
        }
        _ => panic!("no law {words}"),
    }
}

/// One element; sides free under a stretch along z, all surfaces held in simple shear of z along x.
fn cube(law: Arc<dyn Law>, how: &str, amount: f64) {
    let at = |n: u32| f64::from(n) * 0.5;
    let mesh = ElementMesh {
        kind: ElementKind::Hex27,
        nodes: (0..27)
            .map(|n| Vec3::new(at(n % 3), at(n / 3 % 3), at(n / 9)))
            .collect(),
        elements: (0..27).collect(),
    };
    let model = FiniteElementModel::new(mesh, law, Formulation::Mixed).unwrap();
    let nodes = |axis: usize, at: f64| model.mesh().nodes_where(|x| x[axis] == at);
    let mut supports = Supports::none(&model);
    if how == "stretch" {
        for axis in 0..3 {
            supports = supports.fix(&model, nodes(axis, 0.0), axis, 0.0);
        }
        supports = supports.fix(&model, nodes(2, 1.0), 2, amount - 1.0);
    } else {
        let surface = |x: &Vec3| x.iter().any(|&x| x == 0.0 || x == 1.0);
        for node in model.mesh().nodes_where(surface) {
            let z = model.mesh().nodes[node].z;
            for (axis, way) in [amount * z, 0.0, 0.0].into_iter().enumerate() {
                supports = supports.fix(&model, [node], axis, way);
            }
        }
    }
    let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
    let mut state = FiniteElementState::at_rest(&model);
    equilibrate(&model, &supports, &mut state, &mut workspace).unwrap();
    // Reactions at edges belong to two faces; inside a face to one.
    let top: Vec3 = nodes(2, 1.0)
        .into_iter()
        .map(|node| workspace.reaction(&model, node))
        .sum();
    println!("{{\"fx\": {}, \"fz\": {}}}", top.x, top.z);
}

fn punch(law: Arc<dyn Law>, halvings: i32, depth: f64) {
    let radius = 1e-3;
    let block = Block {
        radius: 0.05642,
        height: 0.1,
        base: Base::Bonded,
    };
    let small_strain = law.volume().strain == Strain::Small;
    let run = IndentationRun::new(&IndentationSettings {
        block,
        indenter: Indenter {
            shape: IndenterShape::Flat { side: Side::Absent },
            radius,
            face: FrictionLaw::Bonded,
        },
        law,
        prony: Default::default(),
        deepest: depth,
        halvings,
    })
    .unwrap();
    // Like the other code, this lets tissue pass through the side of the punch.
    let model = run.model();
    let nodes = |holds: &dyn Fn(&Vec3) -> bool| model.mesh().nodes_where(holds);
    let face = nodes(&|x| x.y == 0.0 && x.x <= radius * (1.0 + 1e-9));
    let bottom = nodes(&|x| x.y == -block.height);
    let mut workspace = FiniteElementWorkspace::new(model).unwrap();
    let mut state = FiniteElementState::at_rest(model);
    let steps = if small_strain { 1 } else { 4 };
    for step in 1..=steps {
        let way = depth * radius * f64::from(step) / f64::from(steps);
        let supports = Supports::none(model)
            .fix(model, nodes(&|x| x.x == 0.0), 0, 0.0)
            .fix(model, bottom.iter().copied(), 0, 0.0)
            .fix(model, bottom.iter().copied(), 1, 0.0)
            .fix(model, face.iter().copied(), 0, 0.0)
            .fix(model, face.iter().copied(), 1, -way);
        equilibrate(model, &supports, &mut state, &mut workspace).unwrap();
    }
    let each = face.iter().map(|&node| workspace.reaction(model, node).y);
    let (force, unknowns) = (-each.sum::<f64>(), model.size());
    println!("{{\"force_n\": {force}, \"unknowns\": {unknowns}}}");
}

fn tube(law: Arc<dyn Law>, pressure: f64, accuracy: f64) {
    let problem = TubeProblem {
        tube: Tube {
            length: 0.06,
            inner_radius: 0.005,
            outer_radius: 0.0075,
        },
        law,
        ends: Ends::Fixed,
    };
    let answer = inflate(&problem, &[pressure], accuracy, &mut |_| {}).unwrap();
    println!(
        "{{\"widening_m\": {}, \"unknowns\": {}, \"error\": {}}}",
        answer.answer.inner_displacements[0].unwrap(),
        answer.answer.unknowns,
        answer.error
    );
}
