//! Messages of version 1, as bytes: a header of 58, then the body. All numbers are big-endian.
//!
//! ```text
//! version u16 | type 12 | device 20 | time u64, 32.32 s | size u64 | checksum u64 | body
//! ```

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use nalgebra::UnitQuaternion;
use palpate_servo::Vec3;

use super::checksum;
use crate::publisher::ShownSurface;

/// Size of a header [B].
pub const HEADER: usize = 58;

/// The status of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// All is well.
    Ok = 1,
    /// A person has paused it.
    Manual = 14,
    /// A device has no force.
    HardwareFailure = 18,
}

/// Newton, once: the code of the unit stands in six bits below four for a prefix, its power in four below that.
const NEWTON: u64 = 0x0B << 54 | 1 << 50;

/// Appends a message of the type `kind` about `device` at `time` to `bytes`; `write` appends the body. Names that are
/// too long are cut off.
pub fn append(
    bytes: &mut Vec<u8>,
    kind: &str,
    device: &str,
    time: SystemTime,
    write: impl FnOnce(&mut Vec<u8>),
) {
    let start = bytes.len();
    bytes.extend(1_u16.to_be_bytes());
    append_name::<12>(bytes, kind);
    append_name::<20>(bytes, device);
    bytes.extend(timestamp(time).to_be_bytes());
    bytes.extend([0; 16]);
    let body = bytes.len();
    write(bytes);
    let size = (bytes.len() - body) as u64;
    let sum = checksum(&bytes[body..]);
    bytes[start + 42..start + 50].copy_from_slice(&size.to_be_bytes());
    bytes[start + 50..start + 58].copy_from_slice(&sum.to_be_bytes());
}

/// A position [m] of the scene in the axes of medical images [mm].
pub fn in_image_axes(place: &Vec3) -> [f32; 3] {
    [-place.x, -place.y, place.z].map(|length| (1e3 * length) as f32)
}

/// Body of `TRANSFORM`: from a tool to the room.
pub fn transform(bytes: &mut Vec<u8>, place: &Vec3, orientation: &UnitQuaternion<f64>) {
    // Half a turn about z, before and after.
    let matrix = orientation.to_rotation_matrix();
    let sign = [-1.0, -1.0, 1.0];
    for column in 0..3 {
        for (row, sign) in sign.iter().enumerate() {
            append_single(bytes, (sign * matrix[(row, column)]) as f32);
        }
    }
    in_image_axes(place)
        .into_iter()
        .for_each(|number| append_single(bytes, number));
}

/// Body of `SENSOR`: a force [N] in the axes of the room.
pub fn force(bytes: &mut Vec<u8>, force: &Vec3) {
    bytes.extend([3, 0]);
    bytes.extend(NEWTON.to_be_bytes());
    for number in [-force.x, -force.y, force.z] {
        bytes.extend(number.to_be_bytes());
    }
}

/// Body of `STATUS`.
pub fn status(bytes: &mut Vec<u8>, status: Status, text: &str) {
    bytes.extend((status as u16).to_be_bytes());
    bytes.extend(0_i64.to_be_bytes());
    append_name::<20>(bytes, "");
    bytes.extend(text.bytes().filter(|byte| *byte != 0));
    bytes.push(0);
}

/// Body of `POLYDATA`: triangles.
pub fn surface(bytes: &mut Vec<u8>, surface: &ShownSurface) {
    let triangles = surface.triangles.len() as u32;
    let counts = [
        surface.vertices.len() as u32,
        // Vertices, lines: how many and how many bytes.
        0,
        0,
        0,
        0,
        triangles,
        16 * triangles,
        // Strips, attributes.
        0,
        0,
        0,
    ];
    counts
        .into_iter()
        .for_each(|number| bytes.extend(number.to_be_bytes()));
    for [x, y, z] in &surface.vertices {
        [-x, -y, *z]
            .into_iter()
            .for_each(|length| append_single(bytes, 1e3 * length));
    }
    for triangle in &surface.triangles {
        bytes.extend(3_u32.to_be_bytes());
        triangle
            .iter()
            .for_each(|vertex| bytes.extend(vertex.to_be_bytes()));
    }
}

/// Body of `CAPABILITY`: types of messages.
pub fn capability(bytes: &mut Vec<u8>, kinds: &[&str]) {
    kinds.iter().for_each(|kind| append_name::<12>(bytes, kind));
}

fn append_single(bytes: &mut Vec<u8>, number: f32) {
    bytes.extend(number.to_be_bytes());
}

/// A name, with zeros to the end of its field; letters that are none of ASCII's become `?`.
fn append_name<const N: usize>(bytes: &mut Vec<u8>, name: &str) {
    let mut field = [0; N];
    for (place, letter) in field.iter_mut().zip(name.chars()) {
        *place = if letter.is_ascii_graphic() || letter == ' ' {
            letter as u8
        } else {
            b'?'
        };
    }
    bytes.extend(field);
}

/// Seconds since 1970 in the upper half, parts of 2³² in the lower.
fn timestamp(time: SystemTime) -> u64 {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO);
    let part = (u64::from(since.subsec_nanos()) << 32) / 1_000_000_000;
    (since.as_secs() << 32) | part
}
