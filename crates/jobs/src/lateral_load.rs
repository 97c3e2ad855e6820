use palpate_files::Recording;
use palpate_files::recording::SensorAxes;
use serde::Serialize;

/// Lateral force and torque of a six-axis sensor, around the largest force along the approach.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LateralLoad {
    /// Along the approach [N].
    pub force_n: f64,
    /// Perpendicular to the indenter's axis [N].
    pub lateral_n: f64,
    /// `lateral_n` over `force_n` [-].
    pub part: f64,
    /// About the sensor's origin [N m].
    pub torque_n_m: f64,
}

/// Samples of the mean on each side of the largest force, which averages out the sensor's steps.
const AROUND: usize = 10;
/// Samples of the sensor's zero, which a recording of the rig has before first contact.
const BEFORE: usize = 100;
/// Fraction of lateral force above which the approach gets a warning [-]: a bonded punch at 18 degrees.
const LARGE_PART: f64 = 0.1;

impl LateralLoad {
    /// Of a recording; none for a sensor of one axis.
    pub(crate) fn of(recording: &Recording) -> Option<Self> {
        let axes = recording.axes()?;
        let forces = recording.force_n();
        let largest = |(_, a): &(usize, &f64), (_, b): &(usize, &f64)| a.total_cmp(b);
        let (at, _) = forces.iter().enumerate().max_by(largest)?;
        let there = at.saturating_sub(AROUND)..(at + AROUND + 1).min(forces.len());
        let before = 0..BEFORE.min(at.saturating_sub(AROUND));
        let rise = |values: &[f64]| {
            let zero = match before.is_empty() {
                true => 0.0,
                false => mean(&values[before.clone()]),
            };
            mean(&values[there.clone()]) - zero
        };
        let SensorAxes { columns } = axes;
        let [fx, fy, _, tx, ty, tz] = columns.each_ref().map(|values| rise(values));
        let (force_n, lateral_n) = (rise(forces), fx.hypot(fy));
        Some(Self {
            force_n,
            lateral_n,
            part: lateral_n / force_n.abs().max(f64::MIN_POSITIVE),
            torque_n_m: tx.hypot(ty).hypot(tz),
        })
    }

    /// The warning for a large lateral force.
    pub(crate) fn warning(&self) -> Option<String> {
        (self.part > LARGE_PART).then(|| {
            format!(
                "{:.0} % of the force acts sideways; approach along the surface's normal (measure_normal = true in the \
                 protocol), for all models take the indenter for perpendicular",
                100.0 * self.part
            )
        })
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force that rises to 1 N, 0.3 N and 0.4 N of it sideways, over zeros that are somewhere.
    #[test]
    fn lateral_force_excludes_the_zero() {
        let rise: Vec<f64> = (0..400)
            .map(|i| (f64::from(i) - 200.0).clamp(0.0, 100.0) / 100.0)
            .collect();
        let three = |i: usize, r: &f64| format!("{},{},{}", 1e-3 * i as f64, 4e-3 * r, r + 0.2);
        let read = |names: &str, row: &dyn Fn(usize, &f64) -> String| {
            let rows = rise.iter().enumerate().map(|(i, r)| row(i, r) + "\n");
            let text = format!("# format = 1\n{names}\n{}", rows.collect::<String>());
            Recording::parse(&text, "sideways.csv").unwrap()
        };
        let recording = read("time_s,depth_m,force_n", &three);
        assert_eq!(LateralLoad::of(&recording), None);
        let names = format!("time_s,depth_m,force_n,{}", SensorAxes::COLUMNS.join(","));
        let recording = read(&names, &|i, r| {
            let axes = [0.3 * r + 0.1, 0.1 - 0.4 * r, *r, 0.5, 2e-3 * r - 0.1, 0.0];
            format!(
                "{},{}",
                three(i, r),
                axes.map(|axis| axis.to_string()).join(",")
            )
        });
        let found = LateralLoad::of(&recording).unwrap();
        // The last of the largest is at the end, where the mean has half of its samples.
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(
            near(found.force_n, 1.0) && near(found.lateral_n, 0.5) && near(found.torque_n_m, 2e-3),
            "{found:?}"
        );
        assert!(found.warning().unwrap().starts_with("50 %"));
    }
}
