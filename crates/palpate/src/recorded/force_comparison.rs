//! Compares the force of a session with the recorded one of the same indentation.

use std::path::PathBuf;

use palpate_files::SessionRow;
use palpate_geometry::Vec3;
use palpate_simulate::Site;
use serde::Serialize;

use crate::plot::{Series, Style, thinned_indices};

/// Difference between simulated and recorded depth without a warning, relative to the largest depth [-].
const SAME_DEPTH: f64 = 0.02;

/// A recording, and the deviation of the session from it so far.
#[derive(Debug)]
pub(crate) struct Comparison {
    file: PathBuf,
    site: Site,
    /// Times [s], depths [m] and forces [N].
    recorded: [Vec<f64>; 3],
    warnings: Vec<String>,
    /// The sample after the last step.
    next: usize,
    steps: usize,
    squares: f64,
    worst: [f64; 2],
    worst_depth: f64,
}

/// Its entry in `summary.json`.
#[derive(Debug, Serialize)]
pub(super) struct ComparisonAnswer {
    #[serde(serialize_with = "palpate_jobs::lossy")]
    recording: PathBuf,
    place_m: [f64; 3],
    /// The largest recorded force, filtered.
    largest_recorded_n: f64,
    /// The largest deviation of the simulated force from the recorded one, with its sign.
    largest_deviation_n: f64,
    largest_deviation_at_s: f64,
    root_mean_square_n: f64,
    /// The largest deviation of the depth.
    largest_depth_deviation_m: f64,
}

impl Comparison {
    /// A comparison with times [s], depths [m] and forces [N] of a recording, at a site, with earlier warnings.
    pub(crate) fn new(
        file: PathBuf,
        recorded: [Vec<f64>; 3],
        site: Site,
        warnings: Vec<String>,
    ) -> Self {
        Self {
            file,
            site,
            recorded,
            warnings,
            next: 0,
            steps: 0,
            squares: 0.0,
            worst: [0.0; 2],
            worst_depth: 0.0,
        }
    }

    /// Adds a step of the tool that repeats it; times increase.
    pub(super) fn add(&mut self, row: &SessionRow) {
        let [_, depth, force] = self.recorded_at(row.time_s);
        if depth <= 0.0 && !row.contact {
            return;
        }
        let off = Vec3::from(row.force_n).dot(&self.site.normal) - force;
        if off.abs() > self.worst[0].abs() {
            self.worst = [off, row.time_s];
        }
        let depth_off = row.depth_m - depth.max(0.0);
        if depth_off.abs() > self.worst_depth.abs() {
            self.worst_depth = depth_off;
        }
        self.steps += 1;
        self.squares += off * off;
    }

    /// Time, depth and force at a time [s], by linear interpolation.
    fn recorded_at(&mut self, time: f64) -> [f64; 3] {
        let times = &self.recorded[0];
        while times.get(self.next).is_some_and(|next| *next <= time) {
            self.next += 1;
        }
        let after = self.next.min(times.len() - 1);
        let before = self.next.saturating_sub(1);
        let step = times[after] - times[before];
        let part = if step > 0.0 {
            (time - times[before]) / step
        } else {
            0.0
        };
        let between = |values: &Vec<f64>| values[before] + part * (values[after] - values[before]);
        [0, 1, 2].map(|column| between(&self.recorded[column]))
    }

    /// Time [s], depth [mm] and force [mN] of the samples that a line needs.
    fn drawn(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let [time, depth, force] = &self.recorded;
        thinned_indices(time, depth, force)
            .into_iter()
            .map(|i| [time[i], 1e3 * depth[i].max(0.0), 1e3 * force[i]])
    }

    /// The recorded force [mN] over the column `over` of time [s] and depth [mm].
    pub(super) fn series(&self, over: usize) -> Series {
        let points = self.drawn().map(|point| (point[over], point[2])).collect();
        Series::new("recorded", points, Style::BroadLine, 0)
    }

    /// The result, and warnings.
    pub(super) fn finish(mut self) -> (ComparisonAnswer, Vec<String>) {
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let [_, depths, forces] = &self.recorded;
        let deepest = largest(depths);
        if self.worst_depth.abs() > SAME_DEPTH * deepest {
            self.warnings.push(format!(
                "the simulated depth is {:.2} mm {} than the recorded one, because the surface curves or the wall is thin \
                 there; choose another place with --at",
                1e3 * self.worst_depth.abs(),
                if self.worst_depth > 0.0 { "greater" } else { "smaller" },
            ));
        }
        let answer = ComparisonAnswer {
            place_m: self.site.point.into(),
            largest_recorded_n: largest(forces),
            largest_deviation_n: self.worst[0],
            largest_deviation_at_s: self.worst[1],
            root_mean_square_n: (self.squares / self.steps.max(1) as f64).sqrt(),
            largest_depth_deviation_m: self.worst_depth,
            recording: self.file,
        };
        (answer, self.warnings)
    }
}

impl ComparisonAnswer {
    /// For a person, on a line of its own.
    pub(super) fn line(&self) -> String {
        let part = |force: f64| 100.0 * force / self.largest_recorded_n;
        let off = self.largest_deviation_n;
        format!(
            "\nbeside {}: {:+.2} mN at most, {:+.1} % of the largest force, at {:.2} s; {:.1} % in the mean",
            self.recording.display(),
            1e3 * off,
            part(off),
            self.largest_deviation_at_s,
            part(self.root_mean_square_n),
        )
    }
}
