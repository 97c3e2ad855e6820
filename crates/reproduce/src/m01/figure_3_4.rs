use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::Bond;
use palpate_mechanics::finite_spheres::{FiniteSphereModel, FiniteSphereSettings, Form};

use super::plots;
use super::pole::{FORMS, POISSONS_RATIOS, YOUNGS_MODULUS, contact, finite_elements};
use super::timing::measure;
use super::uncalibrated;
use crate::Error;
use crate::machine::processor;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::Series;

pub(crate) const FIGURE_3_4: Item = Item {
    name: "figure-3-4",
    title: "force at the pole against the number of particles",
    seconds: 90.0,
    run,
};

/// Numbers of particles; 34 is the source's.
const PARTICLES: [usize; 4] = [20, 34, 93, 300];

/// Radii of the flat tip [m]; the source names none.
const RADII: [f64; 2] = [2e-3, 3e-3];

/// The tip of the plots.
const PLOTTED_RADIUS: f64 = 3e-3;

/// The radius that the periphery is held at when particles are added, as in the source [m].
const HELD_RADIUS: f64 = 0.02;

const ERROR_NOTE: &str = "against finite elements of the whole hemisphere under a flat tip of this radius \
    (force_per_depth/finite_elements); calibrated, so fitted and not validated: the model's spacing is set on the half-space, and its constants on \
    finite elements of other shapes and tips";

const HIDDEN_NOTE: &str = "radius a = alpha h of the tool that one displaced particle stands for when the \
    periphery stays at 20 mm; without a tool radius the force is proportional to a, and so to the \
    spacing h: it does not converge but tends to zero as particles are added, and a comparison with \
    finite elements that displace one node compares two implied radii";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut errors = Vec::new();
    for poissons_ratio in POISSONS_RATIOS {
        let law = LinearElastic::new(YOUNGS_MODULUS, poissons_ratio)?;
        let judge = judge(rows, &law)?;
        for (form, word) in FORMS {
            errors.push(force_errors(rows, (form, word), &law, &judge)?);
        }
        let found = uncalibrated::force_errors(rows, &law, PLOTTED_RADIUS, judge[1])?;
        errors.extend(found);
    }
    let note = "the curves of the source carry no numbers; size of the error, tip of 3 mm radius";
    rows.add_figure(None, &plots::of_errors(errors), note)?;
    let times = times(rows)?;
    rows.add_figure(Some("time"), &plots::of_times(times), "")?;
    implied_radii(rows)
}

/// Finite element stiffness [N/m] under each of the tips, with its rows.
fn judge(rows: &mut Rows<'_>, law: &LinearElastic) -> Result<[f64; 2], Error> {
    let mut stiffness = [0.0; 2];
    for (radius, stiffness) in RADII.into_iter().zip(&mut stiffness) {
        let found = finite_elements(law, radius)?;
        *stiffness = found.answer.force;
        let (nu, millimetres) = (law.poissons_ratio(), 1e3 * radius);
        let name = format!("force_per_depth/finite_elements/nu_{nu}/radius_{millimetres}_mm");
        let note = format!(
            "E = 10 kPa, {} unknowns, relative error {:.1e}",
            found.answer.unknowns, found.error
        );
        rows.add(&name, own(Some(found.answer.force), "N/m"), note);
    }
    Ok(stiffness)
}

/// The curve for the tip of the plots; rows for all tips.
fn force_errors(
    rows: &mut Rows<'_>,
    (form, word): (Form, &str),
    law: &LinearElastic,
    judge: &[f64; 2],
) -> Result<Series, Error> {
    let nu = law.poissons_ratio();
    let mut points = Vec::new();
    for (radius, exact) in RADII.into_iter().zip(judge) {
        for particles in PARTICLES {
            let millimetres = 1e3 * radius;
            let name = format!("force_error/{word}/nu_{nu}/radius_{millimetres}_mm/{particles}");
            let model = match model(particles, form, law) {
                Ok(model) => model,
                Err(reason) => {
                    rows.add_missing(&name, "%", reason.to_string());
                    continue;
                }
            };
            let ours = model
                .respond(&contact(radius)?, &mut model.workspace())
                .stiffness[(2, 2)];
            let error = 100.0 * (ours / exact - 1.0);
            if radius == PLOTTED_RADIUS {
                points.push((particles as f64, error.abs()));
            }
            rows.add(&name, own(Some(error), "%"), ERROR_NOTE);
        }
    }
    Ok(Series {
        name: format!("fitted, {word}, ν = {nu}"),
        points,
        style: plots::style(form),
        color: usize::from(nu > 0.4),
    })
}

fn times(rows: &mut Rows<'_>) -> Result<Vec<Series>, Error> {
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIOS[0])?;
    let note = format!(
        "placement, equations and direct solution of one step, median, ν = 0.3, tip of 3 mm radius, on {}, one \
         thread",
        processor()
    );
    let mut series = Vec::new();
    for (form, word) in FORMS {
        let mut points = Vec::new();
        for particles in PARTICLES {
            let name = format!("time/{word}/{particles}");
            match model(particles, form, &law) {
                Ok(model) => {
                    let total = measure(&model, &contact(PLOTTED_RADIUS)?).total;
                    points.push((particles as f64, 1e3 * total));
                    rows.add(&name, own(Some(total), "s"), note.clone());
                }
                Err(reason) => rows.add_missing(&name, "s", reason.to_string()),
            }
        }
        series.push(Series {
            name: word.to_owned(),
            points,
            style: plots::style(form),
            color: 0,
        });
    }
    uncalibrated::time(rows, &law, PLOTTED_RADIUS, &note)?;
    Ok(series)
}

fn implied_radii(rows: &mut Rows<'_>) -> Result<(), Error> {
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIOS[0])?;
    for particles in PARTICLES {
        let name = format!("implied_tool_radius/{particles}");
        match model(particles, Form::Weak, &law) {
            // Radii scale: a tool of one metre has its periphery at held_radius(1).
            Ok(model) => {
                let radius = HELD_RADIUS / model.held_radius(1.0);
                rows.add(&name, own(Some(radius), "m"), HIDDEN_NOTE);
            }
            Err(reason) => rows.add_missing(&name, "m", reason.to_string()),
        }
    }
    Ok(())
}

fn model(
    particles: usize,
    form: Form,
    law: &LinearElastic,
) -> Result<FiniteSphereModel, palpate_mechanics::Error> {
    let settings = FiniteSphereSettings {
        particles,
        form,
        ..FiniteSphereSettings::default()
    };
    FiniteSphereModel::new(settings, law, Bond::Slip)
}

/// A number that the source does not print.
fn own(ours: Option<f64>, unit: &'static str) -> Value {
    Value {
        published: None,
        ours,
        unit,
    }
}
