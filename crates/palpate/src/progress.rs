//! Progress bars on standard error, for work that may take longer than a second.
//!
//! Nothing is drawn when standard error is no terminal, or when a program reads the answer.

use std::fmt;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use palpate_files::printable;
use palpate_jobs::ProgressCallback;

use crate::interrupt::{self, UninterruptedSection};
use crate::output;

/// Steps of the bar of one long work.
const PARTS: u64 = 1000;

/// How often the spinner turns.
const TURN: Duration = Duration::from_millis(120);

/// The reader of the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reader {
    Person,
    Machine,
}

impl Reader {
    /// From the option `--json`.
    pub(crate) fn of_json(json: bool) -> Self {
        if json { Self::Machine } else { Self::Person }
    }
}

/// A progress bar, drawn from its creation until it is dropped.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// Turns the spinner until its other end is dropped.
    _turning: Option<Sender<()>>,
    pace: Option<Pace>,
    reader: Reader,
    /// Warnings that were printed.
    warned: Mutex<Vec<String>>,
}

/// Estimates the remaining time from the usual duration of each part and the actual duration of the completed ones.
struct Pace {
    begun: Instant,
    /// Usual duration of all parts [s].
    usual: f64,
    /// Usual and actual duration of the completed parts [s].
    done: Mutex<[f64; 2]>,
}

impl Pace {
    /// Weight of the usual durations relative to those of this machine [s].
    const TRUST: f64 = 30.0;

    fn left(&self) -> Duration {
        let [usual, took] = *self.done.lock().unwrap_or_else(PoisonError::into_inner);
        let slowness = (took + Self::TRUST) / (usual + Self::TRUST);
        let within = self.begun.elapsed().as_secs_f64() - took;
        let left = (self.usual - usual) * slowness - within;
        Duration::from_secs_f64(left.max(1.0))
    }
}

impl Progress {
    /// A bar over `steps` steps, or a spinner when their number is not known.
    pub(crate) fn new(reader: Reader, steps: Option<u64>) -> Self {
        let target = match reader {
            Reader::Person => ProgressDrawTarget::stderr(),
            Reader::Machine => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(steps, target);
        let template = match steps {
            Some(_) => "{spinner} {bar:30} {pos}/{len} {wide_msg}",
            None => "{spinner} {wide_msg}",
        };
        // The templates are constants; the plain bar would do as well.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self {
            _turning: turning(&bar),
            bar,
            pace: None,
            reader,
            warned: Mutex::default(),
        }
    }

    /// A bar over parts that usually take `seconds` together, with the remaining time.
    pub(crate) fn of_works(reader: Reader, seconds: f64) -> Self {
        let mut progress = Self::new(reader, Some(seconds.ceil() as u64));
        let template = "{spinner} {bar:30} about {prefix} left: {wide_msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            progress.bar.set_style(style);
        }
        progress.pace = Some(Pace {
            begun: Instant::now(),
            usual: seconds,
            done: Mutex::new([0.0; 2]),
        });
        progress
    }

    /// Completes a part, which usually takes `seconds`.
    pub(crate) fn work_done(&self, seconds: f64) {
        if let Some(pace) = &self.pace {
            let mut done = pace.done.lock().unwrap_or_else(PoisonError::into_inner);
            let usual = done[0] + seconds;
            *done = [usual, pace.begun.elapsed().as_secs_f64()];
            self.bar.set_position(usual.round() as u64);
        }
    }

    /// Takes the bar away while `print` writes to standard output.
    pub(crate) fn aside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// A bar over the parts of one long work, with the remaining time.
    pub(crate) fn of_parts(reader: Reader) -> Self {
        let bar = Self::new(reader, Some(PARTS));
        let template = "{spinner} {bar:30} {percent:>3} % {msg}{left}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            let left = |state: &ProgressState, text: &mut dyn fmt::Write| {
                // No estimate before a part is done.
                if state.pos() > 0 {
                    let _ = write!(text, ", {:#} left", HumanDuration(state.eta()));
                }
            };
            bar.bar.set_style(style.with_key("left", left));
        }
        bar
    }

    /// A bar over the parts of one job, whose duration is not known.
    pub(crate) fn of_job(reader: Reader) -> Self {
        let bar = Self::new(reader, Some(PARTS));
        let template = "{spinner} {bar:30} {percent:>3} % {wide_msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.bar.set_style(style);
        }
        bar
    }

    /// Shows the current step.
    pub(crate) fn show_step(&self, doing: impl Into<String>) {
        ProgressCallback::report_step(self, &doing.into());
    }

    /// Takes the bar away and returns those of `warnings` that were not printed yet.
    pub(crate) fn unprinted(self, mut warnings: Vec<String>) -> Vec<String> {
        let warned = self.warned.lock();
        let warned = warned.unwrap_or_else(PoisonError::into_inner);
        warnings.retain(|own| !warned.contains(own));
        warnings
    }

    /// Sets the number of completed steps.
    pub(crate) fn at(&self, step: u64) {
        self.bar.set_position(step);
    }
}

/// Turns the spinner on a thread; none when it is hidden, or when the system gives no thread: then it turns with each
/// new step.
fn turning(bar: &ProgressBar) -> Option<Sender<()>> {
    if bar.is_hidden() {
        return None;
    }
    let (turning, ended) = channel::<()>();
    let bar = bar.clone();
    let turn = move || {
        while ended.recv_timeout(TURN) == Err(RecvTimeoutError::Timeout) {
            bar.tick();
        }
    };
    Builder::new().spawn(turn).ok().map(|_| turning)
}

/// Ctrl-C asks a job to stop, unless its command ends between files by itself.
impl ProgressCallback for Progress {
    fn report_step(&self, doing: &str) {
        if let Some(pace) = &self.pace {
            self.bar.set_prefix(HumanDuration(pace.left()).to_string());
        }
        self.bar.set_message(printable(doing).into_owned());
    }

    fn warn(&self, warning: &str) {
        if self.reader == Reader::Person {
            self.aside(|| output::warnings(&[warning.to_owned()]));
            let mut warned = self.warned.lock().unwrap_or_else(PoisonError::into_inner);
            warned.push(warning.to_owned());
        }
    }

    fn report_fraction(&self, part: f64) {
        if let Some(steps) = self.bar.length() {
            self.bar.set_position((part * steps as f64).round() as u64);
        }
    }

    fn should_stop(&self) -> bool {
        interrupt::is_requested()
    }

    fn without_cancellation(&self, write: &mut dyn FnMut()) {
        let _unbroken = UninterruptedSection::begin();
        write();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
