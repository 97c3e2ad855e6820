//! The window as a trainer: start screen, tasks, results, replays.

use std::path::Path;

use eframe::egui;
use palpate_files::Scene;
use palpate_simulate::SessionFolder;

use super::attempt::{Attempt, Phase};
use super::cards::{self, AttemptAction, CardContext};
use super::choice::Choice;
use super::class_page::{ClassPage, ClassPageAction};
use super::compared::ShownDemonstration;
use super::home::{Chosen, Home};
use super::play::{ModelRequest, Play};
use super::settings_page::SettingsPage;
use super::texts::text;
use super::training::TrainingResult;
use super::{SimulatorWindow, panel};
use crate::Error;

impl SimulatorWindow {
    /// The start screen instead of everything else.
    pub(super) fn show_home(&mut self, ui: &mut egui::Ui) {
        let (Some(home), Some(training)) = (&mut self.home, &mut self.training) else {
            self.home = None;
            return;
        };
        let chosen = egui::CentralPanel::default()
            .show(ui, |ui| home.show(ui, training))
            .inner;
        let context = ui.ctx().clone();
        let scene = match chosen {
            None => return,
            Some(Chosen::Task(number)) => training.tasks[number].scene.clone(),
            Some(Chosen::Class) => {
                let titles = training.tasks.iter();
                let titles = titles.filter_map(|task| task.scene.task.title.clone());
                let page = ClassPage::new(training.record.class(), titles.collect());
                self.class_page = Some(page);
                return;
            }
            Some(Chosen::Settings) => {
                self.settings_page = Some(SettingsPage::new(&self.settings));
                return;
            }
            Some(Chosen::Free) => training.free.clone(),
            Some(Chosen::Session(session)) => match scene_of(&session) {
                Ok(scene) => {
                    self.awaited = Some(session);
                    scene
                }
                Err(trouble) => {
                    home.error = Some(trouble);
                    return;
                }
            },
        };
        self.open(scene, &context);
    }

    /// The teacher's page instead of everything else.
    pub(super) fn show_class(&mut self, ui: &mut egui::Ui) {
        let (Some(page), Some(training)) = (&mut self.class_page, &mut self.training) else {
            return;
        };
        let panel = egui::CentralPanel::default();
        match panel.show(ui, |ui| page.show(ui)).inner {
            None => {}
            Some(ClassPageAction::Leave) => {
                self.class_page = None;
                // What was assigned is seen on the start screen.
                self.home = Some(Home::default());
            }
            Some(ClassPageAction::Assign(given)) => {
                let outcome = training.record.assign(&given);
                page.take(outcome, training.record.class());
            }
        }
    }

    /// The page of settings instead of everything else.
    pub(super) fn show_settings(&mut self, ui: &mut egui::Ui) {
        let Some(page) = &mut self.settings_page else {
            return;
        };
        let is_left = egui::CentralPanel::default()
            .show(ui, |ui| page.show(ui, &mut self.settings))
            .inner;
        // While the slider is dragged it would run away from the pointer.
        if !ui.input(|input| input.pointer.any_down()) {
            let scale = self.settings.settings.scale as f32;
            ui.ctx().set_zoom_factor(scale);
        }
        if is_left {
            self.settings_page = None;
            if let Some(home) = &mut self.home {
                home.error.clone_from(&self.settings.error);
            }
        }
    }

    fn open(&mut self, scene: Scene, context: &egui::Context) {
        self.home = None;
        self.compared = None;
        self.shown_demonstration = None;
        self.attempt = None;
        self.play = None;
        self.fault = None;
        let hand = self.settings.settings.mouse_hand;
        self.choice = Choice::new(scene).with_mouse(hand);
        self.radius = 1e3 * self.choice.tip.radius_m;
        self.picture.shading = self.choice.shading();
        self.reset(context);
    }

    /// Back to the start screen; what was being prepared or touched ends.
    pub(super) fn go_home(&mut self) {
        self.preparation = None;
        self.play = None;
        self.attempt = None;
        self.compared = None;
        self.shown_demonstration = None;
        self.awaited = None;
        self.begins = false;
        self.notice = None;
        self.home = Some(Home::default());
    }

    /// Whether organ, tissue and tools may be changed: not within a task or a session.
    pub(super) fn can_choose(&mut self) -> bool {
        self.attempt.is_none() && !self.is_replaying()
    }

    /// Whether a session is played again.
    pub(super) fn is_replaying(&mut self) -> bool {
        let play = self.play.as_mut();
        play.is_some_and(|play| play.source.playback().is_some())
    }

    /// A scene that has something to do becomes an attempt, unless one goes on.
    pub(super) fn take_task(&mut self, play: &Play) {
        let goes_on = matches!(
            &self.attempt,
            Some(Attempt {
                phase: Phase::Running(_),
                ..
            })
        );
        if !goes_on && self.awaited.is_none() {
            let is_wanted = Attempt::has_goal(&play.scene.task);
            self.attempt = is_wanted.then(|| Attempt::new(play));
        }
    }

    /// Checks whether the task is over, and stores its result.
    pub(super) fn watch_attempt(&mut self, context: &egui::Context) {
        let (Some(attempt), Some(play)) = (&mut self.attempt, &mut self.play) else {
            return;
        };
        let elapsed = f64::from(context.input(|input| input.stable_dt));
        self.picture.shown = attempt.shown(play, elapsed.min(0.1));
        if attempt.look(play) {
            self.keep_result();
        }
    }

    fn keep_result(&mut self) {
        let (Some(attempt), Some(play), Some(training)) =
            (&mut self.attempt, &self.play, &mut self.training)
        else {
            return;
        };
        let Phase::Ended(done) = &attempt.phase else {
            return;
        };
        let trainee = training.trainee.trim();
        let earlier = training.record.results(trainee).unwrap_or_default();
        let title = play.scene.task.title.as_deref();
        let earlier = earlier
            .into_iter()
            .filter(|own| Some(own.task.as_str()) == title);
        let earlier: Vec<_> = earlier.collect();
        let Some(folder) = &done.folder else {
            attempt.compare_with(earlier);
            return;
        };
        let saved = training.record.keep(&TrainingResult {
            trainee,
            scene: &play.scene,
            session: folder,
            score: &done.score,
        });
        if let Err(trouble) = saved {
            attempt.error = Some(text!("result-not-kept", trouble = trouble));
        }
        attempt.compare_with(earlier);
    }

    /// The card of the task over the picture.
    pub(super) fn show_card(&mut self, ui: &egui::Ui) {
        let around = CardContext {
            preparing: self.preparing(),
            begins: self.begins,
            has_home: self.training.is_some(),
            comparing: self
                .shown_demonstration
                .as_ref()
                .map(ShownDemonstration::part),
        };
        let (Some(attempt), Some(play)) = (&mut self.attempt, &mut self.play) else {
            return;
        };
        let asked = cards::show(ui, attempt, &around);
        let by_key = std::mem::take(&mut self.begins_anew).then_some(AttemptAction::Begin);
        if asked.is_some() {
            // A button that was clicked would have the keyboard, and Enter click it again.
            ui.memory_mut(|memory| {
                if let Some(focused) = memory.focused() {
                    memory.surrender_focus(focused);
                }
            });
        }
        match asked.or(by_key) {
            None => {}
            Some(AttemptAction::Show) => {
                attempt.show(play);
                self.picture.release_tools();
                self.picture.lists_keys = false;
                self.history.clear();
            }
            Some(AttemptAction::Begin)
                if (attempt.is_over() || attempt.was_shown) && self.choice.draws() =>
            {
                let context = ui.ctx().clone();
                self.attempt = None;
                self.begins = true;
                self.reset(&context);
            }
            Some(AttemptAction::Begin) => self.begin_attempt(),
            Some(AttemptAction::State) => self.state_diameter(),
            Some(AttemptAction::End) => self.end_attempt(),
            Some(AttemptAction::RecordElsewhere) => {
                attempt.record_elsewhere(play);
                if attempt.is_over() && attempt.unsaved.is_none() {
                    self.keep_result();
                }
            }
            Some(AttemptAction::Compare) => {
                let folder = attempt.folder();
                if let Some(folder) = folder {
                    let context = ui.ctx().clone();
                    self.compare_with_demonstration(&folder, &context);
                }
            }
            Some(AttemptAction::Home) => self.go_home(),
            Some(AttemptAction::Replay) => {
                if let Some(folder) = attempt.folder() {
                    self.replay_session(&folder);
                }
            }
        }
    }

    /// Enter: begins a task that was read, marks a place, or ends.
    pub(super) fn mark(&mut self) {
        match &self.attempt {
            Some(Attempt {
                phase: Phase::Briefing | Phase::Ended(_),
                ..
            }) => self.begins_anew = true,
            Some(attempt) if attempt.is_shown() => self.end_attempt(),
            Some(attempt) if attempt.awaits_diameter() => self.state_diameter(),
            Some(Attempt {
                phase: Phase::Running(_),
                ..
            })
            | None => {
                if let Some(play) = &mut self.play {
                    play.send(ModelRequest::Mark);
                }
            }
        }
    }

    /// States the diameter that is set, if one is.
    fn state_diameter(&mut self) {
        if let (Some(attempt), Some(play)) = (&self.attempt, &mut self.play)
            && let Some(diameter) = attempt.diameter
        {
            play.send(ModelRequest::StateDiameter(1e-3 * f64::from(diameter)));
        }
    }

    /// The arrow keys set the diameter that is to be stated.
    pub(super) fn set_diameter(&mut self, context: &egui::Context) {
        if !context.egui_wants_keyboard_input() {
            let times = |key| context.input(|input| input.num_presses(key)) as i32;
            self.change_diameter(times(egui::Key::ArrowRight) - times(egui::Key::ArrowLeft));
        }
    }

    /// Sets the diameter that is to be stated by so many millimetres more or less.
    pub(super) fn change_diameter(&mut self, by: i32) {
        if let Some(attempt) = &mut self.attempt
            && by != 0
            && attempt.awaits_diameter()
            && !attempt.is_shown()
        {
            attempt.change_diameter(by);
        }
    }

    pub(super) fn begin_attempt(&mut self) {
        // A request before the organ is prepared takes effect when it is.
        self.begins = self.preparing().is_some();
        if self.begins {
            return;
        }
        if let (Some(attempt), Some(play)) = (&mut self.attempt, &mut self.play) {
            let training = self.training.as_ref();
            let session = training.map(|training| training.record.new_session(&attempt.task));
            attempt.begin(play, session);
            self.picture.release_tools();
            self.picture.lists_keys = false;
            self.history.clear();
        }
    }

    fn end_attempt(&mut self) {
        if let (Some(attempt), Some(play)) = (&mut self.attempt, &mut self.play) {
            attempt.end(play, false);
            self.keep_result();
        }
    }

    /// Plays the session of a folder again, on the organ that is there.
    pub(super) fn replay_session(&mut self, session: &Path) {
        let Some(play) = &self.play else { return };
        let again = SessionFolder::read(session)
            .map_err(Error::from)
            .and_then(|folder| play.played_session(text!("replay-own"), &folder.session))
            .and_then(|session| Play::of_session(session, &self.gpu));
        self.show_again(again);
    }

    /// Shows a session that is played again, in place of an attempt.
    pub(super) fn show_again(&mut self, again: Result<Play, Error>) {
        match again {
            Ok(again) => {
                self.play = Some(again);
                self.attempt = None;
                self.history.clear();
                self.picture.release_tools();
                self.picture.lists_keys = false;
            }
            Err(error) => self.notice = Some(error.to_string()),
        }
    }

    /// Choices and measurements; a trainee within a task sees the organ alone, unless something is
    /// wrong. With a force-feedback device the emergency stop stays.
    pub(super) fn show_panels(&mut self, ui: &mut egui::Ui) {
        if self.compared.is_some() && self.notice.is_none() {
            return;
        }
        let has_devices = self.play.as_ref().is_some_and(Play::has_devices);
        let trains = self.attempt.is_some() || self.begins;
        let is_trainee = trains && !self.engineer_view && !has_devices;
        let is_quiet = self.fault.is_none() && self.notice.is_none() && self.preparation.is_none();
        if !is_trainee || !is_quiet {
            egui::Panel::bottom("status").show(ui, |ui| panel::status(self, ui));
        }
        if !is_trainee {
            egui::Panel::right("panel")
                .resizable(true)
                .default_size(300.0)
                .size_range(220.0..=460.0)
                .show(ui, |ui| panel::side(self, ui));
        }
    }
}

/// The scene next to a session.
fn scene_of(session: &Path) -> Result<Scene, String> {
    let folder = SessionFolder::read(session).map_err(|error| error.to_string())?;
    folder.scene.ok_or_else(|| {
        let folder = session.display().to_string();
        text!("replay-no-scene", folder = folder)
    })
}
