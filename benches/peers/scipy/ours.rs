//! Our side of `compare.py`: least squares on the residual that stands there too, timed.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a program of one page, whose output is read by another"
)]

use std::time::Instant;

use palpate_characterize::fit::{Parameter, Settings, least_squares};

/// Relaxed force of a ramp of `RAMP` [s] to one and a hold: stiffness, then g and ln τ of each term.
fn force(p: &[f64], time: f64) -> f64 {
    const RAMP: f64 = 0.2;
    let risen = |t: f64| {
        let t = t.max(0.0);
        let term = |g: f64, log: f64| g * (t + log.exp() * (-t / log.exp()).exp_m1());
        t - term(p[1], p[2]) - term(p[3], p[4])
    };
    p[0] * (risen(time) - risen(time - RAMP)) / RAMP
}

fn main() {
    let truth = [0.02, 0.2866, 1.537_f64.ln(), 0.2022, 6.090_f64.ln()];
    let start = [0.01, 0.1, 0.0, 0.1, 2.5];
    let noise = |i: usize| 2e-5 * (12.9898 * i as f64).sin();
    let data: Vec<f64> = (0..=1500)
        .map(|i| force(&truth, 0.02 * i as f64) + noise(i))
        .collect();
    let names = ["stiffness", "g_1", "log_tau_1", "g_2", "log_tau_2"];
    let parameters: Vec<Parameter> = names
        .iter()
        .zip(start)
        .map(|(name, value)| {
            let parameter = Parameter::new(*name, value);
            match name.starts_with("log") {
                true => parameter.within(-4.0, 6.0).scaled(1.0),
                false => parameter.within(0.0, 1.0),
            }
        })
        .collect();
    let residuals = |p: &[f64], found: &mut [f64]| {
        for (i, (residual, measured)) in found.iter_mut().zip(&data).enumerate() {
            *residual = force(p, 0.02 * i as f64) - measured;
        }
        Some(())
    };
    let mut least = f64::INFINITY;
    let mut fit = None;
    for _ in 0..20 {
        let began = Instant::now();
        let found =
            least_squares(&parameters, data.len(), &Settings::default(), residuals).unwrap();
        least = least.min(began.elapsed().as_secs_f64());
        fit = Some(found);
    }
    let fit = fit.unwrap();
    let values: Vec<f64> = fit.parameters.iter().map(|p| p.value).collect();
    println!(
        "{{\"seconds\": {least:e}, \"sum_of_squares\": {:e}, \"evaluations\": {}, \"values\": {values:?}}}",
        fit.sum_of_squares(),
        fit.evaluations
    );
}
