//! The simulator's window, in which an organ is touched: the picture on the left, choices, force and depth on
//! the right, warnings below.
//!
//! The window owns no model: it moves a hand and shows the state of an [`Interaction`], whose threads do not depend
//! on the frame rate.
//!
//! *How we know*: `gestures::…`, `invariants::dragging_over_every_organ`; the window itself is checked by eye.
//!
//! Keys and a gamepad move both tools at once, a mouse one of them: `hands`.
//!
//! [`Interaction`]: palpate_simulate::interactive::Interaction

mod actions;
mod attempt;
mod cards;
mod choice;
mod class_page;
mod compared;
mod covered;
mod diameter;
mod display;
mod enhancement;
pub mod gesture;
mod ghosts;
pub mod hands;
mod home;
#[cfg(test)]
mod keyboard_tests;
mod list;
mod overlay;
mod page;
mod panel;
mod picture;
mod placeholder;
mod play;
mod preparation;
mod rates;
mod render_quality;
mod results;
pub mod settings;
mod settings_page;
mod shown_picture;
mod source;
#[cfg(test)]
mod test_page;
mod texts;
mod timeline;
mod trainer;
pub mod training;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use eframe::egui;
use palpate_files::Scene;
use palpate_files::scene::{Tool, ToolKind};
use palpate_simulate::{Replay, Resources, Simulation};

use crate::history::History;
use crate::{Error, Gpu, native};
use attempt::Attempt;
use choice::Choice;
use class_page::ClassPage;
use compared::{Compared, ShownDemonstration};
pub use display::check_display;
use hands::gamepads::Gamepads;
use home::Home;
use picture::OrganView;
use play::{Play, Prepared};
use preparation::Preparation;
use rates::Rates;
use settings::WindowSettings;
use settings_page::SettingsPage;
use texts::text;
use training::Training;

/// How long a picture in which nothing moves is left as it is.
const REST: Duration = Duration::from_millis(200);

/// How long a gamepad is not looked at.
const LOOK: Duration = Duration::from_millis(30);

/// The simulator as a window.
struct SimulatorWindow {
    gpu: Gpu,
    choice: Choice,
    /// The slider of the tip's radius [mm].
    radius: f64,
    resources: Resources,
    /// The scene that is shown when the choice fails.
    fallback: Scene,
    picture: OrganView,
    play: Option<Play>,
    preparation: Option<Preparation>,
    fault: Option<String>,
    notice: Option<String>,
    history: History,
    rates: Rates,
    surroundings: Option<String>,
    /// Whether the last picture was asked for at once.
    moves: bool,
    /// Whether the key was pressed by which the mouse takes the other tool.
    takes_other: bool,
    /// Trainee and tasks.
    training: Option<Training>,
    /// The settings, and where they are stored.
    settings: WindowSettings,
    /// The page of settings, while it is shown.
    settings_page: Option<SettingsPage>,
    /// The teacher's page, while it is shown.
    class_page: Option<ClassPage>,
    /// The start screen, while it is shown.
    home: Option<Home>,
    /// The task that is attempted.
    attempt: Option<Attempt>,
    /// Whether the attempt begins as soon as its organ is prepared.
    begins: bool,
    /// Whether a key was pressed that begins an attempt, or the next one.
    begins_anew: bool,
    /// Whether the panels for engineers are shown during a task.
    engineer_view: bool,
    /// The session that is seen on the right of another one.
    compared: Option<Box<Compared>>,
    /// The demonstration that is computed to be seen there.
    shown_demonstration: Option<ShownDemonstration>,
    /// The session that shall be looked at again when its organ is prepared.
    awaited: Option<PathBuf>,
    /// Whether the window shall close, as if somebody had closed it.
    is_ended: fn() -> bool,
}

/// Start of a window.
pub enum Start {
    /// The start screen.
    Home,
    /// A scene.
    Scene(Box<Scene>),
    /// A replayed session, and another one for comparison.
    Replay(Box<PlayedSession>, Option<Box<PlayedSession>>),
}

/// A session of a scene that is played again.
pub struct PlayedSession {
    /// Its name in the window.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// What it was played on.
    pub simulation: Arc<Simulation>,
    /// The session.
    pub replay: Replay,
}

/// Resources of a window.
pub struct WindowOptions {
    /// A scene that works, which is offered when another does not.
    pub fallback: Scene,
    /// Resources to prepare whole organs during the touch.
    pub resources: Resources,
    /// If given, tasks can be chosen, and sessions and results are stored.
    pub training: Option<Training>,
    /// Changed on a page of their own.
    pub settings: WindowSettings,
    /// Asked at every picture: whether it shall close as if somebody had closed it.
    pub is_ended: fn() -> bool,
}

/// Opens a window and waits until it is closed.
///
/// # Errors
/// When there is no display, no adapter, or the window breaks down. What is wrong with the scene is shown in
/// the window.
pub fn open_window(start: Start, options: WindowOptions) -> Result<(), Error> {
    native::open([[1280.0, 800.0], [560.0, 380.0]], move |context| {
        SimulatorWindow::new(context, start, options)
    })
}

impl SimulatorWindow {
    fn new(
        context: &eframe::CreationContext<'_>,
        start: Start,
        options: WindowOptions,
    ) -> Result<Self, Error> {
        let WindowOptions {
            fallback,
            resources,
            training,
            settings,
            is_ended,
        } = options;
        let Some(state) = &context.wgpu_render_state else {
            return Err(Error::Window {
                cause: "it came without a graphics adapter".to_owned(),
            });
        };
        let gpu = Gpu::of(&state.adapter, state.device.clone(), state.queue.clone());
        let scene = match &start {
            Start::Home => fallback.clone(),
            Start::Scene(scene) => (**scene).clone(),
            Start::Replay(session, _) => session.scene.clone(),
        };
        let choice = Choice::new(scene).with_mouse(settings.settings.mouse_hand);
        texts::set_language(settings.language());
        context
            .egui_ctx
            .set_zoom_factor(settings.settings.scale as f32);
        let mut window = Self {
            picture: OrganView::new(&gpu, choice.shading()),
            radius: 1e3 * choice.tip.radius_m,
            choice,
            resources,
            fallback,
            play: None,
            preparation: None,
            fault: None,
            notice: None,
            history: History::default(),
            rates: Rates::default(),
            surroundings: None,
            moves: false,
            takes_other: false,
            training,
            settings,
            settings_page: None,
            class_page: None,
            home: None,
            attempt: None,
            begins: false,
            begins_anew: false,
            engineer_view: false,
            compared: None,
            shown_demonstration: None,
            awaited: None,
            is_ended,
            gpu,
        };
        window.picture.gamepads = Gamepads::start();
        match start {
            Start::Home => {
                let mut home = Home::default();
                home.error.clone_from(&window.settings.error);
                window.home = Some(home);
            }
            Start::Scene(_) => window.reset(&context.egui_ctx),
            Start::Replay(session, other) => {
                let name = session.name.clone();
                window.play = Some(Play::of_session(*session, &window.gpu)?);
                if let Some(other) = other {
                    window.compare(name, *other)?;
                }
            }
        }
        Ok(window)
    }

    /// Prepares the choice on another thread; the current organ stays until the new one is ready.
    fn reset(&mut self, context: &egui::Context) {
        let preparation = Preparation::start(
            self.choice.scene(),
            &self.resources,
            &self.gpu,
            context.clone(),
        );
        self.preparation = Some(preparation);
    }

    /// Takes over a finished preparation.
    fn receive(&mut self) {
        let Some(outcome) = self.preparation.as_mut().and_then(Preparation::outcome) else {
            return;
        };
        if outcome.last {
            self.preparation = None;
        }
        self.history.clear();
        match outcome.play {
            Ok(prepared) => self.touch(prepared, outcome.last, outcome.second),
            Err(error) if outcome.second => self.notice = Some(error.to_string()),
            Err(error) => {
                self.play = None;
                self.fault = Some(error.to_string());
            }
        }
    }

    /// Begins the touch of what was prepared; with the last of it, a session that waited for it is looked at.
    fn touch(&mut self, mut prepared: Prepared, is_last: bool, is_second: bool) {
        let before = self.play.as_ref();
        let before = before.map(|play| play.scene.organ.shape.clone());
        // The organ-scale model takes over from the local one in the middle of a touch: no device is closed.
        let mut touched = self.play.take();
        let is_ended = self.is_ended;
        let takes_over = is_second
            && touched
                .as_mut()
                .is_some_and(|play| play.take_over(&mut prepared, is_ended));
        let started = match touched {
            Some(play) if takes_over => Ok(play.showing(prepared)),
            touched => {
                if prepared.has_devices() {
                    // The running touch releases them first.
                    drop(touched);
                }
                Play::start(prepared, is_ended)
            }
        };
        let mut play = match started {
            Ok(play) => play,
            Err(error) => {
                self.play = None;
                self.fault = Some(error.to_string());
                return;
            }
        };
        if before.is_none_or(|shape| shape != play.scene.organ.shape) {
            self.picture.reset_framing();
            let makes_more = |tool: &Tool| tool.kind != ToolKind::Probe;
            self.picture.lists_keys = play.scene.tools.iter().any(makes_more);
        }
        self.fault = None;
        let enhanced = self.picture.enhance(&self.gpu, &mut play);
        self.notice = enhanced.err().map(|error| error.to_string());
        self.take_task(&play);
        self.play = Some(play);
        if is_last && self.begins {
            self.begin_attempt();
        }
        if is_last && let Some(session) = self.awaited.take() {
            self.replay_session(&session);
        }
    }

    /// Reads what the touch has written since the last picture.
    fn listen(&mut self, context: &egui::Context) {
        let Some(play) = &mut self.play else { return };
        let tool = self.choice.tool;
        for row in play.source.rows() {
            if let Some(attempt) = &mut self.attempt {
                attempt.add(&row);
            }
            if row.tool == tool {
                let force = row.force_n.iter().map(|c| c * c).sum::<f64>().sqrt();
                self.history.add(row.time_s, [force, row.depth_m]);
            }
        }
        let quality = play.source.quality();
        let time = context.input(|input| input.time);
        self.rates.count(time, tool, &quality);
        let wanted = 1.0 / play.simulation.step();
        let late = self.rates.model > 0.0 && self.rates.model < 0.9 * wanted;
        let elapsed = context.input(|input| input.unstable_dt);
        // Pictures that were left out because nothing moved are not slow.
        if self.moves {
            let elapsed = Duration::from_secs_f32(elapsed.max(0.0));
            self.picture.count(elapsed, late);
        }
        if !play.source.is_running() {
            let fault = self.rates.touch.fault;
            let why = fault.map_or_else(|| text!("fault-thread"), |fault| fault.to_string());
            self.fault = Some(text!("fault-stopped", why = why));
        }
    }

    /// How far the whole organ is prepared [-], and the time that it still takes [s] if that can be said; none when it
    /// is.
    fn preparing(&self) -> Option<(f64, Option<f64>)> {
        let preparation = self.preparation.as_ref()?;
        let part = preparation.progress().map_or(0.0, |progress| progress.part);
        Some((part, preparation.time_left()))
    }
}

impl SimulatorWindow {
    /// Handles the emergency stop by the space bar, which with a force-feedback device takes precedence over all other
    /// keys, and reports that the window is alive.
    fn supervise(&self, context: &egui::Context) {
        let Some(play) = &self.play else { return };
        let has_devices = play.has_devices();
        let space = |input: &mut egui::InputState| {
            input.consume_key(egui::Modifiers::NONE, egui::Key::Space)
        };
        if (has_devices || !context.egui_wants_keyboard_input()) && context.input_mut(space) {
            play.source.emergency_stop();
        }
        if has_devices {
            play.source.report_alive();
        }
    }
}

impl eframe::App for SimulatorWindow {
    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        crate::style::cleared()
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        if (self.is_ended)() {
            context.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        context.request_repaint_after(REST);
        self.receive();
        if self.settings_page.is_some() {
            self.show_settings(ui);
            return;
        }
        if self.class_page.is_some() {
            self.show_class(ui);
            return;
        }
        if self.home.is_some() {
            self.show_home(ui);
            return;
        }
        self.supervise(&context);
        self.listen(&context);
        self.watch_attempt(&context);
        self.watch_demonstration(&context);
        self.take_dropped(&context);
        self.act(&context);
        self.set_diameter(&context);
        self.show_timeline(ui);
        self.show_panels(ui);
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let tool = self.choice.tool;
            if self.compared.is_some()
                && let Some(state) = frame.wgpu_render_state()
            {
                self.show_both(ui, state);
                return;
            }
            match (&mut self.play, frame.wgpu_render_state()) {
                (Some(play), Some(state)) => {
                    let rect = self.picture.show(ui, state, &self.gpu, play, tool);
                    let attempt = self.attempt.as_ref();
                    self.picture.show_task(ui, rect, &mut *play, attempt);
                    if !self.attempt.as_ref().is_some_and(Attempt::is_over) {
                        overlay::show(ui, rect, &self.picture, play, tool);
                    }
                }
                _ => self.show_absence(ui),
            }
            self.show_card(ui);
        });
        let moves = self.play.as_mut().is_some_and(|play| {
            play.refresh_limits();
            let snapshot = play.source.snapshot();
            let touches = snapshot.tools.iter().any(|tool| tool.contact.is_some());
            touches
                || play
                    .source
                    .playback()
                    .is_some_and(|playback| playback.moves())
        });
        self.moves = moves || self.picture.is_busy();
        match (self.moves, self.picture.has_gamepad()) {
            (true, _) => context.request_repaint(),
            (false, true) => context.request_repaint_after(LOOK),
            (false, false) => context.request_repaint_after(REST),
        }
    }

    fn raw_input_hook(&mut self, _context: &egui::Context, raw: &mut egui::RawInput) {
        let is_page = self.home.is_some() || self.settings_page.is_some();
        let reads_card = self.attempt.as_ref().is_some_and(Attempt::is_card);
        if is_page || reads_card || self.is_replaying() {
            return;
        }
        // Else it would walk through the buttons while tools are moved, which Shift and Tab still do.
        raw.events.retain(|event| match event {
            egui::Event::Key {
                key: egui::Key::Tab,
                pressed,
                repeat,
                modifiers,
                ..
            } if modifiers.is_none() => {
                self.takes_other |= *pressed && !*repeat;
                false
            }
            _ => true,
        });
    }

    fn on_exit(&mut self) {
        // Threads end before the window does.
        self.play = None;
    }
}
