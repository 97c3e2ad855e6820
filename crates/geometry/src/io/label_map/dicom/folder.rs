use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use dicom_dictionary_std::tags;
use dicom_object::{FileDicomObject, InMemDicomObject, OpenFileOptions};

use super::{MAGIC, PREAMBLE, Values, is_dicom, read_object};
use crate::{ReadError, ReadFault, Vec3};

/// Files that are looked at, at most.
const MAX_FILES: usize = 100_000;

/// Folders in folders that are looked into.
const DEEPEST: usize = 16;

/// Images of one series.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct DicomSeries {
    /// How they were taken: `CT`, `MR`, …
    pub modality: String,
    /// How many there are.
    pub images: usize,
    /// Columns and rows of an image [pixels].
    pub size: [usize; 2],
    /// From column to column, row to row and image to image [m]; none where an image does not state it, or is the only
    /// one.
    pub spacing_m: Option<[f64; 3]>,
}

/// Contents of a folder with DICOM files, and of its subfolders.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DicomFolder {
    /// Its images, by series.
    pub series: Vec<DicomSeries>,
    /// Files of segmentation objects, which are label maps.
    pub segmentations: Vec<PathBuf>,
    /// How many files are something else.
    pub others: usize,
}

/// The images of a series that were seen.
#[derive(Default)]
struct SeriesImages {
    modality: String,
    images: usize,
    size: [usize; 2],
    /// From row to row and column to column [mm].
    spacing: Option<[f64; 2]>,
    normal: Option<Vec3>,
    /// Along the normal [mm].
    heights: Vec<f64>,
}

/// Looks through a folder and the folders in it. Of each file its beginning is read, up to its pixels.
///
/// # Errors
/// When the folder cannot be read, or there are more than 100,000 files.
pub fn read_dicom_folder(path: &Path) -> Result<DicomFolder, ReadError> {
    read_here(path).map_err(|fault| ReadError {
        path: path.to_owned(),
        fault,
    })
}

pub(super) fn read_here(path: &Path) -> Result<DicomFolder, ReadFault> {
    let mut files = Vec::new();
    collect(path, DEEPEST, &mut files)?;
    files.sort_unstable();
    let mut found = DicomFolder::default();
    // By the identifier of the series, which does not identify a person.
    let mut series: BTreeMap<String, SeriesImages> = BTreeMap::new();
    for file in files {
        let Some(object) = header(&file) else {
            found.others += 1;
            continue;
        };
        let values = Values::of(&object);
        let modality = values.text(tags::MODALITY).unwrap_or_default();
        if modality == "SEG" {
            found.segmentations.push(file);
        } else if let Some([columns, rows]) = sides(&values) {
            let series_uid = values.text(tags::SERIES_INSTANCE_UID).unwrap_or_default();
            let seen = series.entry(series_uid).or_default();
            seen.modality = modality;
            seen.size = [columns, rows];
            seen.add(&values);
        } else {
            found.others += 1;
        }
    }
    found.series = series
        .into_values()
        .map(SeriesImages::into_series)
        .collect();
    found
        .series
        .sort_by(|one, other| (&one.modality, other.images).cmp(&(&other.modality, one.images)));
    Ok(found)
}

fn sides(values: &Values<'_>) -> Option<[usize; 2]> {
    let [columns, rows] = [tags::COLUMNS, tags::ROWS].map(|tag| values.number(tag));
    Some([
        usize::try_from(columns?).ok()?,
        usize::try_from(rows?).ok()?,
    ])
}

fn collect(folder: &Path, deeper: usize, files: &mut Vec<PathBuf>) -> Result<(), ReadFault> {
    for entry in fs::read_dir(folder).map_err(ReadFault::Unreadable)? {
        let entry = entry.map_err(ReadFault::Unreadable)?;
        let kind = entry.file_type().map_err(ReadFault::Unreadable)?;
        if kind.is_file() {
            files.push(entry.path());
        } else if kind.is_dir() && deeper > 0 {
            collect(&entry.path(), deeper - 1, files)?;
        }
        if files.len() > MAX_FILES {
            return Err(ReadFault::TooLarge {
                what: "files",
                found: files.len() as u64,
                most: MAX_FILES as u64,
            });
        }
    }
    Ok(())
}

/// The elements of a DICOM file before its pixels; none if it is another or a damaged file.
fn header(file: &Path) -> Option<FileDicomObject<InMemDicomObject>> {
    let mut file = BufReader::new(File::open(file).ok()?);
    let mut bytes = [0; PREAMBLE + MAGIC.len()];
    file.read_exact(&mut bytes).ok()?;
    let options = OpenFileOptions::new().read_until(tags::PIXEL_DATA);
    is_dicom(&bytes)
        .then(|| read_object(file, options).ok())
        .flatten()
}

impl SeriesImages {
    fn add(&mut self, values: &Values<'_>) {
        let frames = values.number(tags::NUMBER_OF_FRAMES).unwrap_or(1);
        self.images += usize::try_from(frames).unwrap_or(1).max(1);
        self.spacing = self.spacing.or_else(|| values.numbers(tags::PIXEL_SPACING));
        if let Some([a, b, c, d, e, f]) = values.numbers(tags::IMAGE_ORIENTATION_PATIENT) {
            let normal = Vec3::new(a, b, c).cross(&Vec3::new(d, e, f));
            self.normal = self.normal.or(Some(normal));
        }
        let position = values.numbers::<3>(tags::IMAGE_POSITION_PATIENT);
        if let (Some(normal), Some(position)) = (self.normal, position) {
            self.heights.push(normal.dot(&Vec3::from(position)));
        }
    }

    fn into_series(mut self) -> DicomSeries {
        self.heights.sort_by(f64::total_cmp);
        let mut gaps: Vec<f64> = self
            .heights
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        gaps.sort_by(f64::total_cmp);
        // The median, for an image may be missing.
        let apart = gaps.get(gaps.len() / 2).copied();
        let spacing = self.spacing.zip(apart);
        let modality = self.modality.chars().filter(char::is_ascii_alphanumeric);
        DicomSeries {
            modality: modality.take(16).collect(),
            images: self.images,
            size: self.size,
            spacing_m: spacing
                .map(|([row, column], apart)| [column, row, apart].map(|mm| 1e-3 * mm)),
        }
    }
}
