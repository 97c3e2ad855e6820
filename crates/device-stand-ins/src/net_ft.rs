//! What stands for an ATI Net F/T: a server of its protocol on the loopback.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_devices::force_sensor::{Counts, NetFtAddress, PACKET};
use palpate_servo::ForceTorque;

/// Between two packets.
const PERIOD: Duration = Duration::from_micros(500);

/// What the stand-in does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NetFtFault {
    /// It sends.
    #[default]
    None,
    /// It is silent.
    Silent,
    /// Its packets miss a byte.
    Short,
    /// Of its packets so many are lost at once.
    Loses(u32),
    /// They have this status.
    Status(u32),
}

#[derive(Debug)]
struct State {
    felt: ForceTorque,
    fault: NetFtFault,
    ends: bool,
}

/// A server that streams to whoever asked last.
#[derive(Debug)]
pub struct NetFtStandIn {
    address: SocketAddr,
    counts: Counts,
    state: Arc<Mutex<State>>,
    thread: Option<JoinHandle<()>>,
}

impl NetFtStandIn {
    /// Starts on a free port of the loopback.
    ///
    /// # Errors
    /// When the system gives no port or no thread.
    pub fn start(counts: Counts) -> io::Result<Self> {
        let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0))?;
        socket.set_read_timeout(Some(PERIOD))?;
        let state = Arc::new(Mutex::new(State {
            felt: ForceTorque::zero(),
            fault: NetFtFault::None,
            ends: false,
        }));
        let (address, own) = (socket.local_addr()?, state.clone());
        let thread = std::thread::Builder::new().name("net f/t stand-in".to_owned());
        let thread = thread.spawn(move || serve(&socket, counts, &own))?;
        Ok(Self {
            address,
            counts,
            state,
            thread: Some(thread),
        })
    }

    /// Where it is.
    pub fn address(&self) -> NetFtAddress {
        NetFtAddress {
            host: self.address.ip().to_string(),
            port: self.address.port(),
        }
    }

    /// What its counts are.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// What it feels, from somewhere else.
    pub fn force_setter(&self) -> impl Fn(ForceTorque) + Send + Sync + use<> {
        let state = self.state.clone();
        move |felt| locked(&state).felt = felt
    }

    /// What goes wrong from now on.
    pub fn misbehave(&self, fault: NetFtFault) {
        locked(&self.state).fault = fault;
    }
}

fn locked(state: &Mutex<State>) -> std::sync::MutexGuard<'_, State> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

fn serve(socket: &UdpSocket, counts: Counts, state: &Mutex<State>) {
    let (mut peer, mut number) = (None, 0_u32);
    loop {
        let mut request = [0; 16];
        // The timeout is the pace.
        if let Ok((8, from)) = socket.recv_from(&mut request)
            && request[..2] == [0x12, 0x34]
        {
            peer = (request[3] == 2).then_some(from);
        }
        let mut state = locked(state);
        if state.ends {
            return;
        }
        let Some(peer) = peer.filter(|_| state.fault != NetFtFault::Silent) else {
            continue;
        };
        number = number.wrapping_add(1);
        let (mut length, mut status) = (PACKET, 0);
        match state.fault {
            NetFtFault::Short => length -= 1,
            NetFtFault::Status(code) => status = code,
            NetFtFault::Loses(lost) => {
                number = number.wrapping_add(lost);
                state.fault = NetFtFault::None;
            }
            NetFtFault::None | NetFtFault::Silent => {}
        }
        let bytes = packet(number, status, &state.felt, counts);
        // A client that is gone asks for no more.
        let _ = socket.send_to(&bytes[..length], peer);
    }
}

fn packet(number: u32, status: u32, felt: &ForceTorque, counts: Counts) -> [u8; PACKET] {
    let mut words = [number, number, status, 0, 0, 0, 0, 0, 0];
    for (axis, value) in felt.components().into_iter().enumerate() {
        let per = [counts.per_newton, counts.per_newton_metre][usize::from(axis >= 3)];
        words[3 + axis] = ((value * per).round() as i32).cast_unsigned();
    }
    let mut bytes = [0; PACKET];
    for (place, word) in words.iter().enumerate() {
        bytes[4 * place..4 * place + 4].copy_from_slice(&word.to_be_bytes());
    }
    bytes
}

impl Drop for NetFtStandIn {
    fn drop(&mut self) {
        locked(&self.state).ends = true;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
