use super::FrameFormat;

/// Bytes of the header of a compressed frame: the number of its segments, then where up to 15 of them begin.
const HEADER: usize = 64;

/// Decompresses one frame [DICOM PS3.5, annex G]. Its segments have one byte of each pixel, the highest first. None
/// where it ends too early.
pub(super) fn decode(fragment: &[u8], format: FrameFormat, data: &mut Vec<u8>) -> Option<()> {
    let number = |place: usize| {
        let bytes = fragment.get(4 * place..4 * place + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?) as usize)
    };
    let (pixels, width) = (format.pixels(), format.width());
    // No more memory than the data justify: two bytes have at most 128 of one kind.
    let most = fragment.len().checked_sub(HEADER)?.saturating_mul(64);
    if number(0)? != width || most < format.bytes() {
        return None;
    }
    data.resize(format.bytes(), 0);
    for segment in 0..width {
        let end = match segment + 1 < width {
            true => number(segment + 2)?,
            false => fragment.len(),
        };
        let mut runs = fragment.get(number(segment + 1)?..end)?.iter().copied();
        let mut places = (0..pixels).map(|pixel| width * pixel + width - 1 - segment);
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

    /// Judge: [DICOM PS3.5, annex G] by hand.
    #[test]
    fn run_lengths_are_those_of_the_standard() {
        let one = fragment(&[&[2, 1, 2, 3, 128, 254, 7]]);
        let format = |columns, bits| FrameFormat {
            columns,
            rows: 1,
            bits,
        };
        let mut data = Vec::new();
        decode(&one, format(6, 8), &mut data).unwrap();
        assert_eq!(data, [1, 2, 3, 7, 7, 7]);
        // The high bytes come first.
        let two = fragment(&[&[255, 1], &[1, 5, 6]]);
        let mut data = Vec::new();
        decode(&two, format(2, 16), &mut data).unwrap();
        assert_eq!(data, [5, 1, 6, 1]);
        for cut in 0..one.len() {
            assert!(
                decode(&one[..cut], format(6, 8), &mut Vec::new()).is_none(),
                "{cut}"
            );
        }
    }
}
