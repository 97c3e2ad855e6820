use eframe::egui::{Color32, FontId, Painter, Pos2, Rect, Vec2};

use super::hands::keys::{LINES, MORE};
use super::play::Play;
use crate::style::QUIET;

/// Size of the letters [points], and from line to line [points].
const LETTERS: f32 = 12.5;
const LINE: f32 = 17.0;

/// Columns from the left [points].
const COLUMNS: [f32; 3] = [10.0, 190.0, 268.0];
const WIDE: f32 = 340.0;

/// Lists the keys in the upper left corner of the picture.
pub(super) fn show(painter: &Painter, rect: Rect, play: &Play) {
    let lines = 1 + LINES.len() + MORE.len();
    let size = Vec2::new(WIDE, LINE * lines as f32 + 18.0);
    let corner = rect.min + Vec2::splat(12.0);
    if size.x + 24.0 > rect.width() || size.y + 60.0 > rect.height() {
        // A small window has room for the organ alone; its keys work all the same.
        return;
    }
    let back = Rect::from_min_size(corner, size);
    painter.rect_filled(back, 6.0, Color32::from_black_alpha(165));
    let bright = Color32::from_rgb(218, 222, 228);
    let write = |line: usize, column: usize, text: &str, color: Color32| {
        let down = 7.0 + LINE * line as f32;
        let at = Pos2::new(corner.x + COLUMNS[column], corner.y + down);
        let font = FontId::proportional(LETTERS);
        painter.text(at, eframe::egui::Align2::LEFT_TOP, text, font, color);
    };
    let named = |name: &str| play.scene.tools.iter().any(|tool| tool.name == name);
    write(0, 0, "keys", QUIET);
    for (column, name) in [(1, "left"), (2, "right")] {
        let color = if named(name) { bright } else { QUIET };
        write(0, column, name, color);
    }
    for (number, [what, left, right]) in LINES.into_iter().enumerate() {
        write(1 + number, 0, what, QUIET);
        write(1 + number, 1, left, bright);
        write(1 + number, 2, right, bright);
    }
    for (number, [key, what]) in MORE.into_iter().enumerate() {
        let line = 1 + LINES.len() + number;
        write(line, 0, key, bright);
        let at = Pos2::new(corner.x + 84.0, corner.y + 7.0 + LINE * line as f32);
        let font = FontId::proportional(LETTERS);
        painter.text(at, eframe::egui::Align2::LEFT_TOP, what, font, QUIET);
    }
}
