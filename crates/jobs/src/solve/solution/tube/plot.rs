use nalgebra::Matrix3;
use palpate_mechanics::finite_elements::estimate::Estimated;
use palpate_mechanics::finite_elements::tube::Inflated;
use palpate_mechanics::{FibreFrame, Law, Vec3};

use super::super::super::problem::{Problem, Tube};
use super::super::plots;
use crate::Error;
use crate::plot::{Plot, Series, Style};

/// Points of the curve that is drawn.
const POINTS: usize = 30;

/// Relative error that is not visible in a plot [-].
const UNSEEN: f64 = 0.2;

/// Displacement [m] and pressure [Pa] up to the largest pressure that has an answer.
pub(crate) fn curve(
    requested: &[f64],
    inflated: &Inflated,
    under: impl Fn(&[f64], f64) -> Result<Estimated<Inflated>, Error>,
) -> Result<Vec<(f64, f64)>, Error> {
    let most = requested.iter().copied().fold(0.0, f64::max);
    let most = inflated
        .limit_pressure
        .map_or(most, |limit| most.min(limit));
    let part = |k: usize| {
        let even = k as f64 / POINTS as f64;
        match inflated.limit_pressure {
            // Denser towards the limit, where a small pressure moves the wall far.
            Some(_) => 1.0 - (1.0 - even).powi(3),
            // Otherwise denser at both ends: fibres stiffen the wall as it widens.
            None => 0.5 - 0.5 * (std::f64::consts::PI * even).cos(),
        }
    };
    let pressures: Vec<f64> = (0..=POINTS)
        .map(|k| part(k) * (1.0 - 1e-6) * most)
        .collect();
    let moved = under(&pressures, UNSEEN)?.answer.inner_displacements;
    let known = moved.iter().zip(&pressures);
    Ok(known
        .filter_map(|(moved, pressure)| Some(((*moved)?, *pressure)))
        .collect())
}

/// Pressure against displacement, compared with the closed form of a tube without ends.
pub(crate) fn over_displacement(
    problem: &Problem,
    case: &Tube,
    inflated: &Inflated,
    drawn: Vec<(f64, f64)>,
) -> Plot {
    let requested = inflated.inner_displacements.iter().zip(&case.pressures);
    let requested = requested.filter_map(|(moved, pressure)| Some((1e3 * (*moved)?, *pressure)));
    let limit = inflated.limit_displacement.zip(inflated.limit_pressure);
    let ends = drawn.iter().copied().chain(limit);
    let widest = ends.map(|(moved, _)| moved).fold(0.0, f64::max);
    let curve = drawn
        .iter()
        .map(|(moved, pressure)| (1e3 * moved, *pressure));
    let mut series = vec![
        plots::line("finite elements, ends fixed", curve),
        Series {
            style: Style::Dots,
            ..plots::line("asked for", requested)
        },
    ];
    if let Some((moved, pressure)) = limit {
        series.push(Series {
            style: Style::Dots,
            color: 3,
            ..plots::line("limit", [(1e3 * moved, pressure)].into_iter())
        });
    }
    let along = (0..=80).map(|k| widest * f64::from(k) / 80.0);
    let endless = along.map(|moved| (1e3 * moved, endless_pressure(problem, case, moved)));
    series.push(plots::closed_form("endless tube, closed form", endless));
    Plot {
        title: "Pressure against displacement of the inner wall".to_owned(),
        x_label: "Displacement of the inner wall at mid-length [mm]".to_owned(),
        y_label: "Pressure [Pa]".to_owned(),
        series,
        ..Plot::default()
    }
}

/// The pressure [Pa] at which the inner wall of a tube without ends has moved by `moved` [m].
fn endless_pressure(problem: &Problem, case: &Tube, moved: f64) -> f64 {
    let (inner, outer) = (case.inner_radius, case.outer_radius);
    let at_rest = &problem.material.at_rest;
    match problem.is_small_strain() {
        // Lamé, plane strain.
        true => {
            let (young, nu) = (at_rest.youngs_modulus(), at_rest.poissons_ratio());
            let squares = (inner * inner, outer * outer);
            let compliance = (1.0 + nu) / young * inner / (squares.1 - squares.0)
                * ((1.0 - 2.0 * nu) * squares.0 + squares.1);
            moved / compliance
        }
        false => {
            let law = &problem.material.law;
            // The hoop is the first axis here, the axis of the tube the third.
            let frame = FibreFrame::new(&Vec3::x(), &Vec3::z());
            let in_wall = frame.and_then(|frame| law.in_frame(&frame));
            let law = in_wall.as_ref().unwrap_or(law);
            incompressible_pressure(law.as_ref(), inner, outer, moved)
        }
    }
}

/// p = ∫ (σ_θ − σ_r)/r dr over a wall of constant volume, by Simpson's rule over the radius at rest.
fn incompressible_pressure(law: &dyn Law, inner: f64, outer: f64, moved: f64) -> f64 {
    let more = (inner + moved).powi(2) - inner * inner;
    let integrand = |rest: f64| {
        let now = (rest * rest + more).sqrt();
        let hoop = now / rest;
        let f = Matrix3::from_diagonal(&[hoop, 1.0 / hoop, 1.0].into());
        let stress = law.distortion_stress(&f);
        (stress[(0, 0)] * hoop - stress[(1, 1)] / hoop) * rest / (now * now)
    };
    let parts = 64;
    let step = (outer - inner) / f64::from(parts);
    let weighted = (0..=parts).map(|k| {
        let weight = match k {
            0 => 1.0,
            k if k == parts => 1.0,
            k if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        weight * integrand(inner + step * f64::from(k))
    });
    weighted.sum::<f64>() * step / 3.0
}
