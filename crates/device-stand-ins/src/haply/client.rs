//! One client of the stand-in.

use std::io::Write;
use std::net::TcpStream;
use std::sync::atomic::Ordering;
use std::time::Duration;

use tungstenite::protocol::frame::Frame;
use tungstenite::protocol::frame::coding::{Data, OpCode};
use tungstenite::{Error, Message, WebSocket};

use super::words::{commands, frame};
use super::{PATIENCE, Shared, locked};
use crate::Misbehaviour;

type Socket = WebSocket<TcpStream>;

/// Without a message for so long, forces are taken off.
const IDLE: Duration = Duration::from_millis(50);

fn accept(stream: TcpStream) -> Option<Socket> {
    stream.set_nonblocking(false).ok()?;
    stream.set_nodelay(true).ok()?;
    let socket = tungstenite::accept(stream).ok()?;
    socket.get_ref().set_read_timeout(Some(PATIENCE)).ok()?;
    Some(socket)
}

/// Answers every message with a state.
pub(super) fn answer(stream: TcpStream, shared: &Shared) {
    let Some(mut socket) = accept(stream) else {
        return;
    };
    let mut driven = Vec::new();
    let wrong = locked(&shared.misbehaviour).clone();
    let first = frame(
        &locked(&shared.robots),
        &shared.settings,
        wrong.as_ref(),
        true,
    );
    let mut goes_on = send(&mut socket, first, wrong.as_ref());
    while goes_on && !shared.ended.load(Ordering::Relaxed) && !shared.cut.load(Ordering::Relaxed) {
        goes_on = match socket.read() {
            Ok(Message::Text(text)) => {
                let said = commands(&text, shared.settings.generation);
                answer_to(&said, &mut driven, &mut socket, shared)
            }
            Ok(_) => true,
            Err(Error::Io(error)) if is_waiting(&error) => {
                for robot in locked(&shared.robots).iter_mut() {
                    robot.rest_after(IDLE);
                }
                true
            }
            Err(_) => false,
        };
    }
    let mut robots = locked(&shared.robots);
    for number in driven {
        if let Some(robot) = robots.get_mut::<usize>(number) {
            robot.rest();
        }
    }
}

fn answer_to(
    said: &[(usize, palpate_servo::Vec3)],
    driven: &mut Vec<usize>,
    socket: &mut Socket,
    shared: &Shared,
) -> bool {
    let wrong = locked(&shared.misbehaviour).clone();
    if let Some(Misbehaviour::Stalls(time)) = wrong {
        std::thread::sleep(time);
    }
    let mut robots = locked(&shared.robots);
    for (number, force) in said {
        if let Some(robot) = robots.get_mut(*number) {
            robot.command(*force);
        }
        if !driven.contains(number) {
            driven.push(*number);
        }
    }
    let text = frame(&robots, &shared.settings, wrong.as_ref(), false);
    drop(robots);
    send(socket, text, wrong.as_ref())
}

/// Sends a state as it should be, or not; whether the connection stands.
fn send(socket: &mut Socket, text: String, wrong: Option<&Misbehaviour>) -> bool {
    let sent = match wrong {
        Some(Misbehaviour::Disconnects) => return false,
        Some(Misbehaviour::NoReply) => Ok(()),
        Some(Misbehaviour::SendsText(other)) => socket.send(Message::text(other.as_str())),
        Some(Misbehaviour::SendsBinary(bytes)) => socket.send(Message::binary(bytes.clone())),
        Some(Misbehaviour::SendsRaw(bytes)) => return socket.get_mut().write_all(bytes).is_ok(),
        Some(Misbehaviour::Truncates(length)) => {
            let cut = text.get(..*length).unwrap_or(&text);
            socket.send(Message::text(cut))
        }
        Some(Misbehaviour::Fragments(length)) => send_fragments(socket, &text, *length),
        Some(Misbehaviour::SendsBytewise(gap)) => return dribble(socket, text, *gap),
        Some(Misbehaviour::Repeats(times)) => {
            (0..=*times).try_for_each(|_| socket.send(Message::text(text.as_str())))
        }
        _ => socket.send(Message::text(text)),
    };
    sent.is_ok()
}

fn send_fragments(socket: &mut Socket, text: &str, length: usize) -> Result<(), Error> {
    let parts: Vec<&[u8]> = text.as_bytes().chunks(length.max(1)).collect();
    for (number, part) in parts.iter().enumerate() {
        let kind = if number == 0 {
            Data::Text
        } else {
            Data::Continue
        };
        let is_last = number + 1 == parts.len();
        let fragment = Frame::message(part.to_vec(), OpCode::Data(kind), is_last);
        socket.send(Message::Frame(fragment))?;
    }
    Ok(())
}

fn dribble(socket: &mut Socket, text: String, gap: Duration) -> bool {
    let whole = Frame::message(text.into_bytes(), OpCode::Data(Data::Text), true);
    let mut bytes = Vec::new();
    if whole.format(&mut bytes).is_err() {
        return false;
    }
    bytes.iter().all(|byte| {
        std::thread::sleep(gap);
        socket.get_mut().write_all(&[*byte]).is_ok()
    })
}

/// Tells every event since the client came.
pub(super) fn tell(stream: TcpStream, shared: &Shared) {
    let Some(mut socket) = accept(stream) else {
        return;
    };
    let mut told = locked(&shared.events).len();
    shared.listeners.fetch_add(1, Ordering::AcqRel);
    tell_on(&mut socket, &mut told, shared);
    shared.listeners.fetch_sub(1, Ordering::AcqRel);
}

fn tell_on(socket: &mut Socket, told: &mut usize, shared: &Shared) {
    while !shared.ended.load(Ordering::Relaxed) && !shared.cut.load(Ordering::Relaxed) {
        let new: Vec<String> = locked(&shared.events)[*told..].to_vec();
        *told += new.len();
        for event in new {
            let sent = socket.send(Message::text(event));
            shared.told.fetch_add(1, Ordering::AcqRel);
            if sent.is_err() {
                return;
            }
        }
        match socket.read() {
            Ok(_) => {}
            Err(Error::Io(error)) if is_waiting(&error) => {}
            Err(_) => return,
        }
    }
}

fn is_waiting(error: &std::io::Error) -> bool {
    use std::io::ErrorKind::{TimedOut, WouldBlock};
    matches!(error.kind(), WouldBlock | TimedOut)
}
