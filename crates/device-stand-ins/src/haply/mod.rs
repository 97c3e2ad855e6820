//! A Haply Inverse Service that is not there: states and forces on one port, events on another, both on loopback.
//!
//! On connection it sends everything that it has, then one state per message. A device that hears nothing for 50 ms
//! takes its force off, and so does one whose client has gone.
//!
//! *Limits*: it has no HTTP and no settings; its 50 ms are ours.

mod client;
mod words;

use std::io;
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_devices::haply::{Generation, HaplyAddress};
use palpate_servo::Vec3;

use super::robot::Robot;
use super::{Mechanics, Misbehaviour, StandInClock};

/// What is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StandInGrip {
    /// Nothing but the handle.
    None,
    /// A grip on a cable: one button.
    Wired,
    /// One without: three buttons.
    Wireless,
}

/// How it is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HaplyStandInSettings {
    /// How forces have to be written; others are not understood.
    pub generation: Generation,
    /// What is held, at every device.
    pub grip: StandInGrip,
    /// How time goes by.
    pub clock: StandInClock,
    /// The ports of states and of events; zero for any that is free.
    pub ports: [u16; 2],
}

impl Default for HaplyStandInSettings {
    /// Version 3.5, with a grip, a millisecond per message.
    fn default() -> Self {
        Self {
            generation: Generation::Vector,
            grip: StandInGrip::Wireless,
            clock: StandInClock::PerCommand(1e-3),
            ports: [0, 0],
        }
    }
}

/// How long a thread waits before it looks whether it shall end.
const PATIENCE: Duration = Duration::from_millis(2);

/// A service that runs. Dropping it ends it.
pub struct HaplyStandIn {
    address: HaplyAddress,
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

/// What its threads share.
struct Shared {
    settings: HaplyStandInSettings,
    robots: Mutex<Vec<Robot>>,
    misbehaviour: Mutex<Option<Misbehaviour>>,
    events: Mutex<Vec<String>>,
    /// Events that were sent, over all who listen, and how many listen.
    told: AtomicUsize,
    listeners: AtomicUsize,
    cut: AtomicBool,
    ended: AtomicBool,
}

impl HaplyStandIn {
    /// A service that has `devices`, with the names `0`, `1` and so on.
    ///
    /// # Errors
    /// When a port is taken.
    pub fn start(
        devices: Vec<Box<dyn Mechanics>>,
        settings: HaplyStandInSettings,
    ) -> io::Result<Self> {
        let robots = devices.into_iter();
        let robots = robots.map(|device| Robot::new(device, settings.clock));
        let shared = Arc::new(Shared {
            settings,
            robots: Mutex::new(robots.collect()),
            misbehaviour: Mutex::new(None),
            events: Mutex::new(Vec::new()),
            told: AtomicUsize::new(0),
            listeners: AtomicUsize::new(0),
            cut: AtomicBool::new(false),
            ended: AtomicBool::new(false),
        });
        let [port, events_port] = settings.ports;
        let states = listen(port)?;
        let events = listen(events_port)?;
        let address = HaplyAddress {
            port: states.local_addr()?.port(),
            events_port: events.local_addr()?.port(),
            ..HaplyAddress::default()
        };
        let threads = vec![
            serve(states, shared.clone(), client::answer)?,
            serve(events, shared.clone(), client::tell)?,
        ];
        Ok(Self {
            address,
            shared,
            threads,
        })
    }

    /// Where it is.
    pub fn address(&self) -> &HaplyAddress {
        &self.address
    }

    /// From now on this goes wrong; with none, nothing does.
    pub fn misbehave(&self, how: Option<Misbehaviour>) {
        let drops = how == Some(Misbehaviour::Disconnects);
        *locked(&self.shared.misbehaviour) = how;
        self.shared.cut.store(drops, Ordering::Relaxed);
    }

    /// Tells whoever listens to events, and waits until that was sent, for five seconds at most.
    pub fn send_event(&self, event: &str) {
        let count = |number: &AtomicUsize| number.load(Ordering::Acquire);
        let told = count(&self.shared.told) + count(&self.shared.listeners);
        locked(&self.shared.events).push(event.to_owned());
        for _ in 0..2500 {
            if count(&self.shared.told) >= told {
                return;
            }
            std::thread::sleep(PATIENCE);
        }
    }

    /// The force that device `number` displays [N], in our axes.
    pub fn force(&self, number: usize) -> Vec3 {
        locked(&self.shared.robots)[number].force
    }

    /// Every force that device `number` was commanded [N], in our axes; none that was not understood.
    pub fn forces(&self, number: usize) -> Vec<Vec3> {
        locked(&self.shared.robots)[number].forces.clone()
    }
}

impl Drop for HaplyStandIn {
    fn drop(&mut self) {
        self.shared.ended.store(true, Ordering::Relaxed);
        for thread in self.threads.drain(..) {
            // One that panicked has ended too.
            let _ = thread.join();
        }
    }
}

/// What a panic of another thread left is good enough for a stand-in.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn listen(port: u16) -> io::Result<TcpListener> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
    listener.set_nonblocking(true)?;
    Ok(listener)
}

/// A thread that has a thread for each client.
fn serve(
    listener: TcpListener,
    shared: Arc<Shared>,
    with: fn(TcpStream, &Shared),
) -> io::Result<JoinHandle<()>> {
    std::thread::Builder::new().spawn(move || {
        let mut clients = Vec::new();
        while !shared.ended.load(Ordering::Relaxed) {
            match listener.accept() {
                Ok((stream, _)) => {
                    let shared = shared.clone();
                    let thread = std::thread::Builder::new();
                    // Without a thread the client hears nothing, as of a busy service.
                    clients.extend(thread.spawn(move || with(stream, &shared)).ok());
                }
                Err(_) => std::thread::sleep(PATIENCE),
            }
        }
        for client in clients {
            let _ = client.join();
        }
    })
}
