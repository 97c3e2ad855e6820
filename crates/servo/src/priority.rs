//! Thread priorities: threads with a deadline run before all others, long preparations after them.
//!
//! | thread | on Linux |
//! |---|---|
//! | monitor ([`crate::monitor`]) | SCHED_FIFO 46: a loop that spins must not keep it from running |
//! | servo | SCHED_FIFO 45 |
//! | model | SCHED_FIFO 40 |
//! | window, recorder | ordinary |
//! | preparation of an organ | nice 10 |
//!
//! All real-time levels are below 50, the default of interrupt threads, on which devices depend.

use thread_priority::{ThreadPriority, ThreadPriorityValue};

/// The priority that the operating system gave a thread.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Priority {
    /// Real time: it runs before every ordinary thread.
    #[serde(rename = "real time")]
    RealTime,
    /// Ordinary priority; lateness then depends on the other threads.
    #[default]
    Ordinary,
}

const WATCH: u8 = 46;
const SERVO: u8 = 45;
const MODEL: u8 = 40;

/// By how much the niceness of a preparation is raised [-].
#[cfg(target_os = "linux")]
const NICER: i32 = 10;

impl Priority {
    /// The priority as a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::RealTime => "real time",
            Self::Ordinary => "ordinary",
        }
    }

    /// If the `thread` has no raised priority: the consequence and how to allow it.
    pub fn warning(self, thread: &str) -> Option<String> {
        (self == Self::Ordinary).then(|| {
            format!(
                "the {thread} thread runs at ordinary priority, and other programs can delay it; allow real-time \
                 priority (on Linux CAP_SYS_NICE, or an rtprio limit of {WATCH})"
            )
        })
    }
}

/// Asks for real-time priority for the calling thread, which runs a servo loop. Without the right to it (on Linux
/// CAP_SYS_NICE or an `rtprio` limit) the thread goes on as it is.
pub fn raise_priority() -> Priority {
    ask_for(SERVO)
}

/// The same for a model thread, between whose forces servo loops extrapolate: below the priority of the loops.
pub fn raise_model_priority() -> Priority {
    ask_for(MODEL)
}

/// The same for the thread that watches the loops.
pub(crate) fn raise_monitor_priority() -> Priority {
    ask_for(WATCH)
}

fn ask_for(level: u8) -> Priority {
    let Ok(level) = ThreadPriorityValue::try_from(level) else {
        return Priority::Ordinary;
    };
    if raise_to(ThreadPriority::Crossplatform(level)) {
        Priority::RealTime
    } else {
        Priority::Ordinary
    }
}

#[cfg(unix)]
fn raise_to(priority: ThreadPriority) -> bool {
    use thread_priority::unix::{set_thread_priority_and_policy, thread_native_id};
    use thread_priority::{RealtimeThreadSchedulePolicy, ThreadSchedulePolicy};

    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    set_thread_priority_and_policy(thread_native_id(), priority, policy).is_ok()
}

#[cfg(not(unix))]
fn raise_to(_priority: ThreadPriority) -> bool {
    thread_priority::set_current_thread_priority(ThreadPriority::Max).is_ok()
}

/// Lowers the priority of the calling thread, and on Linux of the threads that it starts, below that of every ordinary
/// one: for long work in the background of a touch. Whether the operating system did so.
pub fn lower_priority() -> bool {
    lower()
}

/// On Linux each thread has its own niceness; elsewhere it belongs to the process, which must keep its own.
#[cfg(target_os = "linux")]
fn lower() -> bool {
    rustix::process::nice(NICER).is_ok()
}

#[cfg(not(target_os = "linux"))]
fn lower() -> bool {
    thread_priority::set_current_thread_priority(ThreadPriority::Min).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the levels of Linux; each is one that `thread_priority` takes.
    #[test]
    fn levels_are_ordered_and_below_those_of_interrupts() {
        let levels = [MODEL, SERVO, WATCH, 50];
        assert!(levels.is_sorted_by(|lower, higher| lower < higher));
        assert!(
            levels
                .map(ThreadPriorityValue::try_from)
                .iter()
                .all(Result::is_ok)
        );
    }

    #[test]
    fn only_an_ordinary_priority_is_warned_of() {
        assert_eq!(Priority::RealTime.warning("model"), None);
        let warning = Priority::Ordinary.warning("model").unwrap();
        assert!(
            warning.contains("model thread") && warning.contains("CAP_SYS_NICE"),
            "{warning}"
        );
    }

    /// A thread that lowers its priority leaves that of others alone.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_preparation_is_nicer_than_its_neighbours() {
        // Field 19 of stat(5), the seventeenth after the name.
        let niceness = || -> i32 {
            let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
            let after_name = stat.rsplit_once(") ").unwrap().1;
            after_name.split(' ').nth(16).unwrap().parse().unwrap()
        };
        let before = niceness();
        let lowered = std::thread::spawn(move || {
            assert!(lower_priority());
            let inherited = std::thread::spawn(niceness).join().unwrap();
            [niceness(), inherited]
        });
        let expected = (before + NICER).min(19);
        assert_eq!(lowered.join().unwrap(), [expected; 2]);
        assert_eq!(niceness(), before);
    }
}
