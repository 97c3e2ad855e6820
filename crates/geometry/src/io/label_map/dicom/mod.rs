//! DICOM: the image series in a folder, and segmentation objects as label maps. No identity of a patient and no date
//! is read from a file.
//!
//! *How we know*: `dicom::…`, on files that another library wrote.
//!
//! *Limits*: pixels that are uncompressed, or compressed by run lengths, lossless JPEG, JPEG 2000 or deflate, but not by
//! JPEG-LS; frames that lie on one lattice. Images are listed, not read: a segmentation has a geometry of its own.

mod folder;
mod frames;
mod lengths;
mod pixel_data;
mod segmentation;

use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use dicom_dictionary_std::uids;
use dicom_object::{FileDicomObject, FileMetaTable, InMemDicomObject, OpenFileOptions, Tag};
use flate2::read::DeflateDecoder;

pub use folder::{DicomFolder, DicomSeries, read_dicom_folder};

use self::lengths::{Encoding, check_lengths};
use crate::io::text::shortened;
use crate::io::{MAX_BYTES, read_whole};
use crate::{LabelMap, ReadFault};

/// The magic bytes after the preamble of a file.
const MAGIC: &[u8] = b"DICM";

/// Explicit big-endian, which is retired.
const BIG_ENDIAN: &str = "1.2.840.10008.1.2.2";

/// Bytes of the preamble.
const PREAMBLE: usize = 128;

/// Start of the elements before the data set [bytes].
const META_BEGIN: u64 = (PREAMBLE + MAGIC.len()) as u64;

/// Bytes of the first of these elements, whose last four are the length of the others.
const META_LENGTH_SIZE: usize = 12;

/// Whether a file that begins with `bytes` is of DICOM.
pub(super) fn is_dicom(bytes: &[u8]) -> bool {
    bytes
        .get(PREAMBLE..)
        .is_some_and(|rest| rest.starts_with(MAGIC))
}

/// The label map of a segmentation object.
pub(super) fn read_segmentation(bytes: &[u8]) -> Result<LabelMap, ReadFault> {
    let object = read_object(Cursor::new(bytes), OpenFileOptions::new())?;
    segmentation::label_map(&object)
}

/// The object in a file. A deflated data set [DICOM PS3.5, A.5] is decompressed, up to as many bytes as a file
/// may have, and its transfer syntax is then that of the decompressed data.
fn read_object(
    mut file: impl Read + Seek,
    options: OpenFileOptions,
) -> Result<FileDicomObject<InMemDicomObject>, ReadFault> {
    let end = file.seek(SeekFrom::End(0)).map_err(ReadFault::Unreadable)?;
    let meta_end = meta_end(&mut file).map_err(ReadFault::Unreadable)?;
    check_lengths(&mut file, META_BEGIN..meta_end.min(end), Encoding::Explicit)?;
    file.seek(SeekFrom::Start(PREAMBLE as u64))
        .map_err(ReadFault::Unreadable)?;
    let mut meta = FileMetaTable::from_reader(&mut file).map_err(invalid)?;
    let object = match meta.transfer_syntax() {
        uids::DEFLATED_EXPLICIT_VR_LITTLE_ENDIAN => {
            meta.transfer_syntax = uids::EXPLICIT_VR_LITTLE_ENDIAN.to_owned();
            meta.update_information_group_length();
            let mut header = MAGIC.to_vec();
            meta.write(&mut header).map_err(invalid)?;
            let data = inflated(file)?;
            check_lengths(
                &mut Cursor::new(&data),
                0..data.len() as u64,
                Encoding::Explicit,
            )?;
            options.from_reader(Cursor::new(header).chain(Cursor::new(data)))
        }
        syntax => {
            let encoding = match syntax {
                uids::IMPLICIT_VR_LITTLE_ENDIAN => Encoding::Implicit,
                BIG_ENDIAN => Encoding::BigEndian,
                _ => Encoding::Explicit,
            };
            let begin = file.stream_position().map_err(ReadFault::Unreadable)?;
            check_lengths(&mut file, begin..end, encoding)?;
            file.rewind().map_err(ReadFault::Unreadable)?;
            options.from_reader(file)
        }
    };
    object.map_err(invalid)
}

/// End of the elements before the data set, from the first of them; where they begin if the file is too short.
fn meta_end(file: &mut (impl Read + Seek)) -> io::Result<u64> {
    let mut first = [0; META_LENGTH_SIZE];
    file.seek(SeekFrom::Start(META_BEGIN))?;
    match file.read_exact(&mut first) {
        Ok(()) => {
            let length = u32::from_le_bytes([first[8], first[9], first[10], first[11]]);
            Ok(META_BEGIN + META_LENGTH_SIZE as u64 + u64::from(length))
        }
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(META_BEGIN),
        Err(error) => Err(error),
    }
}

fn inflated(file: impl Read) -> Result<Vec<u8>, ReadFault> {
    let mut data = Vec::new();
    let mut stream = DeflateDecoder::new(file).take(MAX_BYTES + 1);
    stream
        .read_to_end(&mut data)
        .map_err(ReadFault::BadCompression)?;
    match data.len() as u64 {
        found if found > MAX_BYTES => Err(ReadFault::TooLarge {
            what: "bytes",
            found,
            most: MAX_BYTES,
        }),
        _ => Ok(data),
    }
}

/// The only segmentation object in a folder, and its bytes.
pub(super) fn only_segmentation(path: &Path) -> Result<(PathBuf, Vec<u8>), ReadFault> {
    let mut folder = folder::read_here(path)?;
    match folder.segmentations.len() {
        1 => {
            let file = folder.segmentations.remove(0);
            let bytes = read_whole(&file, MAX_BYTES)?;
            Ok((file, bytes))
        }
        found => Err(ReadFault::NotOneSegmentation { found }),
    }
}

fn invalid(cause: impl std::error::Error) -> ReadFault {
    let mut words = cause.to_string();
    let mut source = cause.source();
    while let Some(inner) = source {
        words += &format!(": {inner}");
        source = inner.source();
    }
    ReadFault::Dicom {
        cause: shortened(&words).into_owned(),
    }
}

/// Values of an object or of an item of a sequence.
struct Values<'o>(&'o InMemDicomObject);

impl<'o> Values<'o> {
    fn of(object: &'o FileDicomObject<InMemDicomObject>) -> Self {
        Self(object)
    }

    fn text(&self, tag: Tag) -> Option<String> {
        let text = self.0.get(tag)?.to_str().ok()?;
        Some(text.trim_matches([' ', '\0']).to_owned())
    }

    fn number(&self, tag: Tag) -> Option<i64> {
        self.0.get(tag)?.to_int().ok()
    }

    /// Finite numbers.
    fn numbers<const N: usize>(&self, tag: Tag) -> Option<[f64; N]> {
        let numbers = self.0.get(tag)?.to_multi_float64().ok()?;
        let numbers: [f64; N] = numbers.try_into().ok()?;
        numbers
            .iter()
            .all(|number| number.is_finite())
            .then_some(numbers)
    }

    fn items(&self, tag: Tag) -> &'o [InMemDicomObject] {
        self.0
            .get(tag)
            .and_then(|own| own.items())
            .unwrap_or_default()
    }

    fn first(&self, tag: Tag) -> Option<Values<'o>> {
        self.items(tag).first().map(Values)
    }
}
