//! Commands by the sticks and buttons of a gamepad, by the codes of Linux for gamepads (`linux/input-event-codes.h`; which
//! code is where: the kernel's `Documentation/input/gamepad.rst`).
//!
//! *How we know*: `hands::…`, with events written as the drivers `xpad`, `hid-playstation` and `hid-generic` report them.
//!
//! *Limits*: no gamepad was at hand when this was written. `xpad` names X and Y the other way round than the kernel's
//! document, so both do the same here.

use super::Drive;

/// Part of a stick's way in which it counts as released [-].
const DEAD: f64 = 0.14;

const SOUTH: u16 = 0x130;
const EAST: u16 = 0x131;
const NORTH: u16 = 0x133;
const WEST: u16 = 0x134;
const SHOULDERS: [u16; 2] = [0x136, 0x137];
const TRIGGER_BUTTONS: [u16; 2] = [0x138, 0x139];
const SELECT: u16 = 0x13a;
const START: u16 = 0x13b;
const THUMBS: [u16; 2] = [0x13d, 0x13e];
const PAD_LEFT: u16 = 0x222;
const PAD_RIGHT: u16 = 0x223;

/// The code of the button that every gamepad has.
pub const FIRST_BUTTON: u16 = SOUTH;

/// Codes of axes up to the digital pad's.
const AXES: usize = 0x12;
const LEFT_STICK: [usize; 2] = [0x00, 0x01];
const PAD_ACROSS: usize = 0x10;

/// Something that happened at a gamepad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PadEvent {
    /// A button went down or up.
    Button {
        /// Its code.
        code: u16,
        /// Whether it is down.
        is_down: bool,
    },
    /// An axis moved.
    Axis {
        /// Its code.
        code: u16,
        /// Where it is, as a part of its range, from 0 to 1 [-].
        part: f64,
    },
}

/// Which axes of a gamepad are its right stick and its triggers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Layout {
    /// The right stick is RX and RY, the triggers are Z and RZ.
    #[default]
    Sticks,
    /// The right stick is Z and RZ, the triggers are brake and gas.
    Pedals,
}

impl Layout {
    /// Of a gamepad with axes of these codes.
    pub fn of(axes: &[u16]) -> Self {
        match axes.contains(&0x03) && axes.contains(&0x04) {
            true => Self::Sticks,
            false => Self::Pedals,
        }
    }

    fn right_stick(self) -> [usize; 2] {
        match self {
            Self::Sticks => [0x03, 0x04],
            Self::Pedals => [0x02, 0x05],
        }
    }

    fn triggers(self) -> [usize; 2] {
        match self {
            Self::Sticks => [0x02, 0x05],
            Self::Pedals => [0x0a, 0x09],
        }
    }
}

/// The part of a gamepad that moves a tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PadPart {
    /// All of it.
    Whole,
    /// The stick, trigger, shoulder and buttons of the left hand.
    Left,
    /// Those of the right hand.
    Right,
}

impl PadPart {
    /// The part of gamepad number `pad` of `pads` that moves the tool of a side, left (0) or right (1), of so many `tools`. One
    /// gamepad serves both hands by halves, two serve a hand each, and a single tool has all of them.
    pub fn of([pad, pads]: [usize; 2], side: usize, tools: usize) -> Option<Self> {
        match (tools, pads, side) {
            (0 | 1, ..) => Some(Self::Whole),
            (_, 1, 0) => Some(Self::Left),
            (_, 1, _) => Some(Self::Right),
            _ => (pad == side).then_some(Self::Whole),
        }
    }
}

/// Actions of a gamepad that happen once.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PadRequests {
    /// To mark the place, to begin, or to end.
    pub mark: bool,
    /// To pause or to continue.
    pub pause: bool,
    /// To undo the last cut.
    pub undo: bool,
    /// To state a diameter that is so many millimetres larger [mm].
    pub larger: i32,
}

impl PadRequests {
    /// Combines the actions of `self` and `other`.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            mark: self.mark || other.mark,
            pause: self.pause || other.pause,
            undo: self.undo || other.undo,
            larger: self.larger + other.larger,
        }
    }
}

/// Sticks and buttons as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pad {
    layout: Layout,
    /// Each as a part of its range; none before it has moved.
    axes: [Option<f64>; AXES],
    /// Bit by bit.
    down: u64,
    /// Buttons that went down since somebody looked, bit by bit.
    pressed: u64,
}

impl Pad {
    /// With all sticks and buttons released.
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            axes: [None; AXES],
            down: 0,
            pressed: 0,
        }
    }

    /// The bit of a button; none for one that has no use here.
    fn bit(code: u16) -> u64 {
        match code {
            SOUTH..=0x13f => 1 << (code - SOUTH),
            PAD_LEFT | PAD_RIGHT => 1 << (16 + code - PAD_LEFT),
            _ => 0,
        }
    }

    /// Takes the initial state: buttons that are down then do not count as pressed.
    pub fn begin(&mut self, event: PadEvent) {
        self.take(event);
        self.pressed = 0;
    }

    /// Takes an event.
    pub fn take(&mut self, event: PadEvent) {
        match event {
            PadEvent::Button { code, is_down } => self.push(Self::bit(code), is_down),
            PadEvent::Axis { code, part } => {
                let code = usize::from(code);
                let part = part.clamp(0.0, 1.0);
                if code == PAD_ACROSS {
                    self.push(Self::bit(PAD_LEFT), part < 0.25);
                    self.push(Self::bit(PAD_RIGHT), part > 0.75);
                } else if let Some(axis) = self.axes.get_mut(code) {
                    *axis = Some(part);
                }
            }
        }
    }

    fn push(&mut self, bit: u64, is_down: bool) {
        if is_down {
            self.pressed |= bit & !self.down;
            self.down |= bit;
        } else {
            self.down &= !bit;
        }
    }

    /// The state with the buttons that were pressed since the last call, which it clears.
    pub fn look(&mut self) -> Self {
        let seen = *self;
        self.pressed = 0;
        seen
    }

    fn is_down(&self, code: u16) -> bool {
        self.down & Self::bit(code) != 0
    }

    fn is_pressed(&self, code: u16) -> bool {
        self.pressed & Self::bit(code) != 0
    }

    /// A stick's way to the right and up, from -1 to 1, without what it says when it is released.
    fn stick(&self, axes: [usize; 2]) -> [f64; 2] {
        let [across, below] = axes.map(|axis| {
            let way = 2.0 * self.axes[axis].unwrap_or(0.5) - 1.0;
            way.signum() * (way.abs() - DEAD).max(0.0) / (1.0 - DEAD)
        });
        [across, -below]
    }

    /// How far a trigger is pulled, from 0 to 1; some gamepads have a button there.
    fn trigger(&self, hand: usize) -> f64 {
        let pulled = self.axes[self.layout.triggers()[hand]].unwrap_or(0.0);
        let pressed = f64::from(u8::from(self.is_down(TRIGGER_BUTTONS[hand])));
        pulled.max(pressed)
    }

    /// Command of a part of it to a tool. Halves: the stick moves the tool in the picture, the trigger moves it in and
    /// the shoulder out; the stick's button closes or opens the jaws; X, Y (left) and B (right) cut. The whole: the left
    /// stick moves it, the right trigger moves it in and the left one out, the right stick rolls it; the right shoulder
    /// or a stick's button closes or opens the jaws, the left shoulder slows down; B, X and Y cut.
    pub fn drive(&self, part: PadPart) -> Drive {
        let left_cuts = self.is_down(WEST) || self.is_down(NORTH);
        let right_cuts = self.is_down(EAST);
        let half = |hand: usize, stick, cuts| {
            let [across, up] = self.stick(stick);
            let out = f64::from(u8::from(self.is_down(SHOULDERS[hand])));
            Drive {
                way: [across, up, self.trigger(hand) - out],
                jaws: self.is_pressed(THUMBS[hand]),
                cuts,
                ..Drive::default()
            }
        };
        match part {
            PadPart::Left => half(0, LEFT_STICK, left_cuts),
            PadPart::Right => half(1, self.layout.right_stick(), right_cuts),
            PadPart::Whole => {
                let [across, up] = self.stick(LEFT_STICK);
                let [roll, _] = self.stick(self.layout.right_stick());
                let jaws = [SHOULDERS[1], THUMBS[0], THUMBS[1]];
                Drive {
                    way: [across, up, self.trigger(1) - self.trigger(0)],
                    roll: -roll,
                    fine: self.is_down(SHOULDERS[0]),
                    jaws: jaws.into_iter().any(|code| self.is_pressed(code)),
                    cuts: left_cuts || right_cuts,
                }
            }
        }
    }

    /// Its actions that happen once: A marks, the menu button pauses, the view button undoes a cut, the digital pad
    /// changes a diameter.
    pub fn requests(&self) -> PadRequests {
        let larger = i32::from(self.is_pressed(PAD_RIGHT)) - i32::from(self.is_pressed(PAD_LEFT));
        PadRequests {
            mark: self.is_pressed(SOUTH),
            pause: self.is_pressed(START),
            undo: self.is_pressed(SELECT),
            larger,
        }
    }
}
