use std::time::Instant;

use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{FiniteSphereModel, FiniteSphereSettings, Form, Solver};

use super::pole::{FORMS, YOUNGS_MODULUS, contact, hemisphere_problem};
use super::timing::measure;
use crate::Error;
use crate::machine::processor;
use crate::row::Rows;

/// Relative residual of the iteration [-]; the source gives none.
const TOLERANCE: f64 = 1e-6;

/// The source names neither.
const POISSONS_RATIO: f64 = 0.3;
const TIP_RADIUS: f64 = 2e-3;

/// Smallest elements [-], in radii of the tip, and halvings of a mesh with about as many nodes as the
/// source's, and of one halved once more.
const MESHES: [(&str, f64, i32); 2] = [("", 0.1, 1), ("/converged", 0.1, 2)];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let particles = FiniteSphereSettings::default().particles;
    rows.add("nodes", particles as f64);
    rows.add("degrees_of_freedom", 3.0 * particles as f64);
    let tolerance = TOLERANCE;
    for (form, word) in FORMS {
        for (solver, way) in [
            (Solver::Direct, "direct"),
            (Solver::Gmres { tolerance }, "gmres"),
        ] {
            add_local(rows, form, word, solver, way)?;
        }
    }
    finite_elements(rows)
}

fn add_local(
    rows: &mut Rows<'_>,
    form: Form,
    word: &str,
    solver: Solver,
    way: &str,
) -> Result<(), Error> {
    let settings = FiniteSphereSettings {
        form,
        solver,
        ..FiniteSphereSettings::default()
    };
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIO)?;
    let model = FiniteSphereModel::new(settings, &law, Friction::Frictionless)?;
    let timing = measure(&model, &contact(TIP_RADIUS)?);
    for (quantity, ours) in [("solution_s", timing.solution), ("total_s", timing.total)] {
        // The default has the plain name.
        let name = match (form, solver) {
            (Form::Weak, Solver::Direct) => quantity.to_owned(),
            _ => format!("{quantity}/{word}_{way}"),
        };
        rows.row(&name)
            .with("form", word)
            .with("way", way)
            .with("iterations", way)
            .with("count", timing.iterations.unwrap_or(0))
            .with("tolerance", format!("{TOLERANCE:e}"))
            .with("steps", timing.steps)
            .with("machine", processor())
            .is(ours);
    }
    Ok(())
}

/// Ours is axisymmetric: as many nodes resolve far more than in the source's solid.
fn finite_elements(rows: &mut Rows<'_>) -> Result<(), Error> {
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIO)?;
    let problem = hemisphere_problem(&law, TIP_RADIUS);
    for (which, edge, halvings) in MESHES {
        let start = Instant::now();
        let answer = problem.solve_on(edge, halvings)?;
        let total = start.elapsed().as_secs_f64();
        for (quantity, ours) in [
            ("nodes", Some(answer.nodes as f64)),
            ("degrees_of_freedom", Some(answer.unknowns as f64)),
            ("solution_s", None),
            ("total_s", Some(total)),
        ] {
            rows.row(&format!("finite_elements{which}/{quantity}"))
                .with("force", answer.force)
                .with("machine", processor())
                .is(ours);
        }
    }
    Ok(())
}
