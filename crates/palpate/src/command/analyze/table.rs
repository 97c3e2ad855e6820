use std::fmt::Write;

use palpate_characterize::Analysis;
use palpate_files::printable;
use palpate_jobs::ReadRecording;
use palpate_jobs::analyze::Analyzed;

/// The analysis for people: forces in millinewtons, depths in millimetres.
pub(super) fn of(analyzed: &Analyzed) -> String {
    let mut text = String::new();
    for (read, found) in &analyzed.recordings {
        // Writing to a string does not fail.
        let _ = of_file(&mut text, read, found);
    }
    if analyzed.recordings.len() < 2 {
        return text;
    }
    for (group, response) in analyzed.organs() {
        let name = response.organ.as_deref();
        let name = name.unwrap_or("recordings without an organ");
        let _ = writeln!(text, "{}, all recordings", printable(name));
        for row in group.iter().flat_map(|group| &group.rows) {
            let _ = of_row(&mut text, row.depth_m, row.mean_n);
            if row.n > 1 {
                let (least, most) = (1e3 * row.min_n, 1e3 * row.max_n);
                let _ = write!(text, " ({least:.2} to {most:.2}, {} holds)", row.n);
            }
            text.push('\n');
        }
    }
    text
}

fn of_file(text: &mut String, read: &ReadRecording, found: &Analysis) -> std::fmt::Result {
    writeln!(text, "{}", printable(&read.path.display().to_string()))?;
    for hold in &found.holds {
        of_row(text, hold.depth_m, hold.steady_n)?;
        writeln!(text)?;
    }
    if let Some(found) = &found.relaxation {
        let (peak, steady) = (1e3 * found.peak_n, 1e3 * found.steady_n);
        writeln!(
            text,
            "  relaxation  {peak:.2} mN to {steady:.2} mN ({:.0} %), within a tenth after {:.1} s",
            100.0 * found.ratio,
            found.settle_s
        )?;
    }
    if let Some(found) = &read.lateral_load {
        writeln!(
            text,
            "  all axes    {:.2} mN along the approach, {:.2} mN sideways ({:.1} %), {:.3} mN m at the sensor",
            1e3 * found.force_n,
            1e3 * found.lateral_n,
            100.0 * found.part,
            1e3 * found.torque_n_m
        )?;
    }
    if let Some(found) = found.longest_sine() {
        writeln!(
            text,
            "  sine        {:.2} Hz: {:.2} N/m, phase {:.1}°, {:.2e} J lost in a cycle",
            found.frequency_hz,
            found.stiffness_n_per_m,
            found.phase_rad.to_degrees(),
            found.hysteresis_j
        )?;
    }
    Ok(())
}

/// A steady force [N] at a depth [m].
fn of_row(text: &mut String, depth: f64, force: f64) -> std::fmt::Result {
    let (depth, force) = (1e3 * depth, 1e3 * force);
    write!(text, "  steady      {depth:.2} mm: {force:.2} mN")
}
