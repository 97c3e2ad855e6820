//! Memory locking: a page that was swapped out delays a tick by milliseconds.
//!
//! *Limits*: the first access to a page still maps it, which takes microseconds. Only on Linux.

use std::sync::OnceLock;

/// Whether the program's memory is locked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MemoryLock {
    /// Locked: a page stays in memory after its first access.
    Locked,
    /// Not locked: the operating system does not permit it, or has no such lock.
    #[default]
    Unlocked,
}

impl MemoryLock {
    /// If memory is not locked: the consequence and how to allow it.
    pub fn warning(self) -> Option<String> {
        let warning = "memory is not locked, and a page that was swapped out can delay a tick; allow locking (on Linux \
                       CAP_IPC_LOCK, or an unlimited memlock limit)";
        (self == Self::Unlocked).then(|| warning.to_owned())
    }
}

/// Locks the memory of the whole program, now and later, where the operating system permits it without a limit: beyond
/// a limit, later allocations would fail. A second call returns the first result.
pub fn lock_memory() -> MemoryLock {
    static LOCK: OnceLock<MemoryLock> = OnceLock::new();
    *LOCK.get_or_init(|| match lock() {
        true => MemoryLock::Locked,
        false => MemoryLock::Unlocked,
    })
}

#[cfg(target_os = "linux")]
fn lock() -> bool {
    use rustix::mm::{MlockAllFlags, mlockall};
    use rustix::process::{Resource, getrlimit};
    use rustix::thread::{CapabilitySet, capabilities};

    let may_lock =
        |sets: rustix::thread::CapabilitySets| sets.effective.contains(CapabilitySet::IPC_LOCK);
    let is_capable = capabilities(None).is_ok_and(may_lock);
    let is_unlimited = getrlimit(Resource::Memlock).current.is_none();
    // Pages that are never accessed, such as the rest of a thread's stack, take no memory.
    let all = MlockAllFlags::CURRENT | MlockAllFlags::FUTURE | MlockAllFlags::ONFAULT;
    (is_capable || is_unlimited) && mlockall(all).is_ok()
}

#[cfg(not(target_os = "linux"))]
fn lock() -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the kernel's data on this program. VmLck is the locked memory; with pages locked on first touch it may be
    /// as small as the memory that is mapped now.
    #[cfg(target_os = "linux")]
    #[test]
    fn memory_is_locked_where_the_answer_says_so() {
        let answer = lock_memory();
        let status = std::fs::read_to_string("/proc/self/status").unwrap();
        let locked = status
            .lines()
            .find_map(|line| line.strip_prefix("VmLck:"))
            .unwrap();
        let locked: u64 = locked.trim().split(' ').next().unwrap().parse().unwrap();
        println!("{answer:?}, {locked} kB");
        assert_eq!(answer == MemoryLock::Locked, locked > 0);
        assert_eq!(answer.warning().is_none(), answer == MemoryLock::Locked);
        assert_eq!(lock_memory(), answer);
    }
}
