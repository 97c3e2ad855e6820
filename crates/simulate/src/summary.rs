use std::time::Duration;

use palpate_files::session::Event;
use serde::Serialize;

use crate::nonlinear::Body;
use crate::swings::Swings;
use crate::{Simulation, SimulationState, SimulationWorkspace, TRUSTED_DEPTH};

/// The largest frequency [Hz] that the source could follow, and that of its devices.
const FAST: f64 = 8.0;

/// The summary of a played motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Number of steps.
    pub steps: u64,
    /// Duration of the computation.
    #[serde(rename = "step_times_s")]
    pub step_times: StepTimes,
    /// Number of contacts, over all tools.
    pub contacts: u64,
    /// Largest magnitude of force on a tool [N].
    #[serde(rename = "peak_force_n")]
    pub peak_force: f64,
    /// Largest depth [m].
    #[serde(rename = "largest_depth_m")]
    pub deepest: f64,
    /// The summary of the cuts, if anything can cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cuts: Option<CutSummary>,
    /// The summary of each cavity.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cavities: Vec<CavitySummary>,
    /// Whether it was cancelled.
    pub interrupted: bool,
    /// Warnings, as sentences.
    pub warnings: Vec<String>,
}

/// The summary of the cuts.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct CutSummary {
    /// Cuts with an opening.
    pub count: usize,
    /// Length over the resting surface [m].
    #[serde(rename = "length_m")]
    pub length: f64,
    /// Largest number of triangles between the end of an opening and its blade.
    #[serde(rename = "largest_lag_triangles")]
    pub largest_lag: usize,
    /// Triangles before the first cut.
    pub triangles_before: usize,
    /// Triangles after the last cut.
    pub triangles_after: usize,
    /// How often the innermost layer was opened.
    pub perforations: u64,
    /// Number of pieces that are detached from all that is fixed.
    pub detached_pieces: u32,
    /// The cuts through each layer, from outside; empty for an organ without layers.
    pub layers: Vec<LayerCut>,
}

/// The summary of a cavity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CavitySummary {
    /// Its name in the scene.
    pub name: String,
    /// The pressure in it at the end [Pa].
    #[serde(rename = "pressure_pa")]
    pub pressure: f64,
    /// The lowest after a step [Pa].
    #[serde(rename = "lowest_pressure_pa")]
    pub lowest: f64,
    /// The highest after a step [Pa].
    #[serde(rename = "highest_pressure_pa")]
    pub highest: f64,
    /// Its volume before anything touches the organ [m³].
    #[serde(rename = "volume_at_rest_m3")]
    pub volume_at_rest: f64,
    /// Its volume at the end [m³].
    #[serde(rename = "volume_m3")]
    pub volume: f64,
}

/// The cuts through a layer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LayerCut {
    /// Its name in the scene.
    pub name: String,
    /// Their length over the resting surface [m].
    #[serde(rename = "length_m")]
    pub length: f64,
}

/// Percentiles of the computation times of steps [s].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct StepTimes {
    /// Median [s].
    pub p50: f64,
    /// 99th percentile [s].
    pub p99: f64,
    /// 99.9th percentile [s].
    #[serde(rename = "p99.9")]
    pub p99_9: f64,
    /// Maximum [s].
    pub max: f64,
}

/// Collects a summary while a motion is played.
pub(crate) struct Tally {
    times: Vec<Duration>,
    contacts: u64,
    peak_force: f64,
    deepest: f64,
    /// Of each tool.
    swings: Vec<Swings>,
    pulled: f64,
    shaft_contacts: u64,
    non_finite: u64,
    without_equilibrium: u64,
    off_model: u64,
    perforations: u64,
    /// The lowest and the highest pressure in each cavity [Pa].
    pressures: Vec<[f64; 2]>,
}

impl Tally {
    /// For about this number of steps; it grows beyond a million, since a motion may have any length.
    pub(crate) fn with_capacity(steps: u64) -> Self {
        Self {
            times: Vec::with_capacity(steps.min(1_000_000) as usize),
            contacts: 0,
            peak_force: 0.0,
            deepest: 0.0,
            swings: Vec::new(),
            pulled: 0.0,
            shaft_contacts: 0,
            non_finite: 0,
            without_equilibrium: 0,
            off_model: 0,
            perforations: 0,
            pressures: Vec::new(),
        }
    }

    pub(crate) fn add(&mut self, time: Duration, state: &SimulationState) {
        self.times.push(time);
        let pressures = state.body.iter().flat_map(Body::cavity_pressures);
        for (number, pressure) in pressures.enumerate() {
            if number == self.pressures.len() {
                self.pressures.push([pressure; 2]);
            }
            let [lowest, highest] = &mut self.pressures[number];
            (*lowest, *highest) = (lowest.min(pressure), highest.max(pressure));
        }
        self.swings.resize(state.tools.len(), Swings::default());
        for (swings, tool) in self.swings.iter_mut().zip(&state.tools) {
            swings.add(tool.row.time_s, tool.row.depth_m);
        }
        for tool in state.tools.iter().filter(|tool| tool.pose.is_some()) {
            let counts = |event| u64::from(tool.row.events.contains(event));
            self.contacts += counts(Event::Contact);
            self.shaft_contacts += counts(Event::ShaftContact);
            self.non_finite += counts(Event::NonFiniteForce);
            self.without_equilibrium += counts(Event::NoEquilibrium);
            self.off_model += u64::from(tool.off_model && tool.contact.is_some());
            self.perforations += counts(Event::Perforation);
            self.peak_force = self.peak_force.max(tool.force.norm());
            self.deepest = self.deepest.max(tool.row.depth_m);
            self.pulled = self.pulled.max(tool.pulled());
        }
    }

    pub(crate) fn finish(
        mut self,
        simulation: &Simulation,
        state: &SimulationState,
        workspace: &SimulationWorkspace,
        interrupted: bool,
    ) -> Summary {
        let mut warnings = simulation.warnings().to_vec();
        warnings.extend(workspace.warnings());
        let mut warn = |condition: bool, text: String| {
            if condition {
                warnings.push(text);
            }
        };
        warn(
            self.deepest > TRUSTED_DEPTH,
            format!(
                "the depth reached {:.1} mm; beyond 10 mm no model here has been compared with tissue",
                1e3 * self.deepest
            ),
        );
        let swings = self.swings.iter();
        let fastest = swings.filter_map(|swings| swings.fastest(simulation.step));
        let fastest = fastest.fold(0.0, f64::max);
        warn(
            fastest > FAST,
            format!(
                "the depth swung at {fastest:.0} Hz or more; beyond 8 Hz no measurement stands behind the relaxation, and \
                 inertia is left out"
            ),
        );
        warn(
            self.pulled > TRUSTED_DEPTH,
            format!(
                "held tissue was moved by {:.1} mm; {}beyond 10 mm no model here has been compared with tissue",
                1e3 * self.pulled,
                match simulation.nonlinear {
                    Some(_) => "",
                    None => "it answers as at small strain, and ",
                }
            ),
        );
        warn(
            self.shaft_contacts > 0,
            format!(
                "the shaft of a tool touched the organ {} times{}",
                self.shaft_contacts,
                match simulation.nonlinear {
                    Some(_) => "",
                    None => "; it was not pushed by it",
                }
            ),
        );
        warn(
            self.non_finite > 0,
            format!(
                "{} forces were no finite number and were taken as zero",
                self.non_finite
            ),
        );
        warn(
            self.without_equilibrium > 0,
            format!(
                "{} times no equilibrium of the organ was found, and it was put back to rest: it was pulled or pressed too \
                 far, or too fast",
                self.without_equilibrium
            ),
        );
        warn(
            self.off_model > 0,
            format!(
                "a tool touched where the organ is held or was not prepared, in {} steps; its force \
                 there is not the organ's: see `organ.anchor` and `organ.touchable`",
                self.off_model
            ),
        );
        for text in state.warnings(simulation) {
            warn(true, text);
        }
        warn(
            self.contacts == 0,
            "no tool touched the organ; compare the motion's coordinates with the organ's extent \
             (`palpate mesh info`)"
                .to_owned(),
        );
        Summary {
            cavities: self.cavities(simulation, state),
            steps: self.times.len() as u64,
            step_times: StepTimes::of(&mut self.times),
            contacts: self.contacts,
            peak_force: self.peak_force,
            deepest: self.deepest,
            cuts: state.cuts.as_ref().map(|cuts| CutSummary {
                count: cuts.count(),
                length: cuts.length(),
                largest_lag: cuts.largest_lag(),
                triangles_before: simulation.surface().mesh().triangles().len(),
                triangles_after: cuts.mesh().triangles().len(),
                perforations: self.perforations,
                detached_pieces: cuts.detached_pieces(),
                layers: (1..)
                    .zip(simulation.layer_names())
                    .map(|(layers, name)| LayerCut {
                        name: name.clone(),
                        length: cuts.length_through(layers),
                    })
                    .collect(),
            }),
            interrupted,
            warnings,
        }
    }
}

impl Tally {
    fn cavities(&self, simulation: &Simulation, state: &SimulationState) -> Vec<CavitySummary> {
        let (Some(organ), Some(body)) = (&simulation.nonlinear, &state.body) else {
            return Vec::new();
        };
        let at_rest = Body::at_rest(organ, 0);
        let volumes = at_rest.cavity_volumes().zip(body.cavity_volumes());
        let pressures = body.cavity_pressures().zip(&self.pressures);
        let each = organ.cavities().zip(volumes).zip(pressures);
        let each = each.map(
            |((name, (volume_at_rest, volume)), (pressure, &[lowest, highest]))| CavitySummary {
                name: name.to_owned(),
                pressure,
                lowest,
                highest,
                volume_at_rest,
                volume,
            },
        );
        each.collect()
    }
}

impl StepTimes {
    fn of(times: &mut [Duration]) -> Self {
        if times.is_empty() {
            return Self::default();
        }
        times.sort_unstable();
        let at = |part: f64| {
            let rank = (part * times.len() as f64).ceil() as usize;
            times[rank.clamp(1, times.len()) - 1].as_secs_f64()
        };
        Self {
            p50: at(0.5),
            p99: at(0.99),
            p99_9: at(0.999),
            max: at(1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_times_that_occurred() {
        let mut times: Vec<_> = (1..=1000).map(Duration::from_micros).collect();
        let found = StepTimes::of(&mut times);
        let microseconds = |time: f64| (time * 1e6).round();
        assert_eq!(microseconds(found.p50), 500.0);
        assert_eq!(microseconds(found.p99), 990.0);
        assert_eq!(microseconds(found.p99_9), 999.0);
        assert_eq!(microseconds(found.max), 1000.0);
    }
}
