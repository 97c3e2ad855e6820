//! Our side of the comparison of factor and solve; `compare.py` runs it.
//!
//! `write NAME FILE` writes the matrix of a model in the Matrix Market format; `time NAME REPEATS` times
//! the order of elimination, the factors and a solution, and prints the times.
//! `punch_N` is a bonded punch on an axisymmetric block with every element halved N times, `solid_N` a
//! cube of N³ triquadratic hexahedra with a fixed bottom and a patch on its top; both with a pressure
//! field, at rest, of an incompressible neo-Hookean tissue. With `displacement_` before the name there
//! is no pressure field and ν = 0.3, so that the matrix is positive definite.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a script that fails to unwrap has failed, and tells times"
)]

use std::io::Write;
use std::sync::Arc;

use palpate_mechanics::contact::FrictionLaw;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationRun, IndentationSettings, Indenter, IndenterShape, Side,
};
use palpate_mechanics::finite_elements::{
    ElementKind, ElementMesh, FiniteElementModel, FiniteElementState, FiniteElementWorkspace,
    Formulation, LinearSystem, Supports,
};
use palpate_mechanics::{Law, LinearElastic, NeoHookean, Vec3};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["write", name, file] => write(&Body::of(name), file),
        ["time", name, repeats] => time(&Body::of(name), repeats.parse().unwrap()),
        _ => println!("peer_cholmod write NAME FILE | time NAME REPEATS"),
    }
}

/// A model and the displacements that are held at zero, as (nodes, axis).
struct Body {
    model: FiniteElementModel,
    held: Vec<(Vec<usize>, usize)>,
}

impl Body {
    fn of(name: &str) -> Self {
        let (kind, size) = name.rsplit_once('_').unwrap();
        let (law, formulation): (Arc<dyn Law>, _) = if kind.starts_with("displacement_") {
            let law = LinearElastic::new(6000.0, 0.3).unwrap();
            (Arc::new(law), Formulation::Displacement)
        } else {
            let law = NeoHookean::incompressible(1000.0).unwrap();
            (Arc::new(law), Formulation::Mixed)
        };
        let mesh = if kind.ends_with("punch") {
            punch(size.parse().unwrap())
        } else {
            cube(size.parse().unwrap())
        };
        let (axes, bottom) = match mesh.kind {
            ElementKind::Quad9 => (2, -0.1),
            _ => (3, 0.0),
        };
        let height = |x: &Vec3| x[axes - 1];
        let top = if axes == 2 { 0.0 } else { 1.0 };
        let edge = if axes == 2 { 1e-3 } else { 0.25 };
        let across = |x: &Vec3| if axes == 2 { x.x } else { x.x.hypot(x.y) };
        let fixed = mesh.nodes_where(|x| {
            height(x) == bottom || (height(x) == top && across(x) <= edge * (1.0 + 1e-9))
        });
        let mut held: Vec<_> = (0..axes).map(|axis| (fixed.clone(), axis)).collect();
        if axes == 2 {
            held.push((mesh.nodes_where(|x| x.x == 0.0), 0));
        }
        let model = FiniteElementModel::new(mesh, law, formulation).unwrap();
        Self { model, held }
    }

    fn supports(&self) -> Supports<'_> {
        let none = Supports::none(&self.model);
        self.held.iter().fold(none, |supports, (nodes, axis)| {
            supports.fix(&self.model, nodes.iter().copied(), *axis, 0.0)
        })
    }
}

fn punch(halvings: i32) -> ElementMesh {
    let run = IndentationRun::new(&IndentationSettings {
        block: Block {
            radius: 0.05642,
            height: 0.1,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: IndenterShape::Flat { side: Side::Absent },
            radius: 1e-3,
            face: FrictionLaw::Bonded,
        },
        law: Arc::new(NeoHookean::incompressible(1000.0).unwrap()),
        prony: Default::default(),
        // A punch's mesh is the same for every depth.
        deepest: 1e-3,
        halvings,
    })
    .unwrap();
    run.model().mesh().clone()
}

/// The unit cube about the axis, on z = 0.
fn cube(size: u32) -> ElementMesh {
    let (line, step) = (2 * size + 1, 0.5 / f64::from(size));
    let number = |i: u32, j: u32, k: u32| i + line * (j + line * k);
    let mut nodes = Vec::new();
    let mut elements = Vec::new();
    for (k, j) in (0..line).flat_map(|k| (0..line).map(move |j| (k, j))) {
        for i in 0..line {
            let at = [i, j, k].map(|n| f64::from(n) * step);
            nodes.push(Vec3::new(at[0] - 0.5, at[1] - 0.5, at[2]));
            if [i, j, k].iter().all(|n| n % 2 == 0 && n + 1 < line) {
                elements.extend((0..27).map(|n| number(i + n % 3, j + n / 3 % 3, k + n / 9)));
            }
        }
    }
    ElementMesh {
        kind: ElementKind::Hex27,
        nodes,
        elements,
    }
}

fn write(body: &Body, file: &str) {
    let model = &body.model;
    let mut workspace = FiniteElementWorkspace::new(model).unwrap();
    let state = FiniteElementState::at_rest(model);
    let system = LinearSystem::assemble(model, &body.supports(), &state, &mut workspace).unwrap();
    // Held rows leave zeros behind, which the other code need not see.
    let entries: Vec<_> = system.entries().filter(|entry| entry.2 != 0.0).collect();
    let mut out = std::io::BufWriter::new(std::fs::File::create(file).unwrap());
    let size = model.size();
    writeln!(out, "%%MatrixMarket matrix coordinate real symmetric").unwrap();
    writeln!(out, "{size} {size} {}", entries.len()).unwrap();
    for (row, column, value) in entries {
        writeln!(out, "{} {} {value:e}", row + 1, column + 1).unwrap();
    }
    out.flush().unwrap();
}

/// Time on the processor [s], of Linux; a busy machine does not count.
fn now() -> f64 {
    let said = std::fs::read_to_string("/proc/self/schedstat").unwrap();
    1e-9 * said.split(' ').next().unwrap().parse::<f64>().unwrap()
}

/// Mean time [s] of at least so many runs, and of enough of them for the clock, which ticks in
/// milliseconds.
fn mean(repeats: usize, mut run: impl FnMut()) -> f64 {
    let (start, mut count) = (now(), 0);
    while count < repeats || now() - start < 0.2 {
        run();
        count += 1;
    }
    (now() - start) / count as f64
}

fn time(body: &Body, repeats: usize) {
    let model = &body.model;
    let start = now();
    let mut workspace = FiniteElementWorkspace::new(model).unwrap();
    let order = now() - start;
    let numbers = workspace.factor_entries();
    let (supports, state) = (body.supports(), FiniteElementState::at_rest(model));
    let assemble = |workspace: &mut FiniteElementWorkspace| {
        LinearSystem::assemble(model, &supports, &state, workspace).map(drop)
    };
    let assembly = mean(repeats, || assemble(&mut workspace).unwrap());
    let mut system = LinearSystem::assemble(model, &supports, &state, &mut workspace).unwrap();
    let factor = mean(repeats, || system.factor().unwrap());
    let mut solution = vec![1.0; model.size()];
    let solve = mean(repeats, || {
        solution.fill(1.0);
        system.solve(&mut solution).unwrap();
    });
    let residual = relative_residual(&system, &solution);
    println!(
        "{{\"unknowns\": {}, \"factor_entries\": {numbers}, \"order_s\": {order}, \
         \"assembly_s\": {assembly}, \"factor_s\": {factor}, \"solve_s\": {solve}, \
         \"residual\": {residual:e}}}",
        model.size()
    );
}

/// |1 − K x| over |K||x| + 1, row by row, the largest.
fn relative_residual(system: &LinearSystem<'_>, solution: &[f64]) -> f64 {
    let mut left = vec![1.0; solution.len()];
    let mut sums = vec![1.0; solution.len()];
    let mut add = |row: usize, term: f64| {
        left[row] -= term;
        sums[row] += term.abs();
    };
    for (row, column, value) in system.entries() {
        add(row, value * solution[column]);
        if row != column {
            add(column, value * solution[row]);
        }
    }
    let each = left.iter().zip(&sums);
    each.fold(0.0, |largest, (left, sum)| largest.max((left / sum).abs()))
}
