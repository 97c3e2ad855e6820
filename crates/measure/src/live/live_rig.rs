use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

use palpate_servo::watch::{Watch, WatchThread};
use palpate_servo::{Clock, Fault, Supervisor, log};

use super::log_writer::LogWriter;
use super::{Commission, Console, ConsoleEvent, Operated, RigCommand};
use crate::{DepthTrajectory, Error, Rig, RigSample};

/// A rig that runs, and what is seen of it. Dropping it withdraws the indenter and ends its threads.
pub struct LiveRig {
    /// From where it is operated.
    pub console: Console,
    /// Every sample, for as long as somebody reads.
    pub samples: log::Reader<RigSample>,
    /// What happened.
    pub news: Receiver<ConsoleEvent>,
    commissions: Sender<Commission>,
    threads: Vec<JoinHandle<()>>,
    watch: WatchThread,
    /// What is told of who operates a device that is there, and when.
    supervisor: Option<Supervisor>,
    clock: Clock,
}

/// Samples that wait for a window: a quarter of a minute.
const SAMPLES: usize = 1 << 14;

/// How often what was told is written.
const CLERK_RESTS: Duration = Duration::from_millis(5);

impl LiveRig {
    /// Starts `rig`, which shall have a real clock.
    ///
    /// # Errors
    /// When the operating system gives no thread.
    pub fn start(rig: Rig) -> Result<Self, Error> {
        Self::start_until(rig, || false)
    }

    /// The same for a program that `is_ended` says shall end: a device that is there has no force then.
    ///
    /// # Errors
    /// As for [`start`](Self::start).
    pub fn start_until(rig: Rig, is_ended: fn() -> bool) -> Result<Self, Error> {
        // Over tissue that is not there nobody can be hurt, and the indenter withdraws in good order.
        let ends = if rig.is_real() { is_ended } else { || false };
        let watch = Watch::new(rig.supervisor(), vec![rig.watched()], ends);
        let clock = rig.clock();
        let watch = WatchThread::start(watch, clock)?;
        let supervisor = rig.is_real().then(|| rig.supervisor());
        let (operated, console, told) = Operated::new(rig);
        let (samples, samples_reader) = log::ring(SAMPLES);
        let (news, news_reader) = mpsc::channel();
        let (commissions, commissioned) = mpsc::channel();
        let log_writer = LogWriter {
            told,
            commissions: commissioned,
            samples,
            news,
            switches: console.switches(),
            open: None,
        };
        let mut live = Self {
            console,
            samples: samples_reader,
            news: news_reader,
            commissions,
            threads: Vec::new(),
            watch,
            supervisor,
            clock,
        };
        let ended = Arc::new(AtomicBool::new(false));
        let seen = ended.clone();
        live.spawn("rig", move || run(operated, &ended))?;
        live.spawn("clerk", move || write(log_writer, &seen))?;
        Ok(live)
    }

    /// Has a course pressed and recorded.
    pub fn press(&mut self, trajectory: DepthTrajectory, commission: Commission) {
        let number = commission.number;
        // A clerk that has gone says so by `is_running`.
        let _ = self.commissions.send(commission);
        self.console.send(RigCommand::Press(trajectory, number));
    }

    /// Says that who operates it is alive. A device that is there has no force any more when that is not said again within
    /// [`SILENCE`](palpate_servo::supervisor::SILENCE); who never says it need not.
    pub fn report_alive(&self) {
        if let Some(supervisor) = &self.supervisor {
            supervisor.report(self.clock.now());
        }
    }

    /// What a person has to know of a device that does not answer any more.
    pub fn hung_device(&self) -> Option<String> {
        self.watch.watch().warning()
    }

    /// Whether its threads still run.
    pub fn is_running(&self) -> bool {
        self.threads.iter().all(|thread| !thread.is_finished())
    }

    fn spawn(&mut self, name: &str, run: impl FnOnce() + Send + 'static) -> Result<(), Error> {
        let thread = Builder::new().name(name.to_owned());
        let thread = thread.spawn(run).map_err(|_| Fault::NoThread)?;
        self.threads.push(thread);
        Ok(())
    }
}

impl Drop for LiveRig {
    fn drop(&mut self) {
        self.console.end();
        if self.hung_device().is_some() {
            // Its thread never ends; without a force if it ever does.
            return;
        }
        for thread in self.threads.drain(..) {
            // One that panicked has stopped its device.
            let _ = thread.join();
        }
    }
}

fn run(mut operated: Operated, ended: &AtomicBool) {
    operated.rig().raise_priority();
    while operated.turn(&mut |_| ()) {}
    ended.store(true, Ordering::Release);
}

fn write(mut log_writer: LogWriter, ended: &AtomicBool) {
    loop {
        // Asked first, so that nothing is told after the last reading.
        let last = ended.load(Ordering::Acquire);
        log_writer.read();
        if last {
            return;
        }
        std::thread::sleep(CLERK_RESTS);
    }
}
