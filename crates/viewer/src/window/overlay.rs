use std::sync::Arc;

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, Stroke, Vec2};

use palpate_files::scene::{Tip, TipContact};

use super::picture::OrganView;
use super::play::Play;
use super::texts::{decimal, text, tool_name};
use super::{list, page};
use crate::style::{DEPTH, FORCE, PLATE, QUIET, WARNING};

/// Depth that fills the gauge [m].
const FULL: f64 = 0.015;

/// Writes into the picture: how to touch, and next to a touching tool its depth and force.
pub(super) fn show(ui: &egui::Ui, rect: Rect, picture: &OrganView, play: &mut Play, tool: usize) {
    let painter = ui.painter_at(rect);
    let hand = picture.hands.get(tool).copied().unwrap_or_default();
    let pressing = picture.gesture.is_pressing() && !hand.holds() || hand.is_pulling();
    let hint = text!(match (pressing, hand.holds()) {
        (true, false) => press_hint(&play.scene.tools[tool].tip),
        (true, true) => "hint-pulling",
        (false, true) => "hint-shut",
        (false, false) => "hint-touch",
    });
    let hint = match play.scene.tools.as_slice() {
        _ if play.source.playback().is_some() => text!("hint-replay"),
        [_, _] => format!("{}: {hint}", tool_name(&play.scene.tools[tool].name)),
        _ => hint,
    };
    let at = Pos2::new(rect.center().x, rect.max.y - 14.0);
    let font = FontId::proportional(13.0);
    let wide = 0.96 * rect.width();
    let text = ui.painter().layout(hint, font, QUIET, wide);
    plate(ui, &painter, text, at, QUIET);
    if picture.lists_keys {
        list::show(ui, rect, play);
    }
    let pointer = ui.input(|input| input.pointer.latest_pos());
    let again = play.source.playback().is_some();
    let snapshot = play.source.snapshot();
    if snapshot.paused && !again {
        let font = FontId::proportional(16.0);
        let text = ui
            .painter()
            .layout(text!("hint-paused"), font, WARNING, wide);
        plate(ui, &painter, text, at - Vec2::new(0.0, 44.0), WARNING);
    }
    let Some(seen) = snapshot.tools.get(tool) else {
        return;
    };
    if let (true, Some(pointer)) = (pressing, pointer) {
        let depth = seen.contact.map_or(0.0, |contact| contact.depth);
        gauge(&painter, rect, pointer, depth, seen.force.norm());
    }
}

/// Says in words what the picture shows: the organ, and how deep and how hard the tool is.
pub(super) fn describe(response: &egui::Response, play: &mut Play, tool: usize) {
    let named = play.scene.tools.get(tool);
    let name = named.map_or_else(String::new, |own| tool_name(&own.name));
    let snapshot = play.source.snapshot();
    let seen = snapshot.tools.get(tool);
    let [depth, force] = seen.map_or([0.0; 2], |seen| {
        let depth = seen.contact.map_or(0.0, |contact| contact.depth);
        [depth, seen.force.norm()].map(|value| 1e3 * value)
    });
    let value = text!(
        "picture-tool",
        tool = name,
        mm = decimal(depth, 1),
        mn = force.round()
    );
    response.widget_info(|| egui::WidgetInfo {
        current_text_value: Some(value.clone()),
        ..egui::WidgetInfo::labeled(Role::Image, true, text!("picture-organ"))
    });
}

/// The key of how a tip that is pressed in is moved on.
fn press_hint(tip: &Tip) -> &'static str {
    match (tip.contact, tip.friction) {
        (TipContact::Slip, _) => "hint-slips",
        (TipContact::Stick, Some(_)) => "hint-sticks-and-slides",
        (TipContact::Stick, None) => "hint-sticks",
    }
}

/// Writes `text` on a dark plate whose lower middle is `at`.
fn plate(
    ui: &egui::Ui,
    painter: &egui::Painter,
    text: Arc<egui::Galley>,
    at: Pos2,
    color: Color32,
) {
    let corner = at - Vec2::new(0.5 * text.size().x, text.size().y);
    let back = Rect::from_min_size(corner, text.size()).expand2(Vec2::new(10.0, 5.0));
    painter.rect_filled(back, 6.0, PLATE);
    let id = ui.scope_id().with(("plate", at.y as i32));
    let seen = ui.interact(back, id, egui::Sense::hover());
    page::name(&seen, Role::Label, text.text());
    painter.galley(corner, text, color);
}

/// A bar next to the pointer that fills from the top as the tool goes in.
fn gauge(painter: &egui::Painter, rect: Rect, pointer: Pos2, depth: f64, force: f64) {
    let right = pointer.x + 150.0 < rect.max.x;
    let x = if right {
        pointer.x + 28.0
    } else {
        pointer.x - 40.0
    };
    let height = 90.0;
    let top = (pointer.y - 0.5 * height).clamp(rect.min.y + 4.0, rect.max.y - height - 4.0);
    let bar = Rect::from_min_size(Pos2::new(x, top), Vec2::new(8.0, height));
    painter.rect_filled(bar.expand(3.0), 4.0, PLATE);
    let part = (depth / FULL).clamp(0.0, 1.0) as f32;
    let filled = Rect::from_min_size(bar.min, Vec2::new(8.0, height * part));
    painter.rect_filled(filled, 2.0, DEPTH);
    let stroke = Stroke::new(1.0, QUIET);
    painter.rect_stroke(bar, 2.0, stroke, egui::StrokeKind::Outside);
    let (align, side) = match right {
        true => (Align2::LEFT_TOP, bar.max.x + 8.0),
        false => (Align2::RIGHT_TOP, bar.min.x - 8.0),
    };
    let say = |down: f32, text: String, color| {
        let at = Pos2::new(side, top + down);
        let font = FontId::proportional(15.0);
        let shadow = Color32::from_black_alpha(200);
        painter.text(at + Vec2::splat(1.0), align, &text, font.clone(), shadow);
        painter.text(at, align, text, font, color);
    };
    say(0.0, format!("{} mm", decimal(1e3 * depth, 1)), DEPTH);
    say(20.0, format!("{} mN", decimal(1e3 * force, 1)), FORCE);
}
