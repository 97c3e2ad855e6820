//! Forces on tissue.

use palpate_files::SessionRow;
use palpate_geometry::Vec3;

/// The forces on one tool.
#[derive(Debug, Clone)]
pub(super) struct Forces {
    limit: Option<f64>,
    /// Time [s] and force [N] of the last row, and whether it was in contact.
    last: Option<(f64, f64, bool)>,
    touched: f64,
    force_time: f64,
    peak: f64,
    grip_peak: f64,
    above: f64,
    excess: f64,
}

/// Force measures of a tool.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ForceScore {
    /// Contact time [s].
    pub contact_time: f64,
    /// The largest force [N].
    pub peak: f64,
    /// The mean force in contact [N]; none without contact.
    pub mean: Option<f64>,
    /// ∫ F dt [N s].
    pub force_time: f64,
    /// The largest force of its jaws [N].
    pub grip_peak: f64,
    /// Time above the force limit [s]; none without a limit.
    pub time_above_limit: Option<f64>,
    /// Tissue damage: ∫ max(0, F − limit) dt [N s]; none without a limit.
    pub damage: Option<f64>,
}

impl Forces {
    pub(super) fn new(limit: Option<f64>) -> Self {
        Self {
            limit,
            last: None,
            touched: 0.0,
            force_time: 0.0,
            peak: 0.0,
            grip_peak: 0.0,
            above: 0.0,
            excess: 0.0,
        }
    }

    /// Adds a row; returns whether the force rises above its limit with it.
    pub(super) fn add(&mut self, row: &SessionRow) -> bool {
        let force = Vec3::from(row.force_n).norm();
        self.peak = self.peak.max(force);
        self.grip_peak = self.grip_peak.max(row.grip_force_n);
        let limit = self.limit.unwrap_or(f64::INFINITY);
        let mut rises = force > limit;
        if let Some((time, before, touched)) = self.last {
            let elapsed = row.time_s - time;
            rises &= before <= limit;
            if touched || row.contact {
                self.force_time += 0.5 * elapsed * (before + force);
                self.touched += elapsed;
            }
            if let Some(limit) = self.limit {
                let (above, excess) = beyond(before - limit, force - limit);
                self.above += elapsed * above;
                self.excess += elapsed * excess;
            }
        }
        self.last = Some((row.time_s, force, row.contact));
        rises
    }

    pub(super) fn score(&self) -> ForceScore {
        ForceScore {
            contact_time: self.touched,
            peak: self.peak,
            mean: (self.touched > 0.0).then(|| self.force_time / self.touched),
            force_time: self.force_time,
            grip_peak: self.grip_peak,
            time_above_limit: self.limit.map(|_| self.above),
            damage: self.limit.map(|_| self.excess),
        }
    }
}

/// For a line from `start` to `end` over a unit of time: the part of the time above zero, and the area there.
fn beyond(start: f64, end: f64) -> (f64, f64) {
    match (start > 0.0, end > 0.0) {
        (true, true) => (1.0, 0.5 * (start + end)),
        (false, false) => (0.0, 0.0),
        _ => {
            let (high, low) = (start.max(end), start.min(end));
            let part = high / (high - low);
            (part, 0.5 * part * high)
        }
    }
}
