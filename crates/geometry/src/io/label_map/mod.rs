//! Label maps: NIfTI, NRRD and segmentation objects of DICOM.

pub(crate) mod dicom;
mod names;
mod nifti;
mod nrrd;
mod voxels;

use std::io::{Cursor, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;

use super::{MAX_BYTES, read_whole};
use crate::{LabelMap, ReadError, ReadFault};

/// How a compressed file begins.
const GZIP: &[u8] = b"\x1f\x8b";

/// Reads a label map: `.nii`, `.nii.gz`, `.nrrd`, or a segmentation object of DICOM, which may be the only one in a folder.
/// Names of labels come from the file itself, or from a JSON file of the same name in its folder, as `{"labels": {"1":
/// "liver"}}`.
///
/// # Errors
/// When the file cannot be read, is damaged, or holds something else than labels, or a folder holds no segmentation object
/// or several; the error names the path, the cause and the remedy.
pub fn read_label_map(path: &Path) -> Result<LabelMap, ReadError> {
    read_here(path).map_err(|fault| ReadError {
        path: path.to_owned(),
        fault,
    })
}

fn read_here(path: &Path) -> Result<LabelMap, ReadFault> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let name = name.to_ascii_lowercase();
    if path.is_dir() {
        let (file, bytes) = dicom::only_segmentation(path)?;
        let mut map = dicom::read_segmentation(&bytes)?;
        map.add_names(names::in_sidecar_file(&file));
        return Ok(map);
    }
    let bytes = read_whole(path, MAX_BYTES)?;
    let mut map = if name.ends_with(".nii") || name.ends_with(".nii.gz") {
        nifti::read(&mut unpacked(&bytes))?
    } else if name.ends_with(".nrrd") {
        nrrd::read(&bytes)?
    } else if dicom::is_dicom(&bytes) {
        dicom::read_segmentation(&bytes)?
    } else {
        let found = path.extension().unwrap_or_default().to_string_lossy();
        let found = found.chars().take(40).collect();
        return Err(ReadFault::UnknownMapExtension { found });
    };
    map.add_names(names::in_sidecar_file(path));
    Ok(map)
}

/// The bytes, unpacked when they are compressed.
fn unpacked(bytes: &[u8]) -> Box<dyn Read + '_> {
    if bytes.starts_with(GZIP) {
        Box::new(MultiGzDecoder::new(bytes))
    } else {
        Box::new(Cursor::new(bytes))
    }
}

/// Fills `bytes` with what comes next.
fn read_next(source: &mut dyn Read, bytes: &mut [u8], what: &'static str) -> Result<(), ReadFault> {
    let mut filled = 0;
    while filled < bytes.len() {
        match source.read(&mut bytes[filled..]) {
            Ok(0) => {
                return Err(ReadFault::Truncated {
                    what,
                    expected: bytes.len() as u64,
                    found: filled as u64,
                });
            }
            Ok(count) => filled += count,
            Err(error) => return Err(ReadFault::BadCompression(error)),
        }
    }
    Ok(())
}

/// The map, when its voxels have a volume and a place.
fn placed(map: LabelMap) -> Result<LabelMap, ReadFault> {
    /// Spacings of voxels that can be [m].
    const PLAUSIBLE: std::ops::RangeInclusive<f64> = 1e-7..=1.0;
    let spacing = map.spacing();
    let finite = map.origin.iter().all(|c| c.is_finite() && c.abs() < 1e6);
    let box_volume: f64 = spacing.iter().product();
    // Steps in one plane span nothing.
    let upright = map.voxel_volume() > 1e-3 * box_volume;
    if !finite || !upright || !spacing.iter().all(|step| PLAUSIBLE.contains(step)) {
        return Err(ReadFault::BadHeader {
            what: "placement of the voxels",
            found: format!("{spacing:?} m from voxel to voxel"),
            expected: "three steps between 100 nm and 1 m that span a volume",
        });
    }
    Ok(map)
}
