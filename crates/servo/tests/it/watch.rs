//! A watch over loops. Judge: the virtual clock, and for its thread the machine's.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use palpate_servo::monitor::{HANG_TIMEOUT, Heartbeat, LoopMonitor, MonitorThread, MonitoredLoop};
use palpate_servo::supervisor::MONITOR_TIMEOUT;
use palpate_servo::{Clock, ForceState, StopReason, Supervisor};

fn nobody() -> bool {
    false
}

fn watched(names: [&str; 2]) -> [MonitoredLoop; 2] {
    names.map(|name| MonitoredLoop {
        name: name.to_owned(),
        pulse: Heartbeat::default(),
    })
}

/// A loop that does not begin, that takes its time for the first answer, or that has ended, does not hang.
#[test]
fn a_silent_loop_hangs_from_its_first_answer_until_it_ends() {
    let supervisor = Supervisor::armed();
    let loops = watched(["the left device", "the right device"]);
    let watch = LoopMonitor::new(supervisor.clone(), loops.to_vec(), nobody);
    let hangs = |time| {
        watch.check_loops(time);
        watch.hung().len()
    };
    assert_eq!(hangs(1e6), 0);
    loops[0].pulse.begin(10.0);
    assert_eq!((hangs(10.9), supervisor.state()), (0, ForceState::Armed));
    loops.iter().for_each(|each| each.pulse.beat(11.0));
    assert_eq!(hangs(11.0 + HANG_TIMEOUT), 0);
    loops[0].pulse.beat(11.1);
    assert_eq!((hangs(11.15), supervisor.state()), (1, ForceState::Tripped));
    let warning = watch.warning().unwrap();
    assert!(
        warning.starts_with("the right device does not return")
            && warning.contains("cut its power"),
        "{warning}"
    );
    loops[1].pulse.end();
    supervisor.arm();
    assert_eq!((hangs(11.15), supervisor.state()), (0, ForceState::Armed));
    assert_eq!(watch.warning(), None);
}

/// Where nobody has asked for forces, there is nothing to take off, but what hangs is named.
#[test]
fn a_watch_names_what_hangs_when_forces_are_off() {
    let loops = watched(["one", "other"]);
    let supervisor = Supervisor::default();
    let watch = LoopMonitor::new(supervisor.clone(), loops.to_vec(), || true);
    loops[0].pulse.beat(0.0);
    watch.check_loops(1.0);
    assert_eq!(
        (watch.hung(), supervisor.state()),
        (vec!["one"], ForceState::Off)
    );
}

/// Whatever its window does. The times are printed; how long it takes until a device has zero is judged by the campaign of
/// the crate `devices`.
#[test]
fn a_program_that_shall_end_has_no_force() {
    static ENDED: AtomicBool = AtomicBool::new(false);
    let supervisor = Supervisor::armed();
    let watch = LoopMonitor::new(supervisor.clone(), Vec::new(), || {
        ENDED.load(Ordering::Relaxed)
    });
    let thread = MonitorThread::start(watch, Clock::real()).unwrap();
    let mut times: Vec<Duration> = (0..100)
        .map(|_| {
            let asked = Instant::now();
            ENDED.store(true, Ordering::Relaxed);
            while supervisor.state() != ForceState::Tripped {
                std::thread::sleep(Duration::from_micros(100));
                assert!(asked.elapsed() < Duration::from_secs(5));
            }
            let took = asked.elapsed();
            ENDED.store(false, Ordering::Relaxed);
            // It may be looking with what it read before.
            std::thread::sleep(Duration::from_millis(3));
            supervisor.arm();
            took
        })
        .collect();
    times.sort();
    println!("p50 {:?}, longest {:?}", times[50], times[99]);
    assert!(thread.is_running());
}

/// A watch that ends with its session leaves forces alone; one that dies does not.
#[test]
fn a_watch_that_is_gone_is_noticed_unless_it_ended_in_good_order() {
    static PANICS: AtomicBool = AtomicBool::new(false);
    let supervisor = Arc::new(Supervisor::armed());
    let watch = |is_ended| LoopMonitor::new((*supervisor).clone(), Vec::new(), is_ended);
    drop(MonitorThread::start(watch(nobody), Clock::real()).unwrap());
    assert!(!crate::supervisor::is_tripped_at(&supervisor, 1e9));
    let dies = || {
        assert!(
            !PANICS.load(Ordering::Relaxed),
            "a watch that dies, as this test wants it"
        );
        false
    };
    let clock = Clock::real();
    let thread = MonitorThread::start(watch(dies), clock).unwrap();
    std::thread::sleep(Duration::from_millis(20));
    PANICS.store(true, Ordering::Relaxed);
    while thread.is_running() {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(!crate::supervisor::is_tripped_at(&supervisor, clock.now()));
    drop(thread);
    assert!(crate::supervisor::is_tripped_at(
        &supervisor,
        clock.now() + 1.1 * MONITOR_TIMEOUT
    ));
    supervisor.trip_with_reason(StopReason::EmergencyStop);
}
