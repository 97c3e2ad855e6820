use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Instant, SystemTime};

use super::message::{self, Status, append};
use super::{Request, Requests};
use crate::publisher::{
    MOST_CLIENTS, PublishedState, SURFACE_PERIOD, Serve, SharedSource, ShownTool, fill, locked,
};

/// Where readers of this protocol look.
pub const PORT: u16 = 18_944;

/// Bytes that a client may be behind: several organs.
const MOST_BEHIND: usize = 16 << 20;

/// What is sent.
const KINDS: [&str; 4] = ["TRANSFORM", "SENSOR", "STATUS", "POLYDATA"];

/// Under which name the system speaks of itself, and of the organ.
const SYSTEM: &str = "palpate";
const ORGAN: &str = "organ";

/// The server, on its thread.
pub(crate) struct Server {
    listener: TcpListener,
    source: SharedSource,
    clients: Vec<Client>,
    picture: PublishedState,
    /// What every client gets in this period.
    bytes: Vec<u8>,
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

impl Serve for Server {
    fn serve(&mut self) {
        self.accept();
        self.bytes.clear();
        self.fill();
        let answers = self.read();
        for (client, answer) in self.clients.iter_mut().zip(answers) {
            client.behind.extend(&self.bytes);
            client.behind.extend(answer);
        }
        self.clients.retain_mut(Client::write);
    }
}

impl Server {
    pub(crate) fn new(listener: TcpListener, source: SharedSource) -> Self {
        Self {
            listener,
            source,
            clients: Vec::new(),
            picture: PublishedState::default(),
            bytes: Vec::new(),
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
    fn fill(&mut self) {
        let time = SystemTime::now();
        fill(&self.source, &mut self.picture);
        let bytes = &mut self.bytes;
        for tool in &self.picture.tools {
            if let Some(place) = tool.place {
                append(bytes, "TRANSFORM", &tool.name, time, |body| {
                    message::transform(body, &place, &tool.orientation);
                });
            }
            append(bytes, "SENSOR", &tool.name, time, |body| {
                message::force(body, &tool.force);
            });
        }
        append(bytes, "STATUS", SYSTEM, time, |body| {
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
                append(&mut answer, "POLYDATA", ORGAN, SystemTime::now(), |body| {
                    message::surface(body, &surface);
                });
            }
            answer
        });
        answers.collect()
    }
}

fn answer_to(request: &Request, picture: &PublishedState, bytes: &mut Vec<u8>) {
    let time = SystemTime::now();
    match request.kind.as_str() {
        "GET_STATUS" => append(bytes, "STATUS", SYSTEM, time, |body| status(picture, body)),
        "GET_CAPABIL" => append(bytes, "CAPABILITY", SYSTEM, time, |body| {
            message::capability(body, &KINDS);
        }),
        // Transforms and forces come by themselves, surfaces when they are due.
        _ => {}
    }
}

fn status(picture: &PublishedState, body: &mut Vec<u8>) {
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
