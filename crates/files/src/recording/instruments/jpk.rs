//! Force curves of JPK (Bruker): `.jpk-force`, `.jpk-force-map`, `.jpk-qi-data` and `.jpk-qi-series`, ZIP archives of
//! properties and channels.
//!
//! ```text
//! header.properties               a curve, or the map
//! shared-data/header.properties   what segments share
//! segments/0/…                    a segment of a single curve
//! index/7/segments/0/…            a segment of curve 7 of a map
//! ```
//!
//! *Limits*: the time between two segments is taken as none. No real file with a deflection in floating-point numbers was
//! found; that of a height was.

use std::collections::BTreeSet;

use super::jpk_segment::{Linear, Segment};
use super::properties::Properties;
use super::zip::Archive;
use super::{Curve, InstrumentFile, MAX_SAMPLES};
use crate::recording::{Recording, RecordingHeader};
use crate::{Domain, Error, quantity::plain_quantity};

/// Channels of the height, the best first: sensors measure the commanded motion of the piezo.
const HEIGHTS: [&str; 5] = [
    "measuredHeight",
    "capacitiveSensorHeight",
    "strainGaugeHeight",
    "height",
    "head-height",
];
const DEFLECTION: &str = "vDeflection";

/// Whether a file is a ZIP archive.
pub(super) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

/// All curves of a file.
pub(super) fn read(file: &InstrumentFile<'_>) -> Result<Vec<Recording>, Error> {
    let archive =
        Archive::new(file.bytes).map_err(|cause| file.damaged("the ZIP archive", cause))?;
    let shared = properties(file, &archive, "shared-data/header.properties")?.unwrap_or_default();
    let Some(general) = properties(file, &archive, "header.properties")? else {
        let cause = "has no header.properties, as force curves of JPK have; unpack other archives and name the files in them";
        return Err(file.damaged("the ZIP archive", cause));
    };
    let folders = curves(&archive);
    if folders.is_empty() {
        return Err(file.damaged("the ZIP archive", "has no segments of a force curve"));
    }
    let map = Map {
        file,
        archive: &archive,
        shared: &shared,
        general: &general,
    };
    let mut samples = 0;
    let mut all = Vec::new();
    for folder in folders {
        let recording = map.curve(&folder)?;
        samples += recording.time_s().len();
        if samples > MAX_SAMPLES {
            let cause = "has more than 33,554,432 samples; save fewer curves in a file";
            return Err(file.damaged("the map", cause));
        }
        all.push(recording);
    }
    Ok(all)
}

fn properties(
    file: &InstrumentFile<'_>,
    archive: &Archive<'_>,
    name: &str,
) -> Result<Option<Properties>, Error> {
    let bytes = archive
        .read(name)
        .map_err(|cause| file.damaged(name, cause))?;
    Ok(bytes.map(|bytes| Properties::parse(&bytes)))
}

/// The folders of the curves, in the order of their numbers: an empty name for a single one.
fn curves(archive: &Archive<'_>) -> Vec<String> {
    let mut numbers = BTreeSet::new();
    for name in archive.names() {
        if name.starts_with("segments/0/") {
            return vec![String::new()];
        }
        let number = name.strip_prefix("index/").and_then(|rest| {
            let (number, rest) = rest.split_once('/')?;
            rest.starts_with("segments/0/")
                .then_some(number)?
                .parse::<u32>()
                .ok()
        });
        numbers.extend(number);
    }
    let folder = |number: u32| format!("index/{number}/");
    numbers.into_iter().map(folder).collect()
}

/// A file of one curve or more.
struct Map<'f> {
    file: &'f InstrumentFile<'f>,
    archive: &'f Archive<'f>,
    shared: &'f Properties,
    general: &'f Properties,
}

/// Conversion of a channel's values to deflection and force.
struct Calibration {
    /// Values to metres.
    deflection: Linear,
    /// Newtons per metre.
    spring_constant: f64,
    /// Values to newtons.
    force: Linear,
    /// Metres per volt; none where the values are no volts and the file does not state it.
    sensitivity: Option<f64>,
}

impl Map<'_> {
    fn curve(&self, folder: &str) -> Result<Recording, Error> {
        let segments = self.segments(folder)?;
        let part = |cause| {
            self.file
                .damaged(format!("the curve {folder}segments"), cause)
        };
        let first = segments.first().ok_or_else(|| part("has no samples"))?;
        let height = self.height(&segments)?;
        let slot = first.preferred(height);
        let slot = slot.filter(|slot| first.unit(height, slot) == Some("m"));
        let slot = slot.ok_or_else(|| part("has a height that is not in metres"))?;
        let calibration = self.calibration(first)?;
        let mut curve = Curve::default();
        let mut start = 0.0;
        for segment in &segments {
            let to_height = segment.conversion(height, slot);
            let to_height = to_height.ok_or_else(|| part("has a height that is not calibrated"))?;
            let (heights, values) = (segment.values(height)?, segment.values(DEFLECTION)?);
            let duration = segment.duration();
            let duration =
                duration.ok_or_else(|| part("does not state how long a segment took"))?;
            if heights.len() != values.len() {
                return Err(part("has more samples in one channel than in another"));
            }
            let step = duration / values.len().max(1) as f64;
            let times = (0..values.len()).map(|sample| start + step * sample as f64);
            curve.time.extend(times);
            curve.height.extend(to_height.of(&heights));
            curve.deflection.extend(calibration.deflection.of(&values));
            curve.force.extend(calibration.force.of(&values));
            start += duration;
            if curve.time.len() > MAX_SAMPLES {
                return Err(part("has more than 33,554,432 samples"));
            }
        }
        let mut remarks = vec![self.remark(&segments, height, &calibration)];
        if is_upside_down(&curve) {
            for value in curve.deflection.iter_mut().chain(&mut curve.force) {
                *value = -*value;
            }
            remarks.push(
                "the deflection fell as the tissue was pressed, so its sign was turned".to_owned(),
            );
        }
        let header = self.header(folder, first, &calibration);
        curve.recording(
            self.file,
            &format!("the curve {folder}segments"),
            header,
            remarks,
        )
    }

    fn segments(&self, folder: &str) -> Result<Vec<Segment<'_>>, Error> {
        let mut segments = Vec::new();
        loop {
            let folder = format!("{folder}segments/{}/", segments.len());
            let name = format!("{folder}segment-header.properties");
            let Some(own) = properties(self.file, self.archive, &name)? else {
                break;
            };
            segments.push(Segment {
                file: self.file,
                archive: self.archive,
                shared: self.shared,
                own,
                folder,
            });
        }
        segments.retain(|segment| segment.has_channel(DEFLECTION));
        Ok(segments)
    }

    /// The channel of the height, in all segments.
    fn height(&self, segments: &[Segment<'_>]) -> Result<&str, Error> {
        let everywhere = |name: &str| segments.iter().all(|segment| segment.has_channel(name));
        if let Some(named) = self.file.columns.depth.as_deref() {
            return match everywhere(named) {
                true => Ok(named),
                false => Err(self.file.damaged(
                    format!("the channel {named}"),
                    "is not in all segments; name another height",
                )),
            };
        }
        let known = HEIGHTS.into_iter().find(|name| everywhere(name));
        known.ok_or_else(|| {
            self.file
                .damaged("the curve", "has no height in all segments")
        })
    }

    fn calibration(&self, segment: &Segment<'_>) -> Result<Calibration, Error> {
        let given = self.file.given;
        let base = segment.base(DEFLECTION);
        let uncalibrated_spring = || {
            let what = "the spring constant of its cantilever, in newtons per metre";
            self.file.uncalibrated("spring_constant_n_per_m", what)
        };
        let stated = segment.last_step(DEFLECTION, "distance");
        let stated = stated.filter(|(of, _)| *of == "volts");
        let sensitivity = stated
            .map(|(_, own)| own.multiplier)
            .or(given.sensitivity_m_per_v);
        if base == Some("force") {
            let stated = segment.last_step(DEFLECTION, "force");
            let stated = stated.filter(|(of, _)| *of == "distance");
            let stiffness = stated.map(|(_, own)| own).or_else(|| {
                let multiplier = given.spring_constant_n_per_m?;
                Some(Linear {
                    multiplier,
                    ..Linear::SAME
                })
            });
            let stiffness = stiffness
                .filter(|own| Domain::STIFFNESS.contains(own.multiplier))
                .ok_or_else(uncalibrated_spring)?;
            return Ok(Calibration {
                deflection: stiffness.inverse().ok_or_else(uncalibrated_spring)?,
                spring_constant: stiffness.multiplier,
                force: Linear::SAME,
                sensitivity,
            });
        }
        let distance = segment.conversion(DEFLECTION, "distance");
        let force = segment.conversion(DEFLECTION, "force");
        let multiplier = distance
            .map(|own| own.multiplier)
            .or(given.sensitivity_m_per_v);
        let multiplier = multiplier.filter(|own| *own != 0.0).ok_or_else(|| {
            let what = "the sensitivity of its optical lever, in metres per volt";
            self.file.uncalibrated("sensitivity_m_per_v", what)
        })?;
        let deflection = distance.unwrap_or(Linear {
            multiplier,
            ..Linear::SAME
        });
        let known = force.map(|force| force.multiplier / multiplier);
        let spring_constant = known
            .or(given.spring_constant_n_per_m)
            .filter(|own| Domain::STIFFNESS.contains(*own))
            .ok_or_else(uncalibrated_spring)?;
        Ok(Calibration {
            force: force.unwrap_or(Linear {
                offset: spring_constant * deflection.offset,
                multiplier: spring_constant * deflection.multiplier,
            }),
            sensitivity: match base {
                Some("distance") => sensitivity,
                _ => Some(multiplier),
            },
            deflection,
            spring_constant,
        })
    }

    fn remark(&self, segments: &[Segment<'_>], height: &str, calibration: &Calibration) -> String {
        let each = segments.iter().map(|segment| {
            let duration = segment.duration().unwrap_or(0.0);
            format!(
                "{} {}",
                segment.style(),
                plain_quantity("_s", duration, None)
            )
        });
        let base = segments.first().and_then(|own| own.base(DEFLECTION));
        let by = match base {
            Some("distance") => "in metres, by".to_owned(),
            Some("force") => "in newtons, deflection by".to_owned(),
            _ => {
                let metres = plain_quantity("_m", calibration.deflection.multiplier, None);
                format!("by {metres} per volt and")
            }
        };
        format!(
            "read as a force curve of JPK: height from `{height}`, less the deflection of the cantilever; force from `{DEFLECTION}` \
             {by} {}; segments {}",
            plain_quantity("_n_per_m", calibration.spring_constant, None),
            each.collect::<Vec<_>>().join(", ")
        )
    }

    fn header(
        &self,
        folder: &str,
        first: &Segment<'_>,
        calibration: &Calibration,
    ) -> RecordingHeader {
        let describes = |key: &str| {
            let of = |kind: &str| self.general.get(&format!("{kind}.description.{key}"));
            let kinds = [
                "force-scan-series",
                "force-scan-map",
                "quantitative-imaging-map",
                "quantitative-imaging-series",
            ];
            kinds.into_iter().find_map(of).filter(|own| !own.is_empty())
        };
        let source = [describes("instrument"), describes("source-software")];
        let source: Vec<&str> = source.into_iter().flatten().collect();
        // Curves of a map are of as many places.
        let number = folder.trim_start_matches("index/").trim_end_matches('/');
        let site = (!number.is_empty()).then(|| {
            let stem = self.file.path.file_stem().unwrap_or_default();
            format!("{} {number}", stem.to_string_lossy())
        });
        let position = first
            .position()
            .filter(|xy| xy.iter().all(|own| Domain::COORDINATE.contains(*own)));
        RecordingHeader {
            site,
            position_m: position.map(|[x, y]| [x, y, 0.0]),
            spring_constant_n_per_m: Some(calibration.spring_constant),
            sensitivity_m_per_v: calibration
                .sensitivity
                .filter(|own| Domain::SENSITIVITY.contains(*own)),
            source: (!source.is_empty()).then(|| source.join(", ")),
            ..RecordingHeader::default()
        }
    }
}

/// Whether the deflection falls where the base is lowest: a sign that differs between instruments.
fn is_upside_down(curve: &Curve) -> bool {
    let lowest = curve.height.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = curve
        .height
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let mean_near = |height: f64| {
        let near = curve.height.iter().zip(&curve.deflection);
        let near = near.filter(|(z, _)| (**z - height).abs() <= NEAR * (highest - lowest));
        let (sum, count) = near.fold((0.0, 0.0), |(sum, count), (_, d)| (sum + d, count + 1.0));
        sum / count
    };
    mean_near(lowest) < mean_near(highest)
}

/// Tolerance of the lowest or highest position of the base [-].
const NEAR: f64 = 0.02;
