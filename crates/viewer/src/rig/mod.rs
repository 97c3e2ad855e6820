//! The window that operates a rig: state and limits above, controls on the left, live and recorded plots in the
//! middle.
//!
//! The window owns no rig: it sends commands and shows the events of a [`LiveRig`], whose threads do not depend on the
//! frame rate.
//!
//! *How we know*: `rig::journal::…`, `rig::curves::…`, `rig::prepared::…`; the rig by the tests of its crate; the
//! window itself is checked by eye.
//!
//! *Limits*: one specimen at a time.

mod curves;
mod direction;
mod journal;
mod keys;
mod manual;
mod online;
mod plots;
mod preparation;
mod prepared;
mod rig_state;
mod status_bar;
mod stimuli;
mod table;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use eframe::egui;
use palpate_files::recording::RecordingHeader;
use palpate_measure::live::{LiveRig, RigCommand};
use palpate_measure::{DepthTrajectory, Rig, RigSettings};
use palpate_servo::Vec3;

use crate::{Error, native, style};
use journal::Journal;
use preparation::Preparation;
use prepared::Prepared;
use rig_state::RigState;

/// Settings of a rig's window.
pub struct Bench {
    /// The limits and speeds of the rig.
    pub settings: RigSettings,
    /// Stimuli, each with its repetitions in a protocol.
    pub stimuli: Vec<(DepthTrajectory, u64)>,
    /// The specimens, one at least.
    pub places: Vec<Place>,
    /// The relative half interval of every parameter at which a press ends [-]; none for whole stimuli.
    pub stops_at: Option<f64>,
    /// Where recordings go.
    pub folder: PathBuf,
    /// Warnings before anything is measured.
    pub warnings: Vec<String>,
    /// Whether the window shall close, as if somebody had closed it: asked at every picture.
    pub is_ended: fn() -> bool,
}

/// A specimen that a rig can be put over.
pub struct Place {
    /// Its name.
    pub name: String,
    /// Where on it a protocol begins.
    pub begin: Begin,
    /// Makes the rig, on a thread of its own.
    pub make: Arc<Make>,
}

/// Start of a protocol, before the approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Begin {
    /// Where the indenter goes first, in the rig's axes [m].
    pub place: Vec3,
    /// Whether it measures the normal of the surface there.
    pub measures_normal: bool,
}

/// Makes a rig, on a real clock, and reports the part that is done [-].
pub type Make = dyn Fn(&mut dyn FnMut(f64)) -> Result<PreparedRig, String> + Send + Sync;

/// A rig over a specimen.
pub struct PreparedRig {
    /// The rig.
    pub rig: Rig,
    /// Warnings about it.
    pub warnings: Vec<String>,
}

/// Between two pictures.
const PICTURE: Duration = Duration::from_millis(40);

/// Size of the small letters, which are read from a step away.
const SMALL: f32 = 11.5;

/// What stands behind the window.
enum Behind {
    Preparing(Preparation),
    Live(Box<LiveRig>),
    Failed(String),
}

/// The rig as a window.
struct RigWindow {
    settings: RigSettings,
    prepared: Vec<Prepared>,
    places: Vec<Place>,
    place: usize,
    behind: Behind,
    header: RecordingHeader,
    watch: RigState,
    journal: Journal,
    /// How far a click moves the indenter [m].
    step: f64,
    /// The tilt of the normal toward x and y, as it is typed [degrees].
    tilt: [f64; 2],
    /// Warnings about the protocol, and about the specimen.
    warnings: [Vec<String>; 2],
    is_ended: fn() -> bool,
}

/// Opens a window over the first specimen of `bench` and waits until it is closed; the indenter is withdrawn then.
///
/// # Errors
/// When there is no display, no adapter, or the window breaks down.
pub fn open_rig_window(bench: Bench) -> Result<(), Error> {
    native::open([[1280.0, 800.0], [900.0, 600.0]], move |context| {
        Ok(RigWindow::new(bench, &context.egui_ctx))
    })
}

impl RigWindow {
    fn new(bench: Bench, context: &egui::Context) -> Self {
        context.all_styles_mut(|style| {
            let small = egui::FontId::proportional(SMALL);
            style.text_styles.insert(egui::TextStyle::Small, small);
        });
        let stimuli = bench.stimuli.iter();
        Self {
            settings: bench.settings,
            prepared: stimuli
                .map(|(trajectory, repeats)| Prepared::new(*trajectory, *repeats))
                .collect(),
            behind: Behind::Preparing(Preparation::start(&bench.places[0].make, context.clone())),
            places: bench.places,
            place: 0,
            header: RecordingHeader::default(),
            watch: RigState::new(bench.stops_at),
            journal: Journal::new(bench.folder),
            step: 1e-3,
            tilt: [0.0; 2],
            warnings: [bench.warnings, Vec::new()],
            is_ended: bench.is_ended,
        }
    }

    /// Puts a rig over another specimen; the one before is withdrawn first.
    fn move_to(&mut self, place: usize, context: &egui::Context) {
        self.place = place;
        self.watch = RigState::new(self.watch.online.stops_at);
        // It has let go of its device when the next rig asks for one.
        self.behind = Behind::Failed(String::new());
        let make = &self.places[place].make;
        self.behind = Behind::Preparing(Preparation::start(make, context.clone()));
    }

    /// Takes over a prepared rig, and reads the events of the rig.
    fn read(&mut self) {
        let outcome = match &self.behind {
            Behind::Preparing(preparation) => preparation.outcome(),
            _ => None,
        };
        if let Some(outcome) = outcome {
            let live = outcome.and_then(|made| {
                self.header = made.rig.header().clone();
                self.watch.specimen = self.header.clone();
                self.warnings[1] = made.warnings;
                self.watch.sensor_range = made.rig.sensor_range();
                LiveRig::start_until(made.rig, self.is_ended).map_err(|error| error.to_string())
            });
            self.behind = match live {
                Ok(live) => Behind::Live(Box::new(live)),
                Err(sentence) => Behind::Failed(sentence),
            };
        }
        let Behind::Live(live) = &mut self.behind else {
            return;
        };
        live.report_alive();
        self.watch.read(live, &mut self.journal);
        if let Some(hung) = live.hung_device() {
            self.watch.notice = Some(hung);
        }
        if !live.is_running() {
            let sentence =
                "a thread of the rig has ended, and its device was stopped; open the window again";
            self.behind = Behind::Failed(sentence.to_owned());
        }
    }

    fn live(&mut self) -> Option<&mut LiveRig> {
        match &mut self.behind {
            Behind::Live(live) => Some(live),
            _ => None,
        }
    }

    /// Sends a command whose end is reported.
    fn send(&mut self, command: RigCommand) {
        if let Behind::Live(live) = &mut self.behind {
            live.console.send(command);
            self.watch.waiting += 1;
        }
    }

    /// Moves the indenter by a step.
    fn jog(&mut self, way: manual::JogStep) {
        let way = way.in_rig(self.step, &self.watch.normal());
        self.send(RigCommand::Jog(way));
    }

    /// Queues a press and its recording.
    fn press(&mut self, trajectory: &DepthTrajectory) {
        if !self.can_record() {
            return;
        }
        if let Behind::Live(live) = &mut self.behind {
            let settings = &self.settings;
            let commission = self
                .journal
                .ask(trajectory, settings, &self.header, self.place);
            live.press(*trajectory, commission);
            self.watch.waiting += 1;
        }
    }

    /// Only one unwritten recording stays in memory; the next press waits until it is saved or discarded.
    fn can_record(&mut self) -> bool {
        let is_free = self.journal.unsaved.is_none();
        if !is_free {
            let notice = "record or discard the samples in memory first";
            self.watch.notice = Some(notice.to_owned());
        }
        is_free
    }

    /// Every stimulus as often as the protocol says, each as without a window: the tissue rests, is looked for,
    /// rests from that and is pressed.
    fn press_all(&mut self) {
        if !self.can_record() {
            return;
        }
        let begin = self.places[self.place].begin;
        if begin.place != Vec3::zeros() {
            self.send(RigCommand::GoTo(begin.place));
        }
        if begin.measures_normal {
            self.send(RigCommand::MeasureNormal);
        }
        let all: Vec<DepthTrajectory> = self.prepared.iter().flat_map(Prepared::repeated).collect();
        for trajectory in all {
            for command in [RigCommand::Rest, RigCommand::Approach, RigCommand::Rest] {
                self.send(command);
            }
            self.press(&trajectory);
        }
    }

    fn stop(&mut self) {
        if let Some(live) = self.live() {
            live.console.stop();
        }
    }

    fn emergency_stop(&mut self) {
        if let Some(live) = self.live() {
            live.console.emergency_stop();
        }
    }

    /// Lets forces on again.
    fn arm(&mut self) {
        if let Behind::Live(live) = &mut self.behind {
            live.console.arm();
        }
        if let Some(fault) = &mut self.watch.fault {
            fault.arming = true;
        }
    }

    /// Where there is no rig yet, or none any more.
    fn show_absence(&self, ui: &mut egui::Ui) {
        ui.vertical_centered(|ui| {
            ui.add_space(0.4 * ui.available_height());
            match &self.behind {
                Behind::Preparing(preparation) => {
                    ui.label(format!(
                        "preparing {}: a law that is not linear is solved once, which takes a minute",
                        self.places[self.place].name
                    ));
                    ui.add_space(8.0);
                    let bar = egui::ProgressBar::new(preparation.part() as f32);
                    ui.add(bar.desired_width(280.0).show_percentage());
                }
                Behind::Failed(sentence) => {
                    ui.colored_label(style::FAULT, sentence);
                }
                Behind::Live(_) => {}
            }
        });
    }
}

impl eframe::App for RigWindow {
    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        crate::style::cleared()
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        if (self.is_ended)() {
            context.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        keys::take(self, &context);
        self.read();
        egui::Panel::top("above").show(ui, |ui| status_bar::show(self, ui));
        egui::Panel::bottom("recordings")
            .resizable(true)
            .default_size(168.0)
            .size_range(80.0..=360.0)
            .show(ui, |ui| table::show(self, ui));
        egui::Panel::left("orders")
            .resizable(false)
            .exact_size(272.0)
            .show(ui, |ui| {
                egui::ScrollArea::vertical()
                    .auto_shrink([false, false])
                    .show(ui, |ui| {
                        manual::show(self, ui);
                        direction::show(self, ui);
                        direction::axes(self, ui);
                        ui.separator();
                        stimuli::show(self, ui);
                    });
            });
        egui::CentralPanel::default().show(ui, |ui| match &self.behind {
            Behind::Live(_) => {
                self.watch.online.show(ui);
                plots::show(self, ui);
            }
            _ => self.show_absence(ui),
        });
        context.request_repaint_after(PICTURE);
    }

    fn on_exit(&mut self) {
        // The indenter is withdrawn before the window is gone.
        self.behind = Behind::Failed(String::new());
    }
}
