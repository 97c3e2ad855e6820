use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_files::{Event, SessionRow};
use palpate_servo::{StopReason, Supervisor, log};

use super::ROWS;
use crate::{Error, SessionFolderWriter};

/// Interval at which rows are written to their file [ms]: a kill of the program loses no more.
const PERIOD: Duration = Duration::from_millis(50);

/// Rows of a recording that stay in memory until the next one begins [-], in case the disk fails: 20 minutes of two
/// tools at 200 Hz, 70 MB.
pub const MAX_ROWS_IN_MEMORY: usize = 480_000;

/// A recording whose rows can no longer be written. The rows so far stay in memory, up to [`MAX_ROWS_IN_MEMORY`], and
/// further ones join them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordingFailure {
    /// Why, in a sentence.
    pub cause: String,
    /// Whether every row since the beginning is in memory. Else the first [`MAX_ROWS_IN_MEMORY`] are.
    pub is_complete: bool,
}

/// The recorder thread: it reads every row of the model, writes those of a session and passes all of them on, so that
/// neither a slow disk nor a sleeping window loses one.
pub(super) struct SessionRecorder {
    requests: Sender<Request>,
    unwritten: Arc<Mutex<Option<RecordingFailure>>>,
    thread: Option<JoinHandle<()>>,
}

/// A request to the recorder thread.
enum Request {
    /// Records from the next restart on.
    Record(Box<SessionFolderWriter>),
    /// Writes all rows from the start of the recording to another folder, and continues there.
    Elsewhere(Box<SessionFolderWriter>, SyncSender<Result<(), Error>>),
    /// Ends the recording, and replies with the result.
    End(SyncSender<Result<(), Error>>),
}

/// State of the recorder thread.
struct Recording {
    from: log::Reader<SessionRow>,
    to: log::Writer<SessionRow>,
    writer: Option<SessionFolderWriter>,
    stage: Stage,
    in_memory: Vec<SessionRow>,
    /// Largest number of rows in memory.
    most: usize,
    /// First row after a restart, not yet copied.
    beginning: Option<SessionRow>,
    /// Why rows can no longer be written.
    failed: Option<String>,
    unwritten: Arc<Mutex<Option<RecordingFailure>>>,
    /// The session whose forces go off when a row cannot be written.
    stops: Option<Supervisor>,
}

/// The state of the recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// The session's first row has not arrived yet.
    Awaited,
    /// Rows are recorded.
    Begun,
    /// No recording, or it has ended.
    Ended,
}

impl SessionRecorder {
    /// Starts the thread; none if the system provides none. Also returns the other end of the rows. `stops` is the
    /// session whose forces go off when a row cannot be written, if it displays any.
    pub(super) fn start(
        from: log::Reader<SessionRow>,
        stops: Option<Supervisor>,
    ) -> Option<(Self, log::Reader<SessionRow>)> {
        Self::with_memory(from, MAX_ROWS_IN_MEMORY, stops)
    }

    /// With another limit of rows in memory.
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

    /// Records from the next restart on.
    pub(super) fn record(&self, writer: SessionFolderWriter) {
        // A missing thread has panicked; the end of the recording reports that.
        let _ = self.requests.send(Request::Record(Box::new(writer)));
    }

    /// Why rows can no longer be written, if they cannot.
    pub(super) fn recording_failure(&self) -> Option<RecordingFailure> {
        let unwritten = self.unwritten.lock();
        unwritten.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Writes the recording from its start to another folder, and continues there if it still runs.
    pub(super) fn record_elsewhere(&self, writer: SessionFolderWriter) -> Result<(), Error> {
        self.ask(|reply| Request::Elsewhere(Box::new(writer), reply))
    }

    /// Ends the recording; its rows are on the disk, or still in memory.
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
    /// Writes all pending rows.
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
            // A restart belongs to a request from before it, which may have arrived while rows were copied.
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
                    // Before the reply: the requester reads this next. It may also have gone.
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

    /// Copies the rows before the next restart.
    fn copy_to_beginning(&mut self) {
        while self.beginning.is_none()
            && let Some(row) = self.from.next_value()
        {
            match row.events.contains(Event::Restart) {
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
        if self.stage == Stage::Awaited && row.events.contains(Event::Restart) {
            self.stage = Stage::Begun;
        }
        if self.stage == Stage::Begun {
            // One more than the limit, as a sign that rows are missing.
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

    /// After a failure nothing more is written: otherwise a row in between would be missing.
    fn fail_on(&mut self, written: Option<Result<(), palpate_files::Error>>) {
        if let Some(Err(error)) = written {
            self.failed = Some(error.to_string());
            self.writer = None;
            if let Some(supervisor) = &self.stops {
                supervisor.trip_with_reason(StopReason::Unrecorded);
            }
            self.show_failure();
        }
    }

    fn is_complete(&self) -> bool {
        self.in_memory.len() <= self.most
    }

    /// Publishes the failure, if any, to the viewers of the session.
    fn show_failure(&self) {
        let unwritten = self.failed.clone().map(|cause| RecordingFailure {
            cause,
            is_complete: self.is_complete(),
        });
        *self
            .unwritten
            .lock()
            .unwrap_or_else(PoisonError::into_inner) = unwritten;
    }

    /// All rows from the start, as far as they are in memory. An incomplete session gets no end mark.
    fn write_elsewhere(&mut self, mut writer: SessionFolderWriter) -> Result<(), Error> {
        let most = self.most;
        for row in self.in_memory.iter().take(most) {
            writer.write(row)?;
        }
        writer.flush()?;
        if !self.is_complete() {
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
