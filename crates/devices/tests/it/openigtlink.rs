//! The server of pictures: bytes against the published vectors, a client written from the protocol, and the protocol's
//! own library where it is installed.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant, SystemTime};

use nalgebra::UnitQuaternion;
use palpate_devices::openigtlink::message::{HEADER, append};
use palpate_devices::openigtlink::{Requests, checksum};
use palpate_devices::publisher::{Protocol, PublishedState, Publisher, ShownSurface, ShownTool};
use palpate_servo::{Fault, Vec3};
use proptest::prelude::*;

/// Of the catalogue of checksums, and of the tests of the protocol's library (its transform).
#[test]
fn checksums_are_those_of_the_published_vectors() {
    assert_eq!(checksum(b"123456789"), 0x6C40_DF5F_0B49_7347);
    let body = "bf7473cd3e4959e6be63dd98be4959e63e12491b3f7852d63e63dd983f7852d6bdc830ae42383660419bc467\
                42383660";
    let digits: Vec<u8> = body.bytes().filter(u8::is_ascii_hexdigit).collect();
    let bytes: Vec<u8> = digits
        .chunks(2)
        .map(|pair| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap())
        .collect();
    assert_eq!(bytes.len(), 48);
    assert_eq!(checksum(&bytes), 0xF6DD_2B8E_B4DF_6DD2);
}

const PLACE: Vec3 = Vec3::new(0.010, -0.020, 0.030);
const FORCE: Vec3 = Vec3::new(0.25, 0.5, -1.5);

/// A quarter turn about z.
fn turned() -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vec3::z_axis(), std::f64::consts::FRAC_PI_2)
}

fn tool(fault: Option<Fault>) -> ShownTool {
    ShownTool {
        name: "right".to_owned(),
        place: Some(PLACE),
        orientation: turned(),
        force: FORCE,
        torque: Vec3::zeros(),
        fault,
    }
}

fn tetrahedron() -> ShownSurface {
    ShownSurface {
        vertices: vec![
            [0.0; 3],
            [0.001, 0.0, 0.0],
            [0.0, 0.002, 0.0],
            [0.0, 0.0, 0.003],
        ],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    }
}

fn room(fault: Option<Fault>) -> Publisher {
    let anywhere = SocketAddr::from((Ipv4Addr::LOCALHOST, 0));
    let room = Publisher::open(anywhere, Protocol::OpenIgtLink).unwrap();
    let fill = move |picture: &mut PublishedState| picture.tools = vec![tool(fault)];
    room.show(fill, tetrahedron);
    room
}

/// A message as a client reads it.
struct Message {
    kind: String,
    device: String,
    body: Vec<u8>,
}

fn read(stream: &mut TcpStream) -> Message {
    let mut header = [0; HEADER];
    stream.read_exact(&mut header).unwrap();
    let name = |range: std::ops::Range<usize>| {
        let text = String::from_utf8(header[range].to_vec()).unwrap();
        text.trim_end_matches('\0').to_owned()
    };
    let number = |from: usize| u64::from_be_bytes(header[from..from + 8].try_into().unwrap());
    assert_eq!(header[..2], [0, 1]);
    let since = SystemTime::now()
        .duration_since(SystemTime::UNIX_EPOCH)
        .unwrap();
    // The upper half are seconds.
    assert!((number(34) >> 32).abs_diff(since.as_secs()) <= 2);
    let mut body = vec![0; number(42) as usize];
    stream.read_exact(&mut body).unwrap();
    assert_eq!(checksum(&body), number(50));
    Message {
        kind: name(2..14),
        device: name(14..34),
        body,
    }
}

fn until(stream: &mut TcpStream, kind: &str) -> Message {
    let messages = (0..1000).map(|_| read(stream));
    let mut messages = messages.filter(|message| message.kind == kind);
    messages.next().unwrap()
}

fn ask(stream: &mut TcpStream, kind: &str) {
    let mut bytes = Vec::new();
    append(&mut bytes, kind, "", SystemTime::now(), |_| ());
    stream.write_all(&bytes).unwrap();
}

fn singles(bytes: &[u8]) -> Vec<f32> {
    let numbers = bytes.chunks(4);
    numbers
        .map(|four| f32::from_be_bytes(four.try_into().unwrap()))
        .collect()
}

/// By hand: the scene's x and y change their sign. A quarter turn about z stays one, column by column.
#[test]
fn what_is_sent_is_in_the_axes_of_the_room() {
    let room = room(None);
    assert!(room.address().ip().is_loopback());
    let mut stream = TcpStream::connect(room.address()).unwrap();
    let message = until(&mut stream, "TRANSFORM");
    assert_eq!(message.device, "right");
    let expected = [
        0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -10.0, 20.0, 30.0,
    ];
    // The tool's x (scene's y) is the room's −y; its y (scene's −x) is the room's x.
    for (found, expected) in singles(&message.body).iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-6,
            "{:?}",
            singles(&message.body)
        );
    }
    let message = until(&mut stream, "SENSOR");
    assert_eq!(message.body[..2], [3, 0]);
    let numbers = message.body[10..].chunks(8);
    let force: Vec<f64> = numbers
        .map(|eight| f64::from_be_bytes(eight.try_into().unwrap()))
        .collect();
    assert_eq!(force, [-0.25, -0.5, -1.5]);
    let message = until(&mut stream, "STATUS");
    assert_eq!(message.body[..2], [0, 1]);
}

#[test]
fn a_surface_comes_at_first_and_on_request_and_not_too_often() {
    let room = room(None);
    let mut stream = TcpStream::connect(room.address()).unwrap();
    for _ in 0..50 {
        ask(&mut stream, "GET_POLYDATA");
    }
    let began = Instant::now();
    let mut count = 0;
    while began.elapsed() < Duration::from_secs(1) {
        let message = read(&mut stream);
        if message.kind == "POLYDATA" {
            count += 1;
            assert_eq!(message.body.len(), 40 + 4 * 12 + 4 * 16);
            let points = singles(&message.body[40..40 + 48]);
            assert_eq!(points[3..6], [-1.0, 0.0, 0.0]);
            assert_eq!(points[6..9], [0.0, -2.0, 0.0]);
        }
    }
    // One at first and one for all that was asked at once; a third when the requests came in two parts.
    assert!((1..=3).contains(&count), "{count}");
    ask(&mut stream, "GET_CAPABIL");
    let message = until(&mut stream, "CAPABILITY");
    assert_eq!(message.body.len(), 4 * 12);
    assert!(message.body.starts_with(b"TRANSFORM\0\0\0SENSOR"));
}

/// Printed, for it is the machine's; half of what is promised has to come.
#[test]
fn fifty_pictures_a_second() {
    let room = room(None);
    let mut stream = TcpStream::connect(room.address()).unwrap();
    until(&mut stream, "STATUS");
    let began = Instant::now();
    let mut count = 0;
    while began.elapsed() < Duration::from_secs(2) {
        count += u32::from(read(&mut stream).kind == "TRANSFORM");
    }
    let rate = f64::from(count) / began.elapsed().as_secs_f64();
    println!("{rate:.1} transforms a second");
    assert!(rate > 25.0 && rate < 52.0, "{rate}");
}

#[test]
fn a_fault_is_told() {
    let room = room(Some(Fault::Unpowered));
    let mut stream = TcpStream::connect(room.address()).unwrap();
    let message = until(&mut stream, "STATUS");
    assert_eq!(message.body[..2], [0, 18]);
    let said = String::from_utf8(message.body[30..].to_vec()).unwrap();
    assert!(
        said.starts_with("right: the device lost its power"),
        "{said}"
    );
    assert!(said.ends_with('\0'));
}

/// One that speaks otherwise is let go of, and the others see on.
#[test]
fn a_client_that_makes_no_sense_disturbs_nobody() {
    let room = room(None);
    let mut good = TcpStream::connect(room.address()).unwrap();
    let mut bad = TcpStream::connect(room.address()).unwrap();
    bad.write_all(&[b'x'; 200]).unwrap();
    let mut silent = Vec::new();
    // To its end, which comes.
    let _ = bad.read_to_end(&mut silent);
    until(&mut good, "TRANSFORM");
    drop(room);
    let mut rest = Vec::new();
    assert!(good.read_to_end(&mut rest).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(crate::haply_messages::tries().cases))]

    /// Any bytes, in any pieces: requests or none, and never more than was sent.
    #[test]
    fn any_requests(
        pieces in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..120), 0..8),
        version in 0..5u8,
        size in prop_oneof![0..200u64, any::<u64>()],
    ) {
        let mut requests = Requests::default();
        let mut header = vec![0, version];
        header.extend(b"GET_POLYDATA");
        header.extend([0; 28]);
        header.extend(size.to_be_bytes());
        header.extend([0; 8]);
        requests.add(&header);
        let mut count = 0;
        for piece in &pieces {
            requests.add(piece);
            while requests.next_request().is_some() {
                count += 1;
            }
        }
        let sent = header.len() + pieces.iter().map(Vec::len).sum::<usize>();
        prop_assert!(count <= sent / HEADER);
    }

    /// Damaged requests among whole ones: the whole ones before the damage are read.
    #[test]
    fn damaged_requests(at in 0..3 * HEADER, byte in any::<u8>()) {
        let mut bytes = Vec::new();
        for _ in 0..3 {
            append(&mut bytes, "GET_STATUS", "x", SystemTime::now(), |body| body.push(1));
        }
        bytes[at] = byte;
        let mut requests = Requests::default();
        requests.add(&bytes);
        let mut count = 0;
        while let Some(request) = requests.next_request() {
            count += 1;
            prop_assert!(request.kind.len() <= 12 && request.device.len() <= 20);
        }
        prop_assert!(count >= at / (HEADER + 1));
    }
}

/// The judge is the protocol's own library, by a program of its own (`openigtlink.cpp`). Where `libopenigtlink-dev` or a
/// C++ compiler is not installed, this says so and passes.
#[test]
fn the_protocols_own_library_reads_it() {
    let headers = Path::new("/usr/include/openigtlink");
    let has_compiler = Command::new("c++").arg("--version").output().is_ok();
    if !headers.join("igtlClientSocket.h").exists() || !has_compiler {
        println!("left out: libopenigtlink-dev or a C++ compiler is not installed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("client");
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/openigtlink.cpp");
    let made = Command::new("c++")
        .args(["-O0", "-w", "-I"])
        .arg(headers)
        .arg("-o")
        .arg(&program)
        .arg(source)
        .args(["-lOpenIGTLink", "-lpthread"])
        .output()
        .unwrap();
    assert!(
        made.status.success(),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    let room = room(None);
    let port = room.address().port().to_string();
    let output = Command::new(&program).arg(port).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let said = said.replace("-0.000", "0.000");
    assert!(
        output.status.success(),
        "{said}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let expected = [
        "TRANSFORM right: 0.000 -1.000 0.000 1.000 0.000 0.000 0.000 0.000 1.000 -10.000 20.000 30.000",
        "SENSOR right: 3 values, newton 1: -0.250 -0.500 -1.500",
        "STATUS palpate: 1 0 OK",
        "POLYDATA organ: 4 points, 4 polygons: -1.000 0.000 0.000: 0 2 1",
        "CAPABILITY palpate: TRANSFORM SENSOR STATUS POLYDATA",
    ];
    for line in expected {
        assert!(
            said.lines().any(|found| found == line),
            "{line:?} is not in\n{said}"
        );
    }
}
