//! A gamepad, as Linux tells of it: `/dev/input/js0`, eight bytes per event, read on a thread of its own.
//!
//! ```text
//! u32 time [ms], i16 value, u8 kind (1 button, 2 axis; 0x80 the state at the start), u8 number
//! ```
//!
//! No crate stands behind it: those that read gamepads need the headers of `libudev` to be built, which a
//! machine with Rust and a C compiler need not have. Sticks and buttons are those of the kernel's `xpad`.
//!
//! *How we know*: `gamepad::…`, with events as the kernel writes them.
//!
//! *Limits*: Linux; the first gamepad; other layouts than `xpad`'s have other numbers. No gamepad was at
//! hand when this was written.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::Drive;

/// Part of a stick's way in which it counts as let go [-].
const DEAD: f64 = 0.14;

const AXES: usize = 8;

/// Numbers of the axes: sticks to the right and down, triggers from -1 to 1.
const STICKS: [[usize; 2]; 2] = [[0, 1], [3, 4]];
const TRIGGERS: [usize; 2] = [2, 5];

/// Numbers of the buttons that are in, and of those that shut the jaws and cut.
const SHOULDERS: [u8; 2] = [4, 5];
const JAWS: [u8; 2] = [9, 10];
const CUTS: [u8; 2] = [2, 1];

/// Sticks and buttons as they are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pad {
    axes: [f64; AXES],
    /// Bit by bit.
    buttons: u32,
    /// Buttons that went down since somebody looked, bit by bit.
    pressed: u32,
}

impl Pad {
    /// Takes an event of the kernel's.
    pub fn take(&mut self, event: [u8; 8]) {
        let [_, _, _, _, low, high, kind, number] = event;
        let value = i16::from_le_bytes([low, high]);
        match kind & !0x80 {
            1 if number < 32 => {
                let bit = 1 << number;
                let was_down = self.buttons & bit != 0;
                self.buttons &= !bit;
                if value != 0 {
                    self.buttons |= bit;
                    // What is held at the start was not pressed.
                    if !was_down && kind & 0x80 == 0 {
                        self.pressed |= bit;
                    }
                }
            }
            2 => {
                if let Some(axis) = self.axes.get_mut(usize::from(number)) {
                    *axis = (f64::from(value) / f64::from(i16::MAX)).max(-1.0);
                }
            }
            _ => {}
        }
    }

    /// What it wants of the left hand (0) or of the right one (1): the stick moves it, the trigger takes it
    /// in and the button above it out; a stick that is pressed down closes or opens the jaws; X and B cut.
    pub fn drive(&self, hand: usize) -> Drive {
        let hand = hand.min(1);
        let down = |button: u8| self.buttons & (1 << button) != 0;
        let [across, below] = STICKS[hand].map(|axis| alive(self.axes[axis]));
        // A trigger that was never touched tells 0; let go it tells -1.
        let trigger = self.axes[TRIGGERS[hand]].max(0.0);
        let out = f64::from(u8::from(down(SHOULDERS[hand])));
        Drive {
            way: [across, -below, trigger - out],
            jaws: self.pressed & (1 << JAWS[hand]) != 0,
            cuts: down(CUTS[hand]),
            ..Drive::default()
        }
    }
}

/// A stick's way without what it says when it is let go.
fn alive(axis: f64) -> f64 {
    let beyond = (axis.abs() - DEAD).max(0.0) / (1.0 - DEAD);
    axis.signum() * beyond
}

/// A gamepad that is read. The thread ends with it, after the gamepad's next event, or when it is unplugged.
#[derive(Debug, Clone, Default)]
pub struct Gamepad {
    pad: Arc<Mutex<Pad>>,
    gone: Arc<AtomicBool>,
}

impl Gamepad {
    /// The first gamepad of this machine; none where there is none.
    pub fn first() -> Option<Self> {
        Self::open(Path::new("/dev/input/js0"))
    }

    /// Reads events from `path`; none when it cannot be read.
    pub fn open(path: &Path) -> Option<Self> {
        let file = File::open(path).ok()?;
        let pad = Arc::new(Mutex::new(Pad::default()));
        let gone = Arc::new(AtomicBool::new(false));
        let (told, ended) = (Arc::downgrade(&pad), Arc::clone(&gone));
        let read = move || {
            let mut file = file;
            let mut event = [0; 8];
            while file.read_exact(&mut event).is_ok() {
                let Some(pad) = told.upgrade() else { return };
                lock(&pad).take(event);
            }
            // Nobody holds what is unplugged.
            if let Some(pad) = told.upgrade() {
                *lock(&pad) = Pad::default();
            }
            ended.store(true, Ordering::Release);
        };
        let thread = std::thread::Builder::new().name("gamepad".to_owned());
        thread.spawn(read).ok()?;
        Some(Self { pad, gone })
    }

    /// Whether it was unplugged.
    pub fn is_gone(&self) -> bool {
        self.gone.load(Ordering::Acquire)
    }

    /// Sticks and buttons as they are, with the buttons that went down since the last look.
    pub fn look(&self) -> Pad {
        let mut pad = lock(&self.pad);
        let seen = *pad;
        pad.pressed = 0;
        seen
    }
}

fn lock(pad: &Mutex<Pad>) -> std::sync::MutexGuard<'_, Pad> {
    pad.lock().unwrap_or_else(PoisonError::into_inner)
}
