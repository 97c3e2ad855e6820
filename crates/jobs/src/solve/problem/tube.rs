use palpate_files::{Domain, Error, Key, Keys};
use palpate_mechanics::contact::Friction;

use super::{BOND_MEANINGS, BONDS, length_below, some_numbers};

/// A tube with fixed ends under pressure, and perhaps indented.
#[derive(Debug, Clone)]
pub(crate) struct Tube {
    /// [m]
    pub(crate) length: f64,
    /// [m]
    pub(crate) inner_radius: f64,
    /// [m]
    pub(crate) outer_radius: f64,
    /// Pressures inside [Pa].
    pub(crate) pressures: Vec<f64>,
    /// After the last pressure.
    pub(crate) indent: Option<TubeIndent>,
}

/// A flat indenter, pressed radially at mid-length.
#[derive(Debug, Clone)]
pub(crate) struct TubeIndent {
    /// [m]
    pub(crate) radius: f64,
    /// [m]
    pub(crate) depths: Vec<f64>,
    pub(crate) contact: Friction,
}

impl TubeIndent {
    const KEYS: &[Key] = &[
        Key::number("radius_m", Domain::LENGTH, "The indenter's radius.").required("0.001"),
        Key::numbers(
            "depths_m",
            Domain::DEPTH_OR_NONE,
            "How deep it is pressed, for each answer.",
        )
        .required("[0.001]"),
        Key::word("contact", BOND_MEANINGS, "How it holds the tissue.").default("\"stick\""),
    ];
}

impl Tube {
    pub(crate) const KEYS: &'static [Key] = &[
        Key::number("length_m", Domain::LENGTH, "Its length.").required("0.03"),
        Key::number(
            "inner_radius_m",
            Domain::LENGTH,
            "Its inner radius at rest.",
        )
        .required("0.004"),
        Key::number(
            "outer_radius_m",
            Domain::LENGTH,
            "Its outer radius at rest.",
        )
        .required("0.008"),
        Key::number("pressure_pa", Domain::PRESSURE, "The pressure inside.")
            .optional("2000.0", "`pressures_pa`, or 0 with `indent`"),
        Key::numbers(
            "pressures_pa",
            Domain::PRESSURE,
            "Several pressures inside, one after another.",
        )
        .required_without("pressure_pa", "[1000.0, 2000.0]"),
        Key::table(
            "indent",
            TubeIndent::KEYS,
            "A flat indenter, pressed radially at mid-length after the last pressure.",
        )
        .optional("", "it is not indented"),
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let outer_radius = keys.required_number("outer_radius_m")?;
        let tube = Self {
            length: keys.required_number("length_m")?,
            inner_radius: length_below(keys, "inner_radius_m", outer_radius, "the outer radius")?,
            outer_radius,
            pressures: Vec::new(),
            indent: None,
        };
        let indent = keys.table("indent")?;
        let indent = indent.map(|keys| tube.indent(&keys)).transpose()?;
        Ok(Self {
            pressures: pressures(keys, indent.is_some())?,
            indent,
            ..tube
        })
    }

    fn indent(&self, keys: &Keys<'_>) -> Result<TubeIndent, Error> {
        let outer = (self.outer_radius, "the outer radius of the tube");
        let radius = length_below(keys, "radius_m", outer.0, outer.1)?;
        if 2.0 * radius >= self.length {
            let expected = format!("less than half the length of the tube, {} m", self.length);
            return Err(keys.invalid("radius_m", expected));
        }
        Ok(TubeIndent {
            radius,
            depths: some_numbers(keys, "depths_m", Some(outer))?,
            contact: keys.word("contact", BONDS)?.unwrap_or(Friction::Bonded),
        })
    }
}

fn pressures(keys: &Keys<'_>, indented: bool) -> Result<Vec<f64>, Error> {
    match (keys.contains("pressure_pa"), keys.contains("pressures_pa")) {
        (true, true) => Err(keys.given_twice("pressure_pa", "pressures_pa")),
        (true, false) => Ok(vec![keys.required_number("pressure_pa")?]),
        (false, true) => some_numbers(keys, "pressures_pa", None),
        (false, false) if indented => Ok(vec![0.0]),
        (false, false) => Err(keys.missing(
            "pressures_pa",
            "a list of pressures, or one `pressure_pa`, or \
             `indent = { radius_m = 0.001, depths_m = [0.001] }`",
        )),
    }
}
