use palpate_characterize::lumped::{ColumnFit, Contact, column_force, fit_column};

use crate::Error;
use crate::m06::Printed;
use crate::row::Value;
use crate::virtual_rig::RADIUS;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_3: Item = Item {
    name: "figure-6-3",
    title: "Blatz's law on the static responses of liver and esophagus",
    seconds: 0.23,
    run,
};

const ORGANS: [&str; 2] = ["liver", "esophagus"];

const NOTE: &str = "(6.2) fitted to the means of table 5-1, on a column with the probe's face, four times as long as the largest \
    depth; the source prints neither parameters nor the area and length that it used, and its parameters would go with them";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = Vec::new();
    for (color, organ) in ORGANS.into_iter().enumerate() {
        let printed = Printed::all(organ);
        let depths: Vec<f64> = printed
            .iter()
            .map(|row| 1e-3 * f64::from(row.depth_mm))
            .collect();
        let means: Vec<f64> = printed.iter().map(|row| row.mean).collect();
        let found = fit_column(Contact::Flat(RADIUS), &depths, &means)?;
        add(rows, organ, &found);
        series.push(Series {
            name: format!("{organ}, table 5-1"),
            points: depths
                .iter()
                .zip(&means)
                .map(|(d, f)| (1e3 * d, 1e3 * f))
                .collect(),
            style: Style::Dots,
            color,
        });
        let line = (0..=80).filter_map(|i| {
            let depth = 0.1 * f64::from(i);
            let force = column_force(&found.column, 1e-3 * depth).ok()?;
            Some((depth, 1e3 * force))
        });
        series.push(Series {
            name: format!("{organ}, Blatz's law"),
            points: line.collect(),
            style: Style::Line,
            color,
        });
    }
    let plot = Plot {
        title: "Static force and Blatz's law on a column".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    };
    rows.add_figure(None, &plot, "one law through the means of each organ")
}

fn add(rows: &mut Rows<'_>, organ: &str, found: &ColumnFit) {
    let note = match found.doubts.as_slice() {
        [] => NOTE.to_owned(),
        doubts => format!("{NOTE}; {}", doubts.join("; ")),
    };
    let column = &found.column;
    let numbers = [
        ("gamma", column.gamma_pa.value, "Pa"),
        ("alpha", column.alpha.value, "1"),
        ("misfit", found.misfit, "1"),
    ];
    for (word, ours, unit) in numbers {
        rows.add(
            &format!("{organ}/{word}"),
            Value::own(ours, unit),
            note.clone(),
        );
    }
}
