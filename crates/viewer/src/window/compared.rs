//! Two sessions side by side on one clock: an attempt, and the demonstration or another session.
//!
//! The longer session has the clock; the other one follows it by the time since its own beginning, and shows its last
//! step where it is over.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, UiBuilder, Vec2};
use eframe::egui_wgpu::RenderState;
use palpate_files::Session;
use palpate_simulate::{Demonstration, SessionFolder};

use super::picture::OrganView;
use super::play::Play;
use super::source::Playback;
use super::texts::text;
use super::{PlayedSession, SimulatorWindow, timeline};
use crate::Error;
use crate::style::WHITE;

/// Between the pictures [points].
const GAP: f32 = 4.0;

/// The session on the right.
pub(super) struct Compared {
    /// Names of the session on the left and of this one.
    names: [String; 2],
    pub(super) play: Play,
    picture: OrganView,
}

/// A demonstration that is computed on a thread of its own.
pub(super) struct ShownDemonstration {
    outcome: Receiver<Option<Session>>,
    /// How far it is, from 0 to 1 [-].
    part: Arc<Mutex<f64>>,
    is_cancelled: Arc<AtomicBool>,
    /// The session on the left.
    folder: SessionFolder,
}

impl ShownDemonstration {
    /// Begins to compute the demonstration of the task of `play`.
    fn start(play: &Play, folder: SessionFolder, context: egui::Context) -> Option<Self> {
        let (sender, outcome) = channel();
        let part = Arc::new(Mutex::new(0.0));
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let (shared_part, cancelled) = (part.clone(), is_cancelled.clone());
        let (scene, simulation) = (play.scene.clone(), play.simulation.clone());
        let thread = std::thread::Builder::new().name("palpate-demonstration".to_owned());
        let thread = thread.spawn(move || {
            let session = Demonstration::record(&scene, &simulation, &mut |part| {
                *shared_part.lock().unwrap_or_else(PoisonError::into_inner) = part;
                match cancelled.load(Ordering::Relaxed) {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            });
            // Fails when the comparison was closed.
            let _ = sender.send(session);
            context.request_repaint();
        });
        thread.ok()?;
        Some(Self {
            outcome,
            part,
            is_cancelled,
            folder,
        })
    }

    /// How far it is, from 0 to 1 [-].
    pub(super) fn part(&self) -> f64 {
        *self.part.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for ShownDemonstration {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

impl SimulatorWindow {
    /// Shows `other` on the right of the session that is played again, which is called `name`.
    ///
    /// # Errors
    /// When a neighbour cannot be read.
    pub(super) fn compare(&mut self, name: String, other: PlayedSession) -> Result<(), Error> {
        let names = [name, other.name.clone()];
        let picture = OrganView::new(&self.gpu, other.scene.view.shading);
        let play = Play::of_session(other, &self.gpu)?;
        self.compared = Some(Box::new(Compared {
            names,
            play,
            picture,
        }));
        Ok(())
    }

    /// Begins to compute the demonstration of the attempted task, for comparison with the session in `folder`.
    pub(super) fn compare_with_demonstration(
        &mut self,
        folder: &std::path::Path,
        context: &egui::Context,
    ) {
        let Some(play) = &self.play else { return };
        match SessionFolder::read(folder) {
            Ok(folder) => {
                self.shown_demonstration = ShownDemonstration::start(play, folder, context.clone());
            }
            Err(error) => self.notice = Some(error.to_string()),
        }
    }

    /// Shows the demonstration once it is computed.
    pub(super) fn watch_demonstration(&mut self, context: &egui::Context) {
        let Some(own) = &self.shown_demonstration else {
            return;
        };
        let session = match own.outcome.try_recv() {
            Err(TryRecvError::Empty) => {
                context.request_repaint_after(super::REST);
                return;
            }
            Ok(session) => session,
            Err(TryRecvError::Disconnected) => None,
        };
        let Some(own) = self.shown_demonstration.take() else {
            return;
        };
        let (Some(session), Some(play)) = (session, &self.play) else {
            self.notice = Some(text!("demonstration-none"));
            return;
        };
        let shown = play
            .played_session(text!("replay-own"), &own.folder.session)
            .and_then(|left| {
                Ok((
                    left,
                    play.played_session(text!("common-demonstration"), &session)?,
                ))
            })
            .and_then(|(left, right)| Ok((Play::of_session(left, &self.gpu)?, right)))
            .and_then(|(left, right)| {
                self.compare(text!("replay-own"), right)?;
                Ok(left)
            });
        self.show_again(shown);
    }

    /// Both pictures, each in its half, from the same place.
    pub(super) fn show_both(&mut self, ui: &mut egui::Ui, state: &RenderState) {
        let (Some(compared), Some(play)) = (&mut self.compared, &mut self.play) else {
            return;
        };
        let whole = ui.max_rect();
        let width = 0.5 * (whole.width() - GAP);
        let size = Vec2::new(width, whole.height());
        let left = Rect::from_min_size(whole.min, size);
        let right = Rect::from_min_size(whole.min + Vec2::new(width + GAP, 0.0), size);
        // The forces on the right are not plotted.
        drop(compared.play.source.rows());
        let [own, other] = &compared.names;
        let mut half = |rect: Rect, picture: &mut OrganView, play: &mut Play, name: &str| {
            ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
                picture.show(ui, state, &self.gpu, play, 0);
                title(ui, rect, name);
            });
        };
        half(left, &mut self.picture, play, own);
        compared.picture.copy_view(&self.picture);
        half(right, &mut compared.picture, &mut compared.play, other);
        self.picture.copy_view(&compared.picture);
    }

    /// The line below sessions that are played again.
    pub(super) fn show_timeline(&mut self, ui: &mut egui::Ui) {
        let can_leave = self.training.is_some();
        let elapsed = f64::from(ui.input(|input| input.unstable_dt));
        let Some(own) = self.play.as_mut().and_then(|play| play.source.playback()) else {
            return;
        };
        let compared = self.compared.as_mut();
        let other = compared.and_then(|compared| compared.play.source.playback());
        let (clock, follower) = with_clock(own, other);
        clock.go_on(elapsed);
        let leaves = egui::Panel::bottom("timeline")
            .show(ui, |ui| timeline::show(ui, clock, can_leave))
            .inner;
        if let Some(follower) = follower {
            follower.follow(clock.seen_at(), clock.plays);
        }
        if leaves {
            self.go_home();
        }
    }
}

/// The longer one of two sessions, and the other one.
fn with_clock<'a>(
    own: &'a mut Playback,
    other: Option<&'a mut Playback>,
) -> (&'a mut Playback, Option<&'a mut Playback>) {
    match other {
        Some(other) if other.duration() > own.duration() => (other, Some(own)),
        other => (own, other),
    }
}

/// Writes what is seen in a half above it.
fn title(ui: &egui::Ui, rect: Rect, name: &str) {
    let painter = ui.painter_at(rect);
    let at = Pos2::new(rect.center().x, rect.min.y + 12.0);
    let text = painter.layout_no_wrap(name.to_owned(), FontId::proportional(16.0), WHITE);
    let back = Align2::CENTER_TOP.anchor_size(at, text.size());
    painter.rect_filled(
        back.expand2(Vec2::new(10.0, 4.0)),
        6.0,
        Color32::from_black_alpha(170),
    );
    painter.galley(back.min, text, WHITE);
}

#[cfg(test)]
mod tests {
    use palpate_files::{Pose, Scene, SessionRow};
    use palpate_simulate::{Replay, Simulation, SimulationState, SimulationWorkspace, step};

    use super::*;

    /// A press on a cube that lasts so many steps, played again.
    fn playback(simulation: &Arc<Simulation>, steps: u32, begins: f64) -> Playback {
        let mut state = SimulationState::new(simulation);
        let mut workspace = SimulationWorkspace::new(simulation);
        let mut rows: Vec<SessionRow> = Vec::new();
        for number in 0..steps {
            let time = begins + 0.01 * f64::from(number);
            let elapsed = if number == 0 { 0.0 } else { 0.01 };
            let pose = Pose {
                position_m: [0.0, 0.0, 0.052 - 1e-5 * f64::from(number)],
                orientation: None,
                grip: 0.0,
                cut: false,
            };
            step(
                simulation,
                time,
                elapsed,
                &[Some(pose)],
                &mut state,
                &mut workspace,
            );
            rows.push(state.tools[0].row);
        }
        let session = Session {
            header: simulation.session_header(),
            tools: vec!["right".to_owned()],
            rows,
            has_torques: true,
            incomplete: None,
        };
        let mut replay = Replay::new(simulation.clone(), &session).unwrap();
        replay.go_to(0);
        Playback::new(simulation, replay)
    }

    /// The longer one has the clock; both show the same time since their beginnings, forth and back, and the shorter one
    /// its end. Judge: the times of the steps that are seen. Tolerance: a step of 10 ms.
    #[test]
    fn both_sessions_show_the_same_time() {
        let text = "format = 1\n[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n[[tool]]\nname = \"right\"\n";
        let scene = Scene::parse(text, "scene.toml").unwrap();
        let simulation = Arc::new(Simulation::new(&scene).unwrap());
        let mut short = playback(&simulation, 40, 0.0);
        let mut long = playback(&simulation, 100, 3.5);
        {
            let (clock, follower) = with_clock(&mut short, Some(&mut long));
            assert!(clock.duration() > 0.9 && follower.unwrap().duration() < 0.45);
        }
        let end = short.duration();
        for time in [0.2, 0.35, 0.8, 0.1, 0.0, 0.99] {
            // A picture has a budget of time; the tenth is there on any machine.
            for _ in 0..50 {
                long.follow(time, false);
                let at = long.seen_at();
                short.follow(at, false);
            }
            assert!((long.seen_at() - time).abs() < 0.0101, "{time}");
            let wanted = long.seen_at().min(end);
            assert!(
                (short.seen_at() - wanted).abs() < 0.0101,
                "{time}: {}",
                short.seen_at()
            );
        }
    }
}
