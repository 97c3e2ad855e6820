use std::fmt;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

use super::message::{self, Status, append};
use super::{Picture, Request, Requests, ShownSurface, ShownTool};

/// Where readers of this protocol look.
pub const PORT: u16 = 18_944;

/// From one picture to the next.
const PERIOD: Duration = Duration::from_millis(20);

/// How many may look on.
const MOST_CLIENTS: usize = 16;

/// Bytes that a client may be behind: several organs.
const MOST_BEHIND: usize = 16 << 20;

/// From one surface to the next, to one client.
const SURFACE_PERIOD: Duration = Duration::from_millis(100);

/// What is sent.
const KINDS: [&str; 4] = ["TRANSFORM", "SENSOR", "STATUS", "POLYDATA"];

/// Under which name the system speaks of itself, and of the organ.
const SYSTEM: &str = "palpate";
const ORGAN: &str = "organ";

/// Where pictures come from.
pub(super) trait Source: Send {
    fn fill(&mut self, picture: &mut Picture);
    fn surface(&mut self) -> ShownSurface;
}

struct Both<P, S>(P, S);

impl<P: FnMut(&mut Picture) + Send, S: FnMut() -> ShownSurface + Send> Source for Both<P, S> {
    fn fill(&mut self, picture: &mut Picture) {
        self.0(picture);
    }

    fn surface(&mut self) -> ShownSurface {
        self.1()
    }
}

/// A server that shows what it is given. Copies are the same server; it ends with the last.
#[derive(Clone)]
pub struct OperatingRoom(Arc<Running>);

struct Running {
    address: SocketAddr,
    source: Arc<Mutex<Option<Box<dyn Source>>>>,
    ended: Arc<AtomicBool>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

impl OperatingRoom {
    /// A server at `address`, with nothing to show yet.
    ///
    /// # Errors
    /// When the port is taken.
    pub fn open(address: SocketAddr) -> io::Result<Self> {
        let listener = TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let source: Arc<Mutex<Option<Box<dyn Source>>>> = Arc::default();
        let ended = Arc::new(AtomicBool::new(false));
        let room = Room {
            listener,
            source: source.clone(),
            clients: Vec::new(),
            picture: Picture::default(),
        };
        let asked = ended.clone();
        let thread = std::thread::Builder::new().name("openigtlink".to_owned());
        let thread = thread.spawn(move || room.run(&asked))?;
        Ok(Self(Arc::new(Running {
            address,
            source,
            ended,
            thread: Mutex::new(Some(thread)),
        })))
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.0.address
    }

    /// From now on shows what `picture` fills in, fifty times a second, and what `surface` gives when somebody asks.
    /// Both are called on the server's thread.
    pub fn show(
        &self,
        picture: impl FnMut(&mut Picture) + Send + 'static,
        surface: impl FnMut() -> ShownSurface + Send + 'static,
    ) {
        *locked(&self.0.source) = Some(Box::new(Both(picture, surface)));
    }
}

impl fmt::Debug for OperatingRoom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "OperatingRoom({})", self.address())
    }
}

impl PartialEq for OperatingRoom {
    /// Whether it is the same server.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for OperatingRoom {}

impl Drop for Running {
    fn drop(&mut self) {
        self.ended.store(true, Ordering::Relaxed);
        if let Some(thread) = locked(&self.thread).take() {
            // One that panicked has ended too.
            let _ = thread.join();
        }
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The server's thread.
struct Room {
    listener: TcpListener,
    source: Arc<Mutex<Option<Box<dyn Source>>>>,
    clients: Vec<Client>,
    picture: Picture,
}

/// Who looks on.
struct Client {
    stream: TcpStream,
    requests: Requests,
    /// What the system did not take yet.
    behind: Vec<u8>,
    /// Whether it asked for a surface, and when it had the last.
    wants_surface: bool,
    had_surface: Option<Instant>,
}

impl Room {
    fn run(mut self, ended: &AtomicBool) {
        let mut next = Instant::now();
        let mut bytes = Vec::new();
        while !ended.load(Ordering::Relaxed) {
            self.accept();
            bytes.clear();
            self.fill(&mut bytes);
            let answers = self.read();
            for (client, answer) in self.clients.iter_mut().zip(answers) {
                client.behind.extend(&bytes);
                client.behind.extend(answer);
            }
            self.clients.retain_mut(Client::write);
            next += PERIOD;
            let now = Instant::now();
            // What is late is left out.
            next = next.max(now);
            std::thread::sleep(next - now);
        }
    }

    fn accept(&mut self) {
        while let Ok((stream, _)) = self.listener.accept() {
            let is_welcome = self.clients.len() < MOST_CLIENTS;
            let is_set = stream.set_nonblocking(true).and(stream.set_nodelay(true));
            if is_welcome && is_set.is_ok() {
                self.clients.push(Client {
                    stream,
                    requests: Requests::default(),
                    behind: Vec::new(),
                    // Once without asking: some have no way to.
                    wants_surface: true,
                    had_surface: None,
                });
            }
        }
    }

    /// Appends what everybody gets.
    fn fill(&mut self, bytes: &mut Vec<u8>) {
        let time = SystemTime::now();
        if let Some(source) = locked(&self.source).as_mut() {
            source.fill(&mut self.picture);
        }
        for tool in &self.picture.tools {
            if let Some(place) = tool.place {
                append(bytes, ("TRANSFORM", &tool.name), time, |body| {
                    message::transform(body, &place, &tool.orientation);
                });
            }
            append(bytes, ("SENSOR", &tool.name), time, |body| {
                message::force(body, &tool.force);
            });
        }
        append(bytes, ("STATUS", SYSTEM), time, |body| {
            status(&self.picture, body)
        });
    }

    /// What each client gets for itself.
    fn read(&mut self) -> Vec<Vec<u8>> {
        let (source, picture) = (&self.source, &self.picture);
        let answers = self.clients.iter_mut().map(|client| {
            let mut answer = Vec::new();
            client.read();
            while let Some(request) = client.requests.next_request() {
                client.wants_surface |= request.kind == "GET_POLYDATA";
                answer_to(&request, picture, &mut answer);
            }
            if client.is_surface_due()
                && let Some(source) = locked(source).as_mut()
            {
                let surface = source.surface();
                append(
                    &mut answer,
                    ("POLYDATA", ORGAN),
                    SystemTime::now(),
                    |body| {
                        message::surface(body, &surface);
                    },
                );
            }
            answer
        });
        answers.collect()
    }
}

fn answer_to(request: &Request, picture: &Picture, bytes: &mut Vec<u8>) {
    let time = SystemTime::now();
    match request.kind.as_str() {
        "GET_STATUS" => append(bytes, ("STATUS", SYSTEM), time, |body| {
            status(picture, body)
        }),
        "GET_CAPABIL" => append(bytes, ("CAPABILITY", SYSTEM), time, |body| {
            message::capability(body, &KINDS);
        }),
        // Transforms and forces come by themselves, surfaces when they are due.
        _ => {}
    }
}

fn status(picture: &Picture, body: &mut Vec<u8>) {
    let fault = |tool: &ShownTool| Some(format!("{}: {}", tool.name, tool.fault?));
    let fault = picture.tools.iter().find_map(fault);
    match fault {
        Some(fault) => message::status(body, Status::HardwareFailure, &fault),
        None if picture.paused => message::status(body, Status::Manual, "paused"),
        None => message::status(body, Status::Ok, "OK"),
    }
}

impl Client {
    /// Whether a surface that it asked for may be sent; it has to be then.
    fn is_surface_due(&mut self) -> bool {
        let rests = |last: Instant| last.elapsed() < SURFACE_PERIOD;
        if !self.wants_surface || self.had_surface.is_some_and(rests) {
            return false;
        }
        self.wants_surface = false;
        self.had_surface = Some(Instant::now());
        true
    }

    fn read(&mut self) {
        let mut buffer = [0; 4096];
        // A bound, for one that never stops.
        for _ in 0..16 {
            match self.stream.read(&mut buffer) {
                Ok(0) | Err(_) => return,
                Ok(length) => self.requests.add(&buffer[..length]),
            }
        }
    }

    /// Whether it is still there, keeps up and makes sense.
    fn write(&mut self) -> bool {
        if self.requests.is_lost() || self.behind.len() > MOST_BEHIND {
            return false;
        }
        loop {
            if self.behind.is_empty() {
                return true;
            }
            match self.stream.write(&self.behind) {
                Ok(0) => return false,
                Ok(length) => drop(self.behind.drain(..length)),
                Err(error) if error.kind() == ErrorKind::WouldBlock => return true,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(_) => return false,
            }
        }
    }
}
