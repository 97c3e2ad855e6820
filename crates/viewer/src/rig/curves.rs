use palpate_files::protocol::Stimulus;
use palpate_files::recording::RecordingRow;

/// Points that a curve is drawn with.
const POINTS: usize = 600;

/// Of a relaxation, points for a factor of ten in time.
const PER_DECADE: f64 = 16.0;

/// The first time after the ramp of which a force is shown [s].
const EARLIEST: f64 = 0.01;

/// A step of the encoder, and a little [m].
const ENCODED: f64 = 0.04e-3;

/// Force [mN] over depth [mm] of a recording.
pub(super) fn force_over_depth(rows: &[RecordingRow]) -> Vec<[f64; 2]> {
    let stretch = rows.len().div_ceil(POINTS).max(1);
    rows.chunks(stretch)
        .map(|part| {
            [
                1e3 * mean(part, |row| row.depth_m),
                1e3 * mean(part, |row| row.force_n),
            ]
        })
        .collect()
}

/// Force relative to that at the end of the ramp [-], over the logarithm of the time since [s]; nothing for a
/// stimulus without a hold.
pub(super) fn relaxation(rows: &[RecordingRow], stimulus: &Stimulus) -> Vec<[f64; 2]> {
    let Stimulus::RampAndHold { depth_m, .. } = *stimulus else {
        return Vec::new();
    };
    let Some(hold_start) = rows.iter().position(|row| row.depth_m > depth_m - ENCODED) else {
        return Vec::new();
    };
    let rows = &rows[hold_start..];
    let began = rows[0].time_s;
    let largest = rows.iter().take_while(|row| row.time_s < began + EARLIEST);
    let largest = largest.fold(0.0_f64, |most, row| most.max(row.force_n));
    if largest <= 0.0 {
        return Vec::new();
    }
    let mut points = Vec::new();
    let mut rest = rows;
    let mut bin = (EARLIEST.log10() * PER_DECADE).round();
    while !rest.is_empty() {
        let until = began + 10.0_f64.powf((bin + 1.0) / PER_DECADE);
        let end = rest.partition_point(|row| row.time_s < until);
        let (part, later) = rest.split_at(end);
        if !part.is_empty() {
            let place = (bin + 0.5) / PER_DECADE;
            points.push([place, mean(part, |row| row.force_n) / largest]);
        }
        rest = later;
        bin += 1.0;
    }
    points
}

fn mean(rows: &[RecordingRow], column: impl Fn(&RecordingRow) -> f64) -> f64 {
    rows.iter().map(column).sum::<f64>() / rows.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force that falls by a tenth for each factor of ten in time is a straight line. What a bin of a sixteenth
    /// of a decade averages over is less than a hundredth.
    #[test]
    fn a_relaxation_is_drawn_over_the_logarithm_of_time() {
        let stimulus = Stimulus::RampAndHold {
            depth_m: 4e-3,
            ramp_s: 0.5,
            hold_s: 10.0,
        };
        let row = |tick: u32| {
            let time = 1e-3 * f64::from(tick);
            let since = (time - 1.0).max(EARLIEST);
            let depth = if time < 1.0 { 0.0 } else { 4e-3 };
            RecordingRow::from([time, depth, 0.1 * (0.8 - 0.1 * since.log10())])
        };
        let rows: Vec<RecordingRow> = (0..11_000).map(row).collect();
        let points = relaxation(&rows, &stimulus);
        assert!(points.len() > 40);
        for [log, part] in &points {
            assert!((part - (0.8 - 0.1 * log)).abs() < 0.01, "{log} {part}");
        }
        let drawn = force_over_depth(&rows);
        assert!(drawn.len() <= POINTS && (drawn.last().unwrap()[0] - 4.0).abs() < 1e-9);
    }
}
