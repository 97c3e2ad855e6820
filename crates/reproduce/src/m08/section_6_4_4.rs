use palpate_characterize::lumped::{Contact, fit_column};

use super::block::{LAWS, ORGANS, printed};
use super::starts::{ALGORITHMS, Algorithm, Model, steps};
use crate::Error;
use crate::m06::Printed;
use crate::published::prony;
use crate::row::Rows;
use crate::virtual_rig::RADIUS;
use palpate_jobs::plot::Series;

/// Starts are up to ten times too small and too large, in so many steps to either side.
const GRID: i32 = 20;

/// A law with the parameters to be found again.
struct Case {
    name: String,
    model: Model,
    truth: Vec<f64>,
}

impl Case {
    /// What it is called in a title.
    fn words(&self) -> String {
        let spelled = [
            ("/", ", "),
            ("neo_hookean", "neo-Hookean"),
            ("mooney_rivlin", "Mooney-Rivlin"),
            ("blatz", "Blatz"),
        ];
        let name = self.name.clone();
        spelled
            .into_iter()
            .fold(name, |name, (key, word)| name.replace(key, word))
    }
}

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for case in cases()? {
        let count = case.truth.len();
        // All parameters off together; of two, each alone too.
        let mut starts: Vec<(&str, Vec<bool>)> = vec![("all", vec![true; count])];
        if count > 1 {
            starts.push(("first", vec![true, false]));
            starts.push(("second", vec![false, true]));
        }
        let mut series = Vec::new();
        for (color, (which, moved)) in starts.into_iter().enumerate() {
            for (place, (algorithm, word)) in ALGORITHMS.into_iter().enumerate() {
                // A color for each start, or where there is but one for each algorithm.
                let color = if count > 1 { color } else { place };
                rows.report_step(format!("{}, {which}, {word}", case.name));
                let arrived = arrived(&case, algorithm, &moved)?;
                add(rows, &format!("{}/{which}/{word}", case.name), &arrived);
                // The truth alone makes no line.
                if arrived.iter().filter(|(_, steps)| steps.is_some()).count() > 1 {
                    series.push(drawn(which, algorithm, word, color, count, &arrived));
                }
            }
        }
        rows.figure(&case.name.replace('/', "-"))
            .with("words", case.words())
            .draw(series)?;
    }
    Ok(())
}

/// The laws of tables 6-4 and 6-5, and that of figure 6-3.
fn cases() -> Result<Vec<Case>, Error> {
    let mut cases = Vec::new();
    for (organ, depth_mm) in ORGANS {
        let depth = 1e-3 * f64::from(depth_mm);
        for (law, word) in LAWS {
            cases.push(Case {
                name: format!("{organ}/{word}"),
                model: Model::indented(law, depth, prony(organ, depth_mm)?),
                truth: printed(law, organ, "final")?,
            });
        }
    }
    let measured = Printed::all("liver");
    let [depths, means] = Printed::columns(&measured);
    let column = fit_column(Contact::Flat(RADIUS), &depths, &means)?.column;
    cases.push(Case {
        name: "liver/blatz".to_owned(),
        truth: vec![column.gamma_pa.value, column.alpha.value],
        model: Model::Column { column, depths },
    });
    Ok(cases)
}

/// For each factor of the start, ascending, the steps to the truth; none where it is not reached.
fn arrived(
    case: &Case,
    algorithm: Algorithm,
    moved: &[bool],
) -> Result<Vec<(f64, Option<usize>)>, Error> {
    let mut all = Vec::new();
    for place in -GRID..=GRID {
        let factor = 10f64.powf(f64::from(place) / f64::from(GRID));
        let start: Vec<f64> = case
            .truth
            .iter()
            .zip(moved)
            .map(|(truth, moved)| if *moved { factor * truth } else { *truth })
            .collect();
        let (way, ended) = case.model.way(algorithm, &case.truth, &start)?;
        all.push((factor, ended.then(|| steps(&way, &case.truth))));
    }
    Ok(all)
}

/// How far too large and too small a start may be before a fit no longer arrives.
fn add(rows: &mut Rows<'_>, name: &str, arrived: &[(f64, Option<usize>)]) {
    let middle = arrived.len() / 2;
    let reached = |(factor, steps): &(f64, Option<usize>)| steps.map(|_| *factor);
    let up = arrived[middle..].iter().map_while(reached);
    let down = arrived[..=middle].iter().rev().map_while(reached);
    rows.add(&format!("{name}/above"), up.fold(1.0, f64::max));
    rows.add(&format!("{name}/below"), 1.0 / down.fold(1.0, f64::min));
}

fn drawn(
    which: &str,
    algorithm: Algorithm,
    word: &str,
    color: usize,
    count: usize,
    arrived: &[(f64, Option<usize>)],
) -> Series {
    let reached = |(factor, steps): &(f64, Option<usize>)| Some((*factor, (*steps)? as f64));
    let word = word.replace('_', " ");
    let name = match (count, which) {
        (1, _) => word,
        (_, "all") => format!("{word}, both off"),
        _ => format!("{word}, {which} off"),
    };
    let points = arrived.iter().filter_map(reached).collect();
    Series::new(name, points, algorithm.style(), color)
}
