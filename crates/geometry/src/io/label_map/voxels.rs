use std::io::Read;

use super::read_next;
use crate::ReadFault;

/// Voxels that are read at most: a whole body in slices of 1 mm has fewer, and a damaged header must not fill the memory.
/// Their labels take 0.8 GB.
const MAX_VOXELS: u64 = 400_000_000;

/// Bytes that are unpacked at a time; a whole number of voxels of any kind.
const CHUNK: usize = 1 << 16;

/// How a voxel is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Unsigned(usize),
    Signed(usize),
    Float,
    Double,
}

/// How all voxels are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Encoding {
    pub(super) kind: Kind,
    pub(super) big_endian: bool,
    /// Factor and offset of a value [-].
    pub(super) scale: (f64, f64),
}

impl Kind {
    fn bytes(self) -> usize {
        match self {
            Self::Unsigned(bytes) | Self::Signed(bytes) => bytes,
            Self::Float => 4,
            Self::Double => 8,
        }
    }

    /// The value of so many little-endian bytes.
    fn value(self, bytes: &[u8]) -> f64 {
        let mut eight = [0; 8];
        eight[..bytes.len()].copy_from_slice(bytes);
        let whole = u64::from_le_bytes(eight);
        match self {
            Self::Unsigned(_) => whole as f64,
            Self::Signed(count) => {
                let unused = 64 - 8 * count as u32;
                (((whole << unused) as i64) >> unused) as f64
            }
            Self::Float => f64::from(f32::from_bits(whole as u32)),
            Self::Double => f64::from_bits(whole),
        }
    }
}

/// The three lengths of a block, when it is one that can be.
pub(super) fn size(lengths: [i64; 3]) -> Result<[usize; 3], ReadFault> {
    if let Some(wrong) = lengths.iter().find(|&&length| length < 1) {
        return Err(ReadFault::BadHeader {
            what: "number of voxels along an axis",
            found: wrong.to_string(),
            expected: "one or more",
        });
    }
    let product = lengths
        .iter()
        .try_fold(1u64, |product, &length| product.checked_mul(length as u64));
    match product {
        Some(found) if found <= MAX_VOXELS => Ok(lengths.map(|length| length as usize)),
        found => Err(ReadFault::TooLarge {
            what: "voxels",
            found: found.unwrap_or(u64::MAX),
            most: MAX_VOXELS,
        }),
    }
}

/// `count` labels. Memory grows with the actual data, whatever the header announces.
pub(super) fn labels(
    source: &mut dyn Read,
    count: usize,
    encoding: Encoding,
) -> Result<Vec<u16>, ReadFault> {
    let width = encoding.kind.bytes();
    let (factor, shift) = encoding.scale;
    let mut labels: Vec<u16> = Vec::new();
    let mut chunk = vec![0; CHUNK];
    while labels.len() < count {
        if labels.len() + CHUNK > labels.capacity() {
            // Twice what there is, but never more than there may be.
            let more = labels.len().max(CHUNK).min(count - labels.len());
            labels
                .try_reserve_exact(more)
                .map_err(|_| ReadFault::NoMemory {
                    bytes: (size_of::<u16>() * (labels.len() + more)) as u64,
                })?;
        }
        let bytes = &mut chunk[..CHUNK.min((count - labels.len()) * width)];
        read_next(source, bytes, "the block of voxels")?;
        if encoding.kind == Kind::Unsigned(1) && encoding.scale == (1.0, 0.0) {
            // Each value is a label: most maps, and the fastest path.
            labels.extend(bytes.iter().map(|&label| u16::from(label)));
            continue;
        }
        for voxel in bytes.chunks_exact_mut(width) {
            if encoding.big_endian {
                voxel.reverse();
            }
            let found = factor * encoding.kind.value(voxel) + shift;
            if !(found.fract() == 0.0 && (0.0..=f64::from(u16::MAX)).contains(&found)) {
                let voxel = labels.len();
                return Err(ReadFault::NotALabel { voxel, found });
            }
            labels.push(found as u16);
        }
    }
    Ok(labels)
}
