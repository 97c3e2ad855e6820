use std::fmt::Write;

use palpate_files::printable;
use palpate_jobs::analyze::{Answer, FileAnswer, StaticAnswer};

/// What was found, for people: forces in millinewtons, depths in millimetres.
pub(super) fn of(answer: &Answer) -> String {
    let mut text = String::new();
    for file in &answer.files {
        // Writing to a string does not fail.
        let _ = of_file(&mut text, file);
    }
    let several = answer.files.len() > 1;
    for organ in answer.organs.iter().filter(|_| several) {
        let name = organ
            .organ
            .as_deref()
            .unwrap_or("recordings without an organ");
        let _ = writeln!(text, "{}, all recordings", printable(name));
        for row in &organ.static_response {
            let _ = of_row(&mut text, row);
        }
    }
    text
}

fn of_file(text: &mut String, file: &FileAnswer) -> std::fmt::Result {
    writeln!(text, "{}", printable(&file.file.display().to_string()))?;
    for row in &file.static_response {
        of_row(text, row)?;
    }
    if let Some(found) = &file.relaxation {
        let (peak, steady) = (1e3 * found.peak_n, 1e3 * found.steady_n);
        writeln!(
            text,
            "  relaxation  {peak:.2} mN to {steady:.2} mN ({:.0} %), within a tenth after {:.1} s",
            100.0 * found.ratio,
            found.settle_s
        )?;
    }
    if let Some(found) = &file.sideways {
        writeln!(
            text,
            "  all axes    {:.2} mN along the approach, {:.2} mN sideways ({:.1} %), {:.3} mN m at the sensor",
            1e3 * found.force_n,
            1e3 * found.lateral_n,
            100.0 * found.part,
            1e3 * found.torque_n_m
        )?;
    }
    if let Some(found) = &file.sinusoid {
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

fn of_row(text: &mut String, row: &StaticAnswer) -> std::fmt::Result {
    let (depth, mean) = (1e3 * row.depth_m, 1e3 * row.mean_n);
    write!(text, "  steady      {depth:.2} mm: {mean:.2} mN")?;
    if row.n > 1 {
        let (least, most) = (1e3 * row.min_n, 1e3 * row.max_n);
        write!(text, " ({least:.2} to {most:.2}, {} holds)", row.n)?;
    }
    writeln!(text)
}
