use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Takes every force off a rig, from anywhere, at its next tick.
#[derive(Debug, Clone, Default)]
pub struct EmergencySwitch(Arc<AtomicBool>);

impl EmergencySwitch {
    /// No force until somebody arms again.
    pub fn press(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was pressed since the last time.
    pub(crate) fn take(&self) -> bool {
        self.0.swap(false, Ordering::Relaxed)
    }
}
