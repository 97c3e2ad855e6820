//! Section 6.4.6: the source starts from a range of values because a fit may end elsewhere, and cites that parameters
//! vary as much as the measurements do.

use palpate_characterize::fit::Random;

use super::block::{LAWS, ORGANS, printed};
use super::starts::{ALGORITHMS, Model};
use crate::Error;
use crate::published::prony;
use crate::row::Rows;

/// Each parameter starts at these multiples of the printed one, in all combinations.
const FACTORS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];

/// Standard deviation of the noise over the largest force [%].
const NOISE: [u32; 3] = [1, 5, 10];

/// Noisy recordings for each deviation.
const DRAWS: u64 = 20;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, depth_mm) in ORGANS {
        for (law, word) in LAWS {
            let truth = printed(law, organ, "final")?;
            let model = Model::indented(law, 1e-3 * f64::from(depth_mm), prony(organ, depth_mm)?);
            let case = format!("{organ}/{word}");
            add_starts(rows, &case, &model, &truth)?;
            add_noise(rows, &case, &model, &truth)?;
        }
    }
    Ok(())
}

/// Where fits end, in per cent of the starts.
fn add_starts(rows: &mut Rows<'_>, case: &str, model: &Model, truth: &[f64]) -> Result<(), Error> {
    let starts = starts(truth);
    for (algorithm, word) in ALGORITHMS {
        rows.report_step(format_args!("{case}, {word}"));
        let (mut arrived, mut implausible) = (0, 0);
        for start in &starts {
            let (way, ended) = model.way(algorithm, truth, start)?;
            let last = way.last().map_or(&[][..], |values| values);
            let is_tissue = last.iter().all(|value| value.is_finite() && *value >= 0.0);
            arrived += usize::from(ended);
            implausible += usize::from(!ended && !is_tissue);
        }
        let elsewhere = starts.len() - arrived - implausible;
        for (what, count) in [
            ("arrived", arrived),
            ("implausible", implausible),
            ("elsewhere", elsewhere),
        ] {
            rows.row(&format!("{case}/{word}/{what}"))
                .with("starts", starts.len())
                .is(100.0 * count as f64 / starts.len() as f64);
        }
    }
    Ok(())
}

/// All combinations of the factors.
fn starts(truth: &[f64]) -> Vec<Vec<f64>> {
    let mut starts = vec![Vec::new()];
    for value in truth {
        let longer = starts.iter().flat_map(|start: &Vec<f64>| {
            FACTORS.map(|factor| [start.as_slice(), &[factor * value]].concat())
        });
        starts = longer.collect();
    }
    starts
}

/// Deviation of the parameters that are found in noisy forces.
fn add_noise(rows: &mut Rows<'_>, case: &str, model: &Model, truth: &[f64]) -> Result<(), Error> {
    let Some(forces) = model.forces(truth) else {
        return Err(Error::failed("the printed law has no force"));
    };
    let largest = forces.iter().copied().fold(0.0, f64::max);
    for percent in NOISE {
        rows.report_step(format_args!("{case}, {percent} % of noise"));
        let deviation = 1e-2 * f64::from(percent) * largest;
        let mut found = Vec::new();
        for draw in 0..DRAWS {
            let mut random = Random::new(1000 * u64::from(percent) + draw);
            let noisy: Vec<f64> = forces
                .iter()
                .map(|force| force + deviation * random.normal())
                .collect();
            found.push(model.found(truth, &noisy)?);
        }
        let mut add = |name: &str, values: &[f64], printed: f64| {
            rows.row(&format!("{case}/noise_{percent}_percent/{name}"))
                .with("draws", DRAWS)
                .with("samples", forces.len())
                .published(f64::from(percent))
                .is(100.0 * spread(values) / printed);
        };
        for (place, name) in ["c10", "c01"].into_iter().take(truth.len()).enumerate() {
            let values: Vec<f64> = found.iter().map(|values| values[place]).collect();
            add(name, &values, truth[place]);
        }
        if truth.len() > 1 {
            let sums: Vec<f64> = found.iter().map(|values| values.iter().sum()).collect();
            add("sum", &sums, truth.iter().sum());
        }
    }
    Ok(())
}

/// Standard deviation, in the unit of the values.
fn spread(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (squares / (count - 1.0)).sqrt()
}
