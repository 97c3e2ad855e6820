//! The gamepads of this machine, on Linux: they are found while the window is open, and each is read on a thread of its
//! own.
//!
//! `gilrs` would know other systems and layouts, but needs the headers of `libudev` to be built.

use std::sync::{Arc, Mutex, PoisonError};

use super::gamepad::Pad;

/// The gamepads that are plugged in; none until they are looked for.
#[derive(Debug, Default)]
pub struct Gamepads(Arc<Mutex<Vec<Connected>>>);

/// A gamepad that is read.
#[derive(Debug)]
struct Connected {
    #[cfg_attr(
        not(target_os = "linux"),
        expect(dead_code, reason = "no other system is read")
    )]
    path: std::path::PathBuf,
    pad: Pad,
}

impl Gamepads {
    /// Looks for gamepads from now on. The threads end after this does, with a gamepad's next event.
    pub fn start() -> Self {
        let own = Self::default();
        #[cfg(target_os = "linux")]
        linux::watch(&own.0);
        own
    }

    /// Whether there is one.
    pub fn is_any(&self) -> bool {
        !lock(&self.0).is_empty()
    }

    /// Sticks and buttons as they are, with what was pressed since the last look.
    pub fn look(&self) -> Vec<Pad> {
        let mut pads = lock(&self.0);
        pads.iter_mut().map(|own| own.pad.look()).collect()
    }
}

/// The names of the gamepads that are plugged in and may be read.
pub fn gamepads() -> Vec<String> {
    #[cfg(target_os = "linux")]
    return linux::names();
    #[cfg(not(target_os = "linux"))]
    Vec::new()
}

fn lock(pads: &Mutex<Vec<Connected>>) -> std::sync::MutexGuard<'_, Vec<Connected>> {
    pads.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(target_os = "linux")]
mod linux {
    use std::collections::BTreeSet;
    use std::path::{Path, PathBuf};
    use std::sync::{Arc, Mutex, Weak};
    use std::time::Duration;

    use evdev::{AbsInfo, Device, EventType, KeyCode};

    use super::super::gamepad::{FIRST_BUTTON, Layout, Pad, PadEvent};
    use super::{Connected, lock};

    /// Between two looks for gamepads.
    const LOOK: Duration = Duration::from_secs(2);

    /// Ranges of axes, by their codes.
    type Ranges = Vec<(u16, AbsInfo)>;

    pub(super) fn watch(pads: &Arc<Mutex<Vec<Connected>>>) {
        let pads = Arc::downgrade(pads);
        let thread = std::thread::Builder::new().name("gamepads".to_owned());
        // Without a thread there is no gamepad.
        let _ = thread.spawn(move || {
            let mut known = BTreeSet::new();
            while pads.strong_count() > 0 {
                let mut now = inputs();
                // What may not be opened may be a moment later, when the system has set its permissions.
                now.retain(|path| known.contains(path) || connect(path, &pads));
                known = now;
                std::thread::sleep(LOOK);
            }
        });
    }

    /// The devices of input.
    fn inputs() -> BTreeSet<PathBuf> {
        let folder = std::fs::read_dir("/dev/input").into_iter().flatten();
        let paths = folder.filter_map(|entry| Some(entry.ok()?.path()));
        paths.filter(|path| is_event(path)).collect()
    }

    fn is_event(path: &Path) -> bool {
        let name = path.file_name().and_then(|name| name.to_str());
        name.is_some_and(|name| name.starts_with("event"))
    }

    pub(super) fn names() -> Vec<String> {
        let opened = inputs()
            .into_iter()
            .filter_map(|path| Device::open(path).ok());
        let opened = opened.filter(is_gamepad);
        let named = opened.map(|device| device.name().unwrap_or("without a name").to_owned());
        named.collect()
    }

    fn is_gamepad(device: &Device) -> bool {
        let keys = device.supported_keys();
        keys.is_some_and(|keys| keys.contains(KeyCode::new(FIRST_BUTTON)))
    }

    /// Reads a device from now on, if it is a gamepad. Whether it could be opened.
    fn connect(path: &Path, pads: &Weak<Mutex<Vec<Connected>>>) -> bool {
        let Ok(device) = Device::open(path) else {
            return false;
        };
        let Some(shared) = pads.upgrade().filter(|_| is_gamepad(&device)) else {
            return true;
        };
        let (pad, ranges) = state(&device);
        let path = path.to_owned();
        lock(&shared).push(Connected {
            path: path.clone(),
            pad,
        });
        let pads = pads.clone();
        let thread = std::thread::Builder::new().name("gamepad".to_owned());
        let _ = thread.spawn(move || {
            read(device, &path, &ranges, &pads);
            // Nobody holds what is unplugged.
            if let Some(pads) = pads.upgrade() {
                lock(&pads).retain(|own| own.path != path);
            }
        });
        true
    }

    /// A gamepad as it is now.
    fn state(device: &Device) -> (Pad, Ranges) {
        let ranges = device.get_absinfo().into_iter().flatten();
        let ranges: Ranges = ranges.map(|(axis, range)| (axis.0, range)).collect();
        let axes: Vec<u16> = ranges.iter().map(|(code, _)| *code).collect();
        let mut pad = Pad::new(Layout::of(&axes));
        for (code, range) in &ranges {
            let part = part(range, range.value());
            pad.begin(PadEvent::Axis { code: *code, part });
        }
        for key in device.get_key_state().iter().flat_map(|keys| keys.iter()) {
            pad.begin(PadEvent::Button {
                code: key.code(),
                is_down: true,
            });
        }
        (pad, ranges)
    }

    /// A value as a part of its range [-].
    fn part(range: &AbsInfo, value: i32) -> f64 {
        let [least, most, value] = [range.minimum(), range.maximum(), value].map(f64::from);
        match most > least {
            true => (value - least) / (most - least),
            false => 0.5,
        }
    }

    /// Reads until the gamepad is unplugged or nobody looks any more.
    fn read(mut device: Device, path: &Path, ranges: &Ranges, pads: &Weak<Mutex<Vec<Connected>>>) {
        while let Ok(events) = device.fetch_events() {
            let Some(pads) = pads.upgrade() else { return };
            let mut pads = lock(&pads);
            let Some(own) = pads.iter_mut().find(|own| own.path == path) else {
                return;
            };
            for event in events {
                let (code, value) = (event.code(), event.value());
                let taken = match event.event_type() {
                    EventType::KEY => Some(PadEvent::Button {
                        code,
                        is_down: value != 0,
                    }),
                    EventType::ABSOLUTE => {
                        ranges
                            .iter()
                            .find(|(own, _)| *own == code)
                            .map(|(_, range)| PadEvent::Axis {
                                code,
                                part: part(range, value),
                            })
                    }
                    _ => None,
                };
                if let Some(event) = taken {
                    own.pad.take(event);
                }
            }
        }
    }
}
