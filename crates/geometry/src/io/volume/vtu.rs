use super::super::base64;
use super::super::text::unexpected;
use super::cells::CellLists;
use super::words::Words;
use super::{REGION_ARRAYS, RawVolume};
use crate::{ReadFault, Vec3};

/// A tag and the text after it, up to the next one.
struct Tag<'a> {
    /// `Points`, or `/Points` where it ends.
    name: &'a str,
    attributes: &'a str,
    text: &'a str,
    /// The line that the text begins on.
    line: usize,
}

/// How the numbers between tags are written when not as text.
struct Binary {
    /// Bytes of the length before an array.
    header: usize,
    big_endian: bool,
    compressed: bool,
}

pub(super) fn read(text: &str) -> Result<RawVolume, ReadFault> {
    let mut volume = RawVolume::default();
    let mut cells = CellLists::default();
    let mut binary = None;
    let (mut section, mut pieces) = ("", 0);
    let mut rank = REGION_ARRAYS.len();
    for tag in tags(text) {
        match tag.name {
            "VTKFile" => binary = Some(file(&tag)?),
            "Piece" => pieces += 1,
            "Points" | "Cells" | "PointData" | "CellData" => section = tag.name,
            "/Points" | "/Cells" | "/PointData" | "/CellData" => section = "",
            "DataArray" => {
                let binary = binary.as_ref().ok_or(ReadFault::MissingPart {
                    expected: "`VTKFile` tag",
                })?;
                match (section, attribute(&tag, "Name")) {
                    ("Points", _) => {
                        for point in numbers(&tag, binary)?.chunks(3) {
                            let [x, y, z] = *point else {
                                return Err(unexpected(tag.line, "", "three coordinates a point"));
                            };
                            volume.points.add_vertex(Vec3::new(x, y, z))?;
                        }
                    }
                    ("Cells", Some("connectivity")) => cells.nodes = integers(&tag, binary)?,
                    ("Cells", Some("offsets")) => cells.ends = integers(&tag, binary)?,
                    ("Cells", Some("types")) => cells.kinds = integers(&tag, binary)?,
                    ("CellData", Some(name)) => {
                        let place = REGION_ARRAYS
                            .iter()
                            .position(|known| known.eq_ignore_ascii_case(name));
                        // An array that is called so and does not number anything is not of regions.
                        if let Some(place) = place.filter(|place| *place < rank)
                            && let Ok(numbers) = integers(&tag, binary)
                        {
                            (rank, cells.regions) = (place, numbers);
                        }
                    }
                    _ => {}
                }
            }
            _ => {}
        }
    }
    if binary.is_none() {
        return Err(ReadFault::MissingPart {
            expected: "`VTKFile` tag",
        });
    }
    if pieces > 1 {
        return Err(ReadFault::Unsupported {
            what: "a grid in several pieces",
        });
    }
    cells.sort_out(&mut volume)?;
    Ok(volume)
}

fn file(tag: &Tag<'_>) -> Result<Binary, ReadFault> {
    let kind = attribute(tag, "type").unwrap_or("");
    if kind != "UnstructuredGrid" {
        let expected = "`UnstructuredGrid` as the type of the file";
        return Err(unexpected(tag.line, kind, expected));
    }
    Ok(Binary {
        header: if attribute(tag, "header_type") == Some("UInt64") {
            8
        } else {
            4
        },
        big_endian: attribute(tag, "byte_order") == Some("BigEndian"),
        compressed: attribute(tag, "compressor").is_some_and(|name| !name.is_empty()),
    })
}

/// The tags in their order; comments and declarations are passed over.
fn tags(text: &str) -> impl Iterator<Item = Tag<'_>> {
    let (mut rest, mut line) = (text, 1);
    std::iter::from_fn(move || {
        loop {
            let open = rest.find('<')?;
            line += newlines(&rest[..open]);
            rest = &rest[open + 1..];
            let end = if rest.starts_with("!--") { "-->" } else { ">" };
            let close = rest.find(end)?;
            let inside = &rest[..close];
            line += newlines(inside);
            rest = &rest[close + end.len()..];
            if inside.starts_with(['!', '?']) {
                continue;
            }
            let name_end = inside
                .find(|c: char| c.is_ascii_whitespace())
                .unwrap_or(inside.len());
            let (name, attributes) = inside.split_at(name_end);
            return Some(Tag {
                name: name.strip_suffix('/').unwrap_or(name),
                attributes,
                text: &rest[..rest.find('<').unwrap_or(rest.len())],
                line,
            });
        }
    })
}

fn newlines(text: &str) -> usize {
    text.bytes().filter(|&byte| byte == b'\n').count()
}

/// The value of `name="value"`.
fn attribute<'a>(tag: &Tag<'a>, name: &str) -> Option<&'a str> {
    let mut rest = tag.attributes;
    loop {
        let (key, after) = rest.split_once('=')?;
        let after = after.trim_start();
        let quote = after.chars().next().filter(|c| ['"', '\''].contains(c))?;
        let (value, behind) = after[1..].split_once(quote)?;
        if key.trim() == name {
            return Some(value);
        }
        rest = behind;
    }
}

/// The numbers of an array.
fn numbers(tag: &Tag<'_>, binary: &Binary) -> Result<Vec<f64>, ReadFault> {
    match attribute(tag, "format") {
        Some("ascii") => {
            let mut numbers = Vec::new();
            let mut words = Words::starting_at(tag.text, tag.line);
            while let Some(word) = words.try_next() {
                numbers.push(super::super::text::number(Some(word), words.line())?);
            }
            Ok(numbers)
        }
        Some("binary") if !binary.compressed => coded(tag, binary),
        Some("binary" | "appended") => Err(ReadFault::UnreadEncoding {
            what: "a VTU file with compressed or appended numbers",
            remedy: "save it as ASCII (in ParaView: Data Mode Ascii)",
        }),
        other => {
            let expected = "the format `ascii` or `binary`";
            Err(unexpected(tag.line, other.unwrap_or(""), expected))
        }
    }
}

/// Numbers as base64 after their length in bytes.
fn coded(tag: &Tag<'_>, binary: &Binary) -> Result<Vec<f64>, ReadFault> {
    let bad = |expected| unexpected(tag.line, tag.text, expected);
    let compact: String = tag.text.split_ascii_whitespace().collect();
    let bytes = base64::decode(&compact).ok_or_else(|| bad("numbers in base64"))?;
    let found = bytes.len() as u64;
    let announced = bytes.get(..binary.header).ok_or(ReadFault::Truncated {
        what: "an array of numbers",
        expected: binary.header as u64,
        found,
    })?;
    let in_order = |bytes: &[u8]| -> [u8; 8] {
        let mut eight = [0; 8];
        for (k, &byte) in bytes.iter().enumerate() {
            let place = if binary.big_endian {
                bytes.len() - 1 - k
            } else {
                k
            };
            eight[place] = byte;
        }
        eight
    };
    let length = u64::from_le_bytes(in_order(announced));
    let content = &bytes[binary.header..];
    if length != content.len() as u64 {
        return Err(ReadFault::Truncated {
            what: "an array of numbers",
            expected: length.saturating_add(binary.header as u64),
            found,
        });
    }
    let kind = attribute(tag, "type").unwrap_or("");
    let size = match kind {
        "Int8" | "UInt8" => 1,
        "Int16" | "UInt16" => 2,
        "Int32" | "UInt32" | "Float32" => 4,
        "Int64" | "UInt64" | "Float64" => 8,
        _ => return Err(unexpected(tag.line, kind, "a type of number")),
    };
    let value = |bytes: &[u8]| {
        let eight = in_order(bytes);
        let whole = u64::from_le_bytes(eight);
        match kind {
            "Float32" => f64::from(f32::from_bits(whole as u32)),
            "Float64" => f64::from_bits(whole),
            "Int8" => f64::from(whole as i8),
            "Int16" => f64::from(whole as i16),
            "Int32" => f64::from(whole as i32),
            "Int64" => whole as i64 as f64,
            _ => whole as f64,
        }
    };
    Ok(content.chunks_exact(size).map(value).collect())
}

/// The same as whole numbers. `f64` holds every index of a mesh that fits into memory.
fn integers(tag: &Tag<'_>, binary: &Binary) -> Result<Vec<i64>, ReadFault> {
    let whole = |number: f64| {
        (number.fract() == 0.0 && number.abs() < 1e15)
            .then_some(number as i64)
            .ok_or_else(|| unexpected(tag.line, &number.to_string(), "a whole number"))
    };
    numbers(tag, binary)?.into_iter().map(whole).collect()
}
