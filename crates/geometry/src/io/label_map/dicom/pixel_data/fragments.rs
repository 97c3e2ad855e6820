use std::borrow::Cow;

use crate::ReadFault;

/// Bytes before the data of each fragment: its tag and its length.
const ITEM_HEADER: u64 = 8;

/// The compressed data of each frame, in one or several fragments [DICOM PS3.5, A.4].
pub(in super::super) struct Frames<'o>(Vec<&'o [Vec<u8>]>);

impl<'o> Frames<'o> {
    /// Of `count` frames. `offsets` is the basic offset table, which may be empty: where the first fragment of each frame
    /// begins, from the beginning of the first one [bytes]. `first_bytes` are those of each frame, if they are known.
    pub(super) fn of(
        fragments: &'o [Vec<u8>],
        offsets: &[u32],
        count: usize,
        first_bytes: &[u8],
    ) -> Result<Self, ReadFault> {
        let begins: Vec<usize> = if fragments.len() == count {
            (0..count).collect()
        } else if count == 1 && !fragments.is_empty() {
            vec![0]
        } else if offsets.len() == count {
            by_offsets(fragments, offsets)
        } else {
            let begins = fragments.iter().enumerate().filter(|(place, fragment)| {
                *place == 0 || (!first_bytes.is_empty() && fragment.starts_with(first_bytes))
            });
            begins.map(|(place, _)| place).collect()
        };
        if begins.len() != count || count == 0 {
            return Err(ReadFault::Mismatch {
                what: "compressed frames",
                found: begins.len(),
                expected: count,
            });
        }
        let ends = begins.iter().skip(1).copied().chain([fragments.len()]);
        let frames = begins.iter().zip(ends);
        Ok(Self(
            frames.map(|(&begin, end)| &fragments[begin..end]).collect(),
        ))
    }

    /// Of the frame of this number, from zero.
    pub(super) fn data(&self, frame: usize) -> Cow<'o, [u8]> {
        match self.0[frame] {
            [one] => Cow::Borrowed(one),
            several => Cow::Owned(several.concat()),
        }
    }
}

/// The first fragment of each frame, of those whose offset is that of a fragment, in increasing order.
fn by_offsets(fragments: &[Vec<u8>], offsets: &[u32]) -> Vec<usize> {
    let mut offsets = offsets.iter().map(|&offset| u64::from(offset)).peekable();
    let mut at = 0;
    let mut begins = Vec::new();
    for (place, fragment) in fragments.iter().enumerate() {
        if offsets.next_if_eq(&at).is_some() {
            begins.push(place);
        }
        at += ITEM_HEADER + fragment.len() as u64;
    }
    begins
}

#[cfg(test)]
mod tests {
    use super::*;

    const JPEG: &[u8] = b"\xff\xd8\xff";

    fn data(fragments: &[&[u8]], offsets: &[u32], count: usize) -> Option<Vec<Vec<u8>>> {
        let fragments: Vec<_> = fragments.iter().map(|own| own.to_vec()).collect();
        let frames = Frames::of(&fragments, offsets, count, JPEG).ok()?;
        Some((0..count).map(|frame| frames.data(frame).into()).collect())
    }

    /// Judge: [DICOM PS3.5, A.4] by hand.
    #[test]
    fn fragments_are_joined_to_frames() {
        let several: [&[u8]; 4] = [b"\xff\xd8\xff1", b"2345", b"\xff\xd8\xff6", b"78"];
        let joined = vec![b"\xff\xd8\xff12345".to_vec(), b"\xff\xd8\xff678".to_vec()];
        for offsets in [&[0, 24][..], &[]] {
            assert_eq!(data(&several, offsets, 2).unwrap(), joined);
        }
        assert_eq!(data(&several, &[], 4).unwrap(), several);
        assert_eq!(data(&several, &[0], 1).unwrap(), [several.concat()]);
        for (offsets, count) in [(&[0, 23][..], 2), (&[24, 0], 2), (&[], 3), (&[], 0)] {
            assert!(
                data(&several, offsets, count).is_none(),
                "{offsets:?} {count}"
            );
        }
        assert!(data(&[], &[], 1).is_none());
    }
}
