use super::super::text::unexpected;
use crate::ReadFault;

/// How the values after the header are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn named(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }
}

/// A column of an element: one value, or a list after its length.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) length: Option<Scalar>,
    pub(super) value: Scalar,
}

/// A table of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Start of the values: bytes from the start, and the line from one.
    pub(super) end: usize,
    pub(super) end_line: usize,
}

pub(super) fn read(bytes: &[u8]) -> Result<Header, ReadFault> {
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut end = 0;
    for (index, raw) in bytes.split_inclusive(|&b| b == b'\n').enumerate() {
        let line_number = index + 1;
        end += raw.len();
        let line = String::from_utf8_lossy(raw);
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        match words[..] {
            ["ply"] if index == 0 => {}
            _ if index == 0 => return Err(unexpected(1, &line, "`ply`")),
            ["comment" | "obj_info", ..] | [] => {}
            ["format", word, _version] => {
                encoding = Some(named_encoding(word).ok_or_else(|| {
                    let expected = "`ascii`, `binary_little_endian` or `binary_big_endian`";
                    unexpected(line_number, word, expected)
                })?);
            }
            ["element", name, count] => elements.push(Element {
                name: name.to_owned(),
                count: count
                    .parse()
                    .map_err(|_| unexpected(line_number, count, "a count"))?,
                properties: Vec::new(),
            }),
            ["property", ref rest @ ..] => {
                let added = elements.last_mut().zip(property(rest));
                let (element, property) = added.ok_or_else(|| {
                    unexpected(
                        line_number,
                        &line,
                        "a property of an element, with its type",
                    )
                })?;
                element.properties.push(property);
            }
            ["end_header"] => {
                return Ok(Header {
                    encoding: encoding.ok_or(ReadFault::MissingPart {
                        expected: "`format` line",
                    })?,
                    elements,
                    end,
                    end_line: line_number + 1,
                });
            }
            _ => return Err(unexpected(line_number, &line, "a line of a PLY header")),
        }
    }
    Err(ReadFault::MissingPart {
        expected: "`end_header` line",
    })
}

fn named_encoding(word: &str) -> Option<Encoding> {
    Some(match word {
        "ascii" => Encoding::Text,
        "binary_little_endian" => Encoding::LittleEndian,
        "binary_big_endian" => Encoding::BigEndian,
        _ => return None,
    })
}

fn property(words: &[&str]) -> Option<Property> {
    let (length, value, name) = match words {
        ["list", length, value, name] => (Some(Scalar::named(length)?), value, name),
        [value, name] => (None, value, name),
        _ => return None,
    };
    Some(Property {
        name: (*name).to_owned(),
        length,
        value: Scalar::named(value)?,
    })
}
