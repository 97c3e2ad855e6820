//! A connection whose reading ends at a time, however slowly the bytes come.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// How long the system may keep what is written.
const WRITE_WITHIN: Duration = Duration::from_millis(20);

/// A connection with a time until which is read.
pub(super) struct TimedStream {
    stream: TcpStream,
    /// None: what is there, without waiting.
    until: Option<Instant>,
    waits: bool,
}

impl TimedStream {
    pub(super) fn new(stream: TcpStream) -> io::Result<Self> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(WRITE_WITHIN))?;
        Ok(Self {
            stream,
            until: None,
            waits: true,
        })
    }

    /// From now on reading waits until `until`; with none it does not wait.
    pub(super) fn wait_until(&mut self, until: Option<Instant>) {
        self.until = until;
    }

    fn block(&mut self, waits: bool) -> io::Result<()> {
        if self.waits != waits {
            self.stream.set_nonblocking(!waits)?;
            self.waits = waits;
        }
        Ok(())
    }
}

impl Read for TimedStream {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let Some(until) = self.until else {
            self.block(false)?;
            return self.stream.read(buffer);
        };
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(io::ErrorKind::WouldBlock.into());
        }
        self.block(true)?;
        self.stream.set_read_timeout(Some(left))?;
        self.stream.read(buffer)
    }
}

impl Write for TimedStream {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.block(true)?;
        self.stream.write(buffer)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}
