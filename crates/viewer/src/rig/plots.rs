use eframe::egui::{self, Align, Color32, Layout, RichText, Ui, vec2};
use egui_plot::{GridInput, GridMark, Line, Plot, PlotPoints};

use super::RigWindow;
use crate::history::SPAN;
use crate::style::{DEPTH, FORCE, QUIET};

/// Between two plots.
const GAP: f32 = 8.0;
/// The line above a plot that says what it shows.
const TITLE: f32 = 20.0;
/// How much of its colour an earlier repetition has.
const FADED: f32 = 0.35;
/// How far from a whole power of ten a mark may be by rounding [-].
const WHOLE: f64 = 1e-6;

/// Contents of a plot.
struct Drawn<'a> {
    title: String,
    axes: [&'a str; 2],
    /// Each with its colour, the last above the others.
    curves: Vec<(Vec<[f64; 2]>, Color32)>,
    /// Where its axes go at least.
    least: [[f64; 2]; 2],
    logarithmic: bool,
}

/// Shows live plots above and recorded ones below.
pub(super) fn show(window: &RigWindow, ui: &mut Ui) {
    let whole = ui.available_size();
    let size = vec2(0.5 * (whole.x - GAP), 0.5 * (whole.y - GAP));
    ui.spacing_mut().item_spacing = vec2(GAP, GAP);
    for row in [live_plots(window), recorded_plots(window)] {
        ui.horizontal(|ui| {
            for (number, drawn) in row.into_iter().enumerate() {
                ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
                    ui.set_min_size(size);
                    ui.spacing_mut().item_spacing = vec2(0.0, 2.0);
                    let salt = (drawn.logarithmic, drawn.axes[0], number);
                    ui.push_id(salt, |ui| plot(drawn, size, ui));
                });
            }
        });
    }
}

fn live_plots(window: &RigWindow) -> [Drawn<'_>; 2] {
    let history = &window.watch.history;
    let time = |axis, title: &str, points, color| Drawn {
        title: title.to_owned(),
        axes: ["time before now [s]", axis],
        curves: vec![(points, color)],
        least: [[-SPAN, 0.0], [0.0, 2.0]],
        logarithmic: false,
    };
    let contact = window.watch.contact();
    let surface = 1e3 * contact.unwrap_or(0.0);
    let mut depth = history.depth();
    depth.iter_mut().for_each(|point| point[1] -= surface);
    let name = match contact {
        Some(_) => "depth [mm]",
        None => "way down [mm]",
    };
    [
        time("force [mN]", "force now", history.mean_force(), FORCE),
        time(name, "depth now", depth, DEPTH),
    ]
}

fn recorded_plots(window: &RigWindow) -> [Drawn<'_>; 2] {
    let mut force_over_depth = Vec::new();
    let mut relaxation = Vec::new();
    let mut name = "nothing is recorded yet".to_owned();
    if let Some((entry, others)) = window.journal.compared() {
        for other in others {
            force_over_depth.push((other.force_over_depth.clone(), FORCE.gamma_multiply(FADED)));
            relaxation.push((other.relaxation.clone(), DEPTH.gamma_multiply(FADED)));
        }
        let earlier = force_over_depth.len();
        force_over_depth.push((entry.force_over_depth.clone(), FORCE));
        relaxation.push((entry.relaxation.clone(), DEPTH));
        name = format!("{}, repeat {}", entry.what.stimulus, entry.what.repeat);
        if earlier > 0 {
            name += &format!(
                ", and {earlier} other{}",
                if earlier == 1 { "" } else { "s" }
            );
        }
    }
    let has_hold = relaxation.iter().any(|(points, _)| !points.is_empty());
    let of_hold = match has_hold || relaxation.is_empty() {
        true => "force over that at the end of the ramp".to_owned(),
        false => "a swing is not held".to_owned(),
    };
    [
        Drawn {
            title: name,
            axes: ["depth [mm]", "force [mN]"],
            curves: force_over_depth,
            least: [[0.0, 1.0], [0.0, 2.0]],
            logarithmic: false,
        },
        Drawn {
            title: of_hold,
            axes: [
                "time from the end of the ramp [s]",
                "force / first force [-]",
            ],
            curves: relaxation,
            least: [[-2.0, 1.0], [0.0, 1.05]],
            logarithmic: true,
        },
    ]
}

fn plot(drawn: Drawn<'_>, size: egui::Vec2, ui: &mut Ui) {
    ui.label(RichText::new(&drawn.title).small().color(QUIET));
    let [[left, right], [low, high]] = drawn.least;
    let mut plot = Plot::new("plot")
        .width(size.x)
        .height(size.y - TITLE)
        .x_axis_label(RichText::new(drawn.axes[0]).small())
        .y_axis_label(RichText::new(drawn.axes[1]).small())
        .include_x(left)
        .include_x(right)
        .include_y(low)
        .include_y(high)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_axis_zoom_drag(false)
        .allow_boxed_zoom(false);
    if drawn.logarithmic {
        plot = plot
            .x_grid_spacer(decades)
            .x_axis_formatter(|mark, _| power_of_ten(mark.value));
    }
    plot.show(ui, move |plot| {
        for (points, color) in drawn.curves {
            let line = Line::new("", PlotPoints::from(points));
            plot.line(line.color(color).width(1.6));
        }
    });
}

/// A mark for each power of ten, and fainter ones for its multiples.
fn decades(input: GridInput) -> Vec<GridMark> {
    let (from, to) = input.bounds;
    (from.floor() as i32..=to.ceil() as i32)
        .flat_map(|decade| {
            (1..10).map(move |multiple| GridMark {
                value: f64::from(decade) + f64::from(multiple).log10(),
                step_size: if multiple == 1 { 1.0 } else { 0.1 },
            })
        })
        .filter(|mark| (from..=to).contains(&mark.value))
        .collect()
}

/// A whole power as the number; nothing between.
fn power_of_ten(power: f64) -> String {
    match (power - power.round()).abs() < WHOLE {
        true => format!("{}", 10.0_f64.powi(power.round() as i32)),
        false => String::new(),
    }
}
