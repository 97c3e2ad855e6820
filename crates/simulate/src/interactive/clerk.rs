use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_files::{Event, SessionRow};
use palpate_servo::log;

use super::ROWS;
use crate::SessionFolderWriter;

/// How often rows are brought to their file [ms]: no more is lost when the program is killed.
const PERIOD: Duration = Duration::from_millis(50);

/// Reads every row of the model, writes those of a session that is recorded and hands all of them on, so that
/// neither a disk nor a window that sleeps loses one.
pub(super) struct Clerk {
    asks: std::sync::mpsc::Sender<Ask>,
    thread: Option<JoinHandle<()>>,
}

/// What a clerk is asked.
enum Ask {
    /// Records from the next new beginning on.
    Record(Box<SessionFolderWriter>),
    /// Ends the recording, and tells how that went.
    End(SyncSender<Result<(), palpate_files::Error>>),
}

/// What a clerk works with.
struct Desk {
    from: log::Reader<SessionRow>,
    to: log::Writer<SessionRow>,
    writer: Option<SessionFolderWriter>,
    /// Whether the session that is recorded has begun.
    has_begun: bool,
    failed: Option<palpate_files::Error>,
}

impl Clerk {
    /// Starts; none when there is no thread. The other end of the rows is given back.
    pub(super) fn start(from: log::Reader<SessionRow>) -> Option<(Self, log::Reader<SessionRow>)> {
        let (to, rows) = log::ring(ROWS);
        let (asks, asked) = channel();
        let desk = Desk {
            from,
            to,
            writer: None,
            has_begun: false,
            failed: None,
        };
        let thread = std::thread::Builder::new().name("clerk".to_owned());
        let thread = thread.spawn(move || desk.work(&asked)).ok()?;
        let clerk = Self {
            asks,
            thread: Some(thread),
        };
        Some((clerk, rows))
    }

    /// Records from the next new beginning on.
    pub(super) fn record(&self, writer: SessionFolderWriter) {
        // A clerk that is gone panicked, which the end of the recording tells.
        let _ = self.asks.send(Ask::Record(Box::new(writer)));
    }

    /// Ends the recording; what was recorded is on the disk.
    pub(super) fn end(&self) -> Result<(), palpate_files::Error> {
        let (tell, told) = std::sync::mpsc::sync_channel(1);
        let gone = || palpate_files::Error::Write {
            path: "the session".into(),
            source: std::io::Error::other("the thread that writes has ended"),
        };
        self.asks.send(Ask::End(tell)).map_err(|_| gone())?;
        told.recv().map_err(|_| gone())?
    }
}

impl Drop for Clerk {
    /// What was played is written.
    fn drop(&mut self) {
        let (asks, _) = channel();
        drop(std::mem::replace(&mut self.asks, asks));
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Desk {
    fn work(mut self, asked: &Receiver<Ask>) {
        loop {
            match asked.recv_timeout(PERIOD) {
                // Before the rows that have come since: the new beginning may be among them.
                Ok(Ask::Record(writer)) => {
                    self.writer = Some(*writer);
                    self.has_begun = false;
                    self.failed = None;
                }
                Ok(Ask::End(tell)) => {
                    self.copy();
                    let ended = match (self.failed.take(), self.writer.take()) {
                        (Some(error), _) => Err(error),
                        (None, Some(writer)) => writer.finish().map(drop),
                        (None, None) => Ok(()),
                    };
                    // Who asked may have gone.
                    let _ = tell.send(ended);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return self.copy(),
            }
            self.copy();
        }
    }

    fn copy(&mut self) {
        while let Some(row) = self.from.next_value() {
            self.has_begun |= row.events.contains(Event::BeginAnew);
            if let (true, Some(writer)) = (self.has_begun, &mut self.writer) {
                self.failed = self.failed.take().or(writer.write(&row).err());
            }
            self.to.add(row);
        }
        if let Some(writer) = &mut self.writer {
            self.failed = self.failed.take().or(writer.flush().err());
        }
        if self.failed.is_some() {
            self.writer = None;
        }
    }
}
