use std::ops::Bound::Included;

use super::serial_line::{SerialLine, SerialSeparator};
use crate::words::words;
use crate::{Domain, Error, Key, Keys};

words! {
    /// What measures the force.
    pub enum SensorKind {
        /// The source's sensor on a virtual specimen.
        Virtual = "virtual",
        /// Strain gauges at a data acquisition device of National Instruments.
        NiDaq = "ni_daq",
        /// An ATI Net F/T, or a sensor that speaks its protocol.
        NetFt = "net_ft",
        /// Lines of text on a serial line.
        Serial = "serial",
    }
}

/// The force sensor between the device and the indenter. None is the rig's own default.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorPlan {
    /// The source of readings, and the meaning of its numbers.
    pub source: SensorSource,
    /// From the sensor's origin to the tip [m].
    pub tip_distance_m: Option<f64>,
    /// The indenter's x, y and z in the sensor's axes [-]: the rows of a rotation of right angles.
    pub axes: [[f64; 3]; 3],
    /// The largest force on each of the sensor's axes [N].
    pub range_n: Option<[f64; 3]>,
    /// The largest torque about each of the sensor's axes [N m].
    pub range_n_m: Option<[f64; 3]>,
    /// The timeout of a reading [s].
    pub timeout_s: Option<f64>,
}

/// The source of readings.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorSource {
    /// A virtual specimen.
    Virtual,
    /// Voltages.
    NiDaq(Box<Voltages>),
    /// Packets of counts.
    NetFt(Counts),
    /// Lines of text.
    Serial(SerialLine),
}

/// Six voltages of strain gauges.
#[derive(Debug, Clone, PartialEq)]
pub struct Voltages {
    /// The channels, as NI-DAQmx names them.
    pub channels: String,
    /// How often they are sampled [Hz].
    pub rate_hz: f64,
    /// The largest voltage that is measured [V].
    pub range_v: f64,
    /// fx, fy, fz [N] and tx, ty, tz [N m] per volt of each channel; row by row.
    pub matrix: [[f64; 6]; 6],
}

/// The scale of a sensor's counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counts {
    /// Counts per newton [1/N].
    pub per_newton: f64,
    /// Counts per newton metre [1/(N m)].
    pub per_newton_metre: f64,
}

impl Default for SensorPlan {
    fn default() -> Self {
        Self {
            source: SensorSource::Virtual,
            tip_distance_m: None,
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            range_n: None,
            range_n_m: None,
            timeout_s: None,
        }
    }
}

/// Keys of every kind.
const OF_ALL: [&str; 6] = [
    "kind",
    "tip_distance_m",
    "axes",
    "range_n",
    "range_n_m",
    "timeout_s",
];

impl SensorPlan {
    pub(super) const KEYS: &[Key] = &[
        Key::word("kind", SensorKind::MEANINGS, "What measures the force.").default("\"virtual\""),
        Key::number(
            "tip_distance_m",
            Domain::LENGTH,
            "From the sensor's origin, about which torques are, to the tip.",
        )
        .optional("0.05", "the rig's own"),
        Key::texts(
            "axes",
            "The indenter's x, y and z among the sensor's axes; of a real sensor.",
        )
        .optional("[\"x\", \"y\", \"z\"]", "the same axes"),
        Key::vector("range_n", Domain::FORCE, "The largest force on each axis; of a real sensor.")
            .optional("[32.0, 32.0, 100.0]", "the rig's own"),
        Key::vector(
            "range_n_m",
            Domain::TORQUE,
            "The largest torque about each axis; of a real sensor.",
        )
        .optional("[2.5, 2.5, 2.5]", "the rig's own"),
        Key::number(
            "timeout_s",
            TIMEOUT,
            "How long a reading may be missing; of a real sensor.",
        )
        .optional("0.02", "the rig's own"),
        Key::text("channels", "`ni_daq`: the six channels as NI-DAQmx names them.")
            .optional("\"Dev1/ai0:5\"", "another kind"),
        Key::number("rate_hz", SAMPLE_RATE, "`ni_daq`: how often they are sampled.")
            .optional("10000.0", "10000.0"),
        Key::number("range_v", VOLTAGE, "`ni_daq`: the largest voltage that is measured.")
            .optional("10.0", "10.0"),
        Key::numbers(
            "matrix",
            Domain::FINITE,
            "`ni_daq`: the 36 numbers of the calibration certificate, row by row in N and N m per volt.",
        )
        .optional("[]", "another kind"),
        Key::number("counts_per_newton", COUNTS, "`net_ft`, `serial`: counts per newton.")
            .optional("1000000.0", "another kind"),
        Key::number(
            "counts_per_newton_metre",
            COUNTS,
            "`net_ft`, `serial`: counts per newton metre.",
        )
        .optional("1000000.0", "another kind, or a line without torques"),
        Key::integer("baud", 300, 4_000_000, "`serial`: bits per second.")
            .optional("115200", "115200"),
        Key::texts(
            "columns",
            "`serial`: the fields of a line: \"fz\", or all of \"fx\", \"fy\", \"fz\", \"tx\", \"ty\" and \"tz\", and \"sequence\" \
             or \"skip\".",
        )
        .optional("[\"sequence\", \"fz\"]", "another kind"),
        Key::word(
            "separator",
            SerialSeparator::MEANINGS,
            "`serial`: what stands between two fields.",
        )
        .optional("\",\"", "a comma"),
    ];

    pub(super) fn from_keys(keys: Option<&Keys<'_>>) -> Result<Self, Error> {
        let Some(keys) = keys else {
            return Ok(Self::default());
        };
        let kind = keys.word("kind", SensorKind::WORDS)?;
        let kind = kind.unwrap_or(SensorKind::Virtual);
        Self::only(keys, kind)?;
        let source = match kind {
            SensorKind::Virtual => SensorSource::Virtual,
            SensorKind::NiDaq => SensorSource::NiDaq(Box::new(Voltages::from_keys(keys)?)),
            SensorKind::NetFt => SensorSource::NetFt(Counts::from_keys(keys)?),
            SensorKind::Serial => SensorSource::Serial(SerialLine::from_keys(keys)?),
        };
        Ok(Self {
            source,
            tip_distance_m: keys.number("tip_distance_m")?,
            axes: axes(keys)?,
            range_n: keys.vector("range_n")?,
            range_n_m: keys.vector("range_n_m")?,
            timeout_s: keys.number("timeout_s")?,
        })
    }

    /// Rejects every key that belongs to another kind.
    fn only(keys: &Keys<'_>, kind: SensorKind) -> Result<(), Error> {
        let (own, why): (&[&str], _) = match kind {
            SensorKind::Virtual => (&[], "nothing: a virtual sensor has none"),
            SensorKind::NiDaq => (
                &["channels", "rate_hz", "range_v", "matrix"],
                "nothing: a sensor at NI-DAQmx has none",
            ),
            SensorKind::NetFt => (
                &["counts_per_newton", "counts_per_newton_metre"],
                "nothing: an ATI Net F/T has none",
            ),
            SensorKind::Serial => (
                &[
                    "baud",
                    "columns",
                    "separator",
                    "counts_per_newton",
                    "counts_per_newton_metre",
                ],
                "nothing: a serial line has none",
            ),
        };
        let is_foreign = |key: &&'static str| !own.contains(key) && !OF_ALL.contains(key);
        let mut foreign = Self::KEYS.iter().map(|key| key.name).filter(is_foreign);
        foreign.try_for_each(|key| keys.refuse(key, why))?;
        // The virtual sensor is mounted along the indenter and has the ranges of the source's.
        let fixed = ["axes", "range_n", "range_n_m", "timeout_s"];
        match kind {
            SensorKind::Virtual => fixed.iter().try_for_each(|key| keys.refuse(key, why)),
            _ => Ok(()),
        }
    }
}

/// Timeouts of a reading; longer than a tick, and short enough to protect a hand.
const TIMEOUT: Domain = Domain::quantity(
    "a time without a reading",
    "s",
    [Included(0.002), Included(1.0)],
)
.usually(0.005, 0.1);

/// Counts of a sensor for a unit; a sensor that sends newtons has one.
const COUNTS: Domain = Domain::number("a number of counts", [Included(1e-6), Included(1e12)]);

const SAMPLE_RATE: Domain =
    Domain::quantity("a sample rate", "hz", [Included(100.0), Included(1e6)]).usually(1e3, 1e5);

const VOLTAGE: Domain =
    Domain::number("a voltage", [Included(0.01), Included(100.0)]).with_remark("in volts");

impl Voltages {
    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        const CHANNELS: &str = "the six channels as NI-DAQmx names them, such as \"Dev1/ai0:5\"";
        const MATRIX: &str = "a list of 36 numbers, those of the calibration certificate row by row in N and N m per volt";
        let channels = keys.text("channels")?;
        let channels = channels.ok_or_else(|| keys.missing("channels", CHANNELS))?;
        if !channels.is_ascii() {
            return Err(keys.invalid("channels", CHANNELS));
        }
        let matrix = keys.numbers("matrix")?;
        let matrix = matrix.ok_or_else(|| keys.missing("matrix", MATRIX))?;
        if matrix.len() != 36 {
            return Err(keys.invalid("matrix", MATRIX));
        }
        Ok(Self {
            channels,
            rate_hz: keys.number("rate_hz")?.unwrap_or(10_000.0),
            range_v: keys.number("range_v")?.unwrap_or(10.0),
            matrix: std::array::from_fn(|row| {
                std::array::from_fn(|column| matrix[6 * row + column])
            }),
        })
    }
}

impl Counts {
    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            per_newton: keys.required_number("counts_per_newton")?,
            per_newton_metre: keys.required_number("counts_per_newton_metre")?,
        })
    }
}

/// The sensor's axes that correspond to the indenter's.
fn axes(keys: &Keys<'_>) -> Result<[[f64; 3]; 3], Error> {
    const EXPECTED: &str = "three of \"x\", \"y\", \"z\", \"-x\", \"-y\" and \"-z\" that make a right-handed frame, \
                            such as [\"x\", \"-y\", \"-z\"]";
    let words = keys.texts("axes")?;
    if words.is_empty() {
        return match keys.contains("axes") {
            true => Err(keys.invalid("axes", EXPECTED)),
            false => Ok(SensorPlan::default().axes),
        };
    }
    let axis = |word: &String| match word.as_str() {
        "x" => Some([1.0, 0.0, 0.0]),
        "y" => Some([0.0, 1.0, 0.0]),
        "z" => Some([0.0, 0.0, 1.0]),
        "-x" => Some([-1.0, 0.0, 0.0]),
        "-y" => Some([0.0, -1.0, 0.0]),
        "-z" => Some([0.0, 0.0, -1.0]),
        _ => None,
    };
    let rows: Option<Vec<[f64; 3]>> = words.iter().map(axis).collect();
    let rows: Option<[[f64; 3]; 3]> = rows.and_then(|rows| rows.try_into().ok());
    let is_right_handed = |[x, y, z]: &[[f64; 3]; 3]| {
        let cross = [
            x[1] * y[2] - x[2] * y[1],
            x[2] * y[0] - x[0] * y[2],
            x[0] * y[1] - x[1] * y[0],
        ];
        cross.iter().zip(z).map(|(a, b)| a * b).sum::<f64>() > 0.5
    };
    rows.filter(is_right_handed)
        .ok_or_else(|| keys.invalid("axes", EXPECTED))
}
