use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_files::{Event, SessionRow};
use palpate_servo::{StopReason, Supervisor, log};

use super::ROWS;
use crate::{Error, SessionFolderWriter};

/// How often rows are brought to their file [ms]: no more is lost when the program is killed.
const PERIOD: Duration = Duration::from_millis(50);

/// Rows of a recording that stay in memory until the next one begins [-], for a disk that fails: 20 minutes of two
/// tools at 200 Hz, 70 MB.
pub const MOST_ROWS_IN_MEMORY: usize = 480_000;

/// A recording whose rows can no longer be written. Those that were made stay in memory, up to
/// [`MOST_ROWS_IN_MEMORY`], and further ones join them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unwritten {
    /// Why, in a sentence.
    pub cause: String,
    /// Whether every row since the beginning is in memory. Else the first [`MOST_ROWS_IN_MEMORY`] are.
    pub is_whole: bool,
}

/// The thread that records: it reads every row of the model, writes those of a session and hands all of them on, so
/// that neither a disk nor a window that sleeps loses one.
pub(super) struct SessionRecorder {
    requests: Sender<Request>,
    unwritten: Arc<Mutex<Option<Unwritten>>>,
    thread: Option<JoinHandle<()>>,
}

/// What the thread is asked.
enum Request {
    /// Records from the next new beginning on.
    Record(Box<SessionFolderWriter>),
    /// Writes all rows from the beginning elsewhere, and goes on there.
    Elsewhere(Box<SessionFolderWriter>, SyncSender<Result<(), Error>>),
    /// Ends the recording, and replies how that went.
    End(SyncSender<Result<(), Error>>),
}

/// What the thread works with.
struct Recording {
    from: log::Reader<SessionRow>,
    to: log::Writer<SessionRow>,
    writer: Option<SessionFolderWriter>,
    stage: Stage,
    in_memory: Vec<SessionRow>,
    /// Of these rows.
    most: usize,
    /// A row of a new beginning that is not copied yet.
    beginning: Option<SessionRow>,
    /// Why rows can no longer be written.
    failed: Option<String>,
    unwritten: Arc<Mutex<Option<Unwritten>>>,
    /// Whose forces are taken off when a row cannot be written.
    stops: Option<Supervisor>,
}

/// How far the recording is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// The session's first row has not come yet.
    Awaited,
    /// Rows are recorded.
    Begun,
    /// There is none, or it has ended.
    Ended,
}

impl SessionRecorder {
    /// Starts; none when there is no thread. The other end of the rows is given back. `stops` is the session whose forces
    /// are taken off when a row cannot be written, if it displays any.
    pub(super) fn start(
        from: log::Reader<SessionRow>,
        stops: Option<Supervisor>,
    ) -> Option<(Self, log::Reader<SessionRow>)> {
        Self::with_memory(from, MOST_ROWS_IN_MEMORY, stops)
    }

    /// With another number of rows in memory.
    fn with_memory(
        from: log::Reader<SessionRow>,
        most: usize,
        stops: Option<Supervisor>,
    ) -> Option<(Self, log::Reader<SessionRow>)> {
        let (to, rows) = log::ring(ROWS);
        let (requests, requested) = channel();
        let unwritten = Arc::new(Mutex::new(None));
        let recording = Recording {
            from,
            to,
            writer: None,
            stage: Stage::Ended,
            in_memory: Vec::new(),
            most,
            beginning: None,
            failed: None,
            unwritten: unwritten.clone(),
            stops,
        };
        let thread = std::thread::Builder::new().name("recorder".to_owned());
        let thread = thread.spawn(move || recording.run(&requested)).ok()?;
        let recorder = Self {
            requests,
            unwritten,
            thread: Some(thread),
        };
        Some((recorder, rows))
    }

    /// Records from the next new beginning on.
    pub(super) fn record(&self, writer: SessionFolderWriter) {
        // A thread that is gone panicked, which the end of the recording tells.
        let _ = self.requests.send(Request::Record(Box::new(writer)));
    }

    /// Why rows can no longer be written, if they cannot.
    pub(super) fn unwritten(&self) -> Option<Unwritten> {
        let unwritten = self.unwritten.lock();
        unwritten.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Writes the recording elsewhere, from its beginning; if it goes on, there.
    pub(super) fn record_elsewhere(&self, writer: SessionFolderWriter) -> Result<(), Error> {
        self.ask(|reply| Request::Elsewhere(Box::new(writer), reply))
    }

    /// Ends the recording; what was recorded is on the disk, or still in memory.
    pub(super) fn end(&self) -> Result<(), Error> {
        self.ask(Request::End)
    }

    fn ask(
        &self,
        request: impl FnOnce(SyncSender<Result<(), Error>>) -> Request,
    ) -> Result<(), Error> {
        let (reply, replied) = sync_channel(1);
        let gone = || failure("the thread that writes has ended");
        self.requests.send(request(reply)).map_err(|_| gone())?;
        replied.recv().map_err(|_| gone())?
    }
}

fn failure(cause: impl Into<String>) -> Error {
    Error::Unrecorded {
        cause: cause.into(),
    }
}

impl Drop for SessionRecorder {
    /// What was played is written.
    fn drop(&mut self) {
        let (requests, _) = channel();
        drop(std::mem::replace(&mut self.requests, requests));
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Recording {
    fn run(mut self, requested: &Receiver<Request>) {
        loop {
            // A beginning belongs to a request that was made before it, which may have come while rows were copied.
            let request = match self.beginning {
                Some(_) => requested.recv_timeout(Duration::ZERO),
                None => requested.recv_timeout(PERIOD),
            };
            match request {
                Ok(Request::Record(writer)) => {
                    self.writer = Some(*writer);
                    self.stage = Stage::Awaited;
                    self.in_memory.clear();
                    self.failed = None;
                    self.show_failure();
                }
                Ok(Request::Elsewhere(writer, reply)) => {
                    self.copy();
                    let written = self.write_elsewhere(*writer);
                    // Before the reply: who asked looks next. It may also have gone.
                    self.show_failure();
                    let _ = reply.send(written);
                }
                Ok(Request::End(reply)) => {
                    self.copy();
                    let ended = self.end();
                    self.show_failure();
                    let _ = reply.send(ended);
                }
                Err(RecvTimeoutError::Timeout) => self.copy_beginning(),
                Err(RecvTimeoutError::Disconnected) => return self.copy(),
            }
            if self.stage == Stage::Awaited {
                self.copy_beginning();
            }
            self.copy_to_beginning();
        }
    }

    /// Copies all rows.
    fn copy(&mut self) {
        self.copy_beginning();
        while let Some(row) = self.from.next_value() {
            self.copy_row(row);
        }
        self.flush();
    }

    /// Copies the rows before the next new beginning.
    fn copy_to_beginning(&mut self) {
        while self.beginning.is_none()
            && let Some(row) = self.from.next_value()
        {
            match row.events.contains(Event::BeginAnew) {
                true => self.beginning = Some(row),
                false => self.copy_row(row),
            }
        }
        self.flush();
    }

    fn copy_beginning(&mut self) {
        if let Some(row) = self.beginning.take() {
            self.copy_row(row);
        }
    }

    fn copy_row(&mut self, row: SessionRow) {
        if self.stage == Stage::Awaited && row.events.contains(Event::BeginAnew) {
            self.stage = Stage::Begun;
        }
        if self.stage == Stage::Begun {
            // One more than can be kept: so it shows that they are not all.
            if self.in_memory.len() <= self.most {
                self.in_memory.push(row);
            }
            let written = self.writer.as_mut().map(|writer| writer.write(&row));
            self.fail_on(written);
        }
        self.to.add(row);
    }

    fn flush(&mut self) {
        let written = self.writer.as_mut().map(SessionFolderWriter::flush);
        self.fail_on(written);
        if self.failed.is_some() {
            // Memory may be full by now.
            self.show_failure();
        }
    }

    /// After a failure nothing more is written: a row would be missing in between.
    fn fail_on(&mut self, written: Option<Result<(), palpate_files::Error>>) {
        if let Some(Err(error)) = written {
            self.failed = Some(error.to_string());
            self.writer = None;
            if let Some(supervisor) = &self.stops {
                supervisor.trip_because(StopReason::Unrecorded);
            }
            self.show_failure();
        }
    }

    fn is_whole(&self) -> bool {
        self.in_memory.len() <= self.most
    }

    /// Tells who looks at the session.
    fn show_failure(&self) {
        let unwritten = self.failed.clone().map(|cause| Unwritten {
            cause,
            is_whole: self.is_whole(),
        });
        *self
            .unwritten
            .lock()
            .unwrap_or_else(PoisonError::into_inner) = unwritten;
    }

    /// All rows from the beginning, as far as they are in memory. Those that are not all stay without an end mark.
    fn write_elsewhere(&mut self, mut writer: SessionFolderWriter) -> Result<(), Error> {
        let most = self.most;
        for row in self.in_memory.iter().take(most) {
            writer.write(row)?;
        }
        writer.flush()?;
        if !self.is_whole() {
            return Err(failure(format!(
                "only the first {most} rows were in memory; they are there as an incomplete session"
            )));
        }
        self.failed = None;
        match self.stage {
            Stage::Ended => Ok(writer.finish().map(drop)?),
            Stage::Awaited | Stage::Begun => {
                self.writer = Some(writer);
                Ok(())
            }
        }
    }

    fn end(&mut self) -> Result<(), Error> {
        self.stage = Stage::Ended;
        if let Some(Err(error)) = self.writer.take().map(SessionFolderWriter::finish) {
            self.failed = Some(error.to_string());
        }
        match &self.failed {
            Some(cause) => Err(failure(cause)),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
#[cfg(target_os = "linux")]
mod tests;
