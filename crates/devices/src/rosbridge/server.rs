use std::collections::{BTreeMap, VecDeque};
use std::io::ErrorKind;
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant, SystemTime};

use serde_json::{Value, json};
use tungstenite::handshake::server::NoCallback;
use tungstenite::handshake::{HandshakeError, MidHandshake};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, ServerHandshake, Utf8Bytes, WebSocket};

use super::message::{self, Content};
use crate::publisher::{
    MAX_CLIENTS, PublishedState, SURFACE_PERIOD, Serve, SharedSource, fill, locked,
};

/// The largest message of a client [B].
const LARGEST: usize = 1 << 16;

/// Capacity for unsent bytes of a client: several organs.
const MAX_BEHIND: usize = 32 << 20;

/// Timeout of the WebSocket handshake of a client.
const HANDSHAKE_WITHIN: Duration = Duration::from_secs(2);

/// Largest number of topics of a client, of letters of a topic, and of messages that are read from it in a period.
const MAX_TOPICS: usize = 64;
const LONGEST_TOPIC: usize = 256;
const MAX_READ: usize = 16;

/// The server, on its thread.
pub(crate) struct Server {
    listener: TcpListener,
    source: SharedSource,
    arriving: Vec<Arriving>,
    clients: Vec<Client>,
    state: PublishedState,
}

type Role = ServerHandshake<TcpStream, NoCallback>;

/// A connection before its WebSocket handshake.
struct Arriving {
    handshake: MidHandshake<Role>,
    since: Instant,
}

struct Client {
    socket: WebSocket<TcpStream>,
    subscriptions: BTreeMap<String, Subscription>,
    /// Pending replies.
    replies: VecDeque<Value>,
    /// Whether the system has not yet accepted the sent data.
    is_behind: bool,
}

/// A topic of a client, with the least interval `period`.
#[derive(Default)]
struct Subscription {
    period: Duration,
    last: Option<Instant>,
}

impl Server {
    pub(crate) fn new(listener: TcpListener, source: SharedSource) -> Self {
        Self {
            listener,
            source,
            arriving: Vec::new(),
            clients: Vec::new(),
            state: PublishedState::default(),
        }
    }

    fn accept(&mut self) {
        let limits = WebSocketConfig::default()
            .max_message_size(Some(LARGEST))
            .max_frame_size(Some(LARGEST))
            .write_buffer_size(0)
            .max_write_buffer_size(MAX_BEHIND);
        while let Ok((stream, _)) = self.listener.accept() {
            let is_welcome = self.clients.len() + self.arriving.len() < MAX_CLIENTS;
            let is_set = stream.set_nonblocking(true).and(stream.set_nodelay(true));
            if is_welcome && is_set.is_ok() {
                let outcome = tungstenite::accept_with_config(stream, Some(limits));
                self.arrive(outcome, Instant::now());
            }
        }
        for Arriving { handshake, since } in std::mem::take(&mut self.arriving) {
            if since.elapsed() < HANDSHAKE_WITHIN {
                self.arrive(handshake.handshake(), since);
            }
        }
    }

    fn arrive(
        &mut self,
        outcome: Result<WebSocket<TcpStream>, HandshakeError<Role>>,
        since: Instant,
    ) {
        match outcome {
            Ok(socket) => self.clients.push(Client {
                socket,
                subscriptions: BTreeMap::new(),
                replies: VecDeque::new(),
                is_behind: false,
            }),
            Err(HandshakeError::Interrupted(handshake)) => {
                self.arriving.push(Arriving { handshake, since });
            }
            // It is no WebSocket.
            Err(HandshakeError::Failure(_)) => {}
        }
    }
}

impl Serve for Server {
    fn serve(&mut self) {
        self.accept();
        fill(&self.source, &mut self.state);
        let topics = message::topics(&self.state);
        self.clients.retain_mut(|client| client.read(&topics));
        let mut made: Vec<Option<Utf8Bytes>> = vec![None; topics.len()];
        let (now, time) = (Instant::now(), SystemTime::now());
        let (source, state) = (&self.source, &self.state);
        self.clients.retain_mut(|client| {
            if !client.flush() {
                return false;
            }
            for ((topic, content), made) in topics.iter().zip(&mut made) {
                if client.is_behind || !client.is_due(topic, *content, now) {
                    continue;
                }
                if made.is_none() {
                    // The same bytes for all clients.
                    let message = content_of(*content, state, source, time);
                    *made = message.map(|message| published(topic, &message));
                }
                if let Some(text) = made
                    && !client.send(Message::Text(text.clone()))
                {
                    return false;
                }
            }
            true
        });
    }
}

fn content_of(
    content: Content,
    state: &PublishedState,
    source: &SharedSource,
    time: SystemTime,
) -> Option<Value> {
    match content {
        Content::Pose(number) => message::pose(state.tools.get(number)?, time),
        Content::Wrench(number) => Some(message::wrench(state.tools.get(number)?, time)),
        Content::Status => Some(message::status(state)),
        Content::Organ => {
            let surface = locked(source).as_mut()?.surface();
            Some(message::mesh(&surface))
        }
    }
}

fn published(topic: &str, message: &Value) -> Utf8Bytes {
    let whole = json!({"op": "publish", "topic": topic, "msg": message});
    whole.to_string().into()
}

impl Client {
    /// Whether a topic is due for it; the caller then has to send it.
    fn is_due(&mut self, topic: &str, content: Content, now: Instant) -> bool {
        let Some(subscription) = self.subscriptions.get_mut(topic) else {
            return false;
        };
        let period = match content {
            Content::Organ => subscription.period.max(SURFACE_PERIOD),
            _ => subscription.period,
        };
        let is_due = subscription.last.is_none_or(|last| now >= last + period);
        if is_due {
            subscription.last = Some(now);
        }
        is_due
    }

    /// Reads its messages, and answers. Returns whether it is still connected.
    fn read(&mut self, topics: &[(String, Content)]) -> bool {
        for _ in 0..MAX_READ {
            match self.socket.read() {
                Ok(Message::Text(text)) => self.process_command(&text, topics),
                Ok(Message::Binary(_)) => self.refuse("a binary message; send JSON as text"),
                Ok(Message::Close(_)) | Err(Error::ConnectionClosed | Error::AlreadyClosed) => {
                    let _ = self.socket.flush();
                    return false;
                }
                Ok(_) => {}
                Err(error) if is_waiting(&error) => break,
                Err(_) => return false,
            }
        }
        while let Some(reply) = self.replies.pop_front() {
            if !self.send(Message::text(reply.to_string())) {
                return false;
            }
        }
        true
    }

    fn process_command(&mut self, text: &str, topics: &[(String, Content)]) {
        let Ok(command) = serde_json::from_str::<Value>(text) else {
            return self.refuse("a message that is not JSON; send an object with `op`");
        };
        let word = |key: &str| command[key].as_str().unwrap_or_default();
        match word("op") {
            "subscribe" => self.subscribe(&command, topics),
            "unsubscribe" => {
                self.subscriptions.remove(word("topic"));
            }
            "call_service" => self.replies.push_back(answer(&command, topics)),
            "" => {
                self.refuse("a message without `op`; send `{\"op\": \"subscribe\", \"topic\": …}`")
            }
            other => {
                let other: String = other.chars().take(LONGEST_TOPIC).collect();
                self.refuse(&format!(
                    "`{other}`; it only publishes, so send `subscribe`, `unsubscribe` or `call_service`"
                ));
            }
        }
    }

    fn subscribe(&mut self, command: &Value, topics: &[(String, Content)]) {
        let topic = command["topic"].as_str().unwrap_or_default();
        if !topics.iter().any(|(name, _)| name == topic) {
            let names: Vec<&str> = topics.iter().map(|(name, _)| name.as_str()).collect();
            let topic: String = topic.chars().take(LONGEST_TOPIC).collect();
            self.refuse(&format!(
                "a subscription to `{topic}`; there are {}",
                names.join(", ")
            ));
        }
        // A tool may appear later, with another scene.
        if topic.len() <= LONGEST_TOPIC && self.subscriptions.len() < MAX_TOPICS {
            let period = command["throttle_rate"].as_f64().unwrap_or(0.0);
            self.subscriptions.insert(
                topic.to_owned(),
                Subscription {
                    period: Duration::from_secs_f64(1e-3 * period.clamp(0.0, 1e6)),
                    last: None,
                },
            );
        }
    }

    fn refuse(&mut self, what: &str) {
        let message = format!("palpate got {what}");
        self.replies
            .push_back(json!({"op": "status", "level": "error", "msg": message}));
    }

    /// Returns whether it is still connected. Data that the system does not accept now go with the next ones.
    fn send(&mut self, message: Message) -> bool {
        let outcome = self.socket.write(message);
        self.went(outcome) && self.flush()
    }

    fn flush(&mut self) -> bool {
        self.is_behind = false;
        let outcome = self.socket.flush();
        self.went(outcome)
    }

    fn went(&mut self, outcome: Result<(), Error>) -> bool {
        match outcome {
            Ok(()) => true,
            Err(error) if is_waiting(&error) => {
                self.is_behind = true;
                true
            }
            Err(_) => false,
        }
    }
}

fn is_waiting(error: &Error) -> bool {
    matches!(error, Error::Io(io) if io.kind() == ErrorKind::WouldBlock)
}

/// The answer to a request for topics, as `rosapi` gives it.
fn answer(command: &Value, topics: &[(String, Content)]) -> Value {
    let service = &command["service"];
    let of = |topic: &Value| {
        let found = topics.iter().find(|(name, _)| topic == name);
        found.map_or("", |(_, content)| content.kind())
    };
    let values = match service.as_str().unwrap_or_default() {
        "/rosapi/topics" => {
            let names: Vec<&str> = topics.iter().map(|(name, _)| name.as_str()).collect();
            let kinds: Vec<&str> = topics.iter().map(|(_, content)| content.kind()).collect();
            Some(json!({"topics": names, "types": kinds}))
        }
        "/rosapi/topic_type" => Some(json!({"type": of(&command["args"]["topic"])})),
        _ => None,
    };
    let mut reply = json!({
        "op": "service_response",
        "service": service,
        "result": values.is_some(),
        "values": values.unwrap_or_else(|| "palpate has /rosapi/topics and /rosapi/topic_type".into()),
    });
    if let Some(id) = command.get("id") {
        reply["id"] = id.clone();
    }
    reply
}
