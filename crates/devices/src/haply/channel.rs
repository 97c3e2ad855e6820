//! A WebSocket to the service: messages with a timeout, whatever the other side does.

use std::io;
use std::net::{TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};

use palpate_servo::Fault;
use tungstenite::client::IntoClientRequest;
use tungstenite::handshake::HandshakeError;
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, Utf8Bytes, WebSocket};

use super::timed_stream::TimedStream;
use crate::OpenError;

/// Timeout for the connection.
const CONNECT_WITHIN: Duration = Duration::from_secs(1);

/// The largest message [B]: a full one of a device is 2 kB.
const LARGEST: usize = 1 << 20;

/// A connection that exchanges messages.
pub(super) struct Channel {
    socket: WebSocket<TimedStream>,
    /// Why reading ended: after an invalid frame the socket cannot read the next one.
    unreadable: Option<Fault>,
}

impl Channel {
    /// Connects to `port` of `host`.
    pub(super) fn open(host: &str, port: u16) -> Result<Self, OpenError> {
        let address = format!("{host}:{port}");
        let no_service = |cause| OpenError::NoService {
            address: address.clone(),
            cause,
        };
        let stream = connect(host, port).map_err(no_service)?;
        let mut stream = TimedStream::new(stream).map_err(no_service)?;
        let until = Instant::now() + CONNECT_WITHIN;
        stream.wait_until(Some(until));
        let other = |what: String| OpenError::NotTheService {
            address: address.clone(),
            what,
        };
        let request = format!("ws://{address}/").into_client_request();
        let request = request.map_err(|error| other(error.to_string()))?;
        let limits = WebSocketConfig::default()
            .max_message_size(Some(LARGEST))
            .max_frame_size(Some(LARGEST));
        match tungstenite::client::client_with_config(request, stream, Some(limits)) {
            Ok((socket, _)) => Ok(Self {
                socket,
                unreadable: None,
            }),
            Err(HandshakeError::Interrupted(_)) => Err(other("it accepts, and is silent".into())),
            Err(HandshakeError::Failure(Error::Io(cause))) => Err(no_service(cause)),
            Err(HandshakeError::Failure(error)) => Err(other(error.to_string())),
        }
    }

    /// Sends `message`.
    pub(super) fn send(&mut self, message: &str) -> Result<(), Fault> {
        self.socket
            .send(Message::text(message))
            .map_err(|error| fault_of(&error))
    }

    /// The next message, until `until`.
    pub(super) fn receive(&mut self, until: Instant) -> Result<Utf8Bytes, Fault> {
        self.socket.get_mut().wait_until(Some(until));
        loop {
            match self.read()? {
                Some(Message::Text(text)) => return Ok(text),
                Some(Message::Binary(_)) => {
                    return Err(Fault::BadMessage {
                        what: "bytes instead of a text",
                    });
                }
                Some(Message::Close(_)) => return Err(Fault::Disconnected),
                // It answers pings by itself; a service that does nothing else is silent.
                Some(_) if Instant::now() < until => {}
                Some(_) | None => return Err(Fault::Silent),
            }
        }
    }

    /// The next message, if one has arrived.
    pub(super) fn receive_waiting(&mut self) -> Result<Option<Utf8Bytes>, Fault> {
        self.socket.get_mut().wait_until(None);
        // A bound against endless pings.
        for _ in 0..8 {
            match self.read()? {
                Some(Message::Text(text)) => return Ok(Some(text)),
                Some(Message::Close(_)) => return Err(Fault::Disconnected),
                Some(_) => {}
                None => return Ok(None),
            }
        }
        Ok(None)
    }

    /// The next message; none when it does not come in time.
    fn read(&mut self) -> Result<Option<Message>, Fault> {
        if let Some(fault) = self.unreadable {
            return Err(fault);
        }
        match self.socket.read() {
            Ok(message) => Ok(Some(message)),
            Err(error) if is_waiting(&error) => Ok(None),
            Err(error) => {
                let fault = fault_of(&error);
                self.unreadable = Some(fault);
                Err(fault)
            }
        }
    }

    /// Sends the closing message and does not wait for the answer.
    pub(super) fn close(&mut self) {
        self.socket.get_mut().wait_until(None);
        let _ = self.socket.close(None);
        let _ = self.socket.flush();
    }
}

fn connect(host: &str, port: u16) -> io::Result<TcpStream> {
    let host = host.trim_start_matches('[').trim_end_matches(']');
    let mut last = io::Error::from(io::ErrorKind::AddrNotAvailable);
    for address in (host, port).to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, CONNECT_WITHIN) {
            Ok(stream) => return Ok(stream),
            Err(error) => last = error,
        }
    }
    Err(last)
}

fn is_waiting(error: &Error) -> bool {
    use io::ErrorKind::{TimedOut, WouldBlock};
    matches!(error, Error::Io(io) if matches!(io.kind(), WouldBlock | TimedOut))
}

fn fault_of(error: &Error) -> Fault {
    match error {
        // The send buffer is full: the other side does not read.
        _ if is_waiting(error) => Fault::Silent,
        Error::Io(_) | Error::ConnectionClosed | Error::AlreadyClosed => Fault::Disconnected,
        Error::Protocol(tungstenite::error::ProtocolError::ResetWithoutClosingHandshake) => {
            Fault::Disconnected
        }
        Error::Capacity(_) => Fault::BadMessage {
            what: "a message that is too long",
        },
        Error::Utf8(_) => Fault::BadMessage {
            what: "a text that is none",
        },
        _ => Fault::BadMessage {
            what: "what is no WebSocket",
        },
    }
}
