use palpate_mechanics::LinearElastic;
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{
    Calibration, FiniteSphereModel, FiniteSphereSettings, Form,
};

use super::pole::{FORMS, POISSONS_RATIOS, RADIUS, YOUNGS_MODULUS, contact, finite_elements};
use crate::Error;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

/// The source names no tool; this is its probe's order of size [m].
const TIP_RADIUS: f64 = 3e-3;

/// Largest distance from finite elements that the weak form may have beyond the tip's edge, in depths [-].
const PROFILE_BOUND: f64 = 0.05;

/// The model's kinds with the words of their rows.
fn kinds() -> Vec<(FiniteSphereSettings, &'static str)> {
    let settings = FiniteSphereSettings::default();
    let forms = FORMS.map(|(form, word)| (FiniteSphereSettings { form, ..settings }, word));
    let calibration = Calibration::None;
    let own = FiniteSphereSettings {
        form: Form::Weak,
        calibration,
        ..settings
    };
    forms.into_iter().chain([(own, "uncalibrated")]).collect()
}

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for poissons_ratio in POISSONS_RATIOS {
        let law = LinearElastic::new(YOUNGS_MODULUS, poissons_ratio)?;
        let judge = finite_elements(&law, TIP_RADIUS)?.answer.profile;
        let mut series = vec![series("finite elements", &judge, Style::Line, 0)];
        for (color, (settings, word)) in kinds().into_iter().enumerate() {
            let (profile, shown) = profile(settings, &law, &judge)?;
            let each = judge
                .iter()
                .zip(&profile)
                .take_while(|((arc, _), _)| *arc < shown);
            let squares: Vec<f64> = each.map(|((_, a), (_, b))| (a - b).powi(2)).collect();
            let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
            rows.add(&format!("profile_rms/{word}/nu_{poissons_ratio}"), rms);
            let beyond = judge.iter().zip(&profile);
            let beyond = beyond.filter(|((arc, _), _)| *arc > TIP_RADIUS && *arc < shown);
            let worst = beyond
                .map(|((_, a), (_, b))| (a - b).abs())
                .fold(0.0, f64::max);
            let verdict = if worst <= PROFILE_BOUND {
                "within"
            } else {
                "misses"
            };
            rows.row(&format!("profile_worst/{word}/nu_{poissons_ratio}"))
                .with("verdict", verdict)
                .with("bound", PROFILE_BOUND)
                .is(worst);
            let name = format!("34 particles, {}", word.replace('_', " "));
            series.push(self::series(&name, &profile, Style::DashedLine, color + 1));
        }
        rows.figure(&format!("nu_{poissons_ratio}")).draw(series)?;
    }
    Ok(())
}

/// The local model's profile at the arcs of `judge` [m], for a depth of one, and the arc up to which it
/// shows any [m].
fn profile(
    settings: FiniteSphereSettings,
    law: &LinearElastic,
    judge: &[(f64, f64)],
) -> Result<(Vec<(f64, f64)>, f64), Error> {
    let model = FiniteSphereModel::new(settings, law, Friction::Frictionless)?;
    let contact = contact(TIP_RADIUS)?;
    let mut workspace = model.workspace();
    let response = model.respond(&contact, &mut workspace);
    let down = Vec3::new(0.0, 0.0, -1.0);
    let points = judge.iter().map(|&(arc, _)| {
        let angle = arc / RADIUS;
        let normal = Vec3::new(angle.sin(), 0.0, angle.cos());
        let at = contact.point + RADIUS * (normal - Vec3::z());
        let moved = model.displacement(&contact, &response, &mut workspace, &down, &at);
        (arc, moved.dot(&normal))
    });
    Ok((points.collect(), model.shown_radius(TIP_RADIUS)))
}

fn series(name: &str, profile: &[(f64, f64)], style: Style, color: usize) -> Series {
    let points = profile.iter().map(|(arc, u)| (1e3 * arc, *u)).collect();
    Series::new(name, points, style, color)
}
