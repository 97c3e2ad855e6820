use std::path::{Path, PathBuf};

use super::{Jaws, LengthUnit};
use crate::words::words;
use crate::{Domain, Error, Key, Keys};

words! {
    /// What a tool can do.
    pub enum ToolKind {
        /// It presses.
        Probe = "probe",
        /// It holds.
        Grasper = "grasper",
        /// It cuts between blades.
        Scissors = "scissors",
        /// It pulls and cuts with its edge.
        Hook = "hook",
    }
}

words! {
    /// The shape of a tip.
    pub enum TipShape {
        /// A round flat face.
        Flat = "flat",
        /// A ball.
        Sphere = "sphere",
    }
}

words! {
    /// How a tip holds the tissue that it touches.
    pub enum TipContact {
        /// Bonded: tangential motion is transmitted.
        Stick = "stick",
        /// Without tangential force.
        Slip = "slip",
    }
}

words! {
    /// What moves a tool.
    pub enum DeviceKind {
        /// The mouse.
        Mouse = "mouse",
        /// The virtual haptic device.
        Virtual = "virtual",
        /// Nothing.
        None = "none",
        /// A Haply device.
        Haply = "haply",
        /// A device of OpenHaptics.
        OpenHaptics = "openhaptics",
        /// A Force Dimension device.
        ForceDimension = "force_dimension",
    }
}

impl DeviceKind {
    /// Whether it is a device that displays forces to a hand.
    pub fn is_haptic(self) -> bool {
        matches!(self, Self::Haply | Self::OpenHaptics | Self::ForceDimension)
    }
}

/// The tip of a tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// Its shape.
    pub shape: TipShape,
    /// Its radius, not its diameter [m].
    pub radius_m: f64,
    /// Its contact with the tissue.
    pub contact: TipContact,
    /// Coulomb's coefficient of a sticking tip [-], beyond which it slides; none where it never does.
    pub friction: Option<f64>,
}

/// The appearance of a tool, from a file: in the tool's frame, with the tip at the origin and the shaft along +z.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolMesh {
    /// The file.
    pub path: PathBuf,
    /// Its unit; none when the scene does not state it.
    pub unit: Option<LengthUnit>,
}

/// A tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Tool {
    /// Its name, which motions and sessions use.
    pub name: String,
    /// Its kind.
    pub kind: ToolKind,
    /// The tip.
    pub tip: Tip,
    /// The fulcrum, through which its shaft always passes [m]; none for a free tool.
    pub trocar_m: Option<[f64; 3]>,
    /// Friction of its shaft in the trocar [N], along the shaft on the hand.
    pub trocar_friction_n: f64,
    /// Lateral stiffness of the abdominal wall on the shaft: force on the hand over its lateral displacement [N/m].
    pub trocar_stiffness_n_per_m: f64,
    /// Its jaws; none of a probe and a hook.
    pub jaws: Option<Jaws>,
    /// Its appearance, if it differs from that of its kind.
    pub mesh: Option<ToolMesh>,
    /// The device that moves it.
    pub device: DeviceKind,
}

impl Default for Tip {
    /// The source's indenter: a flat punch of 1 mm radius.
    fn default() -> Self {
        Self {
            shape: TipShape::Flat,
            radius_m: 0.001,
            contact: TipContact::Stick,
            friction: None,
        }
    }
}

impl Default for Tool {
    /// The probe of a scene that names no tool.
    fn default() -> Self {
        Self {
            name: "right".to_owned(),
            kind: ToolKind::Probe,
            tip: Tip::default(),
            trocar_m: None,
            trocar_friction_n: 0.0,
            trocar_stiffness_n_per_m: 0.0,
            jaws: None,
            mesh: None,
            device: DeviceKind::Mouse,
        }
    }
}

/// The tools of a scene, of which `keys` are the keys.
pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Vec<Tool>, Error> {
    let tables = keys.tables("tool")?;
    if let Some(third) = tables.get(2) {
        return Err(Error::BadValue {
            place: third.place().clone(),
            key: keys.full_name("tool"),
            found: format!("a list of {} tools", tables.len()),
            expected: "at most two tools, one for each hand".into(),
        });
    }
    let mut tools: Vec<Tool> = Vec::new();
    for keys in &tables {
        // A tool without a name is assigned to the free hand.
        let right_is_taken = tools.iter().any(|tool| tool.name == "right");
        let free = if right_is_taken { "left" } else { "right" };
        tools.push(Tool::from_keys(keys, free, folder)?);
    }
    match tools.as_slice() {
        [] => Ok(vec![Tool::default()]),
        [first, second] if first.name == second.name => Err(Error::BadValue {
            place: tables[1].place().clone(),
            key: tables[1].full_name("name"),
            found: format!("{:?}", second.name),
            expected: "another name than that of the first tool".into(),
        }),
        _ => Ok(tools),
    }
}

impl Tool {
    pub(super) const KEYS: &[Key] = &[
        Key::text("name", "Its name, which motions and sessions use.")
            .optional("\"right\"", "the hand that is free, \"right\" first"),
        Key::word("kind", ToolKind::MEANINGS, "What it can do.").default("\"probe\""),
        Key::table("tip", Tip::KEYS, "The end that touches.")
            .optional("", "a flat tip of 1 mm radius that sticks"),
        Key::vector(
            "trocar_m",
            Domain::POSITION,
            "The point through which its shaft always passes.",
        )
        .optional("[0.0, -0.1, 0.2]", "it moves freely"),
        Key::number(
            "trocar_friction_n",
            Domain::FORCE_OR_NONE,
            "Friction of its shaft in the trocar, which a hand feels along the shaft. Only with `trocar_m`.",
        )
        .optional("0.5", "0.0"),
        Key::number(
            "trocar_stiffness_n_per_m",
            Domain::STIFFNESS_OR_NONE,
            "How the abdominal wall resists a shaft that leans away from the organ: force on the hand per way of the hand \
             across. Only with `trocar_m`.",
        )
        .optional("20.0", "0.0"),
        Key::table(
            "jaws",
            Jaws::KEYS,
            "The jaws of a grasper, or the blades of scissors. Shut, they end at the tip and run along the shaft.",
        )
        .optional("", "those of a short instrument of 5 mm shaft"),
        Key::path(
            "mesh",
            "What it looks like: a mesh file in the tool's frame, the tip at the origin and the shaft along +z.",
        )
        .optional("\"hook.stl\"", "as its kind does"),
        Key::word(
            "mesh_unit",
            LengthUnit::MEANINGS,
            "The unit of the coordinates in the mesh file.",
        )
        .optional("\"mm\"", "the file's own unit, or a guess from its size, with a warning"),
        Key::word("device", DeviceKind::MEANINGS, "What moves it.").default("\"mouse\""),
    ];

    fn from_keys(keys: &Keys<'_>, default_name: &str, folder: &Path) -> Result<Self, Error> {
        let default = Self::default();
        let tip = keys.table("tip")?;
        let kind = keys.word("kind", ToolKind::WORDS)?.unwrap_or(default.kind);
        let trocar_m = keys.vector("trocar_m")?;
        let of_trocar = |key| -> Result<f64, Error> {
            if trocar_m.is_none() {
                keys.refuse(key, "`trocar_m` too, for a tool without one has none")?;
            }
            Ok(keys.number(key)?.unwrap_or(0.0))
        };
        Ok(Self {
            name: keys
                .text("name")?
                .unwrap_or_else(|| default_name.to_owned()),
            kind,
            tip: tip.map_or(Ok(default.tip), |keys| Tip::from_keys(&keys))?,
            trocar_m,
            trocar_friction_n: of_trocar("trocar_friction_n")?,
            trocar_stiffness_n_per_m: of_trocar("trocar_stiffness_n_per_m")?,
            jaws: Jaws::from_keys(keys, kind)?,
            mesh: ToolMesh::from_keys(keys, folder)?,
            device: keys
                .word("device", DeviceKind::WORDS)?
                .unwrap_or(default.device),
        })
    }
}

impl ToolMesh {
    fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Option<Self>, Error> {
        let Some(path) = keys.text("mesh")? else {
            keys.refuse("mesh_unit", "`mesh` too, for nothing else has a unit")?;
            return Ok(None);
        };
        Ok(Some(Self {
            path: folder.join(path),
            unit: keys.word("mesh_unit", LengthUnit::WORDS)?,
        }))
    }
}

const COULOMB: &[Key] = &[Key::number(
    "coulomb",
    Domain::FRICTION,
    "Coulomb's coefficient, beyond which it slides.",
)
.required("0.3")];

impl Tip {
    const KEYS: &[Key] = &[
        Key::word("shape", TipShape::MEANINGS, "Its shape.").required("\"flat\""),
        Key::number(
            "radius_m",
            Domain::TIP_RADIUS,
            "Its radius, not its diameter.",
        )
        .required("0.001"),
        Key::word_or_table(
            "contact",
            TipContact::MEANINGS,
            COULOMB,
            "How it holds the tissue that it touches; a table for a tip that sticks and slides: `contact = { coulomb = 0.3 }`.",
        )
        .default("\"stick\""),
        Key::number(
            "friction",
            Domain::FRICTION,
            "Coulomb's coefficient of a tip that sticks, as in the table `contact`; of the nonlinear model also that of the shaft.",
        )
        .optional("0.3", "it never slides"),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let mut friction = keys.number("friction")?;
        let contact = match keys.is_table("contact") {
            true => {
                if friction.is_some() {
                    return Err(keys.invalid(
                        "friction",
                        "no `friction` beside `contact = { coulomb }`, which says the same",
                    ));
                }
                let table = keys.table("contact")?;
                friction = table
                    .map(|keys| keys.required_number("coulomb"))
                    .transpose()?;
                Some(TipContact::Stick)
            }
            false => keys.word("contact", TipContact::WORDS)?,
        };
        if contact == Some(TipContact::Slip) && friction.is_some() {
            return Err(keys.invalid(
                "friction",
                "no friction of a tip that slips: it is that of `contact = \"stick\"`, beyond which it slides",
            ));
        }
        Ok(Self {
            shape: keys
                .word("shape", TipShape::WORDS)?
                .ok_or_else(|| keys.missing("shape", "\"flat\" or \"sphere\""))?,
            radius_m: keys.required_number("radius_m")?,
            contact: contact.unwrap_or(TipContact::Stick),
            friction,
        })
    }
}
