use eframe::egui::{Context, Key, Modifiers};
use palpate_measure::live::Order;

use super::RigWindow;

/// What the keyboard asks for. Space is the emergency stop, whatever else has the keyboard.
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
    let step = window.step;
    for (key, order) in [
        (Key::ArrowDown, Order::Jog(-step)),
        (Key::ArrowUp, Order::Jog(step)),
        (Key::A, Order::Approach),
        (Key::W, Order::Withdraw),
    ] {
        if taken(key) && window.watch.is_free() {
            window.order(order);
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
    let order = Order::Drive(up);
    let driven = window.watch.doing.is_some_and(|(doing, _)| doing == order);
    if driven {
        // What only prolongs is not heard of again.
        if let Some(live) = window.live() {
            live.console.order(order);
        }
    } else if window.watch.is_free() {
        window.order(order);
    }
}
