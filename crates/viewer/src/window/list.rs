use eframe::egui::accesskit::Role;
use eframe::egui::{Color32, FontId, Pos2, Rect, Sense, Ui, Vec2};

use super::hands::keys::{LINES, MORE};
use super::page;
use super::play::Play;
use super::texts::{key_name, text, tool_name};
use crate::style::{PLATE, QUIET, TEXT};

/// Size of the letters [points], and from line to line [points].
const LETTERS: f32 = 12.5;
const LINE: f32 = 17.0;

/// Between columns, and around the list [points].
const GAP: f32 = 14.0;
const MARGIN: f32 = 10.0;

/// A text of the list: its line, its column and its color.
type Entry = (usize, usize, String, Color32);

/// Lists the keys in the upper left corner of the picture.
pub(super) fn show(ui: &Ui, rect: Rect, play: &Play) {
    let named = |name: &str| play.scene.tools.iter().any(|tool| tool.name == name);
    let mut entries: Vec<Entry> = vec![(0, 0, text!("keys-title"), QUIET)];
    for (column, name) in [(1, "left"), (2, "right")] {
        let color = if named(name) { TEXT } else { QUIET };
        entries.push((0, column, tool_name(name), color));
    }
    for (line, [what, left, right]) in (1..).zip(LINES) {
        entries.push((line, 0, text!(what), QUIET));
        entries.push((line, 1, left.to_owned(), TEXT));
        entries.push((line, 2, right.to_owned(), TEXT));
    }
    let below = 1 + LINES.len();
    for (line, [key, what]) in (below..).zip(MORE) {
        let key = match key {
            "" => text!("key-drag"),
            key => key_name(key),
        };
        entries.push((line, 0, key, TEXT));
        entries.push((line, 1, text!(what), QUIET));
    }
    let painter = ui.painter_at(rect);
    let laid = entries.iter().map(|(line, column, words, color)| {
        let font = FontId::proportional(LETTERS);
        let galley = painter.layout_no_wrap(words.clone(), font, *color);
        (*line, *column, galley)
    });
    let laid: Vec<_> = laid.collect();
    // Two tables, one below the other: the keys of hands in three columns, other keys in two.
    let widest = |column: usize, is_below: bool| {
        let own = laid
            .iter()
            .filter(|(line, own, _)| *own == column && (*line >= below) == is_below);
        own.map(|(.., galley)| galley.size().x).fold(0.0, f32::max)
    };
    let starts = |is_below: bool| {
        let second = widest(0, is_below) + GAP;
        [0.0, second, second + widest(1, is_below) + GAP]
    };
    let [above, under] = [starts(false), starts(true)];
    let wide = (above[2] + widest(2, false)).max(under[1] + widest(1, true));
    let high = LINE * (below + MORE.len()) as f32;
    let size = Vec2::new(wide, high) + Vec2::splat(2.0 * MARGIN);
    let corner = rect.min + Vec2::splat(12.0);
    if size.x + 24.0 > rect.width() || size.y + 60.0 > rect.height() {
        // A small window has room for the organ alone; its keys work all the same.
        return;
    }
    let back = Rect::from_min_size(corner, size);
    painter.rect_filled(back, 6.0, PLATE);
    for (line, column, galley) in laid {
        let start = if line < below { above } else { under }[column];
        let at = Pos2::new(start, LINE * line as f32) + corner.to_vec2() + Vec2::splat(MARGIN);
        painter.galley(at, galley, TEXT);
    }
    let words: Vec<&str> = entries
        .iter()
        .map(|(.., words, _)| words.as_str())
        .collect();
    let seen = ui.interact(back, ui.scope_id().with("keys"), Sense::hover());
    page::name(&seen, Role::Label, &words.join(", "));
}
