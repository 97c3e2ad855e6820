//! NIfTI-1 in one file. World coordinates are millimetres to the right, the front and the head (RAS);
//! the sform is taken when there is one, else the qform.

use std::io::Read;

use nalgebra::Matrix3;

use super::names::in_extension;
use super::read_next;
use super::voxels::{Encoding, Kind, labels, size};
use crate::{LabelMap, ReadFault, Vec3};

const HEADER_BYTES: usize = 348;

/// The longest extension that is read [bytes]; they hold names.
const MAX_EXTENSION: f64 = 1e7;

struct Header {
    bytes: [u8; HEADER_BYTES],
    big_endian: bool,
}

impl Header {
    fn read(source: &mut dyn Read) -> Result<Self, ReadFault> {
        let mut bytes = [0; HEADER_BYTES];
        read_next(source, &mut bytes, "the header of a NIfTI file")?;
        let first: [u8; 4] = [bytes[0], bytes[1], bytes[2], bytes[3]];
        let big_endian = i32::from_be_bytes(first) == HEADER_BYTES as i32;
        if !big_endian && i32::from_le_bytes(first) != HEADER_BYTES as i32 {
            return Err(ReadFault::BadHeader {
                what: "length",
                found: i32::from_le_bytes(first).to_string(),
                expected: "348, that of NIfTI-1,",
            });
        }
        if &bytes[344..347] != b"n+1" {
            return Err(ReadFault::UnreadEncoding {
                what: "a NIfTI header whose voxels are in another file",
                remedy: "save the label map as one .nii or .nii.gz",
            });
        }
        Ok(Self { bytes, big_endian })
    }

    fn short(&self, at: usize) -> i16 {
        let two = [self.bytes[at], self.bytes[at + 1]];
        match self.big_endian {
            true => i16::from_be_bytes(two),
            false => i16::from_le_bytes(two),
        }
    }

    fn float(&self, at: usize) -> f64 {
        let four = [0, 1, 2, 3].map(|k| self.bytes[at + k]);
        f64::from(match self.big_endian {
            true => f32::from_be_bytes(four),
            false => f32::from_le_bytes(four),
        })
    }

    fn size(&self) -> Result<[usize; 3], ReadFault> {
        let axes = self.short(40);
        let length = |k: usize| i64::from(self.short(40 + 2 * k));
        let more = (4..=7).find(|&k| k as i16 <= axes && length(k) > 1);
        if !(3..=7).contains(&axes) || more.is_some() {
            return Err(ReadFault::BadHeader {
                what: "number of axes",
                found: axes.to_string(),
                expected: "3, one block of voxels,",
            });
        }
        size([length(1), length(2), length(3)])
    }

    fn encoding(&self) -> Result<Encoding, ReadFault> {
        let kind = match self.short(70) {
            2 => Kind::Unsigned(1),
            4 => Kind::Signed(2),
            8 => Kind::Signed(4),
            16 => Kind::Float,
            64 => Kind::Double,
            256 => Kind::Signed(1),
            512 => Kind::Unsigned(2),
            768 => Kind::Unsigned(4),
            1024 => Kind::Signed(8),
            1280 => Kind::Unsigned(8),
            other => {
                return Err(ReadFault::BadHeader {
                    what: "kind of voxels",
                    found: other.to_string(),
                    expected: "one of whole or real numbers",
                });
            }
        };
        let (slope, shift) = (self.float(112), self.float(116));
        // A slope of zero means none.
        let is_scaled = slope != 0.0 && slope.is_finite() && shift.is_finite();
        Ok(Encoding {
            kind,
            big_endian: self.big_endian,
            scale: if is_scaled {
                (slope, shift)
            } else {
                (1.0, 0.0)
            },
        })
    }

    /// Steps from voxel to voxel and the first voxel, in the unit of the file and RAS.
    fn placement(&self) -> (Matrix3<f64>, Vec3, Vec<String>) {
        if self.short(254) > 0 {
            let row = |at: usize| [0, 1, 2, 3].map(|k| self.float(at + 4 * k));
            let [x, y, z] = [row(280), row(296), row(312)];
            let steps = Matrix3::from_fn(|i, j| [x, y, z][i][j]);
            return (steps, Vec3::new(x[3], y[3], z[3]), Vec::new());
        }
        let spacing = Vec3::from_fn(|k, _| self.float(80 + 4 * k));
        if self.short(252) > 0 {
            let mirror = if self.float(76) < 0.0 { -1.0 } else { 1.0 };
            let spacing = spacing.component_mul(&Vec3::new(1.0, 1.0, mirror));
            let steps = self.rotation() * Matrix3::from_diagonal(&spacing);
            let origin = Vec3::from_fn(|k, _| self.float(268 + 4 * k));
            return (steps, origin, Vec::new());
        }
        let warning = "the file does not say how the picture lies in the body; right, front and head \
                     are taken for its axes";
        let steps = Matrix3::from_diagonal(&spacing);
        (steps, Vec3::zeros(), vec![warning.to_owned()])
    }

    /// Of the quaternion of the qform.
    fn rotation(&self) -> Matrix3<f64> {
        let [b, c, d] = [256, 260, 264].map(|at| self.float(at));
        let a = (1.0 - b * b - c * c - d * d).max(0.0).sqrt();
        Matrix3::new(
            a * a + b * b - c * c - d * d,
            2.0 * (b * c - a * d),
            2.0 * (b * d + a * c),
            2.0 * (b * c + a * d),
            a * a + c * c - b * b - d * d,
            2.0 * (c * d - a * b),
            2.0 * (b * d - a * c),
            2.0 * (c * d + a * b),
            a * a + d * d - b * b - c * c,
        )
    }

    fn in_metres(&self) -> f64 {
        match self.bytes[123] & 7 {
            1 => 1.0,
            3 => 1e-6,
            // Millimetres, also by habit where nothing is said.
            _ => 1e-3,
        }
    }
}

pub(super) fn read(source: &mut dyn Read) -> Result<LabelMap, ReadFault> {
    let header = Header::read(source)?;
    let size = header.size()?;
    let encoding = header.encoding()?;
    let (steps, origin, warnings) = header.placement();
    let start = header.float(108);
    if !(start >= HEADER_BYTES as f64 && start <= MAX_EXTENSION) {
        return Err(ReadFault::BadHeader {
            what: "beginning of the voxels",
            found: start.to_string(),
            expected: "a place between 348 and 10,000,000",
        });
    }
    let mut extension = vec![0; start as usize - HEADER_BYTES];
    read_next(source, &mut extension, "the extension of the header")?;
    let names = in_extension(&String::from_utf8_lossy(&extension));
    let labels = labels(source, size.iter().product(), encoding)?;
    // From right and front to left and back.
    let to_lps = Matrix3::from_diagonal(&Vec3::new(-1.0, -1.0, 1.0)) * header.in_metres();
    super::placed(LabelMap {
        size,
        labels,
        steps: to_lps * steps,
        origin: to_lps * origin,
        names: names.into_iter().collect(),
        warnings,
    })
}
