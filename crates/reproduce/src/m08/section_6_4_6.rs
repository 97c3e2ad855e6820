//! Section 6.4.6: the source starts from a range of values because a fit may end elsewhere, and cites that parameters
//! vary as much as the measurements do.

use palpate_characterize::fit::Random;
use palpate_characterize::inverse::SoughtLaw;

use super::block::ORGANS;
use super::starts::{ALGORITHMS, Algorithm, Model};
use crate::Error;
use crate::published::{TABLE_6_4, TABLE_6_5, prony};
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const SECTION_6_4_6: Item = Item {
    name: "section-6-4-6",
    title: "a fit from a range of starts, and of noisy forces",
    seconds: 2.0,
    run,
};

/// Each parameter starts at these multiples of the printed one, in all combinations.
const FACTORS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];

/// Standard deviation of the noise over the largest force [%].
const NOISE: [u32; 3] = [1, 5, 10];

/// Noisy recordings for each deviation.
const DRAWS: u64 = 20;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, depth_mm) in ORGANS {
        let laws = [
            (
                SoughtLaw::NeoHookean,
                "neo_hookean",
                vec![TABLE_6_4.value(organ, "final_c10_pa")],
            ),
            (
                SoughtLaw::MooneyRivlin,
                "mooney_rivlin",
                vec![
                    TABLE_6_5.value(organ, "final_c10_pa"),
                    TABLE_6_5.value(organ, "final_c01_pa"),
                ],
            ),
        ];
        for (law, word, truth) in laws {
            let truth: Vec<f64> = truth.into_iter().flatten().collect();
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
        rows.say(format_args!("{case}, {word}"));
        let (mut arrived, mut implausible) = (0, 0);
        for start in &starts {
            let (way, ended) = model.way(algorithm, truth, start)?;
            let last = way.last().map_or(&[][..], |values| values);
            let is_tissue = last.iter().all(|value| value.is_finite() && *value >= 0.0);
            arrived += usize::from(ended);
            implausible += usize::from(!ended && !is_tissue);
        }
        let part = |count: usize| Value::own(100.0 * count as f64 / starts.len() as f64, "%");
        let note = note(algorithm, starts.len());
        let elsewhere = starts.len() - arrived - implausible;
        for (what, count) in [
            ("arrived", arrived),
            ("implausible", implausible),
            ("elsewhere", elsewhere),
        ] {
            rows.add(&format!("{case}/{word}/{what}"), part(count), note.clone());
        }
    }
    Ok(())
}

fn note(algorithm: Algorithm, starts: usize) -> String {
    format!(
        "{}; force without noise, {starts} starts with each parameter 0.1 to 10 times the printed one: arrived within 1 % of it, ended at a \
         negative or no modulus, or elsewhere after at most 100 steps. Where nothing ends elsewhere at a plausible value, the \
         solution is unique as far as these starts see; the source prints no numbers",
        algorithm.told()
    )
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
        rows.add_missing(
            &format!("{case}/noise"),
            "%",
            "the printed law has no force",
        );
        return Ok(());
    };
    let largest = forces.iter().copied().fold(0.0, f64::max);
    for percent in NOISE {
        rows.say(format_args!("{case}, {percent} % of noise"));
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
        let names: &[&str] = match truth.len() {
            1 => &["c10"],
            _ => &["c10", "c01"],
        };
        let note = format!(
            "standard deviation over the printed value, of {DRAWS} fits to {} samples with independent noise, whose deviation is this part of \
             the largest force; published: the claim, cited in 6.4.6, that parameters vary as much as measurements do. One \
             modulus varies less, because independent noise averages out over the samples; C10 and C01 vary more, because they are told \
             apart only weakly, and end on their bounds",
            forces.len()
        );
        let claim = Some(f64::from(percent));
        for (place, name) in names.iter().enumerate() {
            let values: Vec<f64> = found.iter().map(|values| values[place]).collect();
            let value = Value::beside(claim, 100.0 * spread(&values) / truth[place], "%");
            let row = format!("{case}/noise_{percent}_percent/{name}");
            rows.add(&row, value, note.clone());
        }
        if truth.len() > 1 {
            let sums: Vec<f64> = found.iter().map(|values| values.iter().sum()).collect();
            let whole: f64 = truth.iter().sum();
            let value = Value::beside(claim, 100.0 * spread(&sums) / whole, "%");
            let row = format!("{case}/noise_{percent}_percent/sum");
            rows.add(&row, value, note);
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
