use thread_priority::{ThreadPriority, ThreadPriorityValue};

/// What the operating system gave a thread.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Priority {
    /// Real time: it runs before every ordinary thread.
    RealTime,
    /// That of every thread; lateness is then up to the others.
    #[default]
    Ordinary,
}

/// Of 1 to 99; above the default of interrupt threads it would hold up the devices it waits for.
const LEVEL: u8 = 45;

/// Asks for real-time priority for the thread that calls. Without the right to it (on Linux CAP_SYS_NICE or
/// an `rtprio` limit) the thread goes on as it is.
pub fn raise_priority() -> Priority {
    let Ok(level) = ThreadPriorityValue::try_from(LEVEL) else {
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
