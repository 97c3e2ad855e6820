use std::collections::BTreeMap;

use dicom_dictionary_std::tags;
use dicom_object::{FileDicomObject, InMemDicomObject};

use super::Values;
use super::frames::Lattice;
use super::pixel_data::{FrameFormat, PixelData};
use crate::io::label_map::placed;
use crate::io::label_map::voxels::size;
use crate::{LabelMap, ReadFault};

/// How the pixels of a frame encode a label.
#[derive(Clone, Copy)]
enum Pixels {
    /// A bit for each, that of the frame's segment; the first pixel in the lowest bit.
    Bits,
    /// A byte for each: a part of the frame's segment, which has at least this value where more than half is.
    Parts(u8),
    /// One or two bytes for each: the number of a segment.
    Numbers(usize),
}

impl Pixels {
    fn of(object: &Values<'_>) -> Result<Self, ReadFault> {
        let kind = object.text(tags::SEGMENTATION_TYPE).unwrap_or_default();
        let bits = object.number(tags::BITS_ALLOCATED).unwrap_or(0);
        let greatest = object.number(tags::MAXIMUM_FRACTIONAL_VALUE);
        match (kind.as_str(), bits) {
            ("BINARY", 1) => Ok(Self::Bits),
            ("FRACTIONAL", 8) => {
                let greatest = greatest.and_then(|own| u8::try_from(own).ok());
                let half = greatest.unwrap_or(u8::MAX).div_ceil(2);
                Ok(Self::Parts(half.max(1)))
            }
            ("LABELMAP", 8 | 16) => Ok(Self::Numbers(bits as usize / 8)),
            (kind, bits) => Err(ReadFault::BadHeader {
                what: "segmentation type",
                found: format!("{kind} of {bits} bits"),
                expected: "BINARY of 1 bit, FRACTIONAL of 8, or LABELMAP of 8 or 16",
            }),
        }
    }

    /// The same after decompression, which gives a byte for each bit.
    fn decompressed(self) -> Self {
        match self {
            Self::Bits => Self::Parts(1),
            other => other,
        }
    }

    /// Bits of a pixel.
    fn bits(self) -> usize {
        match self {
            Self::Bits => 1,
            Self::Parts(_) => 8,
            Self::Numbers(width) => 8 * width,
        }
    }

    /// The label of a pixel, by its number in `data`; `own` is that of the frame.
    fn label(self, data: &[u8], pixel: usize, own: u16) -> u16 {
        let is_own = match self {
            Self::Bits => (data[pixel / 8] >> (pixel % 8)) & 1 == 1,
            Self::Parts(half) => data[pixel] >= half,
            Self::Numbers(1) => return u16::from(data[pixel]),
            Self::Numbers(_) => {
                return u16::from_le_bytes([data[2 * pixel], data[2 * pixel + 1]]);
            }
        };
        if is_own { own } else { 0 }
    }
}

pub(super) fn label_map(object: &FileDicomObject<InMemDicomObject>) -> Result<LabelMap, ReadFault> {
    let values = Values::of(object);
    let modality = values.text(tags::MODALITY).unwrap_or_default();
    if modality != "SEG" {
        let modality = modality.chars().filter(char::is_ascii_alphanumeric);
        return Err(ReadFault::NotASegmentation {
            modality: modality.take(16).collect(),
        });
    }
    let pixels = Pixels::of(&values)?;
    let lattice = Lattice::of(&values)?;
    let frames = lattice.slices.len();
    let stored = PixelData::of(object, frames)?;
    let side = |tag| values.number(tag).unwrap_or(0);
    let [columns, rows] = [side(tags::COLUMNS), side(tags::ROWS)];
    // One more at either end: frames without a label may have been left out.
    let size = size([columns, rows, lattice.count as i64 + 2])?;
    let area = size[0] * size[1];
    let format = FrameFormat {
        columns: size[0],
        rows: size[1],
        bits: pixels.bits(),
    };
    if let PixelData::Native(data) = &stored {
        let expected = (area as u64 * frames as u64 * format.bits as u64).div_ceil(8);
        if (data.len() as u64) < expected {
            return Err(ReadFault::Truncated {
                what: "the frames",
                expected,
                found: data.len() as u64,
            });
        }
    }
    let own_labels = frame_labels(&values, pixels, frames)?;
    let mut labels = vec![0; area * size[2]];
    let mut shared = 0_usize;
    let mut is_lossy = PixelData::may_be_lossy(object);
    let mut decoded = Vec::new();
    for (frame, (&slice, &own)) in lattice.slices.iter().zip(&own_labels).enumerate() {
        let (data, first, pixels) = match &stored {
            PixelData::Native(data) => (data.as_ref(), frame * area, pixels),
            PixelData::Compressed(codec, frames) => {
                is_lossy |= codec.decode(frames, frame, format, &mut decoded)?;
                (decoded.as_slice(), 0, pixels.decompressed())
            }
        };
        for (pixel, kept) in labels[(slice + 1) * area..][..area].iter_mut().enumerate() {
            let label = pixels.label(data, first + pixel, own);
            if label != 0 {
                shared += usize::from(*kept != 0 && *kept != label);
                *kept = label;
            }
        }
    }
    let mut warnings = Vec::new();
    if is_lossy {
        warnings.push(
            "the compression of the pixels may be lossy, so labels may be wrong; compare them with the original, or \
             store the segmentation without loss"
                .to_owned(),
        );
    }
    if shared > 0 {
        warnings.push(format!(
            "{shared} voxels belong to several segments; each is taken for the one whose frame comes last"
        ));
    }
    let has_label = |slice: usize| {
        labels[slice * area..][..area]
            .iter()
            .any(|label| *label != 0)
    };
    if has_label(1) || has_label(lattice.count) {
        warnings.push(
            "the first or the last frame has labels: a segmentation need not keep empty frames, so whether the images go on \
             there is unknown, and the organ is taken to end"
                .to_owned(),
        );
    }
    placed(LabelMap {
        size,
        labels,
        steps: lattice.steps,
        origin: lattice.origin - lattice.steps.column(2),
        names: names(&values),
        warnings,
    })
}

/// The label of each frame; zeros where pixels have their own.
fn frame_labels(object: &Values<'_>, pixels: Pixels, frames: usize) -> Result<Vec<u16>, ReadFault> {
    if matches!(pixels, Pixels::Numbers(_)) {
        return Ok(vec![0; frames]);
    }
    let shared = object.first(tags::SHARED_FUNCTIONAL_GROUPS_SEQUENCE);
    let read = |group: &Values<'_>| {
        let segment = group.first(tags::SEGMENT_IDENTIFICATION_SEQUENCE)?;
        segment.number(tags::REFERENCED_SEGMENT_NUMBER)
    };
    let groups = object.items(tags::PER_FRAME_FUNCTIONAL_GROUPS_SEQUENCE);
    let each = groups.iter().map(|own| {
        let number = read(&Values(own)).or_else(|| read(shared.as_ref()?));
        let label = number.and_then(|number| u16::try_from(number).ok());
        label
            .filter(|label| *label > 0)
            .ok_or_else(|| ReadFault::BadHeader {
                what: "referenced segment number of a frame",
                found: number.map_or("missing".to_owned(), |number| number.to_string()),
                expected: "a whole number from 1 to 65535",
            })
    });
    each.collect()
}

fn names(object: &Values<'_>) -> BTreeMap<u16, String> {
    let segments = object.items(tags::SEGMENT_SEQUENCE).iter().map(Values);
    let named = segments.filter_map(|segment| {
        let number = segment.number(tags::SEGMENT_NUMBER)?;
        let name = segment.text(tags::SEGMENT_LABEL)?;
        Some((u16::try_from(number).ok()?, name)).filter(|(_, name)| !name.is_empty())
    });
    named.collect()
}
