//! The start screen: what there is to do, who does it, how it went so far, and what this is not.

use eframe::egui::{self, Color32, Frame, Margin, RichText, TextureHandle, Ui};
use egui_plot::{Line, Plot, PlotPoints, Points};
use palpate_files::Scene;

use super::texts;
use super::training::{Assigned, OfferedTask, PastResult, Training};
use crate::style::{DEPTH, FAULT, QUIET, WARNING, WHITE};

/// What was chosen on the start screen.
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
    /// What went wrong with what was chosen last.
    pub(super) trouble: Option<String>,
    /// Whose results are shown, and what they are.
    results: Option<(String, Result<Vec<PastResult>, String>)>,
    /// What they shall do.
    assigned: Vec<Assigned>,
    /// The pictures of the tasks, once they are shown.
    pictures: Vec<Option<TextureHandle>>,
}

/// What this is not.
const NOT: &str = "What it is not: there is no bleeding, no smoke and no suturing; neighbours stop the \
                   tips of tools and an organ that bends, but no shafts; a mouse gives no force. It is no certified medical device, and a score here has not been \
                   shown to predict one in an operating room.";

impl Home {
    /// Shows it; what was chosen.
    pub(super) fn show(&mut self, ui: &mut Ui, training: &mut Training) -> Option<Chosen> {
        let mut chosen = None;
        let margin = Margin::symmetric(28, 20);
        Frame::new().inner_margin(margin).show(ui, |ui| {
            egui::ScrollArea::vertical()
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.label(RichText::new("palpate").size(34.0).color(WHITE));
                        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                            let is_clicked =
                                ui.button(texts::SETTINGS).on_hover_text("or F2").clicked();
                            if is_clicked || ui.input(|input| input.key_pressed(egui::Key::F2)) {
                                chosen = Some(Chosen::Settings);
                            }
                            let is_clicked =
                                ui.button(texts::CLASS).on_hover_text("or F3").clicked();
                            if is_clicked || ui.input(|input| input.key_pressed(egui::Key::F3)) {
                                chosen = Some(Chosen::Class);
                            }
                        });
                    });
                    ui.label(
                        RichText::new("organs that answer a touch, to practise on").color(QUIET),
                    );
                    if let Some(trouble) = &self.trouble {
                        ui.colored_label(FAULT, trouble);
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
                    ui.label(RichText::new(NOT).color(QUIET));
                });
        });
        chosen
    }

    fn tasks(&mut self, ui: &mut Ui, training: &Training, chosen: &mut Option<Chosen>) {
        ui.label(RichText::new("Tasks").size(20.0).color(WHITE));
        ui.add_space(4.0);
        if self.pictures.len() != training.tasks.len() {
            let pictures = training.tasks.iter();
            self.pictures = pictures.map(|task| texture(ui, task)).collect();
        }
        let pictures = self.pictures.clone();
        let results = self.results(training);
        for (number, (task, picture)) in training.tasks.iter().zip(&pictures).enumerate() {
            let scene = &task.scene;
            let title = title(scene);
            let own: Vec<&PastResult> = results
                .iter()
                .flatten()
                .filter(|result| result.task == title)
                .collect();
            let words = scene.task.instructions.as_deref().unwrap_or("");
            let shown = Shown {
                words,
                standing: standing(&own),
                picture: picture.as_ref(),
            };
            if entry(ui, title, &shown) {
                *chosen = Some(Chosen::Task(number));
            }
        }
        let words = "Touch, hold, pull and cut as you like. Nothing is recorded.";
        let shown = Shown {
            words,
            standing: None,
            picture: None,
        };
        if entry(ui, "Free play", &shown) {
            *chosen = Some(Chosen::Free);
        }
    }

    fn person(&mut self, ui: &mut Ui, training: &mut Training, chosen: &mut Option<Chosen>) {
        ui.label(RichText::new("You").size(20.0).color(WHITE));
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            ui.label("name");
            let field = egui::TextEdit::singleline(&mut training.trainee).desired_width(180.0);
            ui.add(field)
                .on_hover_text("results are kept under this name");
        });
        let words = format!("sessions are kept in {}", training.sessions.display());
        ui.label(RichText::new(words).small().color(QUIET));
        ui.add_space(10.0);
        let _ = self.results(training);
        for own in &self.assigned {
            assigned(ui, own);
        }
        match self.results(training) {
            Err(trouble) => {
                ui.colored_label(FAULT, trouble);
            }
            Ok(results) if results.is_empty() => {
                ui.label(RichText::new("No results yet.").color(QUIET));
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

fn title(scene: &Scene) -> &str {
    scene.task.title.as_deref().unwrap_or("without a title")
}

/// A line of what somebody shall do.
fn assigned(ui: &mut Ui, own: &Assigned) {
    let (words, color) = match (own.passed >= own.passes, own.is_over) {
        (true, _) => ("done", DEPTH),
        (false, false) => ("assigned", WARNING),
        (false, true) => ("late", FAULT),
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new(words).strong().color(color));
        ui.label(format!(
            "{}: pass {} times by {}; {} so far",
            own.task, own.passes, own.due, own.passed
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
    let tried = match own.len() {
        1 => "tried once".to_owned(),
        count => format!("tried {count} times"),
    };
    Some((
        format!("{tried}, passed {passed}; last {:.0} s", last.time),
        passed > 0,
    ))
}

/// The picture of a task, for the screen.
fn texture(ui: &Ui, task: &OfferedTask) -> Option<TextureHandle> {
    let picture = task.picture.as_ref()?;
    let size = picture.size.map(|length| length as usize);
    let image = egui::ColorImage::from_rgba_unmultiplied(size, &picture.pixels);
    let name = title(&task.scene).to_owned();
    Some(
        ui.ctx()
            .load_texture(name, image, egui::TextureOptions::LINEAR),
    )
}

/// What is shown of a thing to choose, below its title.
struct Shown<'a> {
    words: &'a str,
    /// How it went so far, and whether it was ever done.
    standing: Option<(String, bool)>,
    picture: Option<&'a TextureHandle>,
}

/// Height of the picture of a task [points].
const PICTURE: f32 = 92.0;

/// One thing to choose. Whether it was.
fn entry(ui: &mut Ui, title: &str, shown: &Shown<'_>) -> bool {
    let frame = Frame::new()
        .fill(Color32::from_rgb(30, 34, 41))
        .corner_radius(6.0)
        .inner_margin(Margin::symmetric(14, 10));
    let mut clicked = false;
    let card = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).size(16.0).color(WHITE));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                clicked = ui.button("Open").clicked();
            });
        });
        ui.horizontal_top(|ui| {
            if let Some(picture) = shown.picture {
                let size = picture.size_vec2();
                let size = size * (PICTURE / size.y.max(1.0));
                ui.add(egui::Image::new((picture.id(), size)).corner_radius(4.0));
            }
            // A column would stretch its lines.
            ui.with_layout(egui::Layout::top_down(egui::Align::LEFT), |ui| {
                ui.label(RichText::new(shown.words).color(QUIET));
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
        let words = format!("{}: time [s] over attempts", last.task);
        ui.label(RichText::new(words).small().color(DEPTH));
        Plot::new("learning")
            .height(130.0)
            .include_y(0.0)
            .include_x(0.5)
            .include_x(times.len() as f64 + 0.5)
            .x_grid_spacer(egui_plot::uniform_grid_spacer(|_| [1.0, 5.0, 10.0]))
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .show(ui, |plot| {
                let points = PlotPoints::from(times.clone());
                plot.line(Line::new("time", PlotPoints::from(times)).color(DEPTH));
                plot.points(Points::new("attempts", points).radius(3.0).color(DEPTH));
            });
    }
    ui.add_space(6.0);
    egui::Grid::new("past")
        .num_columns(5)
        .spacing([14.0, 4.0])
        .show(ui, |ui| {
            for result in results.iter().rev().take(8) {
                ui.label(RichText::new(&result.date).small().color(QUIET));
                ui.label(&result.task);
                let (words, color) = match result.passed {
                    Some(true) => ("passed", DEPTH),
                    Some(false) => ("not passed", WARNING),
                    None => ("", QUIET),
                };
                ui.colored_label(color, words);
                ui.label(format!("{:.0} s, {} errors", result.time, result.errors));
                if result.session.exists() && ui.small_button("look").clicked() {
                    *chosen = Some(Chosen::Session(result.session.clone()));
                }
                ui.end_row();
            }
        });
}
