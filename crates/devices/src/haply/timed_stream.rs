//! A connection whose reads end at a deadline, however slowly the bytes arrive.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Timeout of a write.
const WRITE_WITHIN: Duration = Duration::from_millis(20);

/// A connection with a deadline for reads.
pub(super) struct TimedStream {
    stream: TcpStream,
    /// None: reads return only what has already arrived.
    until: Option<Instant>,
    is_blocking: bool,
}

impl TimedStream {
    pub(super) fn new(stream: TcpStream) -> io::Result<Self> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(WRITE_WITHIN))?;
        Ok(Self {
            stream,
            until: None,
            is_blocking: true,
        })
    }

    /// From now on reads wait until `until`; with none they do not wait.
    pub(super) fn wait_until(&mut self, until: Option<Instant>) {
        self.until = until;
    }

    fn block(&mut self, is_blocking: bool) -> io::Result<()> {
        if self.is_blocking != is_blocking {
            self.stream.set_nonblocking(!is_blocking)?;
            self.is_blocking = is_blocking;
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
