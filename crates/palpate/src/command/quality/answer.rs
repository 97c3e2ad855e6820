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
    model: Model,
}

#[derive(Debug, Serialize)]
struct Touch {
    tool: String,
    priority: &'static str,
    rate_hz: f64,
    ticks: u64,
    missed: u64,
    lateness_s: Times,
    work_s: Times,
    age_s: Times,
    energy_j: f64,
    peak_force_n: f64,
    faults: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
    limited_ticks: Limited,
}

/// Ticks in which a stage of the limits changed a force; and how often a hand let go.
#[derive(Debug, Serialize)]
struct Limited {
    let_go: u64,
    late: u64,
    faded: u64,
    damped: u64,
    walls: u64,
    shortened: u64,
    cooled: u64,
    slowed: u64,
}

#[derive(Debug, Serialize)]
struct Model {
    priority: &'static str,
    rate_hz: f64,
    steps: u64,
    missed: u64,
    touch_s: Times,
    step_s: Times,
    extrapolation_rms_n: f64,
    extrapolation_max_n: f64,
    extrapolation_peak_n: f64,
}

#[derive(Debug, Serialize)]
struct Times {
    p50: f64,
    p99: f64,
    p99_9: f64,
    max: f64,
}

impl Run {
    pub(super) fn new(rate: u32, simulation: &Simulation, quality: &Quality) -> Self {
        let tools = simulation.tools().iter().zip(&quality.loops);
        let touch = |(tool, report): (&Tool, &Option<LoopReport>)| {
            report.as_ref().map(|report| Touch::new(&tool.name, report))
        };
        Self {
            asked_hz: rate,
            tools: tools.filter_map(touch).collect(),
            model: Model::new(&quality.model),
        }
    }
}

impl Touch {
    fn new(tool: &str, report: &LoopReport) -> Self {
        Self {
            tool: tool.to_owned(),
            priority: report.priority.word(),
            rate_hz: report.rate,
            ticks: report.ticks,
            missed: report.missed,
            lateness_s: report.lateness.into(),
            work_s: report.work.into(),
            age_s: report.age.into(),
            energy_j: report.energy,
            peak_force_n: report.peak_force,
            faults: report.faults,
            fault: report.fault.map(|fault| fault.to_string()),
            limited_ticks: report.interventions.into(),
        }
    }
}

impl Model {
    fn new(report: &ModelReport) -> Self {
        Self {
            priority: report.priority.word(),
            rate_hz: report.rate,
            steps: report.steps,
            missed: report.missed,
            touch_s: report.touch_times.into(),
            step_s: report.step_times.into(),
            extrapolation_rms_n: report.extrapolation.rms,
            extrapolation_max_n: report.extrapolation.max,
            extrapolation_peak_n: report.extrapolation.peak,
        }
    }
}

impl From<Interventions> for Limited {
    fn from(did: Interventions) -> Self {
        Self {
            let_go: did.let_go,
            late: did.late,
            faded: did.faded,
            damped: did.damped,
            walls: did.walls,
            shortened: did.shortened,
            cooled: did.cooled,
            slowed: did.slowed,
        }
    }
}

impl Limited {
    /// Those that did anything.
    fn words(&self) -> String {
        let all = [
            ("let go", self.let_go),
            ("late", self.late),
            ("faded", self.faded),
            ("damped", self.damped),
            ("walls", self.walls),
            ("shortened", self.shortened),
            ("cooled", self.cooled),
            ("slowed", self.slowed),
        ];
        let did = all.into_iter().filter(|(_, count)| *count > 0);
        let words: Vec<_> = did.map(|(name, count)| format!("{name} {count}")).collect();
        if words.is_empty() {
            return "no force changed".to_owned();
        }
        format!("{} ticks", words.join(", "))
    }
}

impl From<Percentiles> for Times {
    fn from(times: Percentiles) -> Self {
        Self {
            p50: times.p50,
            p99: times.p99,
            p99_9: times.p99_9,
            max: times.max,
        }
    }
}

impl Times {
    fn microseconds(&self) -> String {
        let [p50, p99, p99_9, max] =
            [self.p50, self.p99, self.p99_9, self.max].map(|time| 1e6 * time);
        format!("p50 {p50:.1}, p99 {p99:.1}, p99.9 {p99_9:.1}, max {max:.1} µs")
    }
}

impl Answer {
    pub(super) fn text(&self) -> String {
        let lines = self.runs.iter().flat_map(Run::lines);
        lines.collect::<Vec<_>>().join("\n")
    }
}

impl Run {
    fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("{} Hz asked", self.asked_hz)];
        for touch in &self.tools {
            lines.extend([
                format!(
                    "  {}: {:.1} Hz ({} priority), {} of {} ticks left out",
                    touch.tool,
                    touch.rate_hz,
                    touch.priority,
                    touch.missed,
                    touch.ticks + touch.missed
                ),
                format!("    late    {}", touch.lateness_s.microseconds()),
                format!("    work    {}", touch.work_s.microseconds()),
                format!("    age     {}", touch.age_s.microseconds()),
                format!(
                    "    energy  {:.4} mJ given to the hand, peak force {:.1} mN",
                    1e3 * touch.energy_j,
                    1e3 * touch.peak_force_n
                ),
                format!(
                    "    limits  {} faults, {}",
                    touch.faults,
                    touch.limited_ticks.words()
                ),
            ]);
            lines.extend(
                touch
                    .fault
                    .iter()
                    .map(|fault| format!("    fault   {fault}")),
            );
        }
        let model = &self.model;
        lines.extend([
            format!(
                "  model: {:.1} Hz ({} priority), {} of {} steps left out",
                model.rate_hz,
                model.priority,
                model.missed,
                model.steps + model.missed
            ),
            format!("    force   {}", model.touch_s.microseconds()),
            format!("    step    {}", model.step_s.microseconds()),
            format!(
                "    extrapolation  off by {:.3} mN (rms), {:.3} mN at most, of {:.1} mN",
                1e3 * model.extrapolation_rms_n,
                1e3 * model.extrapolation_max_n,
                1e3 * model.extrapolation_peak_n
            ),
        ]);
        lines
    }
}
