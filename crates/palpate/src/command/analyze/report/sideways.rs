use palpate_characterize::Analysis;
use palpate_jobs::ReadRecording;

use crate::report::{Markup, Table, quantity};

/// Lateral forces and torques of the sensor.
pub(super) fn table(own: &[&(ReadRecording, Analysis)]) -> Markup {
    let mut table = Table::new([
        "recording",
        "force along the approach",
        "force sideways",
        "sideways over along",
        "torque at the sensor [mN m]",
    ]);
    let all = own
        .iter()
        .filter_map(|(read, _)| Some((read, read.lateral_load?)));
    for (read, found) in all {
        table.row(vec![
            Markup::plain("code", read.path.display().to_string()),
            quantity("_n", found.force_n, None).into(),
            quantity("_n", found.lateral_n, None).into(),
            format!("{:.1} %", 100.0 * found.part).into(),
            format!("{:.3}", 1e3 * found.torque_n_m).into(),
        ]);
    }
    match table.is_empty() {
        true => Markup::default(),
        false => Markup::plain("h3", "All axes of the sensor, at the largest force").and(table),
    }
}
