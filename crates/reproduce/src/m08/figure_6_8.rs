use palpate_jobs::plot::{Series, Style};

use super::block::{DEPTHS_MM, Published, published};
use crate::Error;
use crate::m06::Printed;
use crate::row::Rows;

/// How the printed C10 may be meant: the force of the printed law relaxes by the Prony series of table 6-3, or the
/// printed law is what is left after relaxation.
const READINGS: [(&str, Style); 2] = [
    ("instantaneous", Style::Line),
    ("long_term", Style::DashedLine),
];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let sets = published(rows)?;
    for set in sets {
        let parameters: Vec<_> = set.parameters.iter().map(|p| format!("{p} Pa")).collect();
        for (reading, _) in READINGS {
            for depth in DEPTHS_MM {
                rows.row(&format!("{}/{}/{reading}/{depth}_mm", set.organ, set.law))
                    .with("parameters", parameters.join(" and "))
                    .with("error", format!("{:.3}", set.error))
                    .with("relaxed", format!("{:.3}", set.relaxed))
                    .is(steady(set, reading, f64::from(depth)));
            }
        }
    }
    for organ in ["kidney", "liver"] {
        rows.figure(organ).draw(curves(organ, sets))?;
    }
    Ok(())
}

/// Steady force [N] at `depth` [mm].
fn steady(set: &Published, reading: &str, depth: f64) -> f64 {
    let left = if reading == "instantaneous" {
        set.relaxed
    } else {
        1.0
    };
    left * set.curve.force(1e-3 * depth)
}

fn curves(organ: &str, sets: &[Published]) -> Vec<Series> {
    let mut series = Vec::new();
    let own = sets.iter().filter(|set| set.organ == organ);
    for (color, set) in own.enumerate() {
        for (reading, style) in READINGS {
            let points = (0..=80).map(|i| 0.1 * f64::from(i));
            let points = points.map(|depth| (depth, 1e3 * steady(set, reading, depth)));
            let [law, reading] = [set.law.replace('_', "-"), reading.replace('_', " ")];
            let name = format!("{law}, {reading}");
            series.push(Series::new(name, points.collect(), style, color));
        }
    }
    series.push(measured(organ, 3));
    series
}

/// The measured means.
pub(super) fn measured(organ: &str, color: usize) -> Series {
    let printed = Printed::all(organ);
    let points = printed.iter().map(Printed::drawn);
    let name = "measured mean (table 5-1)";
    Series::new(name, points.collect(), Style::Dots, color)
}
