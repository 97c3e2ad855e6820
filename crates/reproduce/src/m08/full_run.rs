//! Force over time by the full viscoelastic run of finite elements, with internal variables.

use palpate_characterize::inverse::{Body, CandidateLaw};
use palpate_mechanics::finite_elements::indentation::{
    History, IndentationRun, IndentationSettings,
};
use palpate_mechanics::{Law, MooneyRivlin, NeoHookean, PronySeries};
use std::sync::Arc;

use crate::Error;
use crate::row::Rows;
use crate::virtual_rig::{END, RADIUS, RAMP};

/// Samples of the ramp and of the hold.
const OF_RAMP: usize = 20;
const OF_HOLD: usize = 60;
/// The first sample of the hold after the ramp [s]; from there on they lie farther and farther apart.
const FIRST: f64 = 0.02;

/// Times, depths and forces [N] of the source's block under its punch with these parameters [Pa], as printed, on the
/// coarsest mesh.
pub(super) fn full_run(
    rows: &Rows<'_>,
    law: CandidateLaw,
    parameters: &[f64],
    series: &PronySeries,
    depth: f64,
) -> Result<(History, Vec<f64>), Error> {
    let law: Arc<dyn Law> = match (law, parameters) {
        (CandidateLaw::NeoHookean, &[c10]) => Arc::new(NeoHookean::incompressible(c10)?),
        (CandidateLaw::MooneyRivlin, &[c10, c01]) => {
            Arc::new(MooneyRivlin::incompressible(c10, c01)?)
        }
        _ => {
            return Err(Error::failed("no such law is printed; please report this"));
        }
    };
    let Body::Block { block, indenter } = Body::under_punch(RADIUS) else {
        return Err(Error::failed("a punch needs a block; please report this"));
    };
    let mut run = IndentationRun::new(&IndentationSettings {
        block,
        indenter,
        law,
        prony: series.clone(),
        deepest: depth,
        halvings: 0,
    })?;
    let times = times();
    let depths: Vec<f64> = times.iter().map(|t| depth * (t / RAMP).min(1.0)).collect();
    let mut forces = Vec::with_capacity(times.len());
    for (&time, &depth) in times.iter().zip(&depths) {
        rows.report_step(format!("full viscoelastic run, {time:.2} of {END} s"));
        forces.push(run.press(time, depth, |_| {})?.force);
    }
    Ok((History { times, depths }, forces))
}

/// From zero, evenly over the ramp, then each a constant factor farther from its end.
fn times() -> Vec<f64> {
    let ramp = (0..=OF_RAMP).map(|i| RAMP * i as f64 / OF_RAMP as f64);
    let factor = (END - RAMP) / FIRST;
    let hold = (0..OF_HOLD).map(|i| RAMP + FIRST * factor.powf(i as f64 / (OF_HOLD - 1) as f64));
    ramp.chain(hold).collect()
}
