use super::swing::{NOTE, ORGANS, Organ};
use crate::Error;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_5_16: Item = Item {
    name: "figure-5-16",
    title: "stiffness of the organs over frequency",
    seconds: 7.9,
    run,
};

/// Of the source [Hz].
const FREQUENCIES: [f64; 6] = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0];

const RISE_NOTE: &str = "stiffness at 5 Hz over that at 0.5 Hz; the source's kidney falls over these frequencies, which no \
    relaxation does: a Prony series with positive terms, such as its own in table 6-3, only rises";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = Vec::new();
    for (color, name) in ORGANS.into_iter().enumerate() {
        let Some(organ) = Organ::printed(name)? else {
            rows.add_missing(name, "N/m", "no law is printed");
            continue;
        };
        let mut points = Vec::new();
        for frequency in FREQUENCIES {
            let row = format!("{name}/{frequency}_hz");
            match organ.swung(frequency)?.1 {
                Some(found) => {
                    points.push((frequency, found.stiffness_n_per_m));
                    let value = Value::own(found.stiffness_n_per_m, "N/m");
                    rows.add(&row, value, NOTE);
                }
                None => rows.add_missing(&row, "N/m", "no swing is seen in the recording"),
            }
        }
        if let [first, .., last] = points.as_slice() {
            let rise = Value::own(last.1 / first.1, "1");
            rows.add(&format!("{name}/rise"), rise, RISE_NOTE);
        }
        series.push(Series {
            name: name.to_owned(),
            points,
            style: Style::LineWithDots,
            color,
        });
    }
    let plot = Plot {
        title: "Stiffness of the organs under a swing of 2 mm about 2 mm".to_owned(),
        x_label: "frequency [Hz]".to_owned(),
        y_label: "stiffness [N/m]".to_owned(),
        series,
        ..Plot::default()
    };
    rows.add_figure(None, &plot, RISE_NOTE)
}
