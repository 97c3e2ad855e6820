use palpate_jobs::plot::{Series, Style};

use super::swing::{ORGANS, Organ};
use crate::Error;
use crate::row::Rows;

/// Of the source [Hz].
const FREQUENCIES: [f64; 6] = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = Vec::new();
    for (color, name) in ORGANS.into_iter().enumerate() {
        let organ = Organ::printed(name)?;
        let mut points = Vec::new();
        for frequency in FREQUENCIES {
            let row = rows.row(&format!("{name}/{frequency}_hz"));
            match organ.swung(frequency)?.1 {
                Some(found) => {
                    points.push((frequency, found.stiffness_n_per_m));
                    row.is(found.stiffness_n_per_m);
                }
                None => row.missing("no swing is seen in the recording"),
            }
        }
        if let [first, .., last] = points.as_slice() {
            rows.add(&format!("{name}/rise"), last.1 / first.1);
        }
        series.push(Series::new(name, points, Style::LineWithDots, color));
    }
    rows.figure("").draw(series)
}
