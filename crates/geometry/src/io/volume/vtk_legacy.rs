use super::super::text::unexpected;
use super::cells::CellLists;
use super::words::{Lines, Words};
use super::{REGION_ARRAYS, RawVolume};
use crate::ReadFault;

pub(super) fn read(text: &str) -> Result<RawVolume, ReadFault> {
    let mut lines = Lines::new(text);
    let (line, first) = lines.next("`# vtk DataFile Version`")?;
    if !first.starts_with("# vtk DataFile") {
        return Err(unexpected(line, first, "`# vtk DataFile Version`"));
    }
    // The title is free, and empty more often than not.
    let mut encoding = lines.next("`ASCII`")?;
    if !["ASCII", "BINARY"].contains(&encoding.1) {
        encoding = lines.next("`ASCII`")?;
    }
    match encoding.1 {
        "ASCII" => {}
        "BINARY" => {
            return Err(ReadFault::UnreadEncoding {
                what: "a binary VTK file",
                remedy: "save it as ASCII (in ParaView: File Type Ascii)",
            });
        }
        found => return Err(unexpected(encoding.0, found, "`ASCII`")),
    }
    let (line, data) = lines.next("`DATASET UNSTRUCTURED_GRID`")?;
    if data
        .split_ascii_whitespace()
        .ne(["DATASET", "UNSTRUCTURED_GRID"])
    {
        return Err(unexpected(line, data, "`DATASET UNSTRUCTURED_GRID`"));
    }
    read_grid(&mut lines.into_words())
}

fn read_grid(words: &mut Words<'_>) -> Result<RawVolume, ReadFault> {
    let mut volume = RawVolume::default();
    let mut cells = CellLists::default();
    // Other words belong to parts that are passed over: METADATA, FIELD and what they hold.
    while let Some(word) = words.try_next() {
        match word {
            "POINTS" => {
                let count = words.count("a number of points")?;
                words.next("a type of number")?;
                for _ in 0..count {
                    volume.points.add_vertex(words.point()?)?;
                }
            }
            "CELLS" => read_cells(words, &mut cells)?,
            "CELL_TYPES" => {
                for _ in 0..words.count("a number of cells")? {
                    cells.kinds.push(words.integer("a type of cell")?);
                }
            }
            "CELL_DATA" => {
                read_regions(words, &mut cells)?;
                break;
            }
            _ => {}
        }
    }
    cells.sort_out(&mut volume)?;
    Ok(volume)
}

/// `SCALARS name type` and a number for each cell, or a field `name 1 n type` among others; the rest is passed over.
fn read_regions(words: &mut Words<'_>, cells: &mut CellLists) -> Result<(), ReadFault> {
    let mut rank = REGION_ARRAYS.len();
    while let Some(word) = words.try_next() {
        let (name, is_scalars) = match word {
            "SCALARS" => (words.next("the name of an array")?, true),
            name => (name, false),
        };
        let Some(place) = REGION_ARRAYS
            .iter()
            .position(|known| known.eq_ignore_ascii_case(name))
        else {
            continue;
        };
        if is_scalars {
            words.next("a type of number")?;
            let mut word = words.next("`LOOKUP_TABLE`")?;
            if word == "1" {
                word = words.next("`LOOKUP_TABLE`")?;
            }
            if word != "LOOKUP_TABLE" {
                return Err(unexpected(words.line(), word, "`LOOKUP_TABLE`"));
            }
            words.next("the name of a table")?;
        } else {
            let components = words.count("a number of components")?;
            let count = words.count("a number of cells")?;
            words.next("a type of number")?;
            if components != 1 || count != cells.kinds.len() {
                return Err(ReadFault::Mismatch {
                    what: "regions of cells",
                    found: components * count,
                    expected: cells.kinds.len(),
                });
            }
        }
        let mut numbers = Vec::with_capacity(cells.kinds.len());
        for _ in 0..cells.kinds.len() {
            numbers.push(words.next("the number of a region")?);
        }
        let whole = numbers.iter().map(|word| word.parse().ok());
        // An array that is called so and does not number anything is not of regions.
        if let Some(regions) = whole.collect::<Option<_>>()
            && place < rank
        {
            (rank, cells.regions) = (place, regions);
        }
    }
    Ok(())
}

/// `CELLS n size` and n lists after their lengths; since version 5 all ends, from zero, and all
/// nodes.
fn read_cells(words: &mut Words<'_>, cells: &mut CellLists) -> Result<(), ReadFault> {
    let count = words.count("a number of cells")?;
    let size = words.count("a number of values")?;
    if count == 0 {
        return Ok(());
    }
    let first = words.next("a length or `OFFSETS`")?;
    if first == "OFFSETS" {
        words.next("a type of number")?;
        for k in 0..count {
            let end = words.integer("an offset")?;
            if k > 0 {
                cells.ends.push(end);
            }
        }
        let word = words.next("`CONNECTIVITY`")?;
        if word != "CONNECTIVITY" {
            return Err(unexpected(words.line(), word, "`CONNECTIVITY`"));
        }
        words.next("a type of number")?;
        for _ in 0..size {
            cells.nodes.push(words.integer("a node")?);
        }
        return Ok(());
    }
    let mut length = super::words::count(Some(first), words.line(), "a length or `OFFSETS`")?;
    for k in 0..count {
        if k > 0 {
            length = words.count("a length")?;
        }
        for _ in 0..length {
            cells.nodes.push(words.integer("a node")?);
        }
        cells.ends.push(cells.nodes.len() as i64);
    }
    Ok(())
}
