use eframe::egui::accesskit::Role;
use eframe::egui::{self, Button, Color32, Response, RichText, Ui};
use egui_plot::{Line, PlotPoints};
use palpate_files::BuiltinTissue;
use palpate_files::scene::{BuiltinOrgan, ModelKind, Shading, TipContact, TipShape};
use palpate_servo::{LoopReport, Priority, lock_memory};
use palpate_simulate::{TRUSTED_DEPTH, Work};

use super::SimulatorWindow;
use super::enhancement;
use super::page::{self, quiet};
use super::preparation::Preparation;
use super::rates::Rates;
use super::texts::{decimal, text, tool_name};
use crate::history::SPAN;
use crate::style::{DEPTH, FAULT, FORCE, ON_STOP, QUIET, STOP, WARNING};

/// Shows the choices, and force and depth.
pub(super) fn side(window: &mut SimulatorWindow, ui: &mut Ui) {
    egui::ScrollArea::vertical()
        .auto_shrink([false, false])
        .show(ui, |ui| {
            ui.add_space(6.0);
            if window.training.is_some() && ui.button(text!("common-tasks")).clicked() {
                window.go_home();
            }
            // A replayed session and a task cannot be changed.
            if !window.can_choose() {
                look(window, ui);
                ui.separator();
                enhancement::show(window, ui);
                ui.separator();
                force_and_depth(window, ui);
                if !window.is_replaying() {
                    ui.separator();
                    rates(window, ui);
                }
                return;
            }
            let before = window.choice.clone();
            scene(window, ui);
            // Which tool the mouse moves is no matter of the scene.
            let other = window.choice != before && window.choice.scene() != before.scene();
            if ui.button(text!("panel-restart")).clicked() || other {
                let context = ui.ctx().clone();
                window.reset(&context);
            }
            ui.separator();
            look(window, ui);
            ui.separator();
            enhancement::show(window, ui);
            ui.separator();
            force_and_depth(window, ui);
            ui.separator();
            rates(window, ui);
        });
}

/// Organ, tissue, model and tool.
fn scene(window: &mut SimulatorWindow, ui: &mut Ui) {
    let choice = &mut window.choice;
    let given = choice.given_organ();
    egui::Grid::new("scene").num_columns(2).show(ui, |ui| {
        let label = ui.label(text!("panel-organ"));
        let shown = choice
            .organ
            .map_or(given.clone(), |organ| organ.word().to_owned());
        egui::ComboBox::from_id_salt("organ")
            .selected_text(shown)
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut choice.organ, None, given);
                for (word, organ) in BuiltinOrgan::WORDS {
                    ui.selectable_value(&mut choice.organ, Some(*organ), *word);
                }
            })
            .response
            .labelled_by(label.id);
        ui.end_row();
        let label = ui.label(text!("panel-tissue"));
        let shown = choice
            .tissue
            .map_or_else(|| text!("panel-of-scene"), |own| own.word().to_owned());
        egui::ComboBox::from_id_salt("tissue")
            .selected_text(shown)
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut choice.tissue, None, text!("panel-of-scene"));
                for (word, tissue) in BuiltinTissue::WORDS {
                    ui.selectable_value(&mut choice.tissue, Some(*tissue), *word);
                }
            })
            .response
            .labelled_by(label.id);
        ui.end_row();
        model(choice, ui);
        tool(choice, &mut window.radius, ui);
    });
}

fn model(choice: &mut super::Choice, ui: &mut Ui) {
    let label = ui.label(text!("panel-model"));
    let words = |kind| {
        text!(match kind {
            ModelKind::Local => "panel-local",
            ModelKind::Hybrid => "panel-hybrid",
            ModelKind::Nonlinear => "panel-nonlinear",
        })
    };
    egui::ComboBox::from_id_salt("model")
        .selected_text(words(choice.model))
        .show_ui(ui, |ui| {
            for (_, kind) in ModelKind::WORDS {
                ui.selectable_value(&mut choice.model, *kind, words(*kind));
            }
        })
        .response
        .labelled_by(label.id);
    ui.end_row();
}

fn tool(choice: &mut super::Choice, radius: &mut f64, ui: &mut Ui) {
    let label = ui.label(text!("panel-tool"));
    let tools = choice.tools().iter();
    let names: Vec<String> = tools.map(|tool| tool_name(&tool.name)).collect();
    let mut taken = choice.tool;
    egui::ComboBox::from_id_salt("tool")
        .selected_text(&names[taken])
        .show_ui(ui, |ui| {
            for (number, name) in names.iter().enumerate() {
                ui.selectable_value(&mut taken, number, name);
            }
        })
        .response
        .labelled_by(label.id);
    if taken != choice.tool {
        choice.take(taken);
        *radius = 1e3 * choice.tip.radius_m;
    }
    ui.end_row();
    ui.label(text!("panel-tip"));
    ui.horizontal(|ui| {
        ui.selectable_value(&mut choice.tip.shape, TipShape::Flat, text!("panel-flat"));
        ui.selectable_value(&mut choice.tip.shape, TipShape::Sphere, text!("panel-ball"));
        ui.selectable_value(
            &mut choice.tip.contact,
            TipContact::Stick,
            text!("panel-sticks"),
        );
        ui.selectable_value(
            &mut choice.tip.contact,
            TipContact::Slip,
            text!("panel-slips"),
        );
    });
    ui.end_row();
    let label = ui.label(text!("panel-radius"));
    let slider = egui::Slider::new(radius, 0.5..=8.0)
        .suffix(" mm")
        .max_decimals(1);
    let slider = ui.add(slider).labelled_by(label.id);
    // The model is made anew when the hand lets go, not at every step of the slider.
    if slider.drag_stopped() || slider.changed() && !slider.dragged() {
        choice.tip.radius_m = 1e-3 * *radius;
    }
    ui.end_row();
}

/// How it is drawn.
fn look(window: &mut SimulatorWindow, ui: &mut Ui) {
    let picture = &mut window.picture;
    ui.horizontal_wrapped(|ui| {
        let modes = [
            (Shading::Plain, "look-plain"),
            (Shading::Texture, "look-texture"),
            (Shading::SphereMap, "look-sphere-map"),
            (Shading::CubeMap, "look-cube-map"),
        ];
        for (shading, key) in modes {
            ui.selectable_value(&mut picture.shading, shading, text!(key));
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.selectable_value(&mut picture.endoscope, false, text!("look-orbit"));
        ui.selectable_value(&mut picture.endoscope, true, text!("look-endoscope"));
        if ui
            .button(text!("look-frame"))
            .on_hover_text(text!("look-whole"))
            .clicked()
        {
            picture.reset_framing();
        }
        ui.checkbox(&mut picture.looks.relief, text!("look-relief"));
    });
    match window.surroundings.clone() {
        None => {
            ui.label(quiet(text!("look-drop")).small());
        }
        Some(path) => {
            ui.horizontal_wrapped(|ui| {
                ui.label(RichText::new(text!("look-maps", path = path)).small());
                if ui.small_button(text!("look-own")).clicked() {
                    window.picture.surround(&window.gpu, None);
                    window.surroundings = None;
                }
            });
        }
    }
}

/// Force and depth, as numbers and over time.
fn force_and_depth(window: &SimulatorWindow, ui: &mut Ui) {
    let (force, depth) = window.history.last();
    ui.horizontal(|ui| {
        let number = |text: String, color| RichText::new(text).size(21.0).monospace().color(color);
        ui.label(number(format!("{:6.1} mN", 1e3 * force), FORCE));
        ui.label(number(format!("{:5.2} mm", 1e3 * depth), DEPTH));
    });
    let scale = window
        .play
        .as_ref()
        .map_or(1.0, |play| play.simulation.force_scale());
    ui.label(quiet(text!("felt-scale", scale = scale)).small());
    plot(ui, "felt-force", FORCE, window.history.force());
    plot(ui, "felt-depth", DEPTH, window.history.depth());
}

fn plot(ui: &mut Ui, key: &str, color: Color32, points: Vec<[f64; 2]>) {
    let words = text!(key);
    ui.label(RichText::new(&words).small().color(color));
    let plot = page::still_plot(key, 112.0)
        .include_x(-SPAN)
        .include_x(0.0)
        .include_y(1.0)
        .show(ui, move |plot| {
            let line = Line::new(key, PlotPoints::from(points));
            plot.line(line.color(color).width(1.6));
        });
    page::name(&plot.response, Role::Image, &words);
}

/// Measured rates, versus the nominal ones.
fn rates(window: &SimulatorWindow, ui: &mut Ui) {
    let rates = &window.rates;
    let wanted = window
        .play
        .as_ref()
        .map(|play| 1.0 / play.simulation.step());
    let render_quality = &window.picture.render_quality;
    let priority = |priority: Priority| match priority {
        Priority::RealTime => text!("priority-real-time"),
        Priority::Ordinary => text!("priority-ordinary"),
    };
    egui::Grid::new("rates").num_columns(2).show(ui, |ui| {
        let pixels = render_quality.scale().powi(2);
        row(
            ui,
            text!("rates-display"),
            text!(
                "rates-pictures",
                rate = decimal(rates.display, 0),
                samples = render_quality.samples(),
                pixels = decimal(100.0 * f64::from(pixels), 0),
            ),
        );
        row(
            ui,
            text!("rates-model"),
            text!(
                "rates-of",
                rate = decimal(rates.model, 0),
                wanted = decimal(wanted.unwrap_or(0.0), 0),
                priority = priority(rates.answers.priority),
            ),
        );
        row(
            ui,
            text!("rates-servo"),
            text!(
                "rates-of",
                rate = decimal(rates.servo, 0),
                wanted = "1000",
                priority = priority(rates.touch.priority),
            ),
        );
        quality(rates, ui);
    });
    ui.label(RichText::new(window.gpu.adapter()).small().color(QUIET));
}

/// A row of a grid; what its name means is seen under the pointer.
fn row(ui: &mut Ui, name: String, value: String) -> Response {
    let name = ui.label(name);
    ui.label(value);
    ui.end_row();
    name
}

/// How good the touch was since the start.
fn quality(rates: &Rates, ui: &mut Ui) {
    let (touch, answers) = (&rates.touch, &rates.answers);
    let late = touch.lateness;
    let [median, most, nearly_all, longest] =
        [late.p50, late.p99, late.p99_9, late.max].map(|time| decimal(1e6 * time, 0));
    let times = text!(
        "quality-times",
        median = median,
        most = most,
        nearly = nearly_all,
        longest = longest,
    );
    row(ui, text!("quality-late"), times).on_hover_text(text!("quality-late-hint"));
    let (ticks, steps) = (touch.missed, answers.missed);
    let missed = text!("quality-missed", ticks = ticks, steps = steps);
    row(ui, text!("quality-left-out"), missed).on_hover_text(text!("quality-left-out-hint"));
    let [mean, most] =
        [answers.extrapolation.rms, answers.extrapolation.max].map(|force| 1e3 * force);
    let off = text!(
        "quality-off",
        mean = decimal(mean, 2),
        most = decimal(most, 1)
    );
    row(ui, text!("quality-between"), off).on_hover_text(text!("quality-between-hint"));
    let work = text!("quality-work", work = decimal(1e3 * touch.energy, 3));
    row(ui, text!("quality-energy"), work).on_hover_text(text!("quality-energy-hint"));
    limits(touch, ui);
}

/// Measurements of the stages between model and hand.
fn limits(touch: &LoopReport, ui: &mut Ui) {
    let did = touch.interventions;
    ui.label(text!("quality-limits")).on_hover_text(text!(
        "quality-limits-hint",
        late = did.deadline_missed,
        faded = did.faded,
        damped = did.damped,
        walls = did.walls,
        saturated = did.saturated,
        thermal = did.thermally_limited,
        rate = did.rate_limited,
        released = did.dead_man_released,
    ));
    match touch.fault {
        Some(fault) => ui
            .colored_label(FAULT, text!("quality-forces-off"))
            .on_hover_text(fault.to_string()),
        None => ui.label(text!(
            "quality-faults",
            ticks = did.count(),
            faults = touch.faults,
        )),
    };
    ui.end_row();
}

/// Errors and warnings.
pub(super) fn status(window: &SimulatorWindow, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        emergency_stop(window, ui);
        let depth = window.history.last().1;
        let hung = window
            .play
            .as_ref()
            .and_then(|play| play.source.hung_device());
        let message = hung.or_else(|| window.fault.as_ref().or(window.notice.as_ref()).cloned());
        let touch_fault = window.rates.touch.fault.map(|fault| fault.to_string());
        let is_latched = touch_fault.is_some() && message.is_none();
        if let Some(fault) = message.or(touch_fault) {
            ui.colored_label(FAULT, fault);
            arm(window, is_latched, ui);
        } else if let Some(preparation) = &window.preparation {
            waiting(preparation, ui);
        } else if depth > TRUSTED_DEPTH {
            ui.colored_label(WARNING, text!("warning-deep"));
        } else {
            warnings(window, ui);
        }
    });
}

/// The emergency stop, where a device displays forces.
fn emergency_stop(window: &SimulatorWindow, ui: &mut Ui) {
    let Some(play) = window.play.as_ref().filter(|play| play.has_devices()) else {
        return;
    };
    let words = RichText::new(text!("stop-emergency")).color(ON_STOP);
    let button = ui.add(Button::new(words).fill(STOP));
    if button.on_hover_text(text!("stop-hint")).clicked() {
        play.source.emergency_stop();
    }
}

/// Lets the forces of a device on again, where a fault keeps them off.
fn arm(window: &SimulatorWindow, is_latched: bool, ui: &mut Ui) {
    let Some(play) = window.play.as_ref().filter(|_| is_latched) else {
        return;
    };
    let button = ui.button(text!("stop-arm"));
    if button.on_hover_text(text!("stop-arm-hint")).clicked() {
        play.source.arm();
    }
}

/// The running preparation and its progress.
fn waiting(preparation: &Preparation, ui: &mut Ui) {
    page::spinner(ui);
    let Some(progress) = preparation.progress() else {
        ui.label(text!("preparing-organ"));
        return;
    };
    let words = text!(work(progress.work));
    ui.label(&words);
    let bar = egui::ProgressBar::new(progress.part as f32);
    let bar = ui.add(bar.desired_width(160.0).show_percentage());
    page::name(&bar, Role::ProgressIndicator, &words);
    if let Some(seconds) = preparation.time_left() {
        ui.label(text!("preparing-left", seconds = seconds));
    }
    // Nothing else moves meanwhile.
    ui.ctx().request_repaint_after(super::REST);
}

/// The key of what is being done.
fn work(work: Work) -> &'static str {
    match work {
        Work::ForceOverDepth => "preparing-force",
        Work::Reading => "preparing-reading",
        Work::Influences => "preparing-influences",
        Work::Tetrahedra => "preparing-tetrahedra",
        Work::Factors => "preparing-factors",
        Work::Responses => "preparing-responses",
        Work::Storing => "preparing-storing",
    }
}

/// Warnings where the operating system lacks support for a touch with forces.
fn conditions(rates: &Rates) -> impl Iterator<Item = String> {
    let servo = rates.touch.priority.warning("servo");
    let model = rates.answers.priority.warning("model");
    [servo, model, lock_memory().warning()]
        .into_iter()
        .flatten()
}

fn warnings(window: &SimulatorWindow, ui: &mut Ui) {
    // Warnings that affect the current force come first.
    let play = window.play.iter();
    let mut warnings: Vec<_> = play
        .flat_map(|play| play.limits.iter().chain(&play.warnings).cloned())
        .collect();
    if window.play.as_ref().is_some_and(super::Play::has_devices) {
        warnings.extend(conditions(&window.rates));
    }
    match &warnings[..] {
        [] => {
            ui.colored_label(QUIET, text!("warning-none"));
        }
        [first, more @ ..] => {
            let text = match more.len() {
                0 => first.clone(),
                more => text!("warning-more", first = first.as_str(), more = more),
            };
            let label = egui::Label::new(RichText::new(text).small().color(WARNING)).truncate();
            ui.add(label).on_hover_text(warnings.join("\n\n"));
        }
    }
}
