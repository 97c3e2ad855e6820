//! Actions of keys that act once.

use eframe::egui;

use super::hands::keys::{self, Action};
use super::play::ModelRequest;
use super::{SimulatorWindow, gesture};

impl SimulatorWindow {
    /// Does what keys ask for once.
    pub(super) fn act(&mut self, context: &egui::Context) {
        let mut wanted: Vec<Action> = Vec::new();
        if !context.egui_wants_keyboard_input() {
            wanted = context.input(|input| keys::actions(input).collect());
        }
        if std::mem::take(&mut self.takes_other) {
            wanted.push(Action::OtherTool);
        }
        let pads = self.picture.take_requests();
        let of_pads = [
            (pads.mark, Action::Mark),
            (pads.pause, Action::Pause),
            (pads.undo, Action::Undo),
        ];
        let of_pads = of_pads.into_iter().filter(|(is_wanted, _)| *is_wanted);
        wanted.extend(of_pads.map(|(_, action)| action));
        self.change_diameter(pads.larger);
        for action in wanted {
            let request = match action {
                Action::OtherTool => {
                    self.take_other(context);
                    continue;
                }
                Action::Hints => {
                    self.picture.lists_keys = !self.picture.lists_keys;
                    continue;
                }
                Action::Mark => {
                    self.mark();
                    continue;
                }
                Action::EngineerView => {
                    self.engineer_view = !self.engineer_view;
                    continue;
                }
                Action::Undo => ModelRequest::UndoCut,
                Action::Pause => ModelRequest::Pause,
                Action::Reset => ModelRequest::Reset,
            };
            if let Some(play) = &mut self.play {
                play.send(request);
                if request == ModelRequest::Reset {
                    self.picture.release_tools();
                    self.history.clear();
                }
            }
        }
    }

    /// The mouse takes the next tool, which is prepared anew only if nothing could move it before.
    fn take_other(&mut self, context: &egui::Context) {
        let before = self.choice.scene();
        let next = (self.choice.tool + 1) % self.choice.tools().len();
        self.choice.take(next);
        self.radius = 1e3 * self.choice.tip.radius_m;
        self.history.clear();
        self.picture.gesture = gesture::Gesture::default();
        if self.choice.scene() != before {
            self.reset(context);
        }
    }
}
