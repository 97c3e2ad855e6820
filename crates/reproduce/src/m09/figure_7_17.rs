use palpate_jobs::plot::{Series, Style};

use super::organ::printed;
use crate::Error;
use crate::m06::Printed;
use crate::published::animals;
use crate::row::Rows;
use crate::virtual_rig::RADIUS;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    rows.add("animals", animals("esophagus").len() as f64);
    let modulus = 1e3 * printed()?.modulus_kpa;
    // (6.1) with nu = 0.5.
    let stiffness = modulus / 0.75 * 2.0 * RADIUS;
    let measured = Printed::all("esophagus");
    for row in &measured {
        let force = stiffness * row.depth();
        rows.add(&format!("{}_mm", row.depth_mm), force);
    }
    let of = |number: fn(&Printed) -> f64, all: bool| {
        let own = measured.iter().filter(|row| all || !row.suspect);
        own.map(|row| (f64::from(row.depth_mm), 1e3 * number(row)))
            .collect()
    };
    let line = vec![(0.0, 0.0), (8.0, 8.0 * stiffness)];
    rows.figure("").draw(vec![
        Series::new("least", of(|row| row.min, false), Style::DottedLine, 0),
        Series::new("mean", of(|row| row.mean, true), Style::LineWithDots, 0),
        Series::new("largest", of(|row| row.max, false), Style::DashedLine, 0),
        Series::new("(6.1) with 5.22 kPa", line, Style::Line, 1),
    ])
}
