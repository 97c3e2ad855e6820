use palpate_characterize::inverse::SoughtLaw;

use super::block::ORGANS;
use super::starts::{ALGORITHMS, Model, steps};
use crate::Error;
use crate::published::{TABLE_6_4, TABLE_6_5, Table, prony};
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series};

pub(crate) const FIGURE_6_9: Item = Item {
    name: "figure-6-9",
    title: "convergence of the neo-Hookean law from the printed start",
    seconds: 0.21,
    run: |rows| run(rows, SoughtLaw::NeoHookean, TABLE_6_4, &ORGANS, &["c10"]),
};

pub(crate) const FIGURE_6_10: Item = Item {
    name: "figure-6-10",
    title: "convergence of the Mooney-Rivlin law from the printed start",
    seconds: 0.22,
    run: |rows| {
        run(
            rows,
            SoughtLaw::MooneyRivlin,
            TABLE_6_5,
            &ORGANS[1..],
            &["c10", "c01"],
        )
    },
};

/// Steps that the figures show.
const SHOWN: usize = 21;

const NOTE: &str = "steps from the printed start until all parameters stay within 1 % of the printed end, on virtual forces of that \
    end without noise";

fn run(
    rows: &mut Rows<'_>,
    law: SoughtLaw,
    table: Table,
    organs: &[(&str, u32)],
    names: &[&str],
) -> Result<(), Error> {
    let mut series = Vec::new();
    for (place, &(organ, depth_mm)) in organs.iter().enumerate() {
        let printed = |when: &str| -> Vec<f64> {
            let cells = names
                .iter()
                .map(|name| table.value(organ, &format!("{when}_{name}_pa")));
            cells.flatten().collect()
        };
        let (start, truth) = (printed("initial"), printed("final"));
        let depth = 1e-3 * f64::from(depth_mm);
        let model = Model::indented(law, depth, prony(organ, depth_mm)?);
        for (algorithm, word) in ALGORITHMS {
            let (way, ended) = model.way(algorithm, &truth, &start)?;
            let value = Value {
                published: table.value(organ, "iterations"),
                ours: ended.then(|| steps(&way, &truth) as f64),
                unit: "1",
            };
            let note = format!("{NOTE}; {}; {}", algorithm.told(), remark(names.len()));
            rows.add(&format!("{organ}/{word}/steps"), value, note);
            for (number, name) in names.iter().enumerate() {
                let each = way.iter().enumerate().take(SHOWN);
                let word = format!(
                    "{organ}, {}, {}",
                    name.to_uppercase(),
                    word.replace('_', " ")
                );
                let points = each.map(|(i, values)| (i as f64, values[number])).collect();
                let color = 2 * place + number;
                series.push(Series::new(word, points, algorithm.style(), color));
            }
        }
    }
    let plot = Plot {
        title: format!("Parameters of the {} law", law_name(law)),
        x_label: "step [-]".to_owned(),
        y_label: "parameter [Pa]".to_owned(),
        series,
        ..Plot::default()
    };
    let note = "from the initial to the final parameters of the source's table, own fit and (6.16)";
    rows.add_figure(None, &plot, note)
}

fn law_name(law: SoughtLaw) -> &'static str {
    match law {
        SoughtLaw::NeoHookean => "neo-Hookean",
        SoughtLaw::MooneyRivlin => "Mooney-Rivlin",
        SoughtLaw::Exponential => "exponential",
    }
}

fn remark(parameters: usize) -> &'static str {
    match parameters {
        1 => "force is proportional to C10, so one step without damping arrives from anywhere",
        _ => {
            "C10 and C01 do nearly the same to the force, and along their difference a step is as long as the damping lets it be"
        }
    }
}
