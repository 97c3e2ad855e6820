use eframe::egui::{Context, Key, Modifiers};
use palpate_measure::live::RigCommand;

use super::RigWindow;
use super::manual::JogStep;

/// Handles the keyboard. Space is the emergency stop, even while a field has the keyboard.
pub(super) fn take(window: &mut RigWindow, context: &Context) {
    let taken = |key| context.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    if taken(Key::Space) {
        window.emergency_stop();
    }
    if context.egui_wants_keyboard_input() {
        return;
    }
    if taken(Key::Escape) {
        window.stop();
    }
    if window.watch.fault.is_some() {
        return;
    }
    let taken = |modifiers, key| context.input_mut(|input| input.consume_key(modifiers, key));
    for (modifiers, key, way) in [
        (
            Modifiers::SHIFT,
            Key::ArrowUp,
            JogStep::Sideways([0.0, 1.0]),
        ),
        (
            Modifiers::SHIFT,
            Key::ArrowDown,
            JogStep::Sideways([0.0, -1.0]),
        ),
        (Modifiers::NONE, Key::ArrowUp, JogStep::AlongNormal(1.0)),
        (Modifiers::NONE, Key::ArrowDown, JogStep::AlongNormal(-1.0)),
        (
            Modifiers::NONE,
            Key::ArrowLeft,
            JogStep::Sideways([-1.0, 0.0]),
        ),
        (
            Modifiers::NONE,
            Key::ArrowRight,
            JogStep::Sideways([1.0, 0.0]),
        ),
    ] {
        if taken(modifiers, key) && window.watch.is_free() {
            window.jog(way);
        }
    }
    for (key, command) in [
        (Key::A, RigCommand::Approach),
        (Key::N, RigCommand::MeasureNormal),
        (Key::W, RigCommand::Withdraw),
    ] {
        if taken(Modifiers::NONE, key) && window.watch.is_free() {
            window.send(command);
        }
    }
    for (key, up) in [(Key::PageDown, false), (Key::PageUp, true)] {
        if context.input(|input| input.key_down(key)) {
            drive(window, up);
        }
    }
}

/// Drives the indenter for as long as this is called at every picture.
pub(super) fn drive(window: &mut RigWindow, up: bool) {
    let normal = window.watch.normal();
    let command = RigCommand::Drive(if up { normal } else { -normal });
    let driven = window
        .watch
        .doing
        .is_some_and(|(doing, _)| doing == command);
    if driven {
        // A command that only prolongs the drive has no event of its own.
        if let Some(live) = window.live() {
            live.console.send(command);
        }
    } else if window.watch.is_free() {
        window.send(command);
    }
}
