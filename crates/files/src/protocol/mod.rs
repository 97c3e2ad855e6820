//! The protocol of an experiment: specimens, stimuli, and the rig's limits and speeds.

mod place;
mod rig;
mod sensor;
mod serial_line;
mod specimen;
mod stimulus;

use std::path::Path;

pub use place::{MeasuredPlace, VirtualSurface};
pub use rig::{Gains, RigDevice, RigLimits};
pub use sensor::{Counts, SensorKind, SensorPlan, SensorSource, Voltages};
pub use serial_line::{SerialField, SerialLine, SerialSeparator};
pub use specimen::{Measured, MeasuredTissue, PublishedOrgan};
pub use stimulus::{Stimulus, StimulusPlan, Sweep};

use crate::atomic_write::{MAX_DOCUMENT_BYTES, read_text};
use crate::{Document, Error, Key};

/// A protocol: every stimulus on every specimen. Keys that the file leaves out have their defaults here.
#[derive(Debug, Clone, PartialEq)]
pub struct Protocol {
    /// The rig's limits and speeds.
    pub rig: RigLimits,
    /// The force sensor.
    pub sensor: SensorPlan,
    /// The specimens: one or more.
    pub specimens: Vec<Measured>,
    /// The stimuli on each specimen: one or more.
    pub stimuli: Vec<StimulusPlan>,
    /// Warnings about its numbers, as sentences.
    pub warnings: Vec<String>,
}

impl Protocol {
    /// The keys of a protocol, without `format`.
    pub const KEYS: &'static [Key] = &[
        Key::table("rig", RigLimits::KEYS, "How the rig goes about it.")
            .optional("", "the rig's own settings"),
        Key::table("sensor", SensorPlan::KEYS, "What measures the force.")
            .optional("", "the virtual sensor"),
        Key::tables(
            "specimen",
            Measured::KEYS,
            "What is measured; every stimulus is done to each.",
        )
        .required(""),
        Key::tables(
            "stimulus",
            StimulusPlan::KEYS,
            "The stimuli of each specimen.",
        )
        .required(""),
    ];

    /// Reads a protocol file.
    ///
    /// # Errors
    /// When the file cannot be read or does not describe a protocol.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_DOCUMENT_BYTES)?, path)
    }

    /// Reads the text of a protocol file; `path` is its name in errors, and relative paths in it begin in its
    /// folder.
    ///
    /// # Errors
    /// When the text does not describe a protocol.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let folder = path.parent().unwrap_or(Path::new(""));
        let document = Document::parse(text, path)?;
        let keys = document.keys(Self::KEYS)?;
        let specimens = keys.tables("specimen")?;
        let stimuli = keys.tables("stimulus")?;
        if specimens.is_empty() {
            return Err(keys.missing("specimen", "a table `[[specimen]]` for each specimen"));
        }
        if stimuli.is_empty() {
            return Err(keys.missing("stimulus", "a table `[[stimulus]]` for each stimulus"));
        }
        let mut plans = Vec::new();
        for keys in &stimuli {
            plans.extend(StimulusPlan::from_keys(keys)?);
        }
        let rig = RigLimits::from_keys(keys.table("rig")?.as_ref())?;
        let sensor = keys.table("sensor")?;
        let sensor_plan = SensorPlan::from_keys(sensor.as_ref())?;
        let is_virtual = sensor_plan.source == SensorSource::Virtual;
        if let Some(sensor) = sensor.filter(|_| !is_virtual && rig.has_virtual_device()) {
            return Err(sensor.invalid(
                "kind",
                "\"virtual\", or a device in [rig] that presses what this sensor feels: a virtual one cannot",
            ));
        }
        let specimen = |keys| match is_virtual {
            true => Measured::from_keys(keys, folder),
            false => Measured::real_from_keys(keys),
        };
        Ok(Self {
            rig,
            sensor: sensor_plan,
            specimens: specimens.iter().map(specimen).collect::<Result<_, _>>()?,
            stimuli: plans,
            warnings: keys.warnings(),
        })
    }
}
