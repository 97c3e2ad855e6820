//! The start screen: tasks, trainee, results so far, and a disclaimer.

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Frame, Margin, RichText, TextureHandle, Ui};
use egui_plot::{Line, PlotPoints, Points};

use super::page::{self, or_key, quiet};
use super::texts::{of_task, text};
use super::training::{Assigned, OfferedTask, PastResult, Training};
use crate::style::{CARD, DEPTH, FAULT, QUIET, WARNING, WHITE};

/// A choice on the start screen.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Chosen {
    /// A task, by its number.
    Task(usize),
    /// To touch without a task.
    Free,
    /// To change settings.
    Settings,
    /// To see all trainees.
    Class,
    /// To look at a session again.
    Session(std::path::PathBuf),
}

/// The start screen.
#[derive(Default)]
pub(super) struct Home {
    /// Error of the last choice.
    pub(super) error: Option<String>,
    /// Whose results are shown, and what they are.
    results: Option<(String, Result<Vec<PastResult>, String>)>,
    /// Their assignments.
    assigned: Vec<Assigned>,
    /// The pictures of the tasks, once they are shown.
    pictures: Vec<Option<TextureHandle>>,
}

impl Home {
    /// Shows it; what was chosen.
    pub(super) fn show(&mut self, ui: &mut Ui, training: &mut Training) -> Option<Chosen> {
        let mut chosen = None;
        page::frame(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new("palpate").size(34.0).color(WHITE));
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    let mut other = |key, name: &str, words| {
                        let button = ui.button(words).on_hover_text(or_key(name));
                        button.clicked() || ui.input(|input| input.key_pressed(key))
                    };
                    if other(egui::Key::F2, "F2", text!("settings-title")) {
                        chosen = Some(Chosen::Settings);
                    }
                    if other(egui::Key::F3, "F3", text!("class-title")) {
                        chosen = Some(Chosen::Class);
                    }
                });
            });
            ui.label(quiet(text!("home-subtitle")));
            if let Some(error) = &self.error {
                ui.colored_label(FAULT, error);
            }
            ui.add_space(14.0);
            let wide = ui.available_width() > 760.0;
            if wide {
                ui.columns(2, |columns| {
                    self.tasks(&mut columns[0], training, &mut chosen);
                    self.person(&mut columns[1], training, &mut chosen);
                });
            } else {
                self.tasks(ui, training, &mut chosen);
                ui.add_space(14.0);
                self.person(ui, training, &mut chosen);
            }
            ui.add_space(18.0);
            ui.separator();
            ui.label(quiet(text!("home-limits")));
        });
        chosen
    }

    fn tasks(&mut self, ui: &mut Ui, training: &Training, chosen: &mut Option<Chosen>) {
        page::heading(ui, &text!("common-tasks"));
        if self.pictures.len() != training.tasks.len() {
            let pictures = training.tasks.iter();
            self.pictures = pictures.map(|task| texture(ui, task)).collect();
        }
        let pictures = self.pictures.clone();
        let results = self.results(training);
        for (number, (task, picture)) in training.tasks.iter().zip(&pictures).enumerate() {
            let own = &task.scene.task;
            let named = own.title.as_deref();
            let past = results.iter().flatten();
            let past = past.filter(|result| Some(result.task.as_str()) == named);
            let title = named.map_or_else(|| text!("common-untitled"), of_task);
            let shown = Shown {
                words: own.instructions.as_deref().map(of_task).unwrap_or_default(),
                standing: standing(&past.collect::<Vec<_>>()),
                picture: picture.as_ref(),
            };
            if entry(ui, &title, &shown) {
                *chosen = Some(Chosen::Task(number));
            }
        }
        let shown = Shown {
            words: text!("home-free-hint"),
            standing: None,
            picture: None,
        };
        if entry(ui, &text!("common-free-play"), &shown) {
            *chosen = Some(Chosen::Free);
        }
    }

    fn person(&mut self, ui: &mut Ui, training: &mut Training, chosen: &mut Option<Chosen>) {
        page::heading(ui, &text!("home-you"));
        ui.horizontal(|ui| {
            let label = ui.label(text!("home-name"));
            let field = egui::TextEdit::singleline(&mut training.trainee).desired_width(180.0);
            let field = ui.add(field).labelled_by(label.id);
            field.on_hover_text(text!("home-name-hint"));
        });
        let folder = training.sessions.display().to_string();
        let words = text!("home-sessions-in", folder = folder);
        ui.label(quiet(words).small());
        ui.add_space(10.0);
        let _ = self.results(training);
        for own in &self.assigned {
            assigned(ui, own);
        }
        match self.results(training) {
            Err(error) => {
                ui.colored_label(FAULT, error);
            }
            Ok(results) if results.is_empty() => {
                ui.label(quiet(text!("home-no-results")));
            }
            Ok(results) => past(ui, results, chosen),
        }
    }

    fn results(&mut self, training: &Training) -> &Result<Vec<PastResult>, String> {
        let trainee = training.trainee.trim();
        if self.results.as_ref().is_some_and(|(own, _)| own != trainee) {
            self.results = None;
        }
        if self.results.is_none() {
            // Where the record cannot be read, the results say so.
            self.assigned = training.record.assigned(trainee).unwrap_or_default();
        }
        let read = || (trainee.to_owned(), training.record.results(trainee));
        &self.results.get_or_insert_with(read).1
    }
}

/// A line of what somebody shall do.
fn assigned(ui: &mut Ui, own: &Assigned) {
    let (words, color) = match (own.passed >= own.passes, own.is_over) {
        (true, _) => (text!("standing-done"), DEPTH),
        (false, false) => (text!("standing-open"), WARNING),
        (false, true) => (text!("standing-late"), FAULT),
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(words).strong().color(color));
        ui.label(text!(
            "home-assigned",
            task = of_task(&own.task),
            passes = own.passes,
            due = own.due.as_str(),
            passed = own.passed
        ));
    });
}

/// How often a task was tried and done, in words; whether it was ever done.
fn standing(own: &[&PastResult]) -> Option<(String, bool)> {
    let last = own.last()?;
    let passed = own
        .iter()
        .filter(|result| result.passed == Some(true))
        .count();
    let words = text!(
        "home-tried",
        count = own.len(),
        passed = passed,
        s = last.time.round()
    );
    Some((words, passed > 0))
}

/// The picture of a task, for the screen.
fn texture(ui: &Ui, task: &OfferedTask) -> Option<TextureHandle> {
    let picture = task.picture.as_ref()?;
    let size = picture.size.map(|length| length as usize);
    let image = egui::ColorImage::from_rgba_unmultiplied(size, &picture.pixels);
    let name = task.scene.task.title.clone().unwrap_or_default();
    let options = egui::TextureOptions::LINEAR;
    Some(ui.ctx().load_texture(name, image, options))
}

/// Contents of a choice below its title.
struct Shown<'a> {
    words: String,
    /// How it went so far, and whether it was ever done.
    standing: Option<(String, bool)>,
    picture: Option<&'a TextureHandle>,
}

/// Height of the picture of a task [points].
const PICTURE: f32 = 92.0;

/// One thing to choose. Whether it was.
fn entry(ui: &mut Ui, title: &str, shown: &Shown<'_>) -> bool {
    let frame = Frame::new()
        .fill(CARD)
        .corner_radius(6.0)
        .inner_margin(Margin::symmetric(14, 10));
    let mut clicked = false;
    let card = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).size(16.0).color(WHITE));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let button = ui.button(text!("home-open"));
                page::name(
                    &button,
                    Role::Button,
                    &text!("home-open-task", task = title),
                );
                clicked = button.clicked();
            });
        });
        ui.horizontal_top(|ui| {
            if let Some(picture) = shown.picture {
                let size = picture.size_vec2();
                let size = size * (PICTURE / size.y.max(1.0));
                let image = egui::Image::new((picture.id(), size)).alt_text(title);
                ui.add(image.corner_radius(4.0));
            }
            // A column would stretch its lines.
            ui.with_layout(egui::Layout::top_down(egui::Align::LEFT), |ui| {
                ui.label(RichText::new(&shown.words).color(QUIET));
                if let Some((standing, passed)) = &shown.standing {
                    let color = if *passed { DEPTH } else { WARNING };
                    ui.label(RichText::new(standing).small().color(color));
                }
            });
        });
    });
    // The whole card opens.
    // Its button has the keyboard's focus already.
    clicked |= card.response.interact(egui::Sense::CLICK).clicked();
    ui.add_space(8.0);
    clicked
}

/// The learning curve of the task that was tried last, and the last sessions.
fn past(ui: &mut Ui, results: &[PastResult], chosen: &mut Option<Chosen>) {
    let own = |last: &PastResult| -> Vec<[f64; 2]> {
        let own = results.iter().filter(|result| result.task == last.task);
        let numbered = (1..).map(f64::from).zip(own);
        numbered
            .map(|(number, result)| [number, result.time])
            .collect()
    };
    if let Some(last) = results.last()
        && let times = own(last)
        && times.len() > 1
    {
        let words = text!("home-learning", task = of_task(&last.task));
        ui.label(RichText::new(&words).small().color(DEPTH));
        let shown = page::still_plot("learning", 130.0)
            .include_x(0.5)
            .include_x(times.len() as f64 + 0.5)
            .x_grid_spacer(egui_plot::uniform_grid_spacer(|_| [1.0, 5.0, 10.0]))
            .show(ui, |plot| {
                let points = PlotPoints::from(times.clone());
                plot.line(Line::new("time", PlotPoints::from(times)).color(DEPTH));
                plot.points(Points::new("attempts", points).radius(3.0).color(DEPTH));
            });
        page::name(&shown.response, Role::Image, &words);
    }
    ui.add_space(6.0);
    egui::Grid::new("past")
        .num_columns(5)
        .spacing([14.0, 4.0])
        .show(ui, |ui| {
            for result in results.iter().rev().take(8) {
                ui.label(quiet(&result.date).small());
                let task = of_task(&result.task);
                ui.label(&task);
                let (words, color) = passed_words(result.passed);
                ui.colored_label(color, words);
                ui.label(time_and_errors(result.time, result.errors));
                if result.session.exists() {
                    let button = ui.small_button(text!("common-replay"));
                    let date = result.date.as_str();
                    let words = text!("home-replay-session", task = task, date = date);
                    page::name(&button, Role::Button, &words);
                    if button.clicked() {
                        *chosen = Some(Chosen::Session(result.session.clone()));
                    }
                }
                ui.end_row();
            }
        });
}

/// Whether an attempt was passed, in words; nothing where nothing had to be done.
pub(super) fn passed_words(passed: Option<bool>) -> (String, egui::Color32) {
    match passed {
        Some(true) => (text!("common-passed"), DEPTH),
        Some(false) => (text!("common-not-passed"), WARNING),
        None => (String::new(), QUIET),
    }
}

/// Time [s] and errors of an attempt.
pub(super) fn time_and_errors(time: f64, errors: u64) -> String {
    text!("common-time-errors", s = time.round(), errors = errors)
}
