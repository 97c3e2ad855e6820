//! The quality of a touch: measurements of a loop about itself.

use crate::{Disabled, Fault, Histogram, Interventions, Percentiles, Priority, Sample, Vec3};

/// Measurements of a servo loop. Lateness and work are meaningless on a virtual clock.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct LoopReport {
    /// The priority that the operating system gave its thread.
    pub priority: Priority,
    /// Ticks per second [Hz].
    #[serde(rename = "rate_hz")]
    pub rate: f64,
    /// Number of ticks.
    pub ticks: u64,
    /// Missed ticks, because the one before took longer than its period.
    pub missed: u64,
    /// Lateness at the start of ticks [s].
    #[serde(rename = "lateness_s")]
    pub lateness: Percentiles,
    /// Duration of ticks [s].
    #[serde(rename = "work_s")]
    pub work: Percentiles,
    /// Age of the model's answers when they were used [s]; zeros without a model.
    #[serde(rename = "age_s")]
    pub age: Percentiles,
    /// Work that the device did on the hand [J]; positive over a whole contact means that the loop
    /// generated energy, which no tissue does.
    #[serde(rename = "energy_j")]
    pub energy: f64,
    /// Largest force sent [N].
    #[serde(rename = "peak_force_n")]
    pub peak_force: f64,
    /// Faults.
    pub faults: u64,
    /// Why forces are off, if they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<Fault>,
    /// How often each stage changed a force.
    #[serde(rename = "limited_ticks")]
    pub interventions: Interventions,
    /// How long the loop has run [s].
    #[serde(skip)]
    pub elapsed: f64,
    /// The device's last answer to disabling its forces; none before.
    #[serde(skip)]
    pub disabled: Option<Disabled>,
}

/// The measurements of a running loop.
#[derive(Debug, Clone, Default)]
pub(crate) struct Meter {
    lateness: Histogram,
    work: Histogram,
    age: Histogram,
    energy: f64,
    peak_force: f64,
    missed: u64,
    began: Option<f64>,
    last: Option<(f64, Vec3, Vec3)>,
}

impl Meter {
    pub(crate) fn tick(&mut self, sample: &Sample, lateness: f64) {
        self.began.get_or_insert(sample.state.time);
        self.lateness.add(lateness);
        if let Some(age) = sample.age.filter(|age| age.is_finite()) {
            self.age.add(age);
        }
        let position = sample.state.position;
        if let Some((_, from, held)) = self.last {
            let work = held.dot(&(position - from));
            // An absent device has no position.
            self.energy += if work.is_finite() { work } else { 0.0 };
        }
        self.last = Some((sample.state.time, position, sample.applied));
        self.peak_force = self.peak_force.max(sample.output.norm());
    }

    pub(crate) fn record_tick(&mut self, work: f64, missed: u64) {
        self.work.add(work);
        self.missed += missed;
    }

    pub(crate) fn report(&self) -> LoopReport {
        let ticks = self.lateness.count();
        let ends = self.began.zip(self.last.map(|(time, ..)| time));
        let elapsed = ends.map_or(0.0, |(began, last)| last - began);
        LoopReport {
            ticks,
            missed: self.missed,
            elapsed,
            rate: if elapsed > 0.0 {
                (ticks - 1) as f64 / elapsed
            } else {
                0.0
            },
            lateness: self.lateness.percentiles(),
            work: self.work.percentiles(),
            age: self.age.percentiles(),
            energy: self.energy,
            peak_force: self.peak_force,
            ..LoopReport::default()
        }
    }
}
