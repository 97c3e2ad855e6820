//! The estimate during a stimulus, on its own thread: a fit takes longer than a picture.

use std::sync::mpsc::{Receiver, Sender, channel};

use eframe::egui::{Align, Layout, RichText, Ui};
use palpate_characterize::online::{
    DEFAULT_TARGET, OnlineContact, OnlineEstimate, OnlineEstimator, OnlineSample, OnlineSettings,
};
use palpate_files::quantity::plain_quantity;
use palpate_files::recording::RecordingHeader;

use crate::style::{DEPTH, QUIET, WHITE};

/// Samples that make the next estimate worth its time.
const MORE: usize = 100;

/// The current estimate of the tissue under the indenter.
#[derive(Debug, Default)]
pub(super) struct Online {
    /// To the thread; none when the press is not estimated.
    samples: Option<Sender<OnlineSample>>,
    estimates: Option<Receiver<OnlineEstimate>>,
    last: Option<OnlineEstimate>,
    /// The relative half interval at which a press ends [-]; none for whole stimuli.
    pub(super) stops_at: Option<f64>,
}

impl Online {
    /// Begins with a press to `deepest` [m] into the specimen of `header`.
    pub(super) fn begin(&mut self, header: &RecordingHeader, deepest: f64) {
        self.end();
        self.last = None;
        self.estimates = None;
        let settings = OnlineSettings {
            header: header.clone(),
            contact: OnlineContact::Detected,
            deepest_m: Some(deepest),
        };
        if !settings.is_tabulated() {
            return;
        }
        let Ok(online) = OnlineEstimator::new(settings) else {
            return;
        };
        let (samples, taken) = channel();
        let (sender, estimates) = channel();
        let thread = std::thread::Builder::new().name("estimate".to_owned());
        if thread.spawn(move || run(online, &taken, &sender)).is_ok() {
            self.samples = Some(samples);
            self.estimates = Some(estimates);
        }
    }

    /// Ends with the press; its last estimate remains.
    pub(super) fn end(&mut self) {
        self.samples = None;
    }

    pub(super) fn add(&mut self, sample: OnlineSample) {
        if let Some(samples) = &self.samples {
            // The thread may have ended.
            let _ = samples.send(sample);
        }
    }

    /// Takes over the newest estimate; whether the press shall end.
    pub(super) fn is_enough(&mut self) -> bool {
        let estimates = self.estimates.as_ref();
        let newest = estimates.and_then(|all| all.try_iter().last());
        let is_new = newest.is_some();
        self.last = newest.or_else(|| self.last.take());
        let known = self.last.as_ref().zip(self.stops_at);
        is_new
            && self.samples.is_some()
            && known.is_some_and(|(last, target)| last.is_enough(target))
    }

    /// A line with each parameter and its interval, and whether that is enough.
    pub(super) fn show(&self, ui: &mut Ui) {
        let target = self.stops_at.unwrap_or(DEFAULT_TARGET);
        ui.horizontal(|ui| {
            ui.label(RichText::new("tissue").strong());
            let Some(last) = &self.last else {
                let none = "estimated while a ramp and hold is pressed";
                ui.label(RichText::new(none).small().color(QUIET));
                return;
            };
            for own in &last.parameters {
                let half = own.relative_half_interval();
                let is_good = half.is_some_and(|half| half <= target);
                let color = if is_good { DEPTH } else { WHITE };
                ui.label(RichText::new(symbol(own.name)).color(QUIET));
                match (own.value, half) {
                    (Some(value), Some(half)) => {
                        let value = plain_quantity(own.name, value, None);
                        let number = format!("{value} ± {:.0} %", 1e2 * half);
                        ui.label(RichText::new(number).monospace().color(color));
                    }
                    _ => {
                        ui.label(RichText::new("not yet known").color(QUIET));
                    }
                }
                ui.add_space(6.0);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let (word, color) = match last.is_enough(target) {
                    true => ("ENOUGH", DEPTH),
                    false => ("not enough yet", QUIET),
                };
                let hint = format!(
                    "the target: half the 95 % interval of each parameter within {:.0} % of its value",
                    1e2 * target
                );
                ui.label(RichText::new(word).strong().color(color))
                    .on_hover_text(hint);
                let after = format!("{:.1} s", last.time_s);
                ui.label(RichText::new(after).small().color(QUIET));
            });
        });
    }
}

/// As people write it.
fn symbol(name: &str) -> &str {
    match name {
        "c10_pa" => "C10",
        "g_1" => "g1",
        "tau_1_s" => "τ1",
        "g_2" => "g2",
        "tau_2_s" => "τ2",
        name => name,
    }
}

/// Receives samples until the sender is dropped, and sends estimates.
fn run(
    mut online: OnlineEstimator,
    samples: &Receiver<OnlineSample>,
    sender: &Sender<OnlineEstimate>,
) {
    let mut since = 0;
    while let Ok(sample) = samples.recv() {
        online.add(sample);
        since += 1;
        // Samples that arrived meanwhile belong to the same estimate.
        for more in samples.try_iter() {
            online.add(more);
            since += 1;
        }
        if since < MORE || !online.is_touching() {
            continue;
        }
        since = 0;
        if sender.send(online.estimate()).is_err() {
            return;
        }
    }
    if since > 0 && online.is_touching() {
        // Fails when the window is closed.
        let _ = sender.send(online.estimate());
    }
}
