use palpate_servo::{Interventions, LoopReport, Percentiles};
use palpate_simulate::interactive::{ModelReport, Quality};
use palpate_simulate::{Simulation, Tool};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Answer {
    pub(super) palpate: &'static str,
    pub(super) runs: Vec<Run>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
pub(super) struct Run {
    asked_hz: u32,
    tools: Vec<Touch>,
    model: ModelReport,
}

#[derive(Debug, Serialize)]
struct Touch {
    tool: String,
    #[serde(flatten)]
    report: LoopReport,
}

impl Run {
    pub(super) fn new(rate: u32, simulation: &Simulation, quality: &Quality) -> Self {
        let tools = simulation.tools().iter().zip(&quality.loops);
        let touch = |(tool, report): (&Tool, &Option<LoopReport>)| {
            let tool = tool.name.clone();
            report.map(|report| Touch { tool, report })
        };
        Self {
            asked_hz: rate,
            tools: tools.filter_map(touch).collect(),
            model: quality.model,
        }
    }
}

/// The stages that changed a force.
fn words(did: &Interventions) -> String {
    let all = [
        ("dead-man released", did.dead_man_released),
        ("missed deadline", did.deadline_missed),
        ("stale model force faded", did.faded),
        ("passivity damping", did.damped),
        ("workspace walls", did.walls),
        ("saturated", did.saturated),
        ("thermal limit", did.thermally_limited),
        ("rate limit", did.rate_limited),
    ];
    let all = all.into_iter().filter(|(_, count)| *count > 0);
    let words: Vec<_> = all.map(|(name, count)| format!("{name} {count}")).collect();
    if words.is_empty() {
        return "none acted".to_owned();
    }
    format!("{} ticks", words.join(", "))
}

fn microseconds(times: &Percentiles) -> String {
    let [p50, p99, p99_9, max] =
        [times.p50, times.p99, times.p99_9, times.max].map(|time| 1e6 * time);
    format!("p50 {p50:.1}, p99 {p99:.1}, p99.9 {p99_9:.1}, max {max:.1} µs")
}

impl Answer {
    pub(super) fn text(&self) -> String {
        let lines = self.runs.iter().flat_map(Run::lines);
        lines.collect::<Vec<_>>().join("\n")
    }
}

impl Run {
    fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("{} Hz requested", self.asked_hz)];
        for Touch { tool, report } in &self.tools {
            lines.extend([
                format!(
                    "  {}: {:.1} Hz ({} priority), {} of {} ticks missed",
                    tool,
                    report.rate,
                    report.priority.word(),
                    report.missed,
                    report.ticks + report.missed
                ),
                format!("    jitter  {}", microseconds(&report.lateness)),
                format!("    work    {}", microseconds(&report.work)),
                format!("    age     {}", microseconds(&report.age)),
                format!(
                    "    energy  {:.4} mJ delivered to the hand, peak force {:.1} mN",
                    1e3 * report.energy,
                    1e3 * report.peak_force
                ),
                format!(
                    "    limits  {} faults, {}",
                    report.faults,
                    words(&report.interventions)
                ),
            ]);
            lines.extend(
                report
                    .fault
                    .iter()
                    .map(|fault| format!("    fault   {fault}")),
            );
        }
        let model = &self.model;
        lines.extend([
            format!(
                "  model: {:.1} Hz ({} priority), {} of {} steps missed",
                model.rate,
                model.priority.word(),
                model.missed,
                model.steps + model.missed
            ),
            format!("    force   {}", microseconds(&model.touch_times)),
            format!("    step    {}", microseconds(&model.step_times)),
            format!(
                "    extrapolation error  {:.3} mN (rms), {:.3} mN (max), peak force {:.1} mN",
                1e3 * model.extrapolation.rms,
                1e3 * model.extrapolation.max,
                1e3 * model.extrapolation.peak
            ),
        ]);
        lines
    }
}
