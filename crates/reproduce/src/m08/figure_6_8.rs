use super::block::{DEPTHS_MM, Published, published};
use crate::Error;
use crate::published::TABLE_5_1;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_8: Item = Item {
    name: "figure-6-8",
    title: "force on the block with the published laws beside the measured means",
    seconds: 180.0,
    run,
};

/// How the printed C10 may be meant.
#[derive(Clone, Copy)]
enum Reading {
    /// The force of the printed law relaxes by the Prony series of table 6-3.
    Instantaneous,
    /// The printed law is what is left after relaxation.
    LongTerm,
}

const READINGS: [(Reading, &str); 2] = [
    (Reading::Instantaneous, "instantaneous"),
    (Reading::LongTerm, "long_term"),
];

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let sets = published(rows)?;
    for set in sets {
        for (reading, word) in READINGS {
            let note = note(set, word);
            for depth in DEPTHS_MM {
                let name = format!("{}/{}/{word}/{depth}_mm", set.organ, set.law);
                let value = Value {
                    published: measured(set.organ, depth),
                    ours: Some(steady(set, reading, depth)),
                    unit: "N",
                };
                rows.add(&name, value, note.clone());
            }
        }
    }
    for organ in ["kidney", "liver"] {
        let note = "neither reading of the printed parameters has the measured shape: forces grow \
                    with the depth to the power 1.3 to 1.5, the laws' to 1.1 to 1.2";
        rows.add_figure(Some(organ), &plot(organ, sets), note)?;
    }
    Ok(())
}

fn note(set: &Published, word: &str) -> String {
    let parameters: Vec<_> = set.parameters.iter().map(|p| format!("{p} Pa")).collect();
    format!(
        "published: mean of table 5-1; ours: {} read as {word}, bonded face, side sticks, relative \
         error {:.3}; relaxed to {:.3} by table 6-3; ramp and friction are not given by the source",
        parameters.join(" and "),
        set.error,
        set.relaxed,
    )
}

/// Steady force [N] at `depth` [mm].
fn steady(set: &Published, reading: Reading, depth: u32) -> f64 {
    let elastic = set.curve.force(1e-3 * f64::from(depth));
    match reading {
        Reading::Instantaneous => set.relaxed * elastic,
        Reading::LongTerm => elastic,
    }
}

/// Mean of table 5-1 [N].
pub(super) fn measured(organ: &str, depth: u32) -> Option<f64> {
    TABLE_5_1.value_of([organ, &depth.to_string()], "mean_n")
}

fn plot(organ: &str, sets: &[Published]) -> Plot {
    let line = |set: &Published, reading: Reading| {
        let points = (0..=80).map(|i| {
            let depth = 0.1 * f64::from(i);
            let elastic = set.curve.force(1e-3 * depth);
            let part = match reading {
                Reading::Instantaneous => set.relaxed,
                Reading::LongTerm => 1.0,
            };
            (depth, 1e3 * part * elastic)
        });
        points.collect()
    };
    let mut series = Vec::new();
    let own = sets.iter().filter(|set| set.organ == organ);
    for (color, set) in own.enumerate() {
        for (reading, word) in READINGS {
            series.push(Series {
                name: format!("{}, {}", set.law.replace('_', "-"), word.replace('_', " ")),
                points: line(set, reading),
                style: match reading {
                    Reading::Instantaneous => Style::Line,
                    Reading::LongTerm => Style::DashedLine,
                },
                color,
            });
        }
    }
    series.push(measured_series(organ, 3));
    Plot {
        title: format!("Steady force on the pig's {organ}, published laws and measured means"),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    }
}

/// The measured means.
pub(super) fn measured_series(organ: &str, color: usize) -> Series {
    let points = DEPTHS_MM.iter().filter_map(|&depth| {
        let force = measured(organ, depth)?;
        Some((f64::from(depth), 1e3 * force))
    });
    Series {
        name: "measured mean (table 5-1)".to_owned(),
        points: points.collect(),
        style: Style::Dots,
        color,
    }
}
