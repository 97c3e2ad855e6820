use std::fmt::Write as _;

use palpate_devices::{Found, Kind, Origin, SelfTest};
use palpate_files::printable;
use serde::Serialize;

use crate::failure::Failure;
use crate::output;

#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    pub(super) devices: Vec<Device>,
    pub(super) absent: Vec<Absent>,
    /// Names of gamepads, which display no force.
    pub(super) gamepads: Vec<String>,
}

/// A kind of which there is nothing.
#[derive(Debug, Serialize)]
pub(super) struct Absent {
    kind: &'static str,
    pub(super) why: String,
}

/// A device that was found.
#[derive(Debug, Serialize)]
pub(super) struct Device {
    kind: &'static str,
    name: String,
    model: String,
    serial: String,
    peak_force_n: f64,
    continuous_force_n: f64,
    forces_are: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    workspace_m: Option<[[f64; 3]; 2]>,
    remarks: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    self_test: Option<Test>,
}

/// The result of a device's self-test.
#[derive(Debug, Serialize)]
struct Test {
    passed: bool,
    ready: bool,
    rate_hz: f64,
    round_trip_p50_s: f64,
    round_trip_p99_s: f64,
    sent_n: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    displayed_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    position_m: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    moved_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
}

impl Default for Answer {
    fn default() -> Self {
        Self {
            palpate: output::VERSION,
            devices: Vec::new(),
            absent: Vec::new(),
            gamepads: Vec::new(),
        }
    }
}

impl Answer {
    pub(super) fn absent(&mut self, kind: Kind, why: String) {
        let kind = kind.word();
        self.absent.push(Absent { kind, why });
    }

    /// A failure when there is no device, or one has a fault.
    pub(super) fn outcome(&self) -> Result<(), Failure> {
        if self.devices.is_empty() {
            return Err(Failure::failed(
                "no haptic device was found; plug one in, or touch with the mouse or a virtual one",
            ));
        }
        let is_ill = |device: &&Device| device.self_test.as_ref().is_some_and(|test| !test.passed);
        match self.devices.iter().find(is_ill) {
            Some(device) => Err(Failure::failed(format!(
                "{} did not pass its self-test; see what it says above",
                device.name
            ))),
            None => Ok(()),
        }
    }

    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for device in &self.devices {
            // Writing to a string does not fail.
            let _ = device.write(&mut text);
        }
        for absent in &self.absent {
            let _ = writeln!(text, "{}: {}", absent.kind, printable(&absent.why));
        }
        for name in &self.gamepads {
            let _ = writeln!(
                text,
                "gamepad: {} (moves tools in a window, without forces)",
                printable(name)
            );
        }
        text
    }
}

impl Device {
    pub(super) fn new(kind: Kind, found: &Found, test: Option<&SelfTest>) -> Self {
        let capabilities = &found.capabilities;
        Self {
            kind: kind.word(),
            name: capabilities.name.clone(),
            model: found.model.clone(),
            serial: found.serial.clone(),
            peak_force_n: capabilities.peak_force,
            continuous_force_n: capabilities.continuous_force,
            forces_are: match found.forces {
                Origin::Device => "as the device says",
                Origin::Assumed => "ours, for the device does not say",
            },
            workspace_m: capabilities
                .workspace
                .map(|corners| corners.map(Into::into)),
            remarks: found.remarks.clone(),
            self_test: test.map(Test::new),
        }
    }

    fn write(&self, text: &mut String) -> std::fmt::Result {
        writeln!(text, "{}: {}", self.kind, printable(&self.name))?;
        writeln!(
            text,
            "  forces     up to {} N, {} N for as long as one likes ({})",
            self.peak_force_n, self.continuous_force_n, self.forces_are
        )?;
        if let Some([least, greatest]) = self.workspace_m {
            let span = |axis: usize| 1e3 * (greatest[axis] - least[axis]);
            let [right, up, toward] = [span(0), span(1), span(2)];
            writeln!(text, "  workspace  {right:.0} × {up:.0} × {toward:.0} mm")?;
        }
        for remark in &self.remarks {
            writeln!(text, "  {}", printable(remark))?;
        }
        self.self_test
            .as_ref()
            .map_or(Ok(()), |test| test.write(text))
    }
}

impl Test {
    fn new(test: &SelfTest) -> Self {
        let moved = test
            .reached
            .map(|[least, greatest]| (greatest - least).norm());
        Self {
            passed: test.passed(),
            ready: test.ready,
            rate_hz: test.report.rate,
            round_trip_p50_s: test.report.work.p50,
            round_trip_p99_s: test.report.work.p99,
            sent_n: test.sent,
            displayed_n: test.displayed,
            position_m: test.ends.map(|[_, last]| last.into()),
            moved_m: moved,
            fault: test.fault.map(|fault| fault.to_string()),
        }
    }

    fn write(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "  answers    {:.0} times a second, {:.0} µs per round trip, 1 in 100 above {:.0} µs",
            self.rate_hz,
            1e6 * self.round_trip_p50_s,
            1e6 * self.round_trip_p99_s
        )?;
        if let Some([right, up, toward]) = self.position_m {
            writeln!(
                text,
                "  handle     {:.1} mm right, {:.1} mm up, {:.1} mm toward you of the middle",
                1e3 * right,
                1e3 * up,
                1e3 * toward
            )?;
        }
        if let Some(moved) = self.moved_m {
            writeln!(text, "  moved      {:.1} mm during the test", 1e3 * moved)?;
        }
        let displayed = match self.displayed_n {
            Some(force) => format!("{force:.2} N displayed"),
            None => "the device does not say what it displays".to_owned(),
        };
        writeln!(text, "  force      {:.2} N sent, {displayed}", self.sent_n)?;
        if !self.ready {
            writeln!(
                text,
                "  it was not ready: calibrate it and switch its power on"
            )?;
        }
        if let Some(fault) = &self.fault {
            writeln!(text, "  {fault}")?;
        }
        let verdict = if self.passed { "passed" } else { "failed" };
        writeln!(text, "  self-test  {verdict}")
    }
}
