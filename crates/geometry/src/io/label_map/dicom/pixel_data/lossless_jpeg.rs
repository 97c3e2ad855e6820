//! Lossless JPEG with Huffman codes, which DICOM calls process 14 [ITU-T T.81, annexes B, C and H].
//!
//! *How we know*: `dicom::…` on files of DCMTK and of libjpeg-turbo; restart intervals on streams that libjpeg-turbo
//! decodes alike.
//!
//! *Limits*: one component, which labels have.

use super::FrameFormat;

/// The fault of a damaged stream.
type Cause = &'static str;

const TOO_SHORT: Cause = "the JPEG stream ends too early";

/// Codes for the lengths of differences have at most this many bits.
const LONGEST_CODE: usize = 16;

/// Markers of [ITU-T T.81, table B.1], by their second byte.
mod marker {
    pub(super) const LOSSLESS_FRAME: u8 = 0xc3;
    pub(super) const HUFFMAN_TABLES: u8 = 0xc4;
    pub(super) const FIRST_RESTART: u8 = 0xd0;
    pub(super) const START_OF_IMAGE: u8 = 0xd8;
    pub(super) const END_OF_IMAGE: u8 = 0xd9;
    pub(super) const START_OF_SCAN: u8 = 0xda;
    pub(super) const RESTART_INTERVAL: u8 = 0xdd;
}

/// Decompresses one frame; pixels of two bytes are little-endian. Returns how many of the lowest bits of each pixel the
/// stream lacks.
pub(super) fn decode(data: &[u8], format: FrameFormat, pixels: &mut Vec<u8>) -> Result<u32, Cause> {
    let mut rest = data;
    let mut tables: [Option<HuffmanTable>; 4] = [const { None }; 4];
    let mut precision = None;
    let mut restart_interval = 0;
    loop {
        let (kind, segment) = next_segment(&mut rest).ok_or(TOO_SHORT)?;
        match kind {
            marker::LOSSLESS_FRAME => precision = Some(frame_precision(segment, format)?),
            marker::HUFFMAN_TABLES => read_tables(segment, &mut tables)?,
            marker::RESTART_INTERVAL => {
                let interval = number(segment, 0).ok_or(TOO_SHORT)?;
                restart_interval = usize::from(interval);
            }
            marker::START_OF_SCAN => {
                let precision = precision.ok_or("the JPEG stream has no frame header")?;
                let scan = Scan::of(segment, precision, &tables)?;
                scan.decode(rest, restart_interval, format, pixels)?;
                return Ok(scan.point_transform);
            }
            marker::END_OF_IMAGE => return Err("the JPEG stream has no scan"),
            // The other kinds of frames; between them are 0xc8, which is reserved, and 0xcc, of arithmetic coding.
            0xc0..=0xcf => return Err("the JPEG stream is not lossless with Huffman codes"),
            _ => {}
        }
    }
}

/// The next marker and what follows it up to the next one, or the compressed data.
fn next_segment<'d>(rest: &mut &'d [u8]) -> Option<(u8, &'d [u8])> {
    let (&0xff, mut after) = rest.split_first()? else {
        return None;
    };
    // Any number of 0xff may come before a marker.
    while let [0xff, more @ ..] = after {
        after = more;
    }
    let (&kind, after) = after.split_first()?;
    if matches!(kind, marker::START_OF_IMAGE | marker::END_OF_IMAGE) {
        *rest = after;
        return Some((kind, &[]));
    }
    let length = usize::from(number(after, 0)?);
    let segment = after.get(2..length)?;
    *rest = &after[length..];
    Some((kind, segment))
}

/// Two bytes, the high one first.
fn number(bytes: &[u8], at: usize) -> Option<u16> {
    let two = bytes.get(at..at + 2)?;
    Some(u16::from_be_bytes([two[0], two[1]]))
}

/// Bits of a sample, by the frame header [ITU-T T.81, B.2.2].
fn frame_precision(segment: &[u8], format: FrameFormat) -> Result<u32, Cause> {
    let &[precision, _, _, _, _, components, ..] = segment else {
        return Err(TOO_SHORT);
    };
    let [rows, columns] = [1, 3].map(|at| number(segment, at).map(usize::from));
    if (columns, rows) != (Some(format.columns), Some(format.rows)) {
        return Err("the JPEG stream has another size than the DICOM header");
    }
    if components != 1 {
        return Err("the JPEG stream has several components");
    }
    match precision {
        2..=16 => Ok(u32::from(precision)),
        _ => Err("the JPEG stream states an impossible precision"),
    }
}

fn read_tables(mut segment: &[u8], tables: &mut [Option<HuffmanTable>; 4]) -> Result<(), Cause> {
    while let Some((&kind, rest)) = segment.split_first() {
        let (counts, rest) = rest.split_first_chunk().ok_or(TOO_SHORT)?;
        let total = counts.iter().map(|&count| usize::from(count)).sum();
        let (values, rest) = rest.split_at_checked(total).ok_or(TOO_SHORT)?;
        // The others are for lossy frames.
        if let Some(table) = tables.get_mut(usize::from(kind)) {
            *table = Some(HuffmanTable::of(counts, values)?);
        }
        segment = rest;
    }
    Ok(())
}

/// Codes in order: first by length, then by their bits [ITU-T T.81, annex C and F.2.2.3].
struct HuffmanTable {
    /// One more than the last code of each length.
    ends: [i32; LONGEST_CODE],
    /// Place of a value, less its code, by length.
    shifts: [i32; LONGEST_CODE],
    values: Vec<u8>,
}

impl HuffmanTable {
    fn of(counts: &[u8; LONGEST_CODE], values: &[u8]) -> Result<Self, Cause> {
        let (mut ends, mut shifts) = ([0; LONGEST_CODE], [0; LONGEST_CODE]);
        let (mut code, mut place) = (0, 0);
        for (length, &count) in counts.iter().enumerate() {
            code <<= 1;
            shifts[length] = place - code;
            code += i32::from(count);
            place += i32::from(count);
            ends[length] = code;
            if code > 2 << length {
                return Err("the JPEG stream has an impossible Huffman table");
            }
        }
        Ok(Self {
            ends,
            shifts,
            values: values.to_vec(),
        })
    }

    fn value(&self, bits: &mut Bits<'_>) -> Option<u8> {
        let mut code = 0;
        for (end, shift) in self.ends.iter().zip(self.shifts) {
            code = code << 1 | bits.take(1)? as i32;
            if code < *end {
                let place = usize::try_from(code + shift).ok()?;
                return self.values.get(place).copied();
            }
        }
        None
    }

    /// The next difference between a sample and its prediction [ITU-T T.81, H.1.2.2].
    fn difference(&self, bits: &mut Bits<'_>) -> Option<i32> {
        match u32::from(self.value(bits)?) {
            length @ 0..=15 => {
                let found = bits.take(length)? as i32;
                // Negative differences have a first bit of zero.
                let is_negative = length > 0 && found >> (length - 1) == 0;
                Some(found - if is_negative { (1 << length) - 1 } else { 0 })
            }
            16 => Some(1 << 15),
            _ => None,
        }
    }
}

/// The compressed data, bit by bit.
struct Bits<'d> {
    rest: &'d [u8],
    /// Bits that were taken from `rest` and are still unused, as the lowest.
    buffer: u64,
    count: u32,
}

impl Bits<'_> {
    /// At most 16 bits; none where a marker comes before they are complete.
    fn take(&mut self, length: u32) -> Option<u32> {
        while self.count < length {
            let (byte, rest) = match self.rest {
                // After 0xff, data have a zero that does not count.
                [0xff, 0x00, rest @ ..] => (0xff, rest),
                [0xff, ..] | [] => return None,
                [byte, rest @ ..] => (*byte, rest),
            };
            self.rest = rest;
            self.buffer = self.buffer << 8 | u64::from(byte);
            self.count += 8;
        }
        self.count -= length;
        let taken = self.buffer >> self.count;
        self.buffer &= (1 << self.count) - 1;
        Some(taken as u32)
    }

    /// Passes the restart marker of this number.
    fn restart(&mut self, number: usize) -> Option<()> {
        (self.buffer, self.count) = (0, 0);
        while let [0xff, 0xff, ..] = self.rest {
            self.rest = &self.rest[1..];
        }
        let expected = marker::FIRST_RESTART + (number % 8) as u8;
        match self.rest {
            [0xff, found, rest @ ..] if *found == expected => self.rest = rest,
            _ => return None,
        }
        Some(())
    }
}

/// How samples are predicted and coded [ITU-T T.81, B.2.3 and H.1.2.1].
struct Scan<'t> {
    table: &'t HuffmanTable,
    /// From 1 to 7.
    predictor: u8,
    /// Lowest bits that were left out.
    point_transform: u32,
    /// Of the first sample.
    first_prediction: i32,
}

impl<'t> Scan<'t> {
    fn of(
        segment: &[u8],
        precision: u32,
        tables: &'t [Option<HuffmanTable>; 4],
    ) -> Result<Self, Cause> {
        let &[components, _, table, predictor, _, transform, ..] = segment else {
            return Err(TOO_SHORT);
        };
        let point_transform = u32::from(transform & 15);
        let table = tables.get(usize::from(table >> 4)).and_then(Option::as_ref);
        match (components, predictor) {
            (1, 1..=7) if point_transform < precision => Ok(Self {
                table: table.ok_or("the JPEG stream lacks a Huffman table")?,
                predictor,
                point_transform,
                first_prediction: 1 << (precision - point_transform - 1),
            }),
            _ => Err("the JPEG stream has an impossible scan header"),
        }
    }

    fn decode(
        &self,
        data: &[u8],
        restart_interval: usize,
        format: FrameFormat,
        pixels: &mut Vec<u8>,
    ) -> Result<(), Cause> {
        let columns = format.columns;
        // A code has at least one bit: no more memory than the data justify.
        if data.len().saturating_mul(8) < format.pixels() {
            return Err(TOO_SHORT);
        }
        if !restart_interval.is_multiple_of(columns) {
            return Err("the JPEG stream restarts within a row");
        }
        let mut bits = Bits {
            rest: data,
            buffer: 0,
            count: 0,
        };
        let (mut above, mut row) = (vec![0; columns], vec![0; columns]);
        for number in 0..format.rows {
            let restarts = restart_interval > 0 && number > 0;
            let restarts = restarts && (number * columns).is_multiple_of(restart_interval);
            if restarts {
                let passed = number * columns / restart_interval - 1;
                let found = bits.restart(passed);
                found.ok_or("the JPEG stream lacks a restart marker")?;
            }
            for column in 0..columns {
                let prediction = match (number == 0 || restarts, column) {
                    (true, 0) => self.first_prediction,
                    (true, _) => row[column - 1],
                    (false, 0) => above[0],
                    (false, _) => self.predict(row[column - 1], above[column], above[column - 1]),
                };
                let difference = self.table.difference(&mut bits);
                let difference =
                    difference.ok_or("the JPEG stream ends too early, or has an unknown code")?;
                row[column] = (prediction + difference) & 0xffff;
                let sample = row[column] << self.point_transform;
                let bytes = (sample as u16).to_le_bytes();
                if sample >> (8 * format.width()) != 0 {
                    return Err("a pixel has more bits than the DICOM header states");
                }
                pixels.extend_from_slice(&bytes[..format.width()]);
            }
            std::mem::swap(&mut above, &mut row);
        }
        Ok(())
    }

    /// From the samples to the left, above, and above to the left.
    fn predict(&self, left: i32, above: i32, corner: i32) -> i32 {
        match self.predictor {
            1 => left,
            2 => above,
            3 => corner,
            4 => left + above - corner,
            5 => left + ((above - corner) >> 1),
            6 => above + ((left - corner) >> 1),
            _ => (left + above) >> 1,
        }
    }
}
