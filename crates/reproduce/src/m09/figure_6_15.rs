use palpate_mechanics::{IndentationCurve, PronySeries};

use super::indented::at_finite_strain;
use super::organ::printed;
use crate::Error;
use crate::m06::Printed;
use crate::row::Value;
use crate::virtual_rig::{END, ramp_and_hold};
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_6_15: Item = Item {
    name: "figure-6-15",
    title: "the probe on the esophagus as a tube; takes minutes",
    seconds: 52.0,
    run,
};

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let organ = printed()?;
    let outer_mm = 1e3 * organ.tube.outer_radius;
    let (measured, too_deep): (Vec<Printed>, Vec<Printed>) = Printed::all("esophagus")
        .into_iter()
        .partition(|row| f64::from(row.depth_mm) < outer_mm);
    let tube = at_finite_strain(rows)?;
    let (curve, error) = (&tube.unit, tube.error);
    let series = organ.series()?;
    let note = format!(
        "tube of 60 mm with radii of 5 and 7.5 mm, of which the source gives only the length and about 15 mm of diameter; held ends, \
         bonded punch without a side, neo-Hookean, without its 30 mmHg, which such a tube does not bear (section-6-4-5/limit_pressure); \
         relative error {error:.3}"
    );
    for row in &measured {
        let elastic = 1e3 * organ.modulus_kpa * curve.force(1e-3 * f64::from(row.depth_mm));
        let own = series.relaxation(f64::INFINITY) * elastic;
        let name = format!("{}_mm", row.depth_mm);
        let remark = format!(
            "published: mean of table 5-1; ours: steady force with the printed modulus as instantaneous; {note}"
        );
        rows.add(&name, Value::beside(Some(row.mean), own, "N"), remark);
    }
    for row in too_deep {
        let value = Value {
            published: Some(row.mean),
            ours: None,
            unit: "N",
        };
        let reason = format!(
            "deeper than the outer radius of {outer_mm} mm, where the walls have met: this model has no contact of a wall with itself, and \
             `palpate solve` refuses it"
        );
        rows.add(&format!("{}_mm", row.depth_mm), value, reason);
    }
    let modulus = nearest_modulus(curve, &measured);
    let remark = format!(
        "published as found with the tube; ours: the tube whose steady forces come nearest to the means of table 5-1 down to 6 mm, without relaxation, so \
         that it is a relaxed modulus; a tube gives way as a whole, so its tissue has to be several times stiffer than (6.1) says; {note}"
    );
    let value = Value::beside(Some(organ.modulus_kpa), modulus, "kPa");
    rows.add("tube_modulus", value, remark);
    let plot = drawn(curve, (organ.modulus_kpa, modulus), &series, &measured);
    rows.add_figure(None, &plot, note)
}

/// The relaxed modulus [kPa] with which a tube of this `curve` for 1 Pa comes nearest to the means.
pub(crate) fn nearest_modulus(curve: &IndentationCurve, measured: &[Printed]) -> f64 {
    let (mut products, mut squares) = (0.0, 0.0);
    for row in measured {
        let unit = curve.force(1e-3 * f64::from(row.depth_mm));
        products += unit * row.mean;
        squares += unit * unit;
    }
    1e-3 * products / squares
}

/// Force over time at the last measured depth with both moduli [kPa].
fn drawn(
    curve: &IndentationCurve,
    (printed, own): (f64, f64),
    series: &PronySeries,
    measured: &[Printed],
) -> Plot {
    let last = measured
        .last()
        .map_or((0, 0.0), |row| (row.depth_mm, row.mean));
    let course = ramp_and_hold(1e-3 * f64::from(last.0));
    let line = |modulus_kpa: f64, name: &str, color| {
        let scaled = curve.scaled(1.0, 1e3 * modulus_kpa);
        let forces = scaled.relaxed(series, &course.times, &course.depths);
        Series {
            name: name.to_owned(),
            points: course
                .times
                .iter()
                .zip(forces)
                .map(|(t, f)| (*t, 1e3 * f))
                .collect(),
            style: Style::Line,
            color,
        }
    };
    // What is left after relaxation is the modulus that was found.
    let instantaneous = own / series.relaxation(f64::INFINITY);
    Plot {
        title: format!("Force on the esophagus as a tube at {} mm", last.0),
        x_label: "time [s]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series: vec![
            line(printed, "printed modulus", 0),
            line(instantaneous, "modulus found with the tube", 1),
            Series {
                name: "steady mean of table 5-1".to_owned(),
                points: vec![(0.0, 1e3 * last.1), (END, 1e3 * last.1)],
                style: Style::DashedLine,
                color: 5,
            },
        ],
        ..Plot::default()
    }
}
