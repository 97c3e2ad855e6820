//! ATI Net F/T and its successors over Ethernet, by their protocol RDT: a request of eight bytes, then packets of 36,
//! all numbers with their highest byte first.
//!
//! | bytes | request | packet |
//! |---|---|---|
//! | 0 to 3 | 0x1234, command (0 stop, 2 stream) | number of the packet |
//! | 4 to 7 | how many packets, 0 for no end | number of the sample |
//! | 8 to 11 | | status, 0 when all is well |
//! | 12 to 35 | | fx, fy, fz, tx, ty, tz in counts |

use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs, UdpSocket};
use std::time::Duration;

use palpate_servo::{ForceSensor, ForceSensorSpec, ForceTorque, SensorFault};

use super::freshness::{Freshness, Sequence};
use super::{Counts, NetFtAddress, SensorLimits};
use crate::OpenError;

/// The port of the protocol.
pub const NET_FT_PORT: u16 = 49_152;
/// Bytes of a packet.
pub const PACKET: usize = 36;

const HEADER: u16 = 0x1234;
const STOP: u16 = 0;
const STREAM: u16 = 2;

/// In the status: an error; a force or torque, or a strain gauge, out of range.
const ERROR: u32 = 1 << 31;
const OUT_OF_RANGE: u32 = 1 << 30 | 1 << 27;

/// Timeout for the first packet, and interval of requests for it.
const FIRST: Duration = Duration::from_millis(300);
const REQUESTS: usize = 3;

/// Largest number of packets per call: more than a rate of 7 kHz sends in a tick; packets that wait after a stall are
/// old.
const AT_ONCE: usize = 512;

/// An ATI Net F/T.
#[derive(Debug)]
pub struct NetFt {
    socket: UdpSocket,
    spec: ForceSensorSpec,
    counts: Counts,
    sequence: Sequence,
    freshness: Freshness,
    last: ForceTorque,
}

/// The content of a packet.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Packet {
    number: u32,
    status: u32,
    counts: [i32; 6],
}

impl NetFt {
    /// Requests the stream of the sensor at `address`.
    ///
    /// # Errors
    /// When nothing answers there.
    pub fn open(
        address: &NetFtAddress,
        counts: Counts,
        limits: SensorLimits,
    ) -> Result<Self, OpenError> {
        let no_sensor = |cause: std::io::Error| OpenError::NoSensor {
            place: address.to_string(),
            cause,
        };
        let socket = connected(address).map_err(no_sensor)?;
        first_packet(&socket).map_err(no_sensor)?;
        socket.set_nonblocking(true).map_err(no_sensor)?;
        Ok(Self {
            socket,
            spec: ForceSensorSpec {
                name: format!("ATI Net F/T at {address}"),
                range: limits.range,
                has_six_axes: true,
            },
            counts,
            sequence: Sequence::default(),
            freshness: Freshness::new(limits.timeout),
            last: ForceTorque::zero(),
        })
    }

    fn take(&mut self, bytes: &[u8]) -> Result<(), SensorFault> {
        let packet = Packet::of(bytes)?;
        if packet.status & OUT_OF_RANGE != 0 {
            let axis = "an axis that its status does not name";
            return Err(SensorFault::Saturated { axis });
        }
        if packet.status & ERROR != 0 {
            let code = packet.status;
            return Err(SensorFault::Status { code });
        }
        if self.sequence.is_new(packet.number)? {
            let Counts {
                per_newton: n,
                per_newton_metre: nm,
            } = self.counts;
            let per = [n, n, n, nm, nm, nm];
            let reading = std::array::from_fn(|axis| f64::from(packet.counts[axis]) / per[axis]);
            self.last = ForceTorque::from_components(reading);
            self.freshness.renew();
        }
        Ok(())
    }
}

/// A socket that receives from this address alone. It is bound to the loopback if the sensor is there.
fn connected(address: &NetFtAddress) -> std::io::Result<UdpSocket> {
    let found = (address.host.as_str(), address.port)
        .to_socket_addrs()?
        .next();
    let peer: SocketAddr = found.ok_or(ErrorKind::AddrNotAvailable)?;
    let own = match peer.ip() {
        IpAddr::V4(ip) if ip.is_loopback() => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V4(_) => IpAddr::V4(Ipv4Addr::UNSPECIFIED),
        IpAddr::V6(ip) if ip.is_loopback() => IpAddr::V6(Ipv6Addr::LOCALHOST),
        IpAddr::V6(_) => IpAddr::V6(Ipv6Addr::UNSPECIFIED),
    };
    let socket = UdpSocket::bind((own, 0))?;
    socket.connect(peer)?;
    Ok(socket)
}

fn request(command: u16) -> [u8; 8] {
    let mut bytes = [0; 8];
    bytes[..2].copy_from_slice(&HEADER.to_be_bytes());
    bytes[2..4].copy_from_slice(&command.to_be_bytes());
    bytes
}

/// Requests until a packet arrives; a datagram may be lost.
fn first_packet(socket: &UdpSocket) -> std::io::Result<()> {
    socket.set_read_timeout(Some(FIRST))?;
    let mut last = ErrorKind::TimedOut.into();
    for _ in 0..REQUESTS {
        socket.send(&request(STREAM))?;
        match socket.recv(&mut [0; 2 * PACKET]) {
            Ok(_) => return Ok(()),
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(error) => last = error,
        }
    }
    Err(last)
}

impl ForceSensor for NetFt {
    fn spec(&self) -> &ForceSensorSpec {
        &self.spec
    }

    fn read(&mut self) -> Result<ForceTorque, SensorFault> {
        // Longer than a packet, to detect longer ones.
        let mut bytes = [0; 2 * PACKET];
        for _ in 0..AT_ONCE {
            match self.socket.recv(&mut bytes) {
                Ok(length) => self.take(&bytes[..length])?,
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(_) => return Err(SensorFault::Disconnected),
            }
        }
        self.freshness
            .check()
            .inspect_err(|_| self.sequence.reset())?;
        Ok(self.last)
    }
}

impl Drop for NetFt {
    fn drop(&mut self) {
        // An error is harmless: a disconnected sensor no longer streams.
        let _ = self.socket.send(&request(STOP));
    }
}

impl Packet {
    fn of(bytes: &[u8]) -> Result<Self, SensorFault> {
        let Ok(bytes) = <&[u8; PACKET]>::try_from(bytes) else {
            let what = "a packet that has not 36 bytes";
            return Err(SensorFault::BadReading { what });
        };
        let word = |place: usize| {
            let own = std::array::from_fn(|byte| bytes[4 * place + byte]);
            u32::from_be_bytes(own)
        };
        Ok(Self {
            number: word(0),
            status: word(2),
            counts: std::array::from_fn(|axis| word(3 + axis).cast_signed()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the table of the protocol, byte by byte.
    #[test]
    fn a_packet_is_read_as_the_protocol_has_it() {
        let mut bytes = [0; PACKET];
        bytes[3] = 7;
        bytes[8] = 0x80;
        bytes[11] = 0x05;
        // −2 and 256.
        bytes[12..16].copy_from_slice(&[0xFF, 0xFF, 0xFF, 0xFE]);
        bytes[32..36].copy_from_slice(&[0, 0, 1, 0]);
        let packet = Packet::of(&bytes).unwrap();
        assert_eq!(packet.number, 7);
        assert_eq!(packet.status, 0x8000_0005);
        assert_eq!(packet.counts, [-2, 0, 0, 0, 0, 256]);
        assert_eq!(request(STREAM), [0x12, 0x34, 0, 2, 0, 0, 0, 0]);
    }
}
