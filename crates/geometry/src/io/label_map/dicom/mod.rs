//! DICOM: what images lie in a folder, and segmentation objects as label maps. Nothing that tells who a patient is, or
//! when, is read from a file.
//!
//! *How we know*: `dicom::…`, on files that another library wrote.
//!
//! *Limits*: pixels that are uncompressed or compressed by run lengths; frames that lie on one lattice. Images are
//! listed, not read: a segmentation has a geometry of its own.

mod folder;
mod frames;
mod pixel_data;
mod segmentation;

use std::io::Cursor;
use std::path::{Path, PathBuf};

use dicom_object::{FileDicomObject, InMemDicomObject, OpenFileOptions, Tag};

pub use folder::{DicomFolder, DicomSeries, read_dicom_folder};

use crate::io::text::shortened;
use crate::io::{MOST_BYTES, read_whole};
use crate::{LabelMap, ReadFault};

/// What stands after the preamble of a file.
const MAGIC: &[u8] = b"DICM";

/// Bytes of the preamble.
const PREAMBLE: usize = 128;

/// Whether a file that begins with `bytes` is of DICOM.
pub(super) fn is_dicom(bytes: &[u8]) -> bool {
    bytes
        .get(PREAMBLE..)
        .is_some_and(|rest| rest.starts_with(MAGIC))
}

/// The label map of a segmentation object.
pub(super) fn read_segmentation(bytes: &[u8]) -> Result<LabelMap, ReadFault> {
    let object = OpenFileOptions::new().from_reader(Cursor::new(bytes));
    segmentation::label_map(&object.map_err(invalid)?)
}

/// The only segmentation object in a folder, and its bytes.
pub(super) fn only_segmentation(path: &Path) -> Result<(PathBuf, Vec<u8>), ReadFault> {
    let mut folder = folder::read_here(path)?;
    match folder.segmentations.len() {
        1 => {
            let file = folder.segmentations.remove(0);
            let bytes = read_whole(&file, MOST_BYTES)?;
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
