use std::borrow::Cow;

use dicom_dictionary_std::tags;
use dicom_object::{FileDicomObject, InMemDicomObject};

use super::invalid;
use crate::ReadFault;

/// The pixels of all frames: one behind the other, or each compressed by run lengths (part 5 of DICOM, annex G).
pub(super) enum PixelData<'o> {
    Native(Cow<'o, [u8]>),
    RunLengths(&'o [Vec<u8>]),
}

/// Bytes of the header of a compressed frame: the number of its segments, then where up to 15 of them begin.
const HEADER: usize = 64;

impl<'o> PixelData<'o> {
    pub(super) fn of(object: &'o FileDicomObject<InMemDicomObject>) -> Result<Self, ReadFault> {
        let element = object.get(tags::PIXEL_DATA);
        let element = element.ok_or(ReadFault::Truncated {
            what: "a segmentation",
            expected: 1,
            found: 0,
        })?;
        match object.meta().transfer_syntax.trim_end_matches('\0') {
            // Implicit and explicit little endian.
            "1.2.840.10008.1.2" | "1.2.840.10008.1.2.1" => {
                Ok(Self::Native(element.to_bytes().map_err(invalid)?))
            }
            "1.2.840.10008.1.2.5" => Ok(Self::RunLengths(element.fragments().unwrap_or_default())),
            _ => Err(ReadFault::UnreadEncoding {
                what: "a segmentation with big-endian pixels, or compressed by other means than run lengths (RLE)",
                remedy: "save it uncompressed, with `gdcmconv --raw` for instance",
            }),
        }
    }

    /// The pixels of so many `frames`, one behind the other: each frame has `each` bytes, and each pixel `width`.
    pub(super) fn frames(
        self,
        frames: usize,
        each: usize,
        width: usize,
    ) -> Result<Cow<'o, [u8]>, ReadFault> {
        let truncated = |found: usize| ReadFault::Truncated {
            what: "the frames",
            expected: frames.saturating_mul(each) as u64,
            found: found as u64,
        };
        match self {
            Self::Native(data) => match frames.checked_mul(each) {
                Some(expected) if data.len() >= expected => Ok(data),
                _ => Err(truncated(data.len())),
            },
            Self::RunLengths(fragments) => {
                let mut data = Vec::new();
                for fragment in fragments.iter().take(frames) {
                    decode(fragment, each, width, &mut data)
                        .ok_or_else(|| truncated(data.len()))?;
                }
                match data.len() == frames.saturating_mul(each) {
                    true => Ok(Cow::Owned(data)),
                    false => Err(truncated(data.len())),
                }
            }
        }
    }
}

/// Adds a frame of `each` bytes to `data`. Its segments have one byte of each pixel, the highest first. None where it ends
/// too early.
fn decode(fragment: &[u8], each: usize, width: usize, data: &mut Vec<u8>) -> Option<()> {
    let number = |place: usize| {
        let bytes = fragment.get(4 * place..4 * place + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?) as usize)
    };
    let (pixels, begin) = (each / width, data.len());
    // What a frame may be is known before: nothing grows beyond it.
    if number(0)? != width || fragment.len() < HEADER {
        return None;
    }
    data.resize(begin + each, 0);
    for segment in 0..width {
        let end = match segment + 1 < width {
            true => number(segment + 2)?,
            false => fragment.len(),
        };
        let mut runs = fragment.get(number(segment + 1)?..end)?.iter().copied();
        let mut places = (0..pixels).map(|pixel| begin + width * pixel + width - 1 - segment);
        let mut left = pixels;
        while left > 0 {
            // Up to 128 bytes as they are, or one up to 128 times.
            let head = runs.next()?;
            let count = match head {
                0..=127 => usize::from(head) + 1,
                128 => continue,
                129..=255 => 257 - usize::from(head),
            };
            let repeated = match head {
                129.. => Some(runs.next()?),
                _ => None,
            };
            for place in places.by_ref().take(count) {
                data[place] = match repeated {
                    Some(byte) => byte,
                    None => runs.next()?,
                };
            }
            left = left.saturating_sub(count);
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fragment(segments: &[&[u8]]) -> Vec<u8> {
        let mut header = vec![segments.len() as u32];
        let mut at = HEADER;
        for segment in segments {
            header.push(at as u32);
            at += segment.len();
        }
        header.resize(HEADER / 4, 0);
        let mut bytes: Vec<u8> = header.iter().flat_map(|own| own.to_le_bytes()).collect();
        bytes.extend(segments.concat());
        bytes
    }

    /// Judge: the rules of annex G by hand.
    #[test]
    fn run_lengths_are_those_of_the_standard() {
        let one = fragment(&[&[2, 1, 2, 3, 128, 254, 7]]);
        let mut data = Vec::new();
        decode(&one, 6, 1, &mut data).unwrap();
        assert_eq!(data, [1, 2, 3, 7, 7, 7]);
        // The high bytes come first.
        let two = fragment(&[&[255, 1], &[1, 5, 6]]);
        let mut data = vec![9];
        decode(&two, 4, 2, &mut data).unwrap();
        assert_eq!(data, [9, 5, 1, 6, 1]);
        for cut in 0..one.len() {
            assert!(
                decode(&one[..cut], 6, 1, &mut Vec::new()).is_none(),
                "{cut}"
            );
        }
    }
}
