//! Servers that send the running simulation to other programs: tools, forces and the organ, read-only.
//!
//! A server listens on this machine alone, unless its address is another one, and accepts no command.

mod picture;

use std::fmt;
use std::io;
use std::net::{SocketAddr, TcpListener};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

pub use picture::{PublishedState, ShownSurface, ShownTool};

use crate::{openigtlink, rosbridge};

/// Period of the states.
const PERIOD: Duration = Duration::from_millis(20);

/// Period of the surfaces, per client.
pub(crate) const SURFACE_PERIOD: Duration = Duration::from_millis(100);

/// Largest number of clients of a server.
pub(crate) const MAX_CLIENTS: usize = 16;

/// The protocol of a server.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Protocol {
    /// Version 1 of OpenIGTLink, for 3D Slicer and PLUS: [`crate::openigtlink`].
    OpenIgtLink,
    /// Version 2 of rosbridge, JSON over a WebSocket, for clients of ROS: [`crate::rosbridge`].
    Rosbridge,
}

/// The source of states.
pub(crate) trait Source: Send {
    fn fill(&mut self, picture: &mut PublishedState);
    fn surface(&mut self) -> ShownSurface;
}

struct Both<P, S>(P, S);

impl<P: FnMut(&mut PublishedState) + Send, S: FnMut() -> ShownSurface + Send> Source
    for Both<P, S>
{
    fn fill(&mut self, picture: &mut PublishedState) {
        self.0(picture);
    }

    fn surface(&mut self) -> ShownSurface {
        self.1()
    }
}

/// A source, once there is one.
pub(crate) type SharedSource = Arc<Mutex<Option<Box<dyn Source>>>>;

/// The work of a server in each period, without waiting for any client.
pub(crate) trait Serve: Send {
    fn serve(&mut self);
}

/// A server that publishes given data. Copies are the same server; it ends with the last.
#[derive(Clone)]
pub struct Publisher(Arc<Running>);

struct Running {
    address: SocketAddr,
    protocol: Protocol,
    source: SharedSource,
    ended: Arc<AtomicBool>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

impl Publisher {
    /// A server at `address`, with nothing to publish yet.
    ///
    /// # Errors
    /// When the port is taken.
    pub fn open(address: SocketAddr, protocol: Protocol) -> io::Result<Self> {
        let listener = TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let source = SharedSource::default();
        let own = source.clone();
        let server: Box<dyn Serve> = match protocol {
            Protocol::OpenIgtLink => Box::new(openigtlink::Server::new(listener, own)),
            Protocol::Rosbridge => Box::new(rosbridge::Server::new(listener, own)),
        };
        let ended = Arc::new(AtomicBool::new(false));
        let stopped = ended.clone();
        let thread = std::thread::Builder::new().name("publisher".to_owned());
        let thread = thread.spawn(move || run(server, &stopped))?;
        Ok(Self(Arc::new(Running {
            address,
            protocol,
            source,
            ended,
            thread: Mutex::new(Some(thread)),
        })))
    }

    /// Its address.
    pub fn address(&self) -> SocketAddr {
        self.0.address
    }

    /// Its protocol.
    pub fn protocol(&self) -> Protocol {
        self.0.protocol
    }

    /// Publishes the state from `picture`, fifty times a second, and the result of `surface` when a client requests it.
    /// The server's thread calls both.
    pub fn show(
        &self,
        picture: impl FnMut(&mut PublishedState) + Send + 'static,
        surface: impl FnMut() -> ShownSurface + Send + 'static,
    ) {
        *locked(&self.0.source) = Some(Box::new(Both(picture, surface)));
    }
}

impl fmt::Debug for Publisher {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Publisher({:?}, {})", self.protocol(), self.address())
    }
}

impl PartialEq for Publisher {
    /// Whether it is the same server.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for Publisher {}

impl Drop for Running {
    fn drop(&mut self) {
        self.ended.store(true, Ordering::Relaxed);
        if let Some(thread) = locked(&self.thread).take() {
            // A thread that panicked has ended too.
            let _ = thread.join();
        }
    }
}

pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The server's thread.
fn run(mut server: Box<dyn Serve>, ended: &AtomicBool) {
    let mut next = Instant::now();
    while !ended.load(Ordering::Relaxed) {
        server.serve();
        next += PERIOD;
        let now = Instant::now();
        // Late periods are skipped.
        next = next.max(now);
        std::thread::sleep(next - now);
    }
}

/// The state that a server sends next.
pub(crate) fn fill(source: &SharedSource, picture: &mut PublishedState) {
    if let Some(source) = locked(source).as_mut() {
        source.fill(picture);
    }
}
