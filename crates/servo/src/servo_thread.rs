use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use crate::{Clock, Fault, LoopReport, ServoLoop};

/// A servo loop on a thread of its own. Dropping it ends the thread.
pub struct ServoThread {
    stop: Arc<AtomicBool>,
    handle: Option<JoinHandle<LoopReport>>,
}

impl ServoThread {
    /// Starts `servo` on `clock`, at the best priority that there is.
    ///
    /// # Errors
    /// When the operating system gives no thread.
    pub fn start(mut servo: ServoLoop, mut clock: Clock) -> Result<Self, Fault> {
        let stop = Arc::new(AtomicBool::new(false));
        let asked = stop.clone();
        let run = move || {
            servo.raise_priority();
            servo.run(&mut clock, |_| !asked.load(Ordering::Relaxed))
        };
        let thread = std::thread::Builder::new().name("servo".to_owned());
        let handle = thread.spawn(run).map_err(|_| Fault::NoThread)?;
        Ok(Self {
            stop,
            handle: Some(handle),
        })
    }

    /// Whether it still runs; it ends by itself when its device fails.
    pub fn is_running(&self) -> bool {
        self.handle
            .as_ref()
            .is_some_and(|handle| !handle.is_finished())
    }

    /// Ends the loop, which stops its device, and waits for it.
    ///
    /// # Errors
    /// When it panicked; its device was stopped then.
    pub fn stop(mut self) -> Result<LoopReport, Fault> {
        self.join()
    }

    fn join(&mut self) -> Result<LoopReport, Fault> {
        self.stop.store(true, Ordering::Relaxed);
        let handle = self.handle.take();
        handle.map_or(Ok(LoopReport::default()), |handle| {
            handle.join().map_err(|_| Fault::Panicked)
        })
    }
}

impl Drop for ServoThread {
    fn drop(&mut self) {
        // Who wants to know calls `stop`.
        let _ = self.join();
    }
}
