//! Key bindings. The keys of both hands lie around W A S D and I J K L, each hand's mirror image of
//! the other's; none is used twice.

use eframe::egui::{InputState, Key, PointerButton};

use super::Drive;

/// The keys of one hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HandKeys {
    /// Left, right, down, up, out and in.
    pub ways: [Key; 6],
    /// Clockwise and counter-clockwise.
    pub roll: [Key; 2],
    /// Closes and opens the jaws.
    pub jaws: Key,
    /// Cuts while it is held.
    pub cuts: Key,
}

/// Of the left hand and of the right one.
pub const HANDS: [HandKeys; 2] = [
    HandKeys {
        ways: [Key::A, Key::D, Key::S, Key::W, Key::Q, Key::E],
        roll: [Key::R, Key::F],
        jaws: Key::V,
        cuts: Key::X,
    },
    HandKeys {
        ways: [Key::J, Key::L, Key::K, Key::I, Key::O, Key::U],
        roll: [Key::Y, Key::H],
        jaws: Key::N,
        cuts: Key::M,
    },
];

/// Action of a key that acts once, for either hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// The mouse takes the other tool; the window asks for this key itself, which else walks through it.
    OtherTool,
    /// The last cut is taken back.
    Undo,
    /// The model stops, or goes on.
    Pause,
    /// Everything is as it was at the start.
    Reset,
    /// The list of keys is shown, or not.
    Hints,
    /// This place is meant, or it is done.
    Mark,
    /// Panels for engineers are shown during a task, or not.
    EngineerView,
}

/// Actions that happen once, each with its key.
pub const ACTIONS: [(Key, Action); 7] = [
    (Key::Enter, Action::Mark),
    (Key::Z, Action::Undo),
    (Key::P, Action::Pause),
    (Key::Backspace, Action::Reset),
    (Key::Questionmark, Action::Hints),
    (Key::F1, Action::Hints),
    (Key::F4, Action::EngineerView),
];

/// Jaws and cut of the tool that the mouse moves.
pub const JAWS: Key = Key::G;
/// See [`JAWS`].
pub const CUTS: Key = Key::C;

/// The lines of the list: the text's key of what is done, and the keys of the left and of the right hand.
pub const LINES: [[&str; 3]; 5] = [
    ["keys-move", "W A S D", "I J K L"],
    ["keys-shaft", "E · Q", "U · O"],
    ["keys-roll", "R · F", "Y · H"],
    ["keys-jaws", "V", "N"],
    ["keys-cut", "X", "M"],
];

/// Other lines of the list: keys, and the text's key of their action.
pub const MORE: [[&str; 2]; 11] = [
    ["Shift", "keys-fine"],
    ["Tab", "keys-other-tool"],
    ["G · C", "keys-mouse-tool"],
    ["", "keys-drag"],
    ["Z", "keys-undo"],
    ["P", "keys-pause"],
    ["Backspace", "keys-reset"],
    ["Enter", "keys-mark"],
    ["Space", "keys-stop"],
    ["F4", "keys-engineer"],
    ["? · F1", "keys-list"],
];

/// Command of the keys of `hand`.
pub fn drive(hand: &HandKeys, input: &InputState) -> Drive {
    let down = |key| f64::from(u8::from(input.key_down(key)));
    let [left, right, below, above, out, inward] = hand.ways.map(down);
    let [clockwise, counter] = hand.roll.map(down);
    Drive {
        way: [right - left, above - below, inward - out],
        roll: counter - clockwise,
        fine: input.modifiers.shift,
        jaws: pressed(hand.jaws, input),
        cuts: input.key_down(hand.cuts),
    }
}

/// Command of keys and of the further buttons of a mouse to the tool that it moves; without `keys`, of the buttons.
pub fn of_mouse(input: &InputState, keys: bool) -> Drive {
    let pointer = &input.pointer;
    Drive {
        jaws: keys && pressed(JAWS, input) || pointer.button_pressed(PointerButton::Extra1),
        cuts: keys && input.key_down(CUTS) || pointer.button_down(PointerButton::Extra2),
        ..Drive::default()
    }
}

/// Actions of the keys that were pressed.
pub fn actions(input: &InputState) -> impl Iterator<Item = Action> {
    let wanted = ACTIONS.map(|(key, action)| pressed(key, input).then_some(action));
    wanted.into_iter().flatten()
}

/// Whether `key` went down, not counting what it repeats while it is held.
pub fn pressed(key: Key, input: &InputState) -> bool {
    use eframe::egui::Event;
    input.events.iter().any(|event| {
        matches!(event, Event::Key { key: found, pressed: true, repeat: false, .. } if *found == key)
    })
}
