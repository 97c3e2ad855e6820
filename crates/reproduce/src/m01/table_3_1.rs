use std::time::Instant;

use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::Bond;
use palpate_mechanics::finite_spheres::{FiniteSphereModel, FiniteSphereSettings, Form, Solver};

use super::pole::{FORMS, YOUNGS_MODULUS, contact, hemisphere_problem};
use super::timing::{Timing, measure};
use crate::Error;
use crate::machine::processor;
use crate::published::TABLE_3_1 as PUBLISHED;
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const TABLE_3_1: Item = Item {
    name: "table-3-1",
    title: "time to indent a hemisphere at the pole, local model against finite elements",
    seconds: 2.2,
    run,
};

/// Columns of the published table.
const LOCAL: &str = "pcmfs_local";
const FINITE_ELEMENTS: &str = "fe_model_adina";

/// Rows of the published table, as they are called here, with their unit.
const QUANTITIES: [(&str, &str, &str); 4] = [
    ("nodes", "nodes", "1"),
    ("degrees_of_freedom", "degrees_of_freedom", "1"),
    ("solution_time", "solution_s", "s"),
    ("total_time", "total_s", "s"),
];

/// Relative residual of the iteration [-]; the source gives none.
const TOLERANCE: f64 = 1e-6;

/// The source names neither.
const POISSONS_RATIO: f64 = 0.3;
const TIP_RADIUS: f64 = 2e-3;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let particles = FiniteSphereSettings::default().particles;
    let counts = [particles, 3 * particles].map(|count| count as f64);
    for ((quantity, name, unit), ours) in QUANTITIES.into_iter().zip(counts) {
        let value = beside(LOCAL, quantity, Some(ours), unit);
        rows.add(name, value, "");
    }
    let machine = format!("{}, one thread", processor());
    for (form, word) in FORMS {
        for (solver, way) in solvers() {
            let timing = time(form, solver)?;
            let note = note(&machine, word, way, &timing);
            let [solution, total] = [timing.solution, timing.total].map(Some);
            for (at, ours) in [(2, solution), (3, total)] {
                let (quantity, name, unit) = QUANTITIES[at];
                // The default has the plain name.
                let name = match (form, solver) {
                    (Form::Weak, Solver::Direct) => name.to_owned(),
                    _ => format!("{name}/{word}_{way}"),
                };
                rows.add(&name, beside(LOCAL, quantity, ours, unit), note.clone());
            }
        }
    }
    finite_elements(rows, &machine)
}

/// Smallest elements [-], in radii of the tip, and halvings of a mesh with about as many nodes as the
/// source's, and of one halved once more.
const MESHES: [(&str, f64, i32); 2] = [("", 0.1, 1), ("/converged", 0.1, 2)];

/// Ours is axisymmetric: as many nodes resolve far more than in the source's solid.
fn finite_elements(rows: &mut Rows<'_>, machine: &str) -> Result<(), Error> {
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIO)?;
    let problem = hemisphere_problem(&law, TIP_RADIUS);
    for (which, edge, halvings) in MESHES {
        let start = Instant::now();
        let answer = problem.solve_on(edge, halvings)?;
        let total = start.elapsed().as_secs_f64();
        let note = format!(
            "axisymmetric quadratic elements, a patch of the tip's radius is moved: {} N/m; the source \
             moves one node of a solid mesh, which has no force in the limit; total is mesh, equations, \
             factors and solution, which are not told apart, on {machine}",
            answer.force
        );
        let ours = [
            Some(answer.nodes as f64),
            Some(answer.unknowns as f64),
            None,
            Some(total),
        ];
        for ((quantity, name, unit), ours) in QUANTITIES.into_iter().zip(ours) {
            let name = format!("finite_elements{which}/{name}");
            let value = beside(FINITE_ELEMENTS, quantity, ours, unit);
            rows.add(&name, value, note.clone());
        }
    }
    Ok(())
}

fn solvers() -> [(Solver, &'static str); 2] {
    let gmres = Solver::Gmres {
        tolerance: TOLERANCE,
    };
    [(Solver::Direct, "direct"), (gmres, "gmres")]
}

fn time(form: Form, solver: Solver) -> Result<Timing, Error> {
    let settings = FiniteSphereSettings {
        form,
        solver,
        ..FiniteSphereSettings::default()
    };
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIO)?;
    let model = FiniteSphereModel::new(settings, &law, Bond::Slip)?;
    Ok(measure(&model, &contact(TIP_RADIUS)?))
}

fn beside(column: &str, quantity: &str, ours: Option<f64>, unit: &'static str) -> Value {
    Value {
        published: PUBLISHED.value(quantity, column),
        ours,
        unit,
    }
}

fn note(machine: &str, form: &str, way: &str, timing: &Timing) -> String {
    let iterations = match timing.iterations {
        Some(count) => format!(
            ", {count} iterations over three directions to a relative residual of {TOLERANCE:e}"
        ),
        None => String::new(),
    };
    format!(
        "{form} form, {way}{iterations}; median of {} steps on {machine}; three directions are solved for \
         at once; total is placement, equations and solution; the source's machine was a 500 MHz Pentium II",
        timing.steps
    )
}
