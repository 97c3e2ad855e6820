//! The thread that calls the library, so that a call that does not come back holds up nobody.

use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_servo::{Fault, Vec3};

use super::functions::{Opened, Status};
use crate::places::PATIENCE;

/// How long a force is displayed without a new one.
const FRESH: Duration = Duration::from_millis(20);

/// How long the thread is waited for at the end.
const FAREWELL: Duration = Duration::from_millis(200);

/// What the library said, in its axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Said {
    pub(super) position: Vec3,
    pub(super) frame: [[f64; 3]; 3],
    pub(super) buttons: u32,
    pub(super) status: Status,
}

/// The servo loop's end.
pub(super) struct Calls {
    forces: Option<SyncSender<Vec3>>,
    answers: Receiver<Result<Said, i32>>,
    thread: Option<JoinHandle<()>>,
    /// How long an answer may take.
    pub(super) patience: Duration,
}

impl Calls {
    pub(super) fn start(device: Opened) -> Result<Self, Fault> {
        let (forces, commanded) = sync_channel(1);
        // One more, for the answer to a stop that nobody reads.
        let (answer, answers) = sync_channel(2);
        let thread = std::thread::Builder::new().name("force dimension".to_owned());
        let thread = thread
            .spawn(move || serve(device, &commanded, &answer))
            .map_err(|_| Fault::NoThread)?;
        Ok(Self {
            forces: Some(forces),
            answers,
            thread: Some(thread),
            patience: PATIENCE,
        })
    }

    /// Force [N] out, what the library says back.
    pub(super) fn exchange(&mut self, force: Vec3) -> Result<Result<Said, i32>, Fault> {
        // The answer to a stop is not that to this.
        while self.answers.try_recv().is_ok() {}
        self.send(force)?;
        self.answers
            .recv_timeout(self.patience)
            .map_err(|_| Fault::Silent)
    }

    /// Sends a force whose answer nobody waits for.
    pub(super) fn send(&mut self, force: Vec3) -> Result<(), Fault> {
        let forces = self.forces.as_ref().ok_or(Fault::Disconnected)?;
        match forces.try_send(force) {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(_)) => Err(Fault::Silent),
            Err(TrySendError::Disconnected(_)) => Err(Fault::Disconnected),
        }
    }
}

impl Drop for Calls {
    fn drop(&mut self) {
        self.forces = None;
        let Some(thread) = self.thread.take() else {
            return;
        };
        let naps = 100;
        for _ in 0..naps {
            if thread.is_finished() {
                // One that panicked has ended too.
                let _ = thread.join();
                return;
            }
            std::thread::sleep(FAREWELL / naps);
        }
        // A call that does not come back; when it does, the thread takes the forces off.
    }
}

fn serve(device: Opened, forces: &Receiver<Vec3>, answers: &SyncSender<Result<Said, i32>>) {
    loop {
        match forces.recv_timeout(FRESH) {
            Ok(force) => {
                // One that waits meanwhile, of a loop that gave up, is newer.
                let force = forces.try_iter().last().unwrap_or(force);
                let answer = exchange(device, &force);
                if answer.is_err() {
                    // A library that takes no zero takes this.
                    device.disable_forces();
                }
                let _ = answers.try_send(answer);
            }
            Err(RecvTimeoutError::Timeout) => {
                let _ = device.set_force(&Vec3::zeros());
            }
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    let _ = device.set_force(&Vec3::zeros());
    device.disable_forces();
    device.close();
}

fn exchange(device: Opened, force: &Vec3) -> Result<Said, i32> {
    device.set_force(force)?;
    Ok(Said {
        position: device.position()?,
        frame: device.frame()?,
        buttons: device.buttons(),
        status: device.status()?,
    })
}
