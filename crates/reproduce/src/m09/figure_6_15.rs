use palpate_mechanics::{IndentationCurve, PronySeries};

use super::indented::at_finite_strain;
use super::organ::printed;
use crate::Error;
use crate::m06::Printed;
use crate::row::Rows;
use crate::virtual_rig::{END, ramp_and_hold};
use palpate_jobs::plot::{Series, Style};

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let organ = printed()?;
    let outer_mm = 1e3 * organ.tube.outer_radius;
    let (measured, too_deep): (Vec<Printed>, Vec<Printed>) = Printed::all("esophagus")
        .into_iter()
        .partition(|row| f64::from(row.depth_mm) < outer_mm);
    let tube = at_finite_strain(rows)?;
    let (curve, error) = (&tube.unit, tube.error);
    let series = organ.series()?;
    let error = format!("{error:.3}");
    for row in &measured {
        let elastic = 1e3 * organ.modulus_kpa * curve.force(row.depth());
        rows.row(&format!("{}_mm", row.depth_mm))
            .with("how", "pressed")
            .with("error", &error)
            .is(series.relaxation(f64::INFINITY) * elastic);
    }
    for row in too_deep {
        rows.row(&format!("{}_mm", row.depth_mm))
            .with("how", "too_deep")
            .with("outer", outer_mm)
            .is(None::<f64>);
    }
    let modulus = nearest_modulus(curve, &measured);
    let row = rows.row("tube_modulus").with("error", &error);
    row.is(modulus);
    let Some(last) = measured.last() else {
        return Ok(());
    };
    let drawn = drawn(curve, organ.modulus_kpa, modulus, &series, last);
    rows.figure("")
        .with("depth", last.depth_mm)
        .with("error", &error)
        .draw(drawn)
}

/// The relaxed modulus [kPa] with which a tube of this `curve` for 1 Pa comes nearest to the means.
pub(crate) fn nearest_modulus(curve: &IndentationCurve, measured: &[Printed]) -> f64 {
    let (mut products, mut squares) = (0.0, 0.0);
    for row in measured {
        let unit = curve.force(row.depth());
        products += unit * row.mean;
        squares += unit * unit;
    }
    1e-3 * products / squares
}

/// Force over time at the `last` depth with both moduli [kPa].
fn drawn(
    curve: &IndentationCurve,
    printed: f64,
    own: f64,
    series: &PronySeries,
    last: &Printed,
) -> Vec<Series> {
    let course = ramp_and_hold(1e-3 * f64::from(last.depth_mm));
    let line = |modulus_kpa: f64, name: &str, color| {
        let scaled = curve.scaled(1.0, 1e3 * modulus_kpa);
        let forces = scaled.relaxed(series, &course.times, &course.depths);
        let each = course.times.iter().zip(forces);
        let points = each.map(|(t, f)| (*t, 1e3 * f)).collect();
        Series::new(name, points, Style::Line, color)
    };
    // What is left after relaxation is the modulus that was found.
    let instantaneous = own / series.relaxation(f64::INFINITY);
    let mean = vec![(0.0, 1e3 * last.mean), (END, 1e3 * last.mean)];
    vec![
        line(printed, "printed modulus", 0),
        line(instantaneous, "modulus found with the tube", 1),
        Series::new("steady mean of table 5-1", mean, Style::DashedLine, 5),
    ]
}
