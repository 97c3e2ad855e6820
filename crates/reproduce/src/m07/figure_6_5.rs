use palpate_jobs::plot::{Series, Style};

use super::springs::{DEPTHS_MM, ORGANS, forces, printed};
use crate::Error;
use crate::m06::Printed;
use crate::published::prony;
use crate::row::Rows;
use crate::virtual_rig::ramp_and_hold;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for organ in ORGANS {
        let values = printed(organ)?;
        let mut series = Vec::new();
        let mut measured = Vec::new();
        let own = Printed::all(organ);
        let depths = own.iter().filter(|row| DEPTHS_MM.contains(&row.depth_mm));
        for (color, row) in depths.enumerate() {
            let course = ramp_and_hold(row.depth());
            let forces = forces(values, &course)?;
            let last = course.times.len() - 1;
            rows.add(&format!("{organ}/{}_mm", row.depth_mm), forces[last]);
            if (organ, row.depth_mm) == ("liver", 6) {
                let left = prony(organ, row.depth_mm)?.relaxation(f64::INFINITY);
                let peak = forces.iter().copied().fold(0.0, f64::max);
                rows.row("liver/6_mm/peak_over_steady")
                    .published(1.0 / left)
                    .is(peak / forces[last]);
            }
            measured.push((course.times[last], 1e3 * row.mean));
            let each = course.times.iter().zip(&forces);
            let points = each.map(|(t, f)| (*t, 1e3 * f)).collect();
            let name = format!("{} mm", row.depth_mm);
            series.push(Series::new(name, points, Style::Line, color));
        }
        let means = Series::new("means of table 5-1", measured, Style::Dots, 5);
        series.push(means);
        rows.figure(organ).draw(series)?;
    }
    Ok(())
}
