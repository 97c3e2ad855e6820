use eframe::egui::{Align, Grid, Label, Layout, RichText, ScrollArea, Ui};

use super::RigWindow;
use crate::style::{QUIET, WARNING};

/// The recordings that were made, and warnings.
pub(super) fn show(window: &mut RigWindow, ui: &mut Ui) {
    ui.add_space(2.0);
    head(window, ui);
    ui.separator();
    ScrollArea::both()
        .auto_shrink([false, false])
        .show(ui, |ui| {
            let shown = window.journal.shown();
            let mut chosen = None;
            Grid::new("recordings")
                .striped(true)
                .num_columns(6)
                .spacing([22.0, 3.0])
                .show(ui, |ui| {
                    for head in [
                        "file",
                        "stimulus",
                        "repeat",
                        "peak [mN]",
                        "samples",
                        "ended",
                    ] {
                        ui.label(RichText::new(head).small().color(QUIET));
                    }
                    ui.end_row();
                    // The newest first.
                    for (number, entry) in window.journal.entries.iter().enumerate().rev() {
                        let recorded = &entry.recorded;
                        let name = recorded.file.file_name().unwrap_or_default();
                        let name = name.to_string_lossy();
                        if ui.selectable_label(shown == Some(number), name).clicked() {
                            chosen = Some(number);
                        }
                        ui.label(&entry.what.stimulus);
                        ui.label(entry.what.repeat.to_string());
                        ui.label(format!("{:.1}", 1e3 * recorded.peak));
                        ui.label(recorded.samples.to_string());
                        match &recorded.cut_short {
                            None => ui.label("whole"),
                            Some(why) => ui.colored_label(WARNING, why),
                        };
                        ui.end_row();
                    }
                });
            if let Some(chosen) = chosen {
                window.journal.choose(chosen);
            }
        });
}

/// Where recordings go, warnings, and how punctual the rig is.
fn head(window: &RigWindow, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("recordings").strong());
        let folder = format!("in {}", window.journal.folder().display());
        ui.label(RichText::new(folder).small().color(QUIET));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(4.0);
            let waited = window.watch.now.map_or(0.0, |now| now.waited);
            let hint = "where nothing is real, time waits for a processor that is late";
            let rate = format!("1 kHz, waited {waited:.1} s for the processor");
            ui.label(RichText::new(rate).small().color(QUIET))
                .on_hover_text(hint);
            warnings(window, ui);
        });
    });
}

fn warnings(window: &RigWindow, ui: &mut Ui) {
    let warnings = window.warnings.concat();
    if let Some(first) = warnings.first() {
        let text = match warnings.len() {
            1 => first.clone(),
            n => format!("{first} (and {} more)", n - 1),
        };
        let label = Label::new(RichText::new(text).small().color(WARNING)).truncate();
        ui.add_space(16.0);
        ui.add(label).on_hover_text(warnings.join("\n\n"));
    }
}
