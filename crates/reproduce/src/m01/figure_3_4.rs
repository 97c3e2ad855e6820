use palpate_jobs::plot::{Series, Style};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{FiniteSphereModel, FiniteSphereSettings, Form};

use super::pole::{FORMS, POISSONS_RATIOS, YOUNGS_MODULUS, contact, finite_elements};
use super::timing::measure;
use super::uncalibrated;
use crate::Error;
use crate::machine::processor;
use crate::row::Rows;

/// Numbers of particles; 34 is the source's.
pub(super) const PARTICLES: [usize; 4] = [20, 34, 93, 300];

/// Radii of the flat tip [m]; the source names none.
const RADII: [f64; 2] = [2e-3, 3e-3];

/// The tip of the plots.
const PLOTTED_RADIUS: f64 = 3e-3;

/// The radius at which the periphery is fixed when particles are added, as in the source [m].
const FIXED_RADIUS: f64 = 0.02;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut errors = Vec::new();
    for poissons_ratio in POISSONS_RATIOS {
        let law = LinearElastic::new(YOUNGS_MODULUS, poissons_ratio)?;
        let judge = judge(rows, &law)?;
        for (form, word) in FORMS {
            errors.push(force_errors(rows, form, word, &law, &judge)?);
        }
        let found = uncalibrated::force_errors(rows, &law, PLOTTED_RADIUS, judge[1])?;
        errors.extend(found);
    }
    rows.figure("").draw(errors)?;
    let times = times(rows)?;
    rows.figure("time").draw(times)?;
    implied_radii(rows)
}

/// How the curves of a form are drawn.
fn style(form: Form) -> Style {
    match form {
        Form::Weak => Style::LineWithDots,
        Form::Strong => Style::DashedLineWithSquares,
    }
}

/// Finite element stiffness [N/m] under each of the tips, with its rows.
fn judge(rows: &mut Rows<'_>, law: &LinearElastic) -> Result<[f64; 2], Error> {
    let mut stiffness = [0.0; 2];
    for (radius, stiffness) in RADII.into_iter().zip(&mut stiffness) {
        let found = finite_elements(law, radius)?;
        *stiffness = found.answer.force;
        let (nu, millimetres) = (law.poissons_ratio(), 1e3 * radius);
        let name = format!("force_per_depth/finite_elements/nu_{nu}/radius_{millimetres}_mm");
        rows.row(&name)
            .with("unknowns", found.answer.unknowns)
            .with("error", format!("{:.1e}", found.error))
            .is(found.answer.force);
    }
    Ok(stiffness)
}

/// The curve for the tip of the plots; rows for all tips.
fn force_errors(
    rows: &mut Rows<'_>,
    form: Form,
    word: &str,
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
                    rows.row(&name).missing(reason);
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
            rows.add(&name, error);
        }
    }
    let name = format!("fitted, {word}, ν = {nu}");
    Ok(Series::new(
        name,
        points,
        style(form),
        usize::from(nu > 0.4),
    ))
}

fn times(rows: &mut Rows<'_>) -> Result<Vec<Series>, Error> {
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIOS[0])?;
    let machine = processor();
    let contact = contact(PLOTTED_RADIUS)?;
    let mut series = Vec::new();
    for (form, word) in FORMS {
        let mut points = Vec::new();
        for particles in PARTICLES {
            let row = rows.row(&format!("time/{word}/{particles}"));
            match model(particles, form, &law) {
                Ok(model) => {
                    let total = measure(&model, &contact).total;
                    points.push((particles as f64, 1e3 * total));
                    row.with("machine", &machine).is(total);
                }
                Err(reason) => row.missing(reason),
            }
        }
        series.push(Series::new(word, points, style(form), 0));
    }
    let (model, particles) = uncalibrated::of_source(&law)?;
    rows.row(&format!("time/uncalibrated/{particles}"))
        .with("machine", &machine)
        .is(measure(&model, &contact).total);
    Ok(series)
}

fn implied_radii(rows: &mut Rows<'_>) -> Result<(), Error> {
    let law = LinearElastic::new(YOUNGS_MODULUS, POISSONS_RATIOS[0])?;
    for particles in PARTICLES {
        let row = rows.row(&format!("implied_tool_radius/{particles}"));
        match model(particles, Form::Weak, &law) {
            // Radii scale: a tool of one metre has its periphery at fixed_radius(1).
            Ok(model) => row.is(FIXED_RADIUS / model.fixed_radius(1.0)),
            Err(reason) => row.missing(reason),
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
    FiniteSphereModel::new(settings, law, Friction::Frictionless)
}
