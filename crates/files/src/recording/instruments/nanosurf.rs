//! Force curves of Nanosurf (`.nid`): a header of sections `[name]` with lines `key=value`, the mark `#!`, and the numbers of
//! all channels one after another, in the order in which `[DataSet]` lists them.
//!
//! A whole number n of b bits is (n + 2ᵇ⁻¹)/2ᵇ of the channel's range above its least value. A channel has a line for each
//! place of a map; those of the way back are written from the end to the beginning. Samples are even in the time that the
//! header states for a line without a trigger.
//!
//! *How we know*: `microscopes::nanosurf_…`, and a map of 100 curves against the vendor's own reader
//! (`docs/comparisons/recordings.md`).
//!
//! *Limits*: images and spectra in the same file are passed over.

use std::collections::BTreeMap;

use super::nanosurf_places::Places;
use super::properties::number;
use super::{Curve, InstrumentFile, MAX_SAMPLES};
use crate::quantity::plain_quantity;
use crate::recording::{Recording, RecordingHeader};
use crate::{Domain, Error};

const BEGINNING: &[u8] = b"[DataSet]";
const MARK: &[u8] = b"#!";
/// Channels of a group, and groups, at most.
const MOST: usize = 256;

/// The parts of a curve in their order: the name of the frame, the keys of its duration and of its points, and whether it is
/// written from its end.
const FRAMES: [(&str, &str, &str, bool); 4] = [
    ("Spec forward", "FwModTime", "FwModDatapoints", false),
    ("Spec fwd pause", "FwPauseTime", "FwPauseDatapoints", false),
    ("Spec backward", "BwModTime", "BwModDatapoints", true),
    ("Spec bwd pause", "BwPauseTime", "BwPauseDatapoints", false),
];
/// Channels of the base's position, the best first.
const POSITIONS: [&str; 3] = ["Z-Axis Sensor", "Z-AxisSensor", "Z-Axis"];
const DEFLECTION: &str = "Deflection";

/// Whether a file is one of Nanosurf.
pub(super) fn is_nid(bytes: &[u8]) -> bool {
    bytes.starts_with(BEGINNING)
}

/// Lines of a section by their keys.
type Section<'t> = BTreeMap<&'t str, &'t str>;

/// The header's sections, by their names.
pub(super) struct Header<'t>(BTreeMap<&'t str, Section<'t>>);

impl<'t> Header<'t> {
    fn parse(text: &'t str) -> Self {
        let mut sections: BTreeMap<&str, Section<'_>> = BTreeMap::new();
        let mut name = "";
        for line in text.lines().map(str::trim_end) {
            let title = line.strip_prefix('[').and_then(|own| own.strip_suffix(']'));
            if let Some(title) = title {
                name = title;
            } else if let Some((key, value)) = line.split_once('=') {
                sections.entry(name).or_default().insert(key, value);
            }
        }
        Self(sections)
    }

    pub(super) fn get(&self, section: &str, key: &str) -> Option<&'t str> {
        self.0.get(section)?.get(key).copied()
    }

    /// A number as in `D[2.72]*[N/m]`.
    fn quantity(&self, section: &str, key: &str) -> Option<f64> {
        let (value, _) = self.get(section, key)?.split_once("]*[")?;
        number(value.split_once('[')?.1)
    }
}

/// A channel of a frame.
struct Channel<'b> {
    frame: &'b str,
    name: &'b str,
    unit: &'b str,
    least: f64,
    range: f64,
    /// Points of each line, of which the first are its own.
    points: usize,
    own_points: Vec<usize>,
    bytes_of_number: usize,
    bytes: &'b [u8],
}

impl Channel<'_> {
    /// The numbers of a line.
    fn line(&self, line: usize) -> Option<Vec<f64>> {
        let own = *self.own_points.get(line)?;
        let from = line * self.points * self.bytes_of_number;
        let bytes = self.bytes.get(from..)?.get(..own * self.bytes_of_number)?;
        let scaled = |share: f64| self.least + self.range * share;
        Some(match self.bytes_of_number {
            2 => {
                let each = bytes.as_chunks().0.iter();
                let share =
                    each.map(|own| (f64::from(i16::from_le_bytes(*own)) + 32_768.0) / 65_536.0);
                share.map(scaled).collect()
            }
            _ => {
                let each = bytes.as_chunks().0.iter();
                let half = f64::from(1u32 << 31);
                let share =
                    each.map(|own| (f64::from(i32::from_le_bytes(*own)) + half) / (2.0 * half));
                share.map(scaled).collect()
            }
        })
    }
}

/// All curves of a file.
pub(super) fn read(file: &InstrumentFile<'_>) -> Result<Vec<Recording>, Error> {
    let damaged = |cause| file.damaged("the file of Nanosurf", cause);
    let end = file.bytes.windows(2).position(|own| own == MARK);
    let end =
        end.ok_or_else(|| damaged("is cut short: the mark `#!` after its header is missing"))?;
    let text: String = file.bytes[..end].iter().map(|&byte| byte as char).collect();
    let header = Header::parse(&text);
    let channels = channels(&header, &file.bytes[end + MARK.len()..]).map_err(damaged)?;
    let lines = channels.iter().filter(|own| own.frame == FRAMES[0].0);
    let lines = lines.map(|own| own.own_points.len()).min();
    let lines = lines.ok_or_else(|| {
        damaged("has no force curves (frame `Spec forward`); images and spectra are no recordings")
    })?;
    let curves = Curves {
        file,
        header: &header,
        channels: &channels,
        is_map: lines > 1,
        places: Places::of(&header, lines),
    };
    let (mut all, mut samples) = (Vec::new(), 0);
    for line in 0..lines {
        let recording = curves.curve(line)?;
        samples += recording.time_s().len();
        if samples > MAX_SAMPLES {
            return Err(damaged(
                "has more than 33,554,432 samples; save fewer curves in a file",
            ));
        }
        all.push(recording);
    }
    Ok(all)
}

/// All channels in the order of their numbers.
fn channels<'b>(
    header: &Header<'b>,
    mut bytes: &'b [u8],
) -> Result<Vec<Channel<'b>>, &'static str> {
    let count = |section: &str, key: &str| -> Option<usize> {
        header.get(section, key)?.trim().parse().ok()
    };
    let groups = count("DataSet", "GroupCount").filter(|groups| *groups <= MOST);
    let groups = groups.ok_or("does not state its groups of channels (GroupCount)")?;
    let mut channels = Vec::new();
    for group in 0..groups {
        let most = count("DataSet", &format!("Gr{group}-Count")).unwrap_or(0);
        for place in 0..most.min(MOST) {
            let Some(section) = header.get("DataSet", &format!("Gr{group}-Ch{place}")) else {
                continue;
            };
            let own = |key| header.get(section, key);
            let is_known = own("SaveMode").is_none_or(|mode| mode == "Binary")
                && own("SaveSign").is_none_or(|sign| sign == "Signed")
                && own("SaveOrder").is_none_or(|order| order == "Intel");
            let bytes_of_number = match own("SaveBits") {
                Some("16") if is_known => 2,
                Some("32") if is_known => 4,
                _ => {
                    return Err(
                        "has numbers that are not signed, of 16 or 32 bits, the least byte first",
                    );
                }
            };
            let shape = count(section, "Points").zip(count(section, "Lines"));
            let (points, lines) =
                shape.ok_or("does not state the points and lines of a channel")?;
            let size = points
                .checked_mul(lines)
                .and_then(|own| own.checked_mul(bytes_of_number));
            let split = size.and_then(|size| bytes.split_at_checked(size));
            let (mine, rest) =
                split.ok_or("is cut short: it has fewer numbers than its header states")?;
            bytes = rest;
            let scale = |key| own(key).and_then(number);
            let points_of = |line: usize| {
                let own = count(section, &format!("LineDim{line}Points"));
                own.unwrap_or(points).min(points)
            };
            // A line for each number that is there.
            let lines = if points == 0 { 0 } else { lines };
            channels.push(Channel {
                frame: own("Frame").unwrap_or_default(),
                name: own("Dim2Name").unwrap_or_default(),
                unit: own("Dim2Unit").unwrap_or_default(),
                least: scale("Dim2Min").ok_or("does not state the least value of a channel")?,
                range: scale("Dim2Range").ok_or("does not state the range of a channel")?,
                points,
                own_points: (0..lines).map(points_of).collect(),
                bytes_of_number,
                bytes: mine,
            });
        }
    }
    match bytes.is_empty() {
        true => Ok(channels),
        false => Err("has more numbers than its header states"),
    }
}

/// Data that all curves of a file share.
struct Curves<'f> {
    file: &'f InstrumentFile<'f>,
    header: &'f Header<'f>,
    channels: &'f [Channel<'f>],
    is_map: bool,
    places: Places,
}

const PARAMETERS: &str = "DataSet\\Parameters\\Spectroscopy";

impl Curves<'_> {
    fn channel(&self, frame: &str, name: &str) -> Option<&Channel<'_>> {
        let mut own = self.channels.iter();
        own.find(|own| own.frame == frame && own.name == name)
    }

    /// The channel of the base's position.
    fn position(&self) -> Result<&str, Error> {
        let is_there = |name: &&str| {
            self.channel(FRAMES[0].0, name)
                .is_some_and(|own| own.unit == "m")
        };
        let found = match self.file.columns.depth.as_deref() {
            Some(name) => Some(name).filter(is_there),
            None => POSITIONS.into_iter().find(|name| is_there(name)),
        };
        found.ok_or_else(|| {
            let cause = "is not there in metres (--depth names another, such as `Z-Axis`)";
            self.file
                .damaged("the channel of the base's position", cause)
        })
    }

    fn spring_constant(&self) -> Result<f64, Error> {
        let noted = self
            .header
            .quantity("DataSet\\Calibration\\Cantilever", "Prop0");
        let known = noted.or(self.file.given.spring_constant_n_per_m);
        known
            .filter(|own| Domain::STIFFNESS.contains(*own))
            .ok_or_else(|| {
                let what = "the spring constant of its cantilever, in newtons per metre";
                self.file.uncalibrated("spring_constant_n_per_m", what)
            })
    }

    fn curve(&self, line: usize) -> Result<Recording, Error> {
        let part = format!("curve {line}");
        let damaged = |cause| self.file.damaged(part.clone(), cause);
        let spring_constant = self.spring_constant()?;
        let position = self.position()?;
        let (mut curve, mut begin) = (Curve::default(), 0.0);
        for (frame, time, points, is_backward) in FRAMES {
            let both = self
                .channel(frame, position)
                .zip(self.channel(frame, DEFLECTION));
            let Some((place, deflection)) = both else {
                continue;
            };
            // To newtons; a force stays what it is.
            let scale = match deflection.unit {
                "N" => 1.0,
                "m" => spring_constant,
                "V" => {
                    let sensitivity = self.file.given.sensitivity_m_per_v.ok_or_else(|| {
                        let what = "the sensitivity of its optical lever, in metres per volt";
                        self.file.uncalibrated("sensitivity_m_per_v", what)
                    })?;
                    spring_constant * sensitivity
                }
                _ => return Err(damaged("has a deflection that is not in N, m or V")),
            };
            let values = place.line(line).zip(deflection.line(line));
            let (mut heights, mut forces) = values.ok_or_else(|| damaged("is cut short"))?;
            if heights.len() != forces.len() {
                return Err(damaged("has more samples in one channel than in another"));
            }
            if is_backward {
                heights.reverse();
                forces.reverse();
            }
            let stated = self
                .header
                .quantity(PARAMETERS, time)
                .zip(self.header.quantity(PARAMETERS, points));
            let step = stated.map(|(time, points)| time / points);
            let step = step.filter(|step| *step > 0.0 && step.is_finite());
            let step = step.ok_or_else(|| damaged("does not state how long it took"))?;
            curve
                .time
                .extend((0..forces.len()).map(|sample| begin + step * sample as f64));
            begin += step * forces.len() as f64;
            curve.height.extend(heights);
            curve.force.extend(forces.iter().map(|own| own * scale));
        }
        // The position grows towards the specimen, by its sign at the end of the way there.
        let there = self
            .channel(FRAMES[0].0, position)
            .and_then(|own| own.line(line));
        let way = there
            .and_then(|own| Some(own.last()? - own.first()?))
            .unwrap_or(0.0);
        if way > 0.0 {
            curve.height.iter_mut().for_each(|own| *own = -*own);
        }
        curve.deflection = curve
            .force
            .iter()
            .map(|own| own / spring_constant)
            .collect();
        let remark = format!(
            "read as a force curve of Nanosurf: position from `{position}`, less the deflection of the cantilever; \
             spring constant {}",
            plain_quantity("_n_per_m", spring_constant, None)
        );
        let mut remarks = vec![remark];
        remarks.extend(self.places.cause().map(|cause| {
            format!(
                "the place of the curve is not known, for the table of places is not used: {cause}"
            )
        }));
        curve.recording(
            self.file,
            &part,
            self.recording_header(line, spring_constant),
            remarks,
        )
    }

    fn recording_header(&self, line: usize, spring_constant: f64) -> RecordingHeader {
        let stem = self.file.path.file_stem().unwrap_or_default();
        let head = self
            .header
            .get("DataSet\\DataSetInfos\\Global", "Head type");
        RecordingHeader {
            site: self
                .is_map
                .then(|| format!("{} {line}", stem.to_string_lossy())),
            position_m: self.places.of_curve(line).map(|[x, y]| [x, y, 0.0]),
            spring_constant_n_per_m: Some(spring_constant),
            sensitivity_m_per_v: self.file.given.sensitivity_m_per_v,
            source: Some(
                format!("Nanosurf {}", head.unwrap_or_default())
                    .trim_end()
                    .to_owned(),
            ),
            ..RecordingHeader::default()
        }
    }
}
