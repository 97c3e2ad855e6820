//! The local model that nothing is fitted to, on figure 3-4's hemisphere, and what the source claims of it.

use palpate_jobs::plot::{Series, Style};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{Calibration, FiniteSphereModel, FiniteSphereSettings};

use super::figure_3_4::PARTICLES;
use super::pole::contact;
use crate::Error;
use crate::row::Rows;

/// Place of the source's number in them.
const SOURCE: usize = 1;

/// Without calibration, with and without the field of a punch in each sphere.
const KINDS: [(Calibration, &str); 2] = [
    (Calibration::None, "uncalibrated"),
    (Calibration::ParticlesAlone, "particles_alone"),
];

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
            let millimetres = 1e3 * radius;
            let name = format!("force_error/{word}/nu_{nu}/radius_{millimetres}_mm/{particles}");
            rows.add(&name, error);
            errors.push(error.abs());
        }
        let largest = errors.windows(2).map(|pair| pair[1] / pair[0]);
        let name = format!("claim/improves_with_points/{word}/nu_{nu}");
        rows.add(&name, largest.fold(0.0, f64::max));
        let name = format!("claim/below_34_loses_accuracy/{word}/nu_{nu}");
        rows.add(&name, errors[0] / errors[SOURCE]);
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

/// Without calibration and with the source's number of particles, and that number.
pub(super) fn of_source(law: &LinearElastic) -> Result<(FiniteSphereModel, usize), Error> {
    let particles = PARTICLES[SOURCE];
    Ok((model(particles, Calibration::None, law)?, particles))
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
    Ok(FiniteSphereModel::new(
        settings,
        law,
        Friction::Frictionless,
    )?)
}
