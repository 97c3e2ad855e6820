use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Instant, SystemTime};

use super::message::{self, Status, append};
use super::{Request, Requests};
use crate::publisher::{
    MAX_CLIENTS, PublishedState, SURFACE_PERIOD, Serve, SharedSource, ShownTool, fill, locked,
};

/// The default port of this protocol.
pub const PORT: u16 = 18_944;

/// Capacity for unsent bytes of a client: several organs.
const MAX_BEHIND: usize = 16 << 20;

/// The types of sent messages.
const KINDS: [&str; 4] = ["TRANSFORM", "SENSOR", "STATUS", "POLYDATA"];

/// The device names of the system and of the organ.
const SYSTEM: &str = "palpate";
const ORGAN: &str = "organ";

/// The server, on its thread.
pub(crate) struct Server {
    listener: TcpListener,
    source: SharedSource,
    clients: Vec<Client>,
    state: PublishedState,
    /// The data that every client gets in this period.
    bytes: Vec<u8>,
}

/// A client.
struct Client {
    stream: TcpStream,
    requests: Requests,
    /// The bytes that the system has not accepted yet.
    behind: Vec<u8>,
    /// Whether it requested a surface, and when it got the last one.
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
            state: PublishedState::default(),
            bytes: Vec::new(),
        }
    }

    fn accept(&mut self) {
        while let Ok((stream, _)) = self.listener.accept() {
            let is_welcome = self.clients.len() < MAX_CLIENTS;
            let is_set = stream.set_nonblocking(true).and(stream.set_nodelay(true));
            if is_welcome && is_set.is_ok() {
                self.clients.push(Client {
                    stream,
                    requests: Requests::default(),
                    behind: Vec::new(),
                    // Once without a request: some clients cannot send one.
                    wants_surface: true,
                    had_surface: None,
                });
            }
        }
    }

    /// Appends the data for all clients.
    fn fill(&mut self) {
        let time = SystemTime::now();
        fill(&self.source, &mut self.state);
        let bytes = &mut self.bytes;
        for tool in &self.state.tools {
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
            status(&self.state, body)
        });
    }

    /// Reads the clients' requests and returns the answers to each client.
    fn read(&mut self) -> Vec<Vec<u8>> {
        let (source, state) = (&self.source, &self.state);
        let answers = self.clients.iter_mut().map(|client| {
            let mut answer = Vec::new();
            client.read();
            while let Some(request) = client.requests.next_request() {
                client.wants_surface |= request.kind == "GET_POLYDATA";
                answer_to(&request, state, &mut answer);
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

fn answer_to(request: &Request, state: &PublishedState, bytes: &mut Vec<u8>) {
    let time = SystemTime::now();
    match request.kind.as_str() {
        "GET_STATUS" => append(bytes, "STATUS", SYSTEM, time, |body| status(state, body)),
        "GET_CAPABIL" => append(bytes, "CAPABILITY", SYSTEM, time, |body| {
            message::capability(body, &KINDS);
        }),
        // Transforms and forces are sent regularly, surfaces when they are due.
        _ => {}
    }
}

fn status(state: &PublishedState, body: &mut Vec<u8>) {
    let fault = |tool: &ShownTool| Some(format!("{}: {}", tool.name, tool.fault?));
    let fault = state.tools.iter().find_map(fault);
    match fault {
        Some(fault) => message::status(body, Status::HardwareFailure, &fault),
        None if state.paused => message::status(body, Status::Manual, "paused"),
        None => message::status(body, Status::Ok, "OK"),
    }
}

impl Client {
    /// Whether a requested surface is due; the caller then has to send it.
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
        // A bound, for a client that never stops.
        for _ in 0..16 {
            match self.stream.read(&mut buffer) {
                Ok(0) | Err(_) => return,
                Ok(length) => self.requests.add(&buffer[..length]),
            }
        }
    }

    /// Whether it is still connected, keeps up and sends valid requests.
    fn write(&mut self) -> bool {
        if self.requests.is_lost() || self.behind.len() > MAX_BEHIND {
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
