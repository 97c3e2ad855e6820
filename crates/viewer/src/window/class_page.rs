//! The teacher's page: progress of assignments, and learning curves of each task.

use eframe::egui::accesskit::Role;
use eframe::egui::{self, RichText, Ui};
use egui_plot::{HLine, Legend, Line, LineStyle, PlotPoints, Points};

use super::page::{self, heading, quiet};
use super::texts::{of_task, text};
use super::training::{AssignedTask, Class, NewAssignment, StandingWord, TaskProgress};
use crate::style::{DEPTH, EACH, FAULT, FORCE, WARNING, WHITE};

/// The page, while it is shown.
pub(super) struct ClassPage {
    class: Result<Class, String>,
    /// Titles of the tasks that can be assigned.
    tasks: Vec<String>,
    /// The assignment as it is filled in.
    form: NewAssignment,
    /// Outcome of the last assignment.
    said: Option<Result<String, String>>,
}

/// Action on the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum ClassPageAction {
    /// To leave it.
    Leave,
    /// To assign a task.
    Assign(NewAssignment),
}

impl ClassPage {
    /// Of a class, with the titles of the tasks that can be assigned.
    pub(super) fn new(class: Result<Class, String>, tasks: Vec<String>) -> Self {
        let mut assignees = class.iter().flat_map(|class| &class.assignees);
        Self {
            form: NewAssignment {
                to: assignees.next().cloned().unwrap_or_default(),
                task: tasks.first().cloned().unwrap_or_default(),
                passes: 1,
                ..NewAssignment::default()
            },
            class,
            tasks,
            said: None,
        }
    }

    /// Takes over what came of an assignment, and the class after it.
    pub(super) fn take(&mut self, outcome: Result<(), String>, class: Result<Class, String>) {
        let NewAssignment { to, task, due, .. } = &self.form;
        let said = outcome.map(|()| {
            let task = of_task(task);
            text!("class-given", task = task, to = to, due = due)
        });
        self.said = Some(said);
        self.class = class;
    }

    /// Shows it; what somebody wants.
    pub(super) fn show(&mut self, ui: &mut Ui) -> Option<ClassPageAction> {
        let mut wanted = None;
        let title = text!("class-title");
        let is_left = page::closable_page(ui, &title, |ui| {
            let class = match &self.class {
                Err(error) => {
                    ui.colored_label(FAULT, error);
                    return;
                }
                Ok(class) => class,
            };
            heading(ui, &text!("class-assignments"));
            if class.assignments.is_empty() {
                ui.label(quiet(text!("class-no-assignment")));
            }
            for given in &class.assignments {
                assignment(ui, given);
            }
            ui.add_space(6.0);
            if class.assignees.is_empty() {
                ui.label(quiet(text!("class-nobody")));
            } else {
                let choices = [class.assignees.as_slice(), self.tasks.as_slice()];
                if form(ui, &mut self.form, choices) {
                    wanted = Some(ClassPageAction::Assign(self.form.clone()));
                }
            }
            match &self.said {
                Some(Ok(said)) => drop(ui.colored_label(DEPTH, said)),
                Some(Err(error)) => drop(ui.colored_label(FAULT, error)),
                None => {}
            }
            heading(ui, &text!("class-learning"));
            if class.tasks.is_empty() {
                ui.label(quiet(text!("class-no-attempt")));
            }
            for task in &class.tasks {
                progress(ui, task);
            }
        });
        match is_left {
            true => Some(ClassPageAction::Leave),
            false => wanted,
        }
    }
}

/// The form of an assignment; whether it is to be given.
fn form(ui: &mut Ui, form: &mut NewAssignment, [assignees, tasks]: [&[String]; 2]) -> bool {
    egui::Grid::new("assign")
        .num_columns(2)
        .spacing([18.0, 4.0])
        .show(ui, |ui| {
            choice(ui, "class-to", &mut form.to, assignees);
            choice(ui, "class-task", &mut form.task, tasks);
            let label = ui.label(text!("class-due"));
            let field = egui::TextEdit::singleline(&mut form.due).hint_text("2026-12-24");
            ui.add(field).labelled_by(label.id);
            ui.end_row();
            let label = ui.label(text!("class-passes"));
            let number = egui::DragValue::new(&mut form.passes).range(1..=1000);
            ui.add(number).labelled_by(label.id);
            ui.end_row();
            let label = ui.label(text!("class-pin"));
            let field = egui::TextEdit::singleline(&mut form.pin).password(true);
            ui.add(field).labelled_by(label.id);
            ui.end_row();
        });
    ui.button(text!("class-assign")).clicked()
}

/// A row of the form in which one of some names is chosen.
fn choice(ui: &mut Ui, key: &str, chosen: &mut String, names: &[String]) {
    let label = ui.label(text!(key));
    let combo = egui::ComboBox::from_id_salt(key).selected_text(of_task(chosen));
    let combo = combo.show_ui(ui, |ui| {
        for name in names {
            ui.selectable_value(chosen, name.clone(), of_task(name));
        }
    });
    combo.response.labelled_by(label.id);
    ui.end_row();
}

fn heads<const N: usize>(ui: &mut Ui, heads: [&str; N]) {
    for key in heads {
        ui.label(quiet(text!(key)).small());
    }
    ui.end_row();
}

fn assignment(ui: &mut Ui, given: &AssignedTask) {
    ui.add_space(6.0);
    ui.label(text!(
        "class-assigned",
        task = of_task(&given.task),
        cohort = given.cohort.as_str(),
        passes = given.passes,
        due = given.due.as_str()
    ));
    egui::Grid::new(("assignment", &given.cohort, &given.task))
        .num_columns(4)
        .spacing([24.0, 3.0])
        .show(ui, |ui| {
            let keys = [
                "class-trainee",
                "class-standing",
                "class-passed",
                "class-attempts",
            ];
            heads(ui, keys);
            for own in &given.trainees {
                ui.label(&own.trainee);
                let (key, color) = match own.standing {
                    StandingWord::Done => ("standing-done", DEPTH),
                    StandingWord::Open => ("standing-open", WARNING),
                    StandingWord::Late => ("standing-late", FAULT),
                };
                ui.label(RichText::new(text!(key)).color(color));
                ui.label(own.passed.to_string());
                ui.label(own.attempts.to_string());
                ui.end_row();
            }
        });
}

fn progress(ui: &mut Ui, task: &TaskProgress) {
    ui.add_space(6.0);
    let title = of_task(&task.task);
    ui.label(RichText::new(&title).size(16.0).color(WHITE));
    egui::Grid::new(("progress", &task.task))
        .num_columns(4)
        .spacing([24.0, 3.0])
        .show(ui, |ui| {
            let keys = [
                "class-trainee",
                "class-attempts",
                "class-passed",
                "class-proficient",
            ];
            heads(ui, keys);
            for own in &task.trainees {
                ui.label(&own.trainee);
                ui.label(own.attempts.to_string());
                ui.label(own.passed.to_string());
                let since = own.proficient_since.map(|attempt| attempt.to_string());
                ui.label(since.unwrap_or_else(|| text!("result-not-yet")));
                ui.end_row();
            }
        });
    ui.label(quiet(text!("class-times")).small());
    let (each, mean, experts) = (
        text!("class-each"),
        text!("class-mean"),
        text!("class-experts"),
    );
    let plot = page::still_plot(("times", &task.task), 170.0)
        .include_x(0.5)
        .legend(Legend::default())
        .show(ui, |plot| {
            for own in &task.trainees {
                let points = PlotPoints::from(own.times.clone());
                plot.line(Line::new(&each, points).color(EACH).width(1.0));
            }
            let points = || PlotPoints::from(task.mean_times.clone());
            plot.line(Line::new(&mean, points()).color(DEPTH).width(2.5));
            plot.points(Points::new(&mean, points()).color(DEPTH).radius(3.0));
            if let Some(time) = task.expert_time {
                let line = HLine::new(&experts, time).color(FORCE);
                plot.hline(line.style(LineStyle::dashed_loose()));
            }
        });
    let words = text!("home-learning", task = title);
    page::name(&plot.response, Role::Image, &words);
}

#[cfg(test)]
mod tests {
    use eframe::egui::Key;

    use super::super::training::{TraineeProgress, TraineeStanding};
    use super::*;
    use crate::window::test_page::TestPage;

    /// Judge: the accessibility tree.
    #[test]
    fn a_teacher_reads_who_is_late() {
        let class = Class {
            assignees: vec!["spring".to_owned(), "Anna".to_owned()],
            assignments: vec![AssignedTask {
                cohort: "spring".to_owned(),
                task: "Palpation".to_owned(),
                due: "2026-12-24".to_owned(),
                passes: 2,
                trainees: vec![TraineeStanding {
                    trainee: "Anna".to_owned(),
                    attempts: 3,
                    passed: 1,
                    standing: StandingWord::Late,
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
        let mut page = ClassPage::new(Ok(class.clone()), vec!["Palpation".to_owned()]);
        let mut seen = TestPage::default();
        let look = |seen: &mut TestPage, page: &mut ClassPage| {
            let mut wanted = None;
            for _ in 0..3 {
                seen.show(|ui| wanted = wanted.take().or(page.show(ui)));
            }
            wanted
        };
        assert_eq!(look(&mut seen, &mut page), None);
        for label in [
            "Palpation, spring: pass 2 times by 2026-12-24",
            "Anna",
            "late",
            "not yet",
        ] {
            assert!(seen.has(Role::Label, label), "{label}: {:?}", seen.labels());
        }
        assert_eq!(seen.unnamed(), []);
        // What is filled in is what is asked for.
        page.form.due = "2027-01-31".to_owned();
        seen.click(Role::Button, &text!("class-assign"));
        let asked = NewAssignment {
            to: "spring".to_owned(),
            task: "Palpation".to_owned(),
            due: "2027-01-31".to_owned(),
            passes: 1,
            pin: String::new(),
        };
        assert_eq!(
            look(&mut seen, &mut page),
            Some(ClassPageAction::Assign(asked))
        );
        page.take(Err("the PIN is wrong".to_owned()), Ok(class));
        look(&mut seen, &mut page);
        assert!(seen.has(Role::Label, "the PIN is wrong"));
        seen.press(Key::Escape);
        assert_eq!(look(&mut seen, &mut page), Some(ClassPageAction::Leave));
        let mut broken = ClassPage::new(Err("the record is damaged".to_owned()), Vec::new());
        look(&mut seen, &mut broken);
        assert!(seen.has(Role::Label, "the record is damaged"));
    }
}
