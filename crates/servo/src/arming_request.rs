use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Asks a loop, from anywhere, to arm its forces again after a fault.
#[derive(Debug, Clone, Default)]
pub struct ArmingRequest(Arc<AtomicBool>);

impl ArmingRequest {
    /// Asks; the loop arms once the hand is slow and the force small.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked since the last time.
    pub(crate) fn take(&self) -> bool {
        self.0.swap(false, Ordering::Relaxed)
    }
}
