use eframe::egui::{Button, DragValue, RichText, Ui, vec2};
use palpate_measure::live::RigCommand;
use palpate_servo::Vec3;

use super::RigWindow;
use crate::style::{FAULT, QUIET};

/// The steepest that can be typed [degrees].
const STEEPEST: f64 = 60.0;

/// Along which direction the indenter approaches: what it is, typed or measured.
pub(super) fn show(window: &mut RigWindow, ui: &mut Ui) {
    ui.separator();
    ui.label(RichText::new("normal of the surface").strong());
    let normal = window.watch.normal();
    let [x, y] = tilt(&normal);
    let [px, py, pz] = window.watch.place_mm();
    let now = format!(
        "tilted {x:.1}\u{b0} right, {y:.1}\u{b0} away; indenter at ({px:.1}, {py:.1}, {pz:.1}) mm"
    );
    ui.label(RichText::new(now).small().color(QUIET));
    let free = window.watch.is_free();
    ui.horizontal(|ui| {
        for (angle, word) in window.tilt.iter_mut().zip(["right", "away"]) {
            let value = DragValue::new(angle).suffix("\u{b0}").speed(0.5);
            let value = value.range(-STEEPEST..=STEEPEST).max_decimals(1);
            ui.add(value)
                .on_hover_text(format!("tilt of the normal, {word}"));
            ui.label(RichText::new(word).small());
        }
        let typed = direction(window.tilt);
        let face = ui.add_enabled(free, Button::new("Face"));
        if face
            .on_hover_text("approach along the normal that is typed")
            .clicked()
        {
            window.send(RigCommand::Face(typed));
        }
    });
    let size = vec2(ui.available_width(), 26.0);
    let measure = Button::new("Measure the normal (N)").min_size(size);
    let measure = ui.add_enabled(free, measure);
    let hint = "touches the surface at four places around this one";
    if measure.on_hover_text(hint).clicked() {
        window.send(RigCommand::MeasureNormal);
    }
}

/// Reading of the sensor on each of its axes, or why there is none.
pub(super) fn axes(window: &RigWindow, ui: &mut Ui) {
    ui.separator();
    ui.label(RichText::new("sensor, axes of the indenter").strong());
    let small = |text: String| RichText::new(text).small().monospace();
    if let Some(fault) = window.watch.now.and_then(|now| now.sensor_fault) {
        ui.label(small(fault.to_string()).color(FAULT));
        return;
    }
    let Some(axes) = window.watch.steady_axes() else {
        ui.label(small("one axis: no forces sideways and no torques".to_owned()).color(QUIET));
        return;
    };
    let [fx, fy, fz, tx, ty, tz] = axes.components();
    let [fx, fy, fz] = [fx, fy, fz].map(|force| 1e3 * force);
    let [tx, ty, tz] = [tx, ty, tz].map(|torque| 1e3 * torque);
    ui.label(small(format!(
        "fx {fx:>7.1}  fy {fy:>7.1}  fz {fz:>7.1} mN"
    )));
    ui.label(small(format!(
        "tx {tx:>7.3}  ty {ty:>7.3}  tz {tz:>7.3} mN m"
    )));
}

/// The direction that is tilted by two angles [degrees] from upright.
fn direction([x, y]: [f64; 2]) -> Vec3 {
    Vec3::new(x.to_radians().tan(), y.to_radians().tan(), 1.0).normalize()
}

/// The two angles [degrees] of a direction.
fn tilt(normal: &Vec3) -> [f64; 2] {
    // Not −0.
    [normal.x, normal.y].map(|side| side.atan2(normal.z).to_degrees() + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_come_back_from_their_direction() {
        let [x, y] = tilt(&direction([12.0, -7.0]));
        assert!((x - 12.0).abs() < 1e-9 && (y + 7.0).abs() < 1e-9, "{x} {y}");
        assert_eq!(tilt(&Vec3::z()), [0.0, 0.0]);
    }
}
