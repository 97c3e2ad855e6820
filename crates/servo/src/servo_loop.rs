//! The loop: exchange, control, guard, at every tick.
//!
//! Tick n begins at t₀ + n T, an absolute time. A late tick delays no other: ticks whose time has passed are skipped
//! and counted, never caught up in a burst. The force of tick n is sent with tick n + 1, since a device answers once
//! per message; so a hand feels the force of its position one period ago.
//!
//! *How we know*: `servo::skips_and_never_bursts`, `servo::the_same_script_gives_the_same_bytes`,
//! `no_allocation::a_tick_allocates_nothing`, `servo::a_panic_stops_the_device`.
//!
//! *Limits*: on an ordinary operating system the scheduler determines the largest lateness, milliseconds.

use crate::dynamics::Compensator;
use crate::limits::{CommandedForce, Guard, Limits, OutputForce, Stage};
use crate::monitor::Heartbeat;
use crate::priority::{Priority, raise_priority};
use crate::report::Meter;
use crate::supervisor::{Permission, StopReason};
use crate::velocity::Velocity;
use crate::{
    Clock, Command, Controller, Device, DeviceState, Disabled, Fault, ForceState, LoopReport,
    Sample, Scheduler, ServoSettings, Supervisor, Vec3, latest, log,
};

/// The readers' ends of a loop.
pub struct ServoReader {
    /// The latest sample; none before the first tick.
    pub latest: latest::Receiver<Option<Sample>>,
    /// Every sample.
    pub log: log::Reader<Sample>,
    /// The loop's report, ten times a second.
    pub report: latest::Receiver<LoopReport>,
    /// Arms its forces and takes them off.
    pub supervisor: Supervisor,
    /// Time of its device's last answer, for a watch.
    pub pulse: Heartbeat,
}

/// A device, its controller and its limits. Dropping it disables the device.
pub struct ServoLoop {
    device: Box<dyn Device>,
    controller: Box<dyn Controller>,
    guard: Guard,
    velocity: Velocity,
    meter: Meter,
    priority: Priority,
    period: f64,
    number: u64,
    last_time: Option<f64>,
    /// Time of the scheduler's first call [s].
    first_call: Option<f64>,
    /// The device's force at the next tick.
    force: OutputForce,
    compensator: Option<Compensator>,
    /// Whether the device may display forces, and its answer when it was last disabled.
    enabled: bool,
    disabled: Option<Disabled>,
    latest: latest::Sender<Option<Sample>>,
    log: log::Writer<Sample>,
    report: latest::Sender<LoopReport>,
    supervisor: Supervisor,
    pulse: Heartbeat,
    /// The session's count of armings that the loop read last.
    armings: u64,
    last: Option<Sample>,
    fault: Option<Fault>,
}

impl ServoLoop {
    /// A loop that has not begun, and its readers. It owns the device: nothing else calls it. It has a session of its
    /// own, already armed.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn new(
        device: Box<dyn Device>,
        controller: Box<dyn Controller>,
        settings: ServoSettings,
    ) -> Result<(Self, ServoReader), Fault> {
        Self::supervised(device, controller, settings, Supervisor::armed())
    }

    /// The same in a session of several loops.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn supervised(
        device: Box<dyn Device>,
        controller: Box<dyn Controller>,
        settings: ServoSettings,
        supervisor: Supervisor,
    ) -> Result<(Self, ServoReader), Fault> {
        let limits = settings
            .limits
            .unwrap_or_else(|| Limits::of(device.capabilities()));
        let guard = Guard::new(limits, device.capabilities(), settings.period)?;
        let (latest, latest_reader) = latest::channel(&None);
        let (log, log_reader) = log::ring(settings.log);
        let (report, report_reader) = latest::channel(&LoopReport::default());
        let pulse = Heartbeat::default();
        let reader = ServoReader {
            latest: latest_reader,
            log: log_reader,
            report: report_reader,
            supervisor: supervisor.clone(),
            pulse: pulse.clone(),
        };
        let servo = Self {
            device,
            controller,
            guard,
            velocity: Velocity::new(settings.period),
            meter: Meter::default(),
            priority: Priority::Ordinary,
            period: settings.period,
            number: 0,
            last_time: None,
            first_call: None,
            force: OutputForce::default(),
            compensator: settings.compensation.map(Compensator::new),
            enabled: false,
            disabled: None,
            latest,
            log,
            report,
            armings: supervisor.permission(f64::NEG_INFINITY).armings,
            supervisor,
            pulse,
            last: None,
            fault: None,
        };
        Ok((servo, reader))
    }

    /// The scheduler of the device, on whose thread the loop has to tick; none if any thread may tick it.
    pub fn scheduler(&self) -> Option<Box<dyn Scheduler>> {
        self.device.scheduler()
    }

    /// Asks for real-time priority for the calling thread, which must be the one that runs the loop.
    pub fn raise_priority(&mut self) {
        self.priority = raise_priority();
    }

    /// Its host starts at `time` [s]; the device has to answer from then on.
    pub(crate) fn begin(&self, time: f64) {
        self.pulse.begin(time);
    }

    /// Ticks while `go_on`, called with the number of the next tick, returns true, or until the device fails.
    pub fn run(&mut self, clock: &mut Clock, mut go_on: impl FnMut(u64) -> bool) -> LoopReport {
        // A resumed loop ticks one period after its last tick.
        let start = self.last_time.map_or(0.0, |last| last + self.period);
        let first = start.max(clock.now()) - self.number as f64 * self.period;
        while go_on(self.number) {
            let due = first + self.number as f64 * self.period;
            clock.wait_until(due);
            let began = clock.now();
            if self.tick(began, began - due).is_err() {
                break;
            }
            let done = clock.now();
            // The next tick whose time has not passed.
            let next = ((done - first) / self.period).ceil() as u64;
            let missed = next.saturating_sub(self.number);
            self.number += missed;
            self.meter.record_tick(done - began, missed);
        }
        self.finish()
    }

    /// One tick at the pace of the device's scheduler: on the machine's clock now, on a virtual one a period after the
    /// last.
    ///
    /// # Errors
    /// As for [`tick`](Self::tick).
    pub(crate) fn tick_as_called(&mut self, clock: &mut Clock) -> Result<(), Fault> {
        if let Clock::Virtual(_) = clock {
            let first = *self.first_call.get_or_insert(clock.now());
            clock.wait_until(first + self.number as f64 * self.period);
        }
        let began = clock.now();
        let late = self
            .last_time
            .map_or(0.0, |last| began - last - self.period);
        // Ticks that the scheduler missed.
        let missed = match clock {
            Clock::Real(_) => (late / self.period).floor().max(0.0) as u64,
            Clock::Virtual(_) => 0,
        };
        self.number += missed;
        self.tick(began, late.max(0.0))?;
        self.meter.record_tick(clock.now() - began, missed);
        Ok(())
    }

    /// Disables the device and returns the report.
    pub fn finish(&mut self) -> LoopReport {
        self.disable();
        self.pulse.end();
        let report = self.report();
        self.report.send(report);
        report
    }

    /// The same after a panic; it also trips the other loops of the session.
    pub(crate) fn abandon(&mut self) {
        self.supervisor.trip_others();
        self.guard.trip(Fault::Panicked);
        self.fault = Some(Fault::Panicked);
        self.finish();
    }

    /// One tick at `time` [s], `lateness` [s] after it was due.
    ///
    /// # Errors
    /// When the device fails; it is disabled then.
    pub fn tick(&mut self, time: f64, lateness: f64) -> Result<Sample, Fault> {
        let permission = self.supervisor.permission(time);
        self.follow_session(&permission);
        // A force from before a stop is not sent after it, even if the session is armed again meanwhile.
        let goes_on = permission.state.allows_force() && permission.armings == self.armings;
        let (held, force) = match goes_on {
            true => (self.guard.rendered(), std::mem::take(&mut self.force)),
            false => (Vec3::zeros(), OutputForce::default()),
        };
        let answer = self.device.exchange(&Command::new(time, force));
        self.pulse.beat(time);
        let state = match answer {
            Ok(state) => state,
            Err(fault) => return Err(self.fail(fault)),
        };
        let permission = self.after_stop_button(&state, permission);
        let mut sample = self.control(time, state, &permission);
        sample.applied = held;
        self.meter.tick(&sample, lateness);
        self.publish(sample);
        if self.number.is_multiple_of(self.ticks_per_report()) {
            self.report.send(self.report());
        }
        self.number += 1;
        Ok(sample)
    }

    /// The report so far.
    pub fn report(&self) -> LoopReport {
        let fault = match self.guard.stage() {
            Stage::Faulted(fault) => Some(fault),
            _ => None,
        };
        LoopReport {
            priority: self.priority,
            interventions: self.guard.interventions(),
            faults: self.guard.faults(),
            fault: self.fault.or(fault),
            disabled: self.disabled,
            ..self.meter.report()
        }
    }

    /// From the state of the hand to the next command's force.
    fn control(&mut self, time: f64, mut state: DeviceState, permission: &Permission) -> Sample {
        state.time = time;
        let gap = self.last_time.map_or(self.period, |last| time - last);
        self.last_time = Some(time);
        if !state.present {
            self.velocity.reset();
        }
        let measured = self.velocity.update(time, &state.position);
        let velocity = state.velocity.unwrap_or(measured);
        state.velocity = Some(velocity);
        let force = self.controller.update(&state, gap);
        let commanded = CommandedForce {
            force,
            compensation: self.compensation(&state, gap),
            velocity,
            overdue: self.controller.overdue(),
            gap,
            allowed: permission.state.allows_force() && self.enabled,
            rearm_requested: permission.armings != self.armings && self.enabled,
        };
        self.armings = permission.armings;
        if let Some(fault) = permission.fault {
            self.guard.trip(fault);
        }
        let was = self.guard.stage();
        self.force = self.guard.pass(&commanded, &state, gap);
        self.report_stage(was);
        if self.is_off() {
            // The same tick, not the next one.
            self.disable();
        }
        Sample {
            tick: self.number,
            state,
            applied: Vec3::zeros(),
            commanded: force,
            added: self.controller.added(),
            output: self.guard.rendered(),
            compensation: self.guard.compensation(),
            age: self.controller.age(),
            stage: self.guard.stage(),
        }
    }

    /// The permission after a check of the device's stop button, which stops all loops of the session.
    fn after_stop_button(&self, state: &DeviceState, permission: Permission) -> Permission {
        let is_pressed = state.buttons & self.device.capabilities().stop_buttons != 0;
        if !is_pressed || permission.state == ForceState::Off {
            return permission;
        }
        self.supervisor.trip_with_reason(StopReason::DeviceButton);
        Permission {
            armings: permission.armings,
            ..self.supervisor.permission(state.time)
        }
    }

    /// Enables the device after a person armed, and disables it when the session is over.
    fn follow_session(&mut self, permission: &Permission) {
        if matches!(permission.state, ForceState::Off | ForceState::Tripped) {
            self.disable();
        }
        let asked = permission.armings != self.armings;
        let stays_off = self.is_off() && !asked;
        if self.enabled || stays_off || !permission.state.allows_force() {
            return;
        }
        match self.device.enable() {
            Ok(()) => self.enabled = true,
            Err(fault) => {
                self.guard.trip_again(fault);
                self.supervisor.trip_others();
            }
        }
    }

    /// Whether forces are off until a person arms.
    fn is_off(&self) -> bool {
        self.guard.is_latched() && matches!(self.guard.stage(), Stage::Faulted(_))
    }

    /// No force from now on, until the device is enabled again.
    fn disable(&mut self) {
        self.force = OutputForce::default();
        if std::mem::take(&mut self.enabled) {
            self.disabled = Some(self.device.disable());
        }
    }

    /// Reports the stage to the session. A fault that ends by itself, of a device without force, affects no other loop.
    fn report_stage(&self, was: Stage) {
        match (was, self.guard.stage()) {
            (Stage::Faulted(_), _) => {}
            (_, Stage::Faulted(_)) if self.guard.is_latched() => self.supervisor.trip_others(),
            (_, Stage::Ramping(_)) => self.supervisor.run(),
            _ => {}
        }
    }

    /// The compensation force for the device itself [N].
    fn compensation(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let Some(compensator) = &mut self.compensator else {
            return Vec3::zeros();
        };
        if self.guard.part() > 0.0 {
            return compensator.force(&state.position, dt);
        }
        compensator.reset();
        Vec3::zeros()
    }

    fn publish(&mut self, sample: Sample) {
        self.last = Some(sample);
        self.latest.send(Some(sample));
        self.log.add(sample);
    }

    /// Disables the device and ends the log with the reason: no hand is present any more.
    fn fail(&mut self, fault: Fault) -> Fault {
        self.disable();
        let had_failed = self.fault.is_some();
        if self.guard.is_latched() {
            self.supervisor.trip_others();
        }
        self.guard.trip(fault);
        self.fault = Some(fault);
        if let Some(mut sample) = self.last.filter(|_| !had_failed) {
            sample.tick = self.number;
            sample.state.present = false;
            let none = Vec3::zeros();
            (sample.applied, sample.commanded, sample.output) = (none, none, none);
            (sample.added, sample.compensation) = (none, none);
            sample.stage = Stage::Faulted(fault);
            self.publish(sample);
        }
        self.report.send(self.report());
        fault
    }

    fn ticks_per_report(&self) -> u64 {
        ((0.1 / self.period) as u64).max(1)
    }
}

impl Drop for ServoLoop {
    /// Also in a panic: no force stays on a hand.
    fn drop(&mut self) {
        self.disable();
        self.pulse.end();
    }
}
