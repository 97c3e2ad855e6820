//! Long work, waited for as Python wants it: the interpreter is released, Ctrl-C is heard within 50 ms and asks the
//! work to stop, and how far it is goes to a Python callable.
//!
//! ```text
//! thread of the caller ── every 50 ms: signals, progress ──▶ Python
//!        │  ▲
//!        │  └── ProgressMessage (part, words) ── job on a thread of its own
//!        └──── asked to stop ───────▶
//! ```
//!
//! Whoever gives no callable gets `palpate.progress.Bar` once the work has taken a second; whoever gives `False`
//! gets nothing. A callable hears the beginning (part 0) and, of work that succeeds, the end (part 1), however short
//! it is.
//!
//! *How we know*: `tests/test_waiting.py`.
//!
//! *Limits*: work that does not ask whether it shall stop is waited for all the same. Signals come to Python's
//! main thread alone, as Python has it.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use palpate_files::printable;
use pyo3::prelude::*;
use pyo3::types::PyBool;

use crate::failure::Failure;

/// Between two looks at the signals.
const LOOK: Duration = Duration::from_millis(50);

/// Work that is done sooner shows no bar of its own.
const SHORT: Duration = Duration::from_secs(1);

/// What a job tells of itself, and hears.
#[derive(Debug, Default)]
pub(crate) struct ProgressMessage {
    asked_to_stop: AtomicBool,
    /// Bits of a part [-].
    part: AtomicU64,
    words: Mutex<String>,
    done: Mutex<bool>,
    ended: Condvar,
}

impl ProgressMessage {
    /// Says what is being done now.
    pub(crate) fn say(&self, words: impl Into<String>) {
        // Whatever shows it may be a terminal.
        *held(&self.words) = printable(&words.into()).into_owned();
    }

    /// How much is done, from 0 to 1 [-].
    pub(crate) fn at(&self, part: f64) {
        self.part
            .store(part.clamp(0.0, 1.0).to_bits(), Ordering::Relaxed);
    }

    /// Whether Ctrl-C was pressed, or the progress' callable has raised: whatever is returned then is dropped.
    pub(crate) fn should_stop(&self) -> bool {
        self.asked_to_stop.load(Ordering::Relaxed)
    }

    fn part(&self) -> f64 {
        f64::from_bits(self.part.load(Ordering::Relaxed))
    }

    fn end(&self) {
        *held(&self.done) = true;
        self.ended.notify_all();
    }

    /// Waits for the end, at most for a look; whether it has come.
    fn has_ended(&self) -> bool {
        let done = held(&self.done);
        let waited = self.ended.wait_timeout_while(done, LOOK, |done| !*done);
        *waited.unwrap_or_else(PoisonError::into_inner).0
    }
}

/// A lock holds plain values here, which a panic leaves whole.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Tells the end also when the job panics.
struct Ends<'t>(&'t ProgressMessage);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

/// Who hears how far it is.
struct Listener {
    told: Option<Py<PyAny>>,
    /// A bar is made once it is worth while.
    wants_bar: bool,
    began: Instant,
    last: Option<(f64, String)>,
}

impl Listener {
    fn new(py: Python<'_>, progress: Option<Py<PyAny>>) -> Self {
        let is_false = |given: &Py<PyAny>| {
            let given = given.bind(py).cast::<PyBool>();
            given.is_ok_and(|given| !given.is_true())
        };
        Self {
            wants_bar: progress.is_none(),
            told: progress.filter(|given| !is_false(given)),
            began: Instant::now(),
            last: None,
        }
    }

    /// Signals, then news.
    fn look(&mut self, py: Python<'_>, told: &ProgressMessage) -> PyResult<()> {
        py.check_signals()?;
        if self.wants_bar && self.told.is_none() && self.began.elapsed() >= SHORT {
            let bar = py.import("palpate.progress")?.getattr("Bar")?.call0()?;
            self.told = Some(bar.unbind());
        }
        let Some(callable) = &self.told else {
            return Ok(());
        };
        let news = (told.part(), held(&told.words).clone());
        if self.last.as_ref() != Some(&news) {
            callable.call1(py, (news.0, news.1.as_str()))?;
            self.last = Some(news);
        }
        Ok(())
    }

    /// Takes a bar of its own away.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        match &self.told {
            Some(bar) if self.wants_bar => bar.call_method0(py, "close").map(drop),
            _ => Ok(()),
        }
    }
}

/// Does `job` on a thread of its own with the interpreter released, and returns what it returns. `progress` is a
/// callable of (part, words), `False` for silence, or none for a bar.
///
/// # Errors
/// As `job`; `KeyboardInterrupt` after Ctrl-C, or what `progress` raised, whatever `job` then returned.
pub(crate) fn waiting<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    job: impl FnOnce(&ProgressMessage) -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let told = ProgressMessage::default();
    told.say("beginning");
    let mut listener = Listener::new(py, progress);
    listener.look(py, &told)?;
    let (outcome, raised) = py.detach(|| {
        thread::scope(|scope| {
            let work = || {
                let _ends = Ends(&told);
                job(&told)
            };
            let worker = thread::Builder::new()
                .spawn_scoped(scope, work)
                .map_err(|error| {
                    Failure::failed(format!(
                        "the system gives no thread ({error}); close other programs"
                    ))
                });
            let worker = match worker {
                Ok(worker) => worker,
                Err(failure) => return (Ok(Err(failure)), None),
            };
            let mut raised = None;
            while !told.has_ended() {
                if raised.is_none()
                    && let Err(error) = Python::attach(|py| listener.look(py, &told))
                {
                    told.asked_to_stop.store(true, Ordering::Relaxed);
                    raised = Some(error);
                }
            }
            (worker.join(), raised)
        })
    });
    let told_the_end = match &outcome {
        Ok(Ok(_)) if raised.is_none() => {
            told.at(1.0);
            listener.look(py, &told)
        }
        _ => Ok(()),
    };
    let closed = listener.close(py);
    if let Some(error) = raised {
        return Err(error);
    }
    match outcome {
        Ok(outcome) => told_the_end.and(closed).and(Ok(outcome?)),
        // A defect, which Python shows as one.
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// Waits `seconds` [s], for tests of waiting.
#[pyfunction]
#[pyo3(signature = (seconds, progress=None))]
pub(crate) fn _wait(py: Python<'_>, seconds: f64, progress: Option<Py<PyAny>>) -> PyResult<f64> {
    let seconds = Duration::try_from_secs_f64(seconds).map_err(Failure::input)?;
    let begin = Instant::now();
    waiting(py, progress, |told| {
        told.say("waiting");
        while begin.elapsed() < seconds {
            if told.should_stop() {
                // Whatever is returned is dropped.
                break;
            }
            told.at(begin.elapsed().as_secs_f64() / seconds.as_secs_f64());
            thread::sleep(Duration::from_millis(5));
        }
        Ok(begin.elapsed().as_secs_f64())
    })
}
