use super::organ::printed;
use crate::Error;
use crate::m06::Printed;
use crate::published::APPENDIX_A;
use crate::row::Value;
use crate::virtual_rig::RADIUS;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_7_17: Item = Item {
    name: "figure-7-17",
    title: "static response of the lower esophagus and the simulator's modulus",
    seconds: 0.23,
    run,
};

/// Animals that the caption names.
const ANIMALS: f64 = 8.0;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let animals = Value {
        published: Some(ANIMALS),
        ours: APPENDIX_A.sum("esophagus"),
        unit: "1",
    };
    let note = "published: the figure's caption; ours: animals with this organ in appendix A";
    rows.add("animals", animals, note);
    let modulus = 1e3 * printed()?.modulus_kpa;
    // (6.1) with nu = 0.5.
    let stiffness = modulus / 0.75 * 2.0 * RADIUS;
    let measured = Printed::all("esophagus");
    for row in &measured {
        let value = Value::beside(
            Some(row.mean),
            stiffness * 1e-3 * f64::from(row.depth_mm),
            "N",
        );
        let note = "published: mean of table 5-1, for the figure's medians are not printed; ours: (6.1) with the simulator's 5.22 kPa, \
                    which is this mean at 8 mm and nowhere else: a line through a curve";
        rows.add(&format!("{}_mm", row.depth_mm), value, note);
    }
    let of = |number: fn(&Printed) -> f64, all: bool| {
        let own = measured.iter().filter(|row| all || !row.suspect);
        own.map(|row| (f64::from(row.depth_mm), 1e3 * number(row)))
            .collect()
    };
    let line = vec![(0.0, 0.0), (8.0, 8.0 * stiffness)];
    let plot = Plot {
        title: "Static force of the lower esophagus".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series: vec![
            Series::new("least", of(|row| row.min, false), Style::DottedLine, 0),
            Series::new("mean", of(|row| row.mean, true), Style::LineWithDots, 0),
            Series::new("largest", of(|row| row.max, false), Style::DashedLine, 0),
            Series::new("(6.1) with 5.22 kPa", line, Style::Line, 1),
        ],
        ..Plot::default()
    };
    let note = "table 5-1, without the bounds at 5 mm, of which the largest is a misprint";
    rows.add_figure(None, &plot, note)
}
