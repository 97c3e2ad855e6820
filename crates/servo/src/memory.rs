//! Memory that stays where it is: a page that was swapped out delays a tick by milliseconds.
//!
//! *Limits*: a page that is touched for the first time is still mapped then, which takes microseconds. Only on Linux.

use std::sync::OnceLock;

/// Whether the memory of the program is locked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MemoryLock {
    /// It is: what was touched once stays in memory.
    Locked,
    /// It is not: the operating system does not allow it, or knows no such lock.
    #[default]
    Unlocked,
}

impl MemoryLock {
    /// Where memory is not locked, what that means and how to allow it.
    pub fn warning(self) -> Option<String> {
        let warning = "memory is not locked, and a page that was swapped out can delay a tick; allow locking (on Linux \
                       CAP_IPC_LOCK, or an unlimited memlock limit)";
        (self == Self::Unlocked).then(|| warning.to_owned())
    }
}

/// Locks the memory of the whole program, now and later, where the operating system allows that without a limit: beyond a
/// limit, later allocations would fail. Asked again, it answers what was answered first.
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
    // What is never touched, such as the rest of a thread's stack, takes no memory.
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

    /// Judge: what the kernel says of this program. VmLck is what is locked; with pages locked on first touch it may be
    /// as little as what is mapped now.
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
