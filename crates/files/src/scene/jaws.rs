use super::ToolKind;
use crate::{Domain, Error, Key, Keys};

/// The jaws of a grasper, or the blades of scissors. Shut, they end at the tip and run along the shaft; they
/// open along the tool's x, and their faces lie across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jaws {
    /// From the joint to the end [m].
    pub length_m: f64,
    /// Across, along the tool's y [m]; 0 for blades.
    pub width_m: f64,
    /// Between their ends when they are open [m].
    pub opening_m: f64,
    /// The largest force of each on the tissue between them [N]; 0 for blades.
    pub force_n: f64,
    /// Friction of tissue on their faces [-]; 0 for blades.
    pub friction: f64,
}

impl Jaws {
    /// Those of a short grasper of 5 mm shaft.
    pub const GRASPER: Self = Self {
        length_m: 0.012,
        width_m: 0.004,
        opening_m: 0.010,
        force_n: 4.0,
        friction: 0.4,
    };

    /// Those of scissors of 5 mm shaft.
    pub const SCISSORS: Self = Self {
        length_m: 0.012,
        width_m: 0.0,
        opening_m: 0.010,
        force_n: 0.0,
        friction: 0.0,
    };

    pub(super) const KEYS: &[Key] = &[
        Key::number("length_m", Domain::LENGTH, "From the joint to the end.").default("0.012"),
        Key::number(
            "opening_m",
            Domain::LENGTH,
            "Between their ends when they are open.",
        )
        .default("0.010"),
        Key::number(
            "width_m",
            Domain::LENGTH,
            "Across, along the tool's y; of a grasper.",
        )
        .optional("0.004", "0.004"),
        Key::number(
            "force_n",
            Domain::FORCE,
            "The most with which each presses on what is between them; of a grasper.",
        )
        .optional("4.0", "4.0"),
        Key::number(
            "friction",
            Domain::FRICTION,
            "Coulomb's coefficient of tissue on their faces; of a grasper.",
        )
        .optional("0.4", "0.4"),
    ];
    const OF_SCISSORS: &[&str] = &["length_m", "opening_m"];

    /// The jaws of a tool of `kind` with `keys`; missing entries have their defaults.
    pub(super) fn from_keys(keys: &Keys<'_>, kind: ToolKind) -> Result<Option<Self>, Error> {
        let default = match kind {
            ToolKind::Grasper => Self::GRASPER,
            ToolKind::Scissors => Self::SCISSORS,
            ToolKind::Probe | ToolKind::Hook => {
                let remedy =
                    "no jaws to a tool that has none, or `kind` \"grasper\" or \"scissors\"";
                keys.refuse("jaws", remedy)?;
                return Ok(None);
            }
        };
        let Some(keys) = keys.table("jaws")? else {
            return Ok(Some(default));
        };
        if kind == ToolKind::Scissors {
            keys.only(Self::OF_SCISSORS)?;
        }
        let or = |key, default| -> Result<f64, Error> { Ok(keys.number(key)?.unwrap_or(default)) };
        let mut jaws = Self {
            length_m: or("length_m", default.length_m)?,
            opening_m: or("opening_m", default.opening_m)?,
            ..default
        };
        if kind == ToolKind::Grasper {
            jaws.width_m = or("width_m", default.width_m)?;
            jaws.force_n = or("force_n", default.force_n)?;
            let friction = keys.number("friction")?;
            jaws.friction = friction.unwrap_or(default.friction);
        }
        Ok(Some(jaws))
    }
}
