//! NRRD in one file, raw or compressed. The space is that of the patient: `left-posterior-superior`
//! and its kin, in millimetres unless `space units` says otherwise.

use std::collections::BTreeMap;

use nalgebra::Matrix3;

use super::unpacked;
use super::voxels::{Encoding, Kind, labels, size};
use crate::io::text::unexpected;
use crate::{LabelMap, LengthUnit, ReadFault, Vec3};

/// The longest header that is read [bytes]; that of a hundred segments has some ten thousand.
const MAX_HEADER: usize = 1 << 20;

/// A field or key of the header.
struct Entry {
    line: usize,
    name: String,
    value: String,
}

struct Header(Vec<Entry>);

impl Header {
    /// The header and what comes after it.
    fn split(bytes: &[u8]) -> Result<(Self, &[u8]), ReadFault> {
        let mut entries = Vec::new();
        let (mut rest, mut line) = (bytes, 0);
        loop {
            let read = bytes.len() - rest.len();
            let line_end = rest
                .iter()
                .take(MAX_HEADER - read)
                .position(|&b| b == b'\n');
            let Some(end) = line_end else {
                break;
            };
            let text = String::from_utf8_lossy(&rest[..end]);
            let text = text.trim_end();
            rest = &rest[end + 1..];
            line += 1;
            if line == 1 && !text.starts_with("NRRD") {
                return Err(unexpected(line, text, "`NRRD` and a version"));
            }
            if text.is_empty() {
                return Ok((Self(entries), rest));
            }
            if line == 1 || text.starts_with('#') {
                continue;
            }
            let both = text.split_once(":=").or_else(|| text.split_once(": "));
            let (name, value) = both.ok_or_else(|| unexpected(line, text, "`field: value`"))?;
            entries.push(Entry {
                line,
                name: name.trim().to_owned(),
                value: value.trim().to_owned(),
            });
        }
        match bytes.len() > MAX_HEADER {
            true => Err(ReadFault::BadHeader {
                what: "length",
                found: format!("more than {MAX_HEADER} bytes"),
                expected: "an empty line before that",
            }),
            false => Err(ReadFault::EndsEarly {
                line,
                expected: "an empty line after the header",
            }),
        }
    }

    fn find(&self, name: &str) -> Option<&Entry> {
        self.0
            .iter()
            .find(|entry| entry.name.eq_ignore_ascii_case(name))
    }

    fn value(&self, name: &'static str) -> Result<&Entry, ReadFault> {
        self.find(name).ok_or_else(|| ReadFault::BadHeader {
            what: name,
            found: "missing".to_owned(),
            expected: "an entry",
        })
    }

    fn encoding(&self) -> Result<Encoding, ReadFault> {
        let entry = self.value("type")?;
        let kind = match entry.value.as_str() {
            "uchar" | "unsigned char" | "uint8" | "uint8_t" => Kind::Unsigned(1),
            "signed char" | "int8" | "int8_t" | "char" => Kind::Signed(1),
            "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => {
                Kind::Unsigned(2)
            }
            "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => {
                Kind::Signed(2)
            }
            "uint" | "unsigned int" | "uint32" | "uint32_t" => Kind::Unsigned(4),
            "int" | "signed int" | "int32" | "int32_t" => Kind::Signed(4),
            "ulonglong"
            | "unsigned long long"
            | "unsigned long long int"
            | "uint64"
            | "uint64_t" => Kind::Unsigned(8),
            "longlong" | "long long" | "long long int" | "signed long long" | "int64"
            | "int64_t" => Kind::Signed(8),
            "float" => Kind::Float,
            "double" => Kind::Double,
            other => return Err(unexpected(entry.line, other, "a type of numbers")),
        };
        let big_endian = self
            .find("endian")
            .is_some_and(|entry| entry.value == "big");
        Ok(Encoding {
            kind,
            big_endian,
            scale: (1.0, 0.0),
        })
    }

    fn size(&self) -> Result<[usize; 3], ReadFault> {
        let entry = self.value("sizes")?;
        let numbers: Option<Vec<i64>> = entry
            .value
            .split_ascii_whitespace()
            .map(|word| word.parse().ok())
            .collect();
        let three = numbers.and_then(|numbers| <[i64; 3]>::try_from(numbers).ok());
        size(three.ok_or_else(|| unexpected(entry.line, &entry.value, "three whole numbers"))?)
    }

    /// Steps from voxel to voxel and the first voxel [m], to the left, the back and the head.
    fn placement(&self) -> Result<(Matrix3<f64>, Vec3, Vec<String>), ReadFault> {
        let metres = self.in_metres();
        let (signs, mut warnings) = self.signs()?;
        let to_lps = Matrix3::from_diagonal(&signs) * metres;
        let origin = match self.find("space origin") {
            Some(entry) => vectors::<1>(entry)?[0],
            None => Vec3::zeros(),
        };
        let steps = match (self.find("space directions"), self.find("spacings")) {
            (Some(entry), _) => Matrix3::from_columns(&vectors::<3>(entry)?),
            (None, Some(entry)) => Matrix3::from_diagonal(&vectors::<1>(entry)?[0]),
            (None, None) => {
                warnings
                    .push("the file does not say how large a voxel is; 1 mm is taken".to_owned());
                Matrix3::identity()
            }
        };
        Ok((to_lps * steps, to_lps * origin, warnings))
    }

    /// Signs that turn the axes of the space to the left, the back and the head.
    fn signs(&self) -> Result<(Vec3, Vec<String>), ReadFault> {
        let Some(entry) = self.find("space") else {
            let warning = "the file does not say how the picture lies in the body; left, back and head \
                         are taken for its axes";
            return Ok((Vec3::repeat(1.0), vec![warning.to_owned()]));
        };
        let signs = match entry.value.to_ascii_lowercase().as_str() {
            "left-posterior-superior" | "lps" => Vec3::new(1.0, 1.0, 1.0),
            "right-anterior-superior" | "ras" => Vec3::new(-1.0, -1.0, 1.0),
            "left-anterior-superior" | "las" => Vec3::new(1.0, -1.0, 1.0),
            other => {
                let expected =
                    "left-posterior-superior, right-anterior-superior or left-anterior-superior";
                return Err(unexpected(entry.line, other, expected));
            }
        };
        Ok((signs, Vec::new()))
    }

    fn in_metres(&self) -> f64 {
        let unit = self.find("space units").or_else(|| self.find("units"));
        let word = unit.and_then(|entry| entry.value.split('"').nth(1));
        let unit: Option<LengthUnit> = word.and_then(|word| word.parse().ok());
        unit.unwrap_or(LengthUnit::Millimetre).in_metres()
    }

    /// Names of segments, as 3D Slicer writes them.
    fn names(&self) -> impl Iterator<Item = (u16, String)> {
        let mut values = BTreeMap::new();
        for entry in &self.0 {
            let name = entry.name.to_ascii_lowercase();
            values.entry(name).or_insert(&entry.value);
        }
        self.0.iter().filter_map(move |entry| {
            let segment = entry.name.strip_suffix("_LabelValue")?;
            let number = entry.value.parse().ok()?;
            let name = values.get(&format!("{segment}_Name").to_ascii_lowercase())?;
            Some((number, (*name).clone()))
        })
    }
}

/// So many vectors, as `(1,0,0) (0,1,0)` or, for one, as `1 0 0`.
fn vectors<const COUNT: usize>(entry: &Entry) -> Result<[Vec3; COUNT], ReadFault> {
    let words = entry.value.split(['(', ')', ',', ' ', '\t']);
    let numbers: Option<Vec<f64>> = words
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().ok())
        .collect();
    let numbers = numbers.filter(|numbers| numbers.len() == 3 * COUNT);
    let numbers = numbers
        .ok_or_else(|| unexpected(entry.line, &entry.value, "three numbers for each axis"))?;
    Ok(std::array::from_fn(|k| {
        Vec3::from_column_slice(&numbers[3 * k..3 * k + 3])
    }))
}

pub(super) fn read(bytes: &[u8]) -> Result<LabelMap, ReadFault> {
    let (header, data) = Header::split(bytes)?;
    if header
        .find("data file")
        .or(header.find("datafile"))
        .is_some()
    {
        return Err(ReadFault::UnreadEncoding {
            what: "a NRRD header whose voxels are in another file",
            remedy: "save the label map as one .nrrd",
        });
    }
    let size = header.size()?;
    let encoding = header.encoding()?;
    let (steps, origin, warnings) = header.placement()?;
    let how = header.value("encoding")?;
    let count = size.iter().product();
    let labels = match how.value.as_str() {
        "raw" => labels(&mut &data[..], count, encoding)?,
        "gzip" | "gz" => labels(&mut unpacked(data), count, encoding)?,
        other => return Err(unexpected(how.line, other, "raw or gzip")),
    };
    super::placed(LabelMap {
        size,
        labels,
        steps,
        origin,
        names: header.names().collect(),
        warnings,
    })
}
