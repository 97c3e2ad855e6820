use crate::words::words;
use crate::{Error, Keys};

words! {
    /// What a field of a line is.
    pub enum SerialField {
        /// Force along x.
        Fx = "fx",
        /// Force along y.
        Fy = "fy",
        /// Force along z.
        Fz = "fz",
        /// Torque about x.
        Tx = "tx",
        /// Torque about y.
        Ty = "ty",
        /// Torque about z.
        Tz = "tz",
        /// A number that grows by one from line to line.
        Sequence = "sequence",
        /// Something else.
        Skipped = "skip",
    }
}

words! {
    /// What stands between two fields.
    pub enum SerialSeparator {
        /// A comma.
        Comma = ",",
        /// A semicolon.
        Semicolon = ";",
        /// A tabulator.
        Tab = "tab",
        /// One space or more.
        Space = "space",
    }
}

/// Lines of text, one for each reading.
#[derive(Debug, Clone, PartialEq)]
pub struct SerialLine {
    /// Bits per second.
    pub baud: u32,
    /// The fields of a line, in their order: fz, or all six axes, and any others.
    pub fields: Vec<SerialField>,
    /// The separator between two fields.
    pub separator: SerialSeparator,
    /// Counts per newton [1/N].
    pub per_newton: f64,
    /// Counts per newton metre [1/(N m)]; none for a sensor of one axis.
    pub per_newton_metre: Option<f64>,
}

impl SerialLine {
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        const FIELDS: &str = "a list with \"fz\" or all of \"fx\", \"fy\", \"fz\", \"tx\", \"ty\" and \"tz\", each once, \
                              and what else is on a line as \"sequence\" (once) or \"skip\"";
        let texts = keys.texts("columns")?;
        if texts.is_empty() {
            return Err(keys.missing("columns", FIELDS));
        }
        let fields: Option<Vec<SerialField>> = texts
            .iter()
            .map(|text| SerialField::from_word(text))
            .collect();
        let fields = fields.ok_or_else(|| keys.invalid("columns", FIELDS))?;
        let times = |wanted| fields.iter().filter(|field| **field == wanted).count();
        use SerialField::{Fx, Fy, Fz, Sequence, Tx, Ty, Tz};
        let others = [Fx, Fy, Tx, Ty, Tz].map(times);
        let is_six = others == [1; 5];
        if times(Fz) != 1 || times(Sequence) > 1 || !(is_six || others == [0; 5]) {
            return Err(keys.invalid("columns", FIELDS));
        }
        let per_newton_metre = match is_six {
            true => Some(keys.required_number("counts_per_newton_metre")?),
            false => {
                keys.refuse(
                    "counts_per_newton_metre",
                    "nothing: this line has no torques",
                )?;
                None
            }
        };
        let baud = keys.integer("baud")?.unwrap_or(115_200);
        let separator = keys.word("separator", SerialSeparator::WORDS)?;
        Ok(Self {
            baud: u32::try_from(baud).expect("it is in the range"),
            fields,
            separator: separator.unwrap_or(SerialSeparator::Comma),
            per_newton: keys.required_number("counts_per_newton")?,
            per_newton_metre,
        })
    }
}
