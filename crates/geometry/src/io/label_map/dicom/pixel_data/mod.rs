//! The pixels of a segmentation [DICOM PS3.5, 8 and annex A]: uncompressed, or each frame compressed for itself.

mod fragments;
mod jpeg_2000;
mod lossless_jpeg;
mod run_lengths;

use std::borrow::Cow;
use std::io::Read;

use dicom_dictionary_std::{tags, uids};
use dicom_object::{FileDicomObject, InMemDicomObject};
use flate2::read::DeflateDecoder;

use self::fragments::Frames;
use super::{BIG_ENDIAN, Values, invalid};
use crate::ReadFault;

/// How the pixels of all frames are stored.
pub(super) enum PixelData<'o> {
    /// One frame behind the other.
    Native(Cow<'o, [u8]>),
    /// Each frame compressed.
    Compressed(Codec, Frames<'o>),
}

/// How a frame is compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Codec {
    RunLengths,
    LosslessJpeg,
    Jpeg2000,
    /// Deflated, with eight pixels in a byte if a pixel has one bit.
    Deflated,
}

/// The expected format of a decompressed frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrameFormat {
    /// Pixels of a row.
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Bits of a pixel: 8 or 16; or 1, and then a decompressed pixel is a byte, 0 or 1.
    pub(super) bits: usize,
}

impl FrameFormat {
    pub(super) fn pixels(self) -> usize {
        self.columns * self.rows
    }

    /// Bytes of a decompressed pixel.
    pub(super) fn width(self) -> usize {
        self.bits.div_ceil(8)
    }

    fn bytes(self) -> usize {
        self.pixels() * self.width()
    }
}

impl<'o> PixelData<'o> {
    /// Of `count` frames.
    pub(super) fn of(
        object: &'o FileDicomObject<InMemDicomObject>,
        count: usize,
    ) -> Result<Self, ReadFault> {
        let element = object.get(tags::PIXEL_DATA);
        let element = element.ok_or(ReadFault::Truncated {
            what: "a segmentation",
            expected: 1,
            found: 0,
        })?;
        let codec = match object.meta().transfer_syntax() {
            uids::IMPLICIT_VR_LITTLE_ENDIAN | uids::EXPLICIT_VR_LITTLE_ENDIAN => {
                return Ok(Self::Native(element.to_bytes().map_err(invalid)?));
            }
            uids::RLE_LOSSLESS => Codec::RunLengths,
            uids::JPEG_LOSSLESS | uids::JPEG_LOSSLESS_SV1 => Codec::LosslessJpeg,
            uids::JPEG2000_LOSSLESS | uids::JPEG2000 => Codec::Jpeg2000,
            uids::DEFLATED_IMAGE_FRAME_COMPRESSION => Codec::Deflated,
            other => return Err(unread(other)),
        };
        let fragments = element.fragments().unwrap_or_default();
        let offsets = element.value().offset_table().unwrap_or_default();
        let frames = Frames::of(fragments, offsets, count, codec.first_bytes())?;
        Ok(Self::Compressed(codec, frames))
    }

    /// Whether the compression may have changed pixels, by the header.
    pub(super) fn may_be_lossy(object: &FileDicomObject<InMemDicomObject>) -> bool {
        let flag = Values::of(object).text(tags::LOSSY_IMAGE_COMPRESSION);
        object.meta().transfer_syntax() == uids::JPEG2000 && flag.as_deref() != Some("00")
    }
}

/// Why pixels in a transfer syntax are not read.
fn unread(transfer_syntax: &str) -> ReadFault {
    let (what, remedy) = match transfer_syntax {
        uids::JPEG_BASELINE8_BIT | uids::JPEG_EXTENDED12_BIT => (
            "a segmentation that is compressed by lossy JPEG, which changes labels,",
            "store it uncompressed or without loss",
        ),
        uids::JPEGLS_LOSSLESS | uids::JPEGLS_NEAR_LOSSLESS => (
            "a segmentation that is compressed by JPEG-LS",
            "decompress it, with `dcmdjpls IN OUT` or `gdcmconv --raw IN OUT` for instance",
        ),
        BIG_ENDIAN => (
            "a segmentation in big-endian order",
            "convert it, with `dcmconv +te IN OUT` for instance",
        ),
        _ => (
            "a segmentation in this transfer syntax",
            "convert it, with `gdcmconv --raw IN OUT` for instance",
        ),
    };
    ReadFault::UnreadEncoding { what, remedy }
}

impl Codec {
    /// How the compressed data of a frame begin; nothing if they may begin with any byte.
    fn first_bytes(self) -> &'static [u8] {
        match self {
            Self::RunLengths | Self::Deflated => &[],
            Self::LosslessJpeg => b"\xff\xd8\xff",
            Self::Jpeg2000 => b"\xff\x4f\xff\x51",
        }
    }

    /// Decompresses a frame, of this number from zero, into `pixels`, which it replaces. Returns whether the compression
    /// left out bits.
    pub(super) fn decode(
        self,
        frames: &Frames<'_>,
        frame: usize,
        format: FrameFormat,
        pixels: &mut Vec<u8>,
    ) -> Result<bool, ReadFault> {
        pixels.clear();
        let data = frames.data(frame);
        let mut bits_left_out = 0;
        let decoded = match self {
            Self::RunLengths => run_lengths::decode(&data, format, pixels)
                .ok_or_else(|| "the run lengths end too early".to_owned()),
            Self::LosslessJpeg => lossless_jpeg::decode(&data, format, pixels)
                .map(|bits| bits_left_out = bits)
                .map_err(str::to_owned),
            Self::Jpeg2000 => jpeg_2000::decode(&data, format, pixels),
            Self::Deflated => inflate(&data, format, pixels),
        };
        match decoded {
            Ok(()) => Ok(bits_left_out > 0),
            Err(cause) => Err(ReadFault::BadFrame {
                frame: frame + 1,
                cause,
            }),
        }
    }
}

/// Each frame is a deflate stream of its own [RFC 1951].
fn inflate(data: &[u8], format: FrameFormat, pixels: &mut Vec<u8>) -> Result<(), String> {
    let packed = match format.bits {
        1 => format.pixels().div_ceil(8),
        _ => format.bytes(),
    };
    let mut stream = DeflateDecoder::new(data).take(packed as u64);
    let read = stream.read_to_end(pixels);
    let found = read.map_err(|error| error.to_string())?;
    if found < packed {
        return Err(format!("{found} bytes where {packed} were expected"));
    }
    if format.bits == 1 {
        let bits = pixels
            .iter()
            .flat_map(|byte| (0..8).map(move |bit| (byte >> bit) & 1));
        *pixels = bits.take(format.pixels()).collect();
    }
    Ok(())
}
