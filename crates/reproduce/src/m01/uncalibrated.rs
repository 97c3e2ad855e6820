//! The local model that nothing is fitted to, on figure 3-4's hemisphere, and what the source claims of it.

use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::Bond;
use palpate_mechanics::finite_spheres::{Calibration, FiniteSphereModel, FiniteSphereSettings};

use super::pole::contact;
use super::timing::measure;
use crate::Error;
use crate::Rows;
use crate::row::Value;
use palpate_jobs::plot::{Series, Style};

/// Numbers of particles; 34 is the source's.
const PARTICLES: [usize; 4] = [20, 34, 93, 300];

/// Place of the source's number in them.
const SOURCE: usize = 1;

/// Without calibration, with and without the field of a punch in each sphere.
const KINDS: [(Calibration, &str); 2] = [
    (Calibration::None, "uncalibrated"),
    (Calibration::ParticlesAlone, "particles_alone"),
];

const ERROR_NOTE: &str = "nothing is fitted: particles, integration and the held base alone, against the \
    finite elements above; in \"particles_alone\" the spheres do not carry the field of a punch";

/// The errors [%] under a tip of `radius` [m] whose stiffness by finite elements is `exact` [N/m], as rows
/// and curves.
pub(super) fn force_errors(
    rows: &mut Rows<'_>,
    law: &LinearElastic,
    radius: f64,
    exact: f64,
) -> Result<Vec<Series>, Error> {
    let nu = law.poissons_ratio();
    let mut series = Vec::new();
    for (calibration, word) in KINDS {
        let mut errors = Vec::new();
        for particles in PARTICLES {
            let model = model(particles, calibration, law)?;
            let mut workspace = model.workspace();
            let response = model.respond(&contact(radius)?, &mut workspace);
            let error = 100.0 * (response.stiffness[(2, 2)] / exact - 1.0);
            let name = format!(
                "force_error/{word}/nu_{nu}/radius_{}_mm/{particles}",
                1e3 * radius
            );
            rows.add(&name, own(error, "%"), ERROR_NOTE);
            errors.push(error.abs());
        }
        claims(rows, (word, nu), &errors);
        let points = PARTICLES.iter().zip(&errors);
        series.push(Series {
            name: format!("{}, ν = {nu}", word.replace('_', " ")),
            points: points.map(|(n, e)| (*n as f64, *e)).collect(),
            style: Style::DashedLine,
            color: 2
                + 2 * usize::from(calibration == Calibration::ParticlesAlone)
                + usize::from(nu > 0.4),
        });
    }
    Ok(series)
}

/// The source's two sentences on the curve of `errors` [%], one for each number of particles.
fn claims(rows: &mut Rows<'_>, (word, nu): (&str, f64), errors: &[f64]) {
    let largest = errors.windows(2).map(|pair| pair[1] / pair[0]);
    let growth = largest.fold(0.0, f64::max);
    let note = "the source: \"with increase in the number of points used for discretization there is \
        significant improvement\"; largest ratio of an error to that of the number before, below one where \
        this holds";
    let name = format!("claim/improves_with_points/{word}/nu_{nu}");
    rows.add(&name, own(growth, "1"), note);
    let note = "the source: \"if the number of the particles is reduced below 34, the computed solution lost \
        accuracy\"; error of 20 particles over that of 34, above one where this holds";
    let name = format!("claim/below_34_loses_accuracy/{word}/nu_{nu}");
    rows.add(&name, own(errors[0] / errors[SOURCE], "1"), note);
}

/// Time of a step [s].
pub(super) fn time(
    rows: &mut Rows<'_>,
    law: &LinearElastic,
    radius: f64,
    note: &str,
) -> Result<(), Error> {
    let particles = PARTICLES[SOURCE];
    let model = model(particles, Calibration::None, law)?;
    let total = measure(&model, &contact(radius)?).total;
    rows.add(
        &format!("time/uncalibrated/{particles}"),
        own(total, "s"),
        note.to_owned(),
    );
    Ok(())
}

fn model(
    particles: usize,
    calibration: Calibration,
    law: &LinearElastic,
) -> Result<FiniteSphereModel, Error> {
    let settings = FiniteSphereSettings {
        particles,
        calibration,
        ..FiniteSphereSettings::default()
    };
    Ok(FiniteSphereModel::new(settings, law, Bond::Slip)?)
}

/// A number that the source does not print.
fn own(ours: f64, unit: &'static str) -> Value {
    Value {
        published: None,
        ours: Some(ours),
        unit,
    }
}
