//! The two hosts of a loop: a thread of ours, and the scheduler of a device. Judge: the same samples.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use palpate_servo::{
    Capabilities, Clock, Command, Device, DeviceState, Disabled, Fault, ForceState, Next, Sample,
    Scheduler, ServoLoop, ServoReader, ServoSettings, ServoThread, SteppedLoop, Tick, Trajectory,
    Vec3, VirtualDevice,
};

/// A device with a scheduler that a test paces: each value that is sent is a call.
struct Scheduled {
    device: VirtualDevice,
    calls: Arc<Mutex<Option<Receiver<()>>>>,
    /// How long a call takes from the hundredth on [ms].
    hangs: Arc<AtomicU32>,
    exchanges: u32,
}

impl Scheduled {
    fn new() -> (Self, Sender<()>) {
        let (call, calls) = channel();
        let device = VirtualDevice::new(Trajectory::Sine {
            center: Vec3::zeros(),
            amplitude: Vec3::z() * 2e-3,
            frequency: 2.0,
        });
        let scheduled = Self {
            device,
            calls: Arc::new(Mutex::new(Some(calls))),
            hangs: Arc::default(),
            exchanges: 0,
        };
        (scheduled, call)
    }
}

impl Device for Scheduled {
    fn capabilities(&self) -> &Capabilities {
        self.device.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.device.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        self.exchanges += 1;
        if self.exchanges > 100 {
            let hangs = self.hangs.load(Ordering::Relaxed);
            std::thread::sleep(Duration::from_millis(hangs.into()));
        }
        self.device.exchange(command)
    }

    fn disable(&mut self) -> Disabled {
        self.device.disable()
    }

    fn scheduler(&self) -> Option<Box<dyn Scheduler>> {
        Some(Box::new(Paced {
            calls: self.calls.clone(),
            ended: Arc::default(),
        }))
    }
}

struct Paced {
    calls: Arc<Mutex<Option<Receiver<()>>>>,
    ended: Arc<AtomicBool>,
}

impl Scheduler for Paced {
    fn disable(&mut self) -> Disabled {
        Disabled::Unknown
    }

    fn start(&mut self, mut tick: Tick) -> Result<(), Fault> {
        let calls = self.calls.lock().unwrap().take().ok_or(Fault::NoThread)?;
        let ended = self.ended.clone();
        std::thread::spawn(move || {
            while calls.recv().is_ok() && tick() == Next::Continue {}
            drop(tick);
            ended.store(true, Ordering::Release);
        });
        Ok(())
    }

    fn stop(&mut self, timeout: Duration) -> Result<(), Fault> {
        let until = Instant::now() + timeout;
        while !self.ended.load(Ordering::Acquire) {
            if Instant::now() > until {
                let limit = timeout.as_secs_f64();
                return Err(Fault::Hung { limit });
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(())
    }
}

fn servo(device: impl Device + 'static) -> (ServoLoop, ServoReader) {
    let spring = |state: &DeviceState, _: f64| state.position * -100.0;
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    ServoLoop::new(Box::new(device), Box::new(spring), settings).unwrap()
}

/// A stop is seen at the next call, and the last thing that the device is told is to be disabled.
fn stopped(thread: ServoThread, call: &Sender<()>) -> Result<palpate_servo::LoopReport, Fault> {
    let calls = call.clone();
    let caller = std::thread::spawn(move || {
        for _ in 0..1000 {
            std::thread::sleep(Duration::from_millis(1));
            if calls.send(()).is_err() {
                return;
            }
        }
    });
    let report = thread.stop();
    drop(caller);
    report
}

#[test]
fn both_hosts_make_the_same_ticks() {
    let (alone, _call) = Scheduled::new();
    let (mut direct, mut reader) = servo(alone.device);
    direct.run(&mut Clock::virtual_time(), |tick| tick < 1500);
    let expected: Vec<Sample> = reader.log.drain().collect();
    let (device, call) = Scheduled::new();
    let stops = device.device.disable_count();
    let (scheduled, mut reader) = servo(device);
    let thread = ServoThread::start(scheduled, Clock::virtual_time()).unwrap();
    for _ in 0..1500 {
        call.send(()).unwrap();
    }
    let mut found = Vec::new();
    while found.len() < 1500 {
        assert!(thread.is_running());
        found.extend(reader.log.drain());
    }
    let report = stopped(thread, &call).unwrap();
    assert_eq!((report.fault, report.missed), (None, 0));
    assert!(stops.load(Ordering::Relaxed) >= 1);
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
    }
}

/// A controller that panics after 50 ms.
fn defect(state: &DeviceState, _: f64) -> Vec3 {
    assert!(state.time < 0.05, "a defect");
    Vec3::zeros()
}

#[test]
fn a_panic_in_a_scheduler_disables_the_device_and_trips_the_session() {
    let (device, call) = Scheduled::new();
    let stops = device.device.disable_count();
    let (servo, reader) =
        ServoLoop::new(Box::new(device), Box::new(defect), ServoSettings::default()).unwrap();
    let thread = ServoThread::start(servo, Clock::virtual_time()).unwrap();
    for _ in 0..100 {
        let _ = call.send(());
    }
    while thread.is_running() {
        std::thread::yield_now();
    }
    assert!(stops.load(Ordering::Relaxed) >= 1);
    assert_eq!(reader.supervisor.state(), ForceState::Tripped);
    assert_eq!(thread.stop(), Err(Fault::Panicked));
}

/// A hook that prints a backtrace takes tens of milliseconds. It runs alone, for hooks are those of a whole program.
#[test]
fn a_panic_takes_the_force_off_before_it_is_reported() {
    let own = std::env::current_exe().unwrap();
    let helper = "hosts::a_panic_under_a_hook_that_looks_at_the_device";
    let mut command = std::process::Command::new(own);
    let ran = command.args(["--exact", helper, "--ignored"]).output();
    let said = String::from_utf8_lossy(&ran.unwrap().stdout).into_owned();
    assert!(said.contains("1 passed"), "{said}");
}

#[test]
#[ignore = "helper: of the test before it, in a program of its own"]
fn a_panic_under_a_hook_that_looks_at_the_device() {
    let (device, call) = Scheduled::new();
    let stops = device.device.disable_count();
    let seen = Arc::new(Mutex::new(None));
    let (at_hook, at_stops) = (seen.clone(), stops.clone());
    std::panic::set_hook(Box::new(move |panic| {
        let found = (at_stops.load(Ordering::Relaxed), panic.to_string());
        at_hook.lock().unwrap().get_or_insert(found);
    }));
    let (servo, _reader) =
        ServoLoop::new(Box::new(device), Box::new(defect), ServoSettings::default()).unwrap();
    let thread = ServoThread::start(servo, Clock::virtual_time()).unwrap();
    for _ in 0..100 {
        let _ = call.send(());
    }
    while thread.is_running() {
        std::thread::yield_now();
    }
    assert_eq!(thread.stop(), Err(Fault::Panicked));
    let (stops, said) = seen.lock().unwrap().clone().unwrap();
    assert!(stops >= 1 && said.contains("a defect"), "{stops}: {said}");
}

#[test]
fn a_panic_in_a_stepped_loop_is_a_fault() {
    let (device, _call) = Scheduled::new();
    let stops = device.device.disable_count();
    let device = Box::new(Unscheduled(device));
    let (servo, reader) =
        ServoLoop::new(device, Box::new(defect), ServoSettings::default()).unwrap();
    let mut stepped = SteppedLoop::new(servo, reader.log, Clock::virtual_time()).unwrap();
    let mut ticks = (0..100).map(|tick| stepped.tick(1e-3 * f64::from(tick), 0.0));
    assert_eq!(ticks.find_map(Result::err), Some(Fault::Panicked));
    assert!(stops.load(Ordering::Relaxed) >= 1);
    assert_eq!(reader.supervisor.state(), ForceState::Tripped);
}

/// Half a second is waited for a call, not for ever. Judge: the time.
#[test]
fn a_call_that_does_not_return_is_not_waited_for() {
    for scheduled in [true, false] {
        let (device, call) = Scheduled::new();
        device.hangs.store(3000, Ordering::Relaxed);
        let (servo, _reader) = match scheduled {
            true => servo(device),
            false => servo(Unscheduled(device)),
        };
        let thread = ServoThread::start(servo, Clock::real()).unwrap();
        for _ in 0..200 {
            call.send(()).unwrap();
        }
        std::thread::sleep(Duration::from_millis(300));
        let began = Instant::now();
        assert_eq!(thread.stop(), Err(Fault::Hung { limit: 0.5 }));
        // Twice the limit, and a busy machine.
        assert!(began.elapsed() < Duration::from_millis(1800), "{scheduled}");
    }
}

/// The same device, called from our thread.
struct Unscheduled(Scheduled);

impl Device for Unscheduled {
    fn capabilities(&self) -> &Capabilities {
        self.0.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.0.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        self.0.exchange(command)
    }

    fn disable(&mut self) -> Disabled {
        self.0.disable()
    }
}

#[test]
fn a_stepped_loop_gives_the_samples_of_its_host() {
    let (device, call) = Scheduled::new();
    let (scheduled, reader) = servo(device);
    let mut scheduled = SteppedLoop::new(scheduled, reader.log, Clock::virtual_time()).unwrap();
    let (alone, _call) = Scheduled::new();
    let (direct, reader) = servo(alone.device);
    let mut direct = SteppedLoop::new(direct, reader.log, Clock::virtual_time()).unwrap();
    for tick in 0..700 {
        call.send(()).unwrap();
        let expected = direct.tick(f64::from(tick) * 1e-3, 0.0).unwrap();
        let found = scheduled.tick(0.0, 0.0).unwrap();
        assert_eq!(found.tick, expected.tick);
        assert!((found.output - expected.output).norm() < 1e-12);
    }
    // Nobody calls any more.
    assert_eq!(scheduled.tick(0.0, 0.0), Err(Fault::Silent));
}
