use palpate_files::{Domain, Error, Key, Keys};
use palpate_mechanics::contact::{Friction, FrictionLaw};
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, Indenter, IndenterShape, RelaxationMethod, Side,
};

use super::tools::ROUNDING;
use super::{length_below, required_table, some_numbers};

/// A rigid indenter pressed into a block.
#[derive(Debug, Clone)]
pub(crate) struct Indentation {
    pub(crate) block: Block,
    pub(crate) indenter: Indenter,
    pub(crate) loading: Loading,
}

/// How it is pressed.
#[derive(Debug, Clone)]
pub(crate) enum Loading {
    /// To these depths [m], each with instantaneous moduli.
    Depths(Vec<f64>),
    /// In time.
    Ramp(Ramp),
}

/// To a depth at a constant speed, and held there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ramp {
    /// [m]
    pub(crate) depth: f64,
    /// Duration of the ramp [s].
    pub(crate) ramp: f64,
    /// Duration of the hold [s].
    pub(crate) hold: f64,
    /// Number of output times, evenly spaced, ends included.
    pub(crate) samples: usize,
    /// How relaxation is taken into account.
    pub(crate) method: RelaxationMethod,
}

/// The indenter's end.
#[derive(Debug, Clone, Copy)]
enum End {
    Flat,
    Sphere,
    Cone,
}

const BASES: &[(&str, Base)] = &[("bonded", Base::Bonded), ("lubricated", Base::Lubricated)];

const FACES: &[(&str, Friction)] = &[
    ("stick", Friction::Bonded),
    ("slip", Friction::Frictionless),
];

/// The boundary condition of a side; none where there is no side.
const SIDES: &[(&str, Option<Friction>)] = &[
    ("stick", Some(Friction::Bonded)),
    ("slide", Some(Friction::Frictionless)),
    ("none", None),
];

const SHAPES: &[(&str, End)] = &[
    ("flat", End::Flat),
    ("sphere", End::Sphere),
    ("cone", End::Cone),
];

const METHODS: &[(&str, RelaxationMethod)] = &[
    ("convolution", RelaxationMethod::Convolution),
    ("full", RelaxationMethod::Full),
];

const BLOCK: &[Key] = &[
    Key::number("radius_m", Domain::LENGTH, "Its radius: it is a cylinder.").required("0.05"),
    Key::number("height_m", Domain::LENGTH, "Its height.").required("0.1"),
    Key::word(
        "base",
        &[
            ("bonded", "Glued to what it rests on."),
            ("lubricated", "It slides on what it rests on."),
        ],
        "What its lower face does.",
    )
    .default("\"bonded\""),
];

const INDENTER: &[Key] = &[
    Key::word(
        "shape",
        &[
            ("flat", "A round flat face."),
            ("sphere", "A ball."),
            ("cone", "A cone."),
        ],
        "Its end.",
    )
    .default("\"flat\""),
    Key::number(
        "radius_m",
        Domain::LENGTH,
        "Its radius, not its diameter; of a cone that of its base.",
    )
    .required("0.001"),
    Key::number(
        "half_angle_deg",
        Domain::HALF_ANGLE,
        "The angle between a cone's axis and its side.",
    )
    .optional("70.3", "it is no cone"),
    Key::number(
        "edge_radius_m",
        ROUNDING,
        "The radius to which the edge of a flat face, or the apex of a cone, is rounded. The face, its edge and the side are then \
         one surface.",
    )
    .optional("0.0001", "they are sharp"),
    Key::word(
        "face",
        &[
            ("stick", "Tissue that it touches moves with it."),
            ("slip", "Tissue slides along it without friction."),
        ],
        "How its face holds tissue.",
    )
    .default("\"stick\""),
    Key::number(
        "friction",
        Domain::FRICTION,
        "Coulomb's coefficient of a face and a side that stick, beyond which tissue slips along them.",
    )
    .optional("0.3", "tissue never slips along them"),
    Key::word(
        "side",
        &[
            ("stick", "Tissue that touches it moves with it."),
            ("slide", "Tissue slides along it without friction."),
            ("none", "Tissue does not meet it."),
        ],
        "What the side of a flat punch does.",
    )
    .optional("\"stick\"", "`stick`, of a flat punch"),
];

const RAMP: &[Key] = &[
    Key::number("depth_m", Domain::LENGTH, "How deep it is pressed.").required("0.005"),
    Key::number("ramp_s", Domain::DURATION, "How long the way takes.").required("0.5"),
    Key::number("hold_s", Domain::DURATION_OR_NONE, "How long it stays.").required("40.0"),
    Key::integer("samples", 2, 100_000, "How many times are answered for, ends included.")
        .default("200"),
    Key::word(
        "method",
        &[
            (
                "convolution",
                "The instantaneous force's rate, convolved with the relaxation: exact for a linear law.",
            ),
            ("full", "Memory at each point, in small steps of time."),
        ],
        "How relaxation is taken into account.",
    )
    .default("\"convolution\""),
];

impl Indentation {
    pub(crate) const KEYS: &'static [Key] = &[
        Key::table("block", BLOCK, "The block.").required(""),
        Key::table("indenter", INDENTER, "The indenter.").required(""),
        Key::numbers(
            "depths_m",
            Domain::DEPTH_OR_NONE,
            "How deep it is pressed, with instantaneous moduli, for each answer.",
        )
        .required_without("ramp", "[0.001, 0.002]"),
        Key::table(
            "ramp",
            RAMP,
            "It is pressed in time: to a depth, and held there.",
        )
        .optional("", "`depths_m` says how deep"),
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let block = required_table(keys, "block", "block = { radius_m = 0.05, height_m = 0.1 }")?;
        let block = Block {
            radius: block.required_number("radius_m")?,
            height: block.required_number("height_m")?,
            base: block.word("base", BASES)?.unwrap_or_default(),
        };
        Ok(Self {
            indenter: indenter(keys, &block)?,
            loading: loading(keys, &block)?,
            block,
        })
    }
}

fn indenter(keys: &Keys<'_>, block: &Block) -> Result<Indenter, Error> {
    let keys = required_table(keys, "indenter", "indenter = { radius_m = 0.001 }")?;
    let side = keys.word("side", SIDES)?;
    let face = keys.word("face", FACES)?.unwrap_or(Friction::Bonded);
    let coefficient = keys.number("friction")?;
    if face == Friction::Frictionless {
        keys.refuse(
            "friction",
            "no friction of a face that slips: it is that of `face = \"stick\"`, beyond which tissue slips",
        )?;
    }
    let law = |friction| match (friction, coefficient) {
        (Friction::Bonded, Some(coefficient)) => FrictionLaw::Coulomb(coefficient),
        (friction, _) => friction.into(),
    };
    let end = keys.word("shape", SHAPES)?.unwrap_or(End::Flat);
    if !matches!(end, End::Flat) {
        keys.refuse("side", "no side, for only a flat punch has one")?;
    }
    if !matches!(end, End::Cone) {
        keys.refuse("half_angle_deg", "no angle, for only a cone has one")?;
    }
    if matches!(end, End::Sphere) {
        keys.refuse("edge_radius_m", "no edge, for a sphere has none")?;
    }
    let edge_radius = keys.number("edge_radius_m")?.unwrap_or(0.0);
    if edge_radius > 0.0 {
        keys.refuse(
            "side",
            "no side of its own, for a rounded edge leads there: `face` says what both do",
        )?;
    }
    let radius = length_below(&keys, "radius_m", block.radius, "the radius of the block")?;
    let shape = match end {
        End::Flat if edge_radius > 0.0 => IndenterShape::RoundedPunch {
            edge_radius: length_below(
                &keys,
                "edge_radius_m",
                radius,
                "the radius of the indenter",
            )?,
        },
        End::Flat => IndenterShape::Flat {
            side: match side.unwrap_or(Some(Friction::Bonded)) {
                Some(friction) => Side::Touches(law(friction)),
                None => Side::Absent,
            },
        },
        End::Sphere => IndenterShape::Sphere,
        End::Cone => {
            let angle = keys.required_number("half_angle_deg")?;
            IndenterShape::Cone {
                half_angle: angle.to_radians(),
                apex_radius: edge_radius,
            }
        }
    };
    Ok(Indenter {
        shape,
        radius,
        face: law(face),
    })
}

fn loading(keys: &Keys<'_>, block: &Block) -> Result<Loading, Error> {
    let height = (block.height, "the height of the block");
    let ramp = keys.table("ramp")?;
    match (ramp, keys.contains("depths_m")) {
        (Some(_), true) => Err(keys.given_twice("depths_m", "ramp")),
        (Some(ramp), false) => Ok(Loading::Ramp(Ramp {
            depth: length_below(&ramp, "depth_m", height.0, height.1)?,
            ramp: ramp.required_number("ramp_s")?,
            hold: ramp.required_number("hold_s")?,
            samples: ramp.integer("samples")?.unwrap_or(200) as usize,
            method: ramp
                .word("method", METHODS)?
                .unwrap_or(RelaxationMethod::Convolution),
        })),
        (None, true) => some_numbers(keys, "depths_m", Some(height)).map(Loading::Depths),
        (None, false) => Err(keys.missing(
            "depths_m",
            "a list such as [0.001, 0.002], or \
             `ramp = { depth_m = 0.005, ramp_s = 0.5, hold_s = 40.0, samples = 200 }`",
        )),
    }
}
