//! The teacher's page: who has done what is assigned, and how trainees learn each task.

use eframe::egui::{self, Color32, Frame, Key, Margin, RichText, Ui};
use egui_plot::{HLine, Legend, Line, LineStyle, Plot, PlotPoints, Points};

use super::texts;
use super::training::{AssignedTask, Class, TaskProgress};
use crate::style::{DEPTH, FAULT, FORCE, QUIET, WARNING, WHITE};

/// The page, while it is shown.
pub(super) struct ClassPage(pub(super) Result<Class, String>);

/// One trainee beside the mean of all.
const EACH: Color32 = Color32::from_rgb(104, 112, 124);

impl ClassPage {
    /// Shows it; whether somebody leaves it.
    pub(super) fn show(&self, ui: &mut Ui) -> bool {
        let mut is_left = ui.input(|input| input.key_pressed(Key::Escape));
        let margin = Margin::symmetric(28, 20);
        Frame::new().inner_margin(margin).show(ui, |ui| {
            egui::ScrollArea::vertical()
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.label(RichText::new(texts::CLASS).size(34.0).color(WHITE));
                        let back = ui.button(texts::BACK).on_hover_text(texts::BACK_HINT);
                        is_left |= back.clicked();
                    });
                    match &self.0 {
                        Err(trouble) => {
                            ui.colored_label(FAULT, trouble);
                        }
                        Ok(class) => show(ui, class),
                    }
                });
        });
        is_left
    }
}

fn show(ui: &mut Ui, class: &Class) {
    heading(ui, texts::ASSIGNMENTS);
    if class.assignments.is_empty() {
        ui.label(RichText::new(texts::NO_ASSIGNMENT).color(QUIET));
    }
    for given in &class.assignments {
        assignment(ui, given);
    }
    heading(ui, texts::LEARNING);
    if class.tasks.is_empty() {
        ui.label(RichText::new(texts::NO_ATTEMPT).color(QUIET));
    }
    for task in &class.tasks {
        progress(ui, task);
    }
}

fn heading(ui: &mut Ui, words: &str) {
    ui.add_space(14.0);
    ui.label(RichText::new(words).size(20.0).color(WHITE));
}

fn heads<const N: usize>(ui: &mut Ui, heads: [&str; N]) {
    for head in heads {
        ui.label(RichText::new(head).small().color(QUIET));
    }
    ui.end_row();
}

fn assignment(ui: &mut Ui, given: &AssignedTask) {
    ui.add_space(6.0);
    let times = if given.passes == 1 { "time" } else { "times" };
    ui.label(format!(
        "{}, {}: pass {} {times} by {}",
        given.task, given.cohort, given.passes, given.due
    ));
    egui::Grid::new(("assignment", &given.cohort, &given.task))
        .num_columns(4)
        .spacing([24.0, 3.0])
        .show(ui, |ui| {
            heads(ui, ["trainee", "standing", "passed", "attempts"]);
            for own in &given.trainees {
                ui.label(&own.trainee);
                let color = match own.standing {
                    "done" => DEPTH,
                    "late" => FAULT,
                    _ => WARNING,
                };
                ui.label(RichText::new(own.standing).color(color));
                ui.label(own.passed.to_string());
                ui.label(own.attempts.to_string());
                ui.end_row();
            }
        });
}

fn progress(ui: &mut Ui, task: &TaskProgress) {
    ui.add_space(6.0);
    ui.label(RichText::new(&task.task).size(16.0).color(WHITE));
    egui::Grid::new(("progress", &task.task))
        .num_columns(4)
        .spacing([24.0, 3.0])
        .show(ui, |ui| {
            heads(
                ui,
                ["trainee", "attempts", "passed", "proficient since attempt"],
            );
            for own in &task.trainees {
                ui.label(&own.trainee);
                ui.label(own.attempts.to_string());
                ui.label(own.passed.to_string());
                let since = own.proficient_since.map(|attempt| attempt.to_string());
                ui.label(since.unwrap_or_else(|| "not yet".to_owned()));
                ui.end_row();
            }
        });
    ui.label(RichText::new(texts::TIMES).small().color(QUIET));
    Plot::new(("times", &task.task))
        .height(170.0)
        .include_y(0.0)
        .include_x(0.5)
        .legend(Legend::default())
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show(ui, |plot| {
            for own in &task.trainees {
                let points = PlotPoints::from(own.times.clone());
                plot.line(Line::new("each trainee", points).color(EACH).width(1.0));
            }
            let points = || PlotPoints::from(task.mean_times.clone());
            plot.line(
                Line::new("mean of trainees", points())
                    .color(DEPTH)
                    .width(2.5),
            );
            plot.points(
                Points::new("mean of trainees", points())
                    .color(DEPTH)
                    .radius(3.0),
            );
            if let Some(time) = task.expert_time {
                let line = HLine::new("mean of experts", time).color(FORCE);
                plot.hline(line.style(LineStyle::dashed_loose()));
            }
        });
}

#[cfg(test)]
mod tests {
    use eframe::egui::accesskit::Role;

    use super::super::training::{TraineeProgress, TraineeStanding};
    use super::*;
    use crate::window::seen::Seen;

    /// Judge: the accessibility tree.
    #[test]
    fn a_teacher_reads_who_is_late() {
        let class = Class {
            assignments: vec![AssignedTask {
                cohort: "spring".to_owned(),
                task: "Palpation".to_owned(),
                due: "2026-12-24".to_owned(),
                passes: 2,
                trainees: vec![TraineeStanding {
                    trainee: "Anna".to_owned(),
                    attempts: 3,
                    passed: 1,
                    standing: "late",
                }],
            }],
            tasks: vec![TaskProgress {
                task: "Palpation".to_owned(),
                trainees: vec![TraineeProgress {
                    trainee: "Anna".to_owned(),
                    attempts: 3,
                    passed: 1,
                    proficient_since: None,
                    times: vec![[1.0, 40.0], [2.0, 30.0], [3.0, 35.0]],
                }],
                mean_times: vec![[1.0, 40.0], [2.0, 30.0], [3.0, 35.0]],
                expert_time: Some(20.0),
            }],
        };
        let page = ClassPage(Ok(class));
        let mut seen = Seen::default();
        let mut is_left = false;
        for _ in 0..2 {
            seen.show(|ui| is_left |= page.show(ui));
        }
        for label in [
            "Palpation, spring: pass 2 times by 2026-12-24",
            "Anna",
            "late",
            "not yet",
        ] {
            assert!(seen.has(Role::Label, label), "{label}: {:?}", seen.labels());
        }
        assert!(!is_left);
        seen.press(Key::Escape);
        seen.show(|ui| is_left |= page.show(ui));
        assert!(is_left);
        let broken = ClassPage(Err("the record is damaged".to_owned()));
        seen.show(|ui| is_left |= broken.show(ui));
        assert!(seen.has(Role::Label, "the record is damaged"));
    }
}
