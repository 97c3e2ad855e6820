use std::f64::consts::PI;
use std::ops::Bound::{Excluded, Included};
use std::path::{Path, PathBuf};

use super::standing_alone::plain;
use crate::{Domain, Error, Key, Keys};

/// What there is to do, and how a performance is judged.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Task {
    /// What it is called.
    pub title: Option<String>,
    /// What the trainee reads.
    pub instructions: Option<String>,
    /// How long it may take [s].
    pub time_limit_s: Option<f64>,
    /// The force above which tissue would be harmed [N].
    pub force_limit_n: Option<f64>,
    /// The folder of an expert's session, or of several.
    pub expert: Option<PathBuf>,
    /// When it is done.
    pub goal: Goal,
}

/// When a task is done.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Goal {
    /// When somebody says so.
    #[default]
    Free,
    /// When a place is marked; it should be the target.
    Find {
        /// The place on or under the surface that is meant [m].
        target_m: [f64; 3],
        /// How far from it, along the surface, still counts [m].
        tolerance_m: f64,
        /// How large it is, where that is asked for as well.
        size: Option<SoughtSize>,
    },
    /// When a force was held for long enough.
    Traction {
        /// By which tool; none for any.
        tool: Option<String>,
        /// Its magnitude [N].
        force_n: f64,
        /// How far beside it still counts [N].
        tolerance_n: f64,
        /// For how long in all [s].
        hold_s: f64,
        /// Where to pull, and the largest angle from it that still counts [rad]; none for anywhere.
        direction: Option<([f64; 3], f64)>,
        /// The pull above which the tissue tears [N].
        tear_force_n: Option<f64>,
    },
    /// When a straight cut is as long as its line.
    Cut {
        /// Where it should begin [m].
        from_m: [f64; 3],
        /// Where it should end [m].
        to_m: [f64; 3],
        /// How far beside the line still counts [m].
        tolerance_m: f64,
        /// How many layers from outside; none in an organ without layers.
        layers: Option<usize>,
    },
}

/// The size of what is to be found; the trainee states its diameter after marking it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoughtSize {
    /// Its radius [m].
    pub radius_m: f64,
    /// The largest error of the stated diameter that counts [m].
    pub diameter_tolerance_m: f64,
}

impl SoughtSize {
    /// By how much a stated diameter is too large [m]; negative where it is too small.
    pub fn error_of(&self, stated_diameter_m: f64) -> f64 {
        stated_diameter_m - 2.0 * self.radius_m
    }

    /// Whether a stated diameter [m] counts.
    pub fn accepts(&self, stated_diameter_m: f64) -> bool {
        self.error_of(stated_diameter_m).abs() <= self.diameter_tolerance_m
    }
}

/// How far a pull may be from its direction [rad].
const ANGLE: Domain = Domain::quantity("an angle", "rad", [Excluded(0.0), Included(PI)]);

/// Where the expert's session is. What the folder of the scene itself holds is, at most, the session that is judged.
fn expert(keys: &Keys<'_>, folder: &Path) -> Result<Option<PathBuf>, Error> {
    match keys.text("expert")? {
        Some(path) if plain(Path::new(&path)).as_os_str().is_empty() => Err(keys.bad(
            "expert",
            "the folder of an expert's session; with its own scene a session would be judged against itself",
        )),
        path => Ok(path.map(|path| folder.join(path))),
    }
}

impl Goal {
    /// Its word: `free`, or the name of its table.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Find { .. } => "find",
            Self::Traction { .. } => "traction",
            Self::Cut { .. } => "cut",
        }
    }
}

impl Task {
    pub(super) const KEYS: &'static [Key] = &[
        Key::text("title", "What it is called.").optional("\"Find the stiff spot\"", "it has no title"),
        Key::text("instructions", "What the trainee reads.").optional(
            "\"One place under the surface is stiffer. Press on it and say: here.\"",
            "nothing",
        ),
        Key::number("time_limit_s", Domain::DURATION, "How long it may take.")
            .optional("60.0", "as long as it takes"),
        Key::number(
            "force_limit_n",
            Domain::FORCE,
            "The force above which tissue would be harmed; forces above it count against the trainee.",
        )
        .optional("2.0", "no force counts"),
        Key::path(
            "expert",
            "An expert's session to compare with: its folder, or a folder of several.",
        )
        .optional("\"expert-session\"", "none"),
        Key::table(
            "find",
            FIND,
            "Done when a place is marked. At most one of `find`, `traction` and `cut`.",
        )
        .optional("", "everybody does what they like"),
        Key::table("traction", TRACTION, "Done when a force was held for long enough.")
            .optional("", "another goal"),
        Key::table("cut", CUT, "Done when a straight cut is as long as its line.")
            .optional("", "another goal"),
    ];

    /// `layers` is the number of layers that the organ has.
    pub(super) fn from_keys(
        keys: Option<&Keys<'_>>,
        folder: &Path,
        layers: usize,
    ) -> Result<Self, Error> {
        let Some(keys) = keys else {
            return Ok(Self::default());
        };
        Ok(Self {
            title: keys.text("title")?,
            instructions: keys.text("instructions")?,
            time_limit_s: keys.number("time_limit_s")?,
            force_limit_n: keys.number("force_limit_n")?,
            expert: expert(keys, folder)?,
            goal: Goal::from_keys(keys, layers)?,
        })
    }
}

const FIND: &[Key] = &[
    Key::vector(
        "target_m",
        Domain::POSITION,
        "The place on or under the surface that is meant.",
    )
    .required("[0.02, 0.01, 0.05]"),
    Key::number(
        "tolerance_m",
        Domain::LENGTH,
        "How far from it, along the surface, still counts.",
    )
    .required("0.006"),
    Key::number(
        "radius_m",
        Domain::LENGTH,
        "Its radius; with it the trainee also states a diameter after marking the place.",
    )
    .optional("0.008", "only the place counts"),
    Key::number(
        "diameter_tolerance_m",
        Domain::LENGTH,
        "The largest error of the stated diameter that counts.",
    )
    .optional("0.002", "a quarter of the diameter, with a `radius_m`"),
];

const TRACTION: &[Key] = &[
    Key::text("tool", "The tool that pulls.").optional("\"left\"", "any"),
    Key::number("force_n", Domain::FORCE, "The force that is wanted.").required("0.4"),
    Key::number(
        "tolerance_n",
        Domain::FORCE,
        "The largest distance from it that counts.",
    )
    .required("0.1"),
    Key::number(
        "hold_s",
        Domain::DURATION,
        "For how long in all, within the tolerance.",
    )
    .required("10.0"),
    Key::direction("direction", "Where to pull.").optional("[0.0, -1.0, 0.0]", "anywhere"),
    Key::number(
        "direction_tolerance_rad",
        ANGLE,
        "The largest angle from `direction` that still counts.",
    )
    .optional("0.5235987755982988", "30 degrees, with a `direction`"),
    Key::number(
        "tear_force_n",
        Domain::FORCE,
        "A pull above it tears the tissue: the attempt is over, and failed.",
    )
    .optional("0.6", "it never tears"),
];

const CUT: &[Key] = &[
    Key::vector("from_m", Domain::POSITION, "Where it should begin.")
        .required("[0.0, -0.01, 0.015]"),
    Key::vector("to_m", Domain::POSITION, "Where it should end.").required("[0.0, -0.01, -0.015]"),
    Key::number(
        "tolerance_m",
        Domain::LENGTH,
        "The largest distance from the line that counts.",
    )
    .required("0.002"),
    Key::integer(
        "layers",
        1,
        6,
        "How many layers from outside are cut; at most those of the organ.",
    )
    .optional("1", "all but the innermost"),
];

impl Goal {
    const TABLES: [&'static str; 3] = ["find", "traction", "cut"];

    fn from_keys(keys: &Keys<'_>, layers: usize) -> Result<Self, Error> {
        let mut given = Self::TABLES
            .into_iter()
            .filter(|table| keys.contains(table));
        if let (Some(first), Some(second)) = (given.next(), given.next()) {
            return Err(keys.given_twice(first, second));
        }
        if let Some(find) = keys.table("find")? {
            return Ok(Self::Find {
                target_m: find.required_vector("target_m")?,
                tolerance_m: find.required_number("tolerance_m")?,
                size: Self::size(&find)?,
            });
        }
        if let Some(traction) = keys.table("traction")? {
            return Ok(Self::Traction {
                tool: traction.text("tool")?,
                force_n: traction.required_number("force_n")?,
                tolerance_n: traction.required_number("tolerance_n")?,
                hold_s: traction.required_number("hold_s")?,
                direction: Self::direction(&traction)?,
                tear_force_n: Self::tear_force(&traction)?,
            });
        }
        match keys.table("cut")? {
            Some(cut) => Self::cut(&cut, layers),
            None => Ok(Self::Free),
        }
    }

    fn size(find: &Keys<'_>) -> Result<Option<SoughtSize>, Error> {
        let tolerance = find.number("diameter_tolerance_m")?;
        match find.number("radius_m")? {
            Some(radius_m) => Ok(Some(SoughtSize {
                radius_m,
                diameter_tolerance_m: tolerance.unwrap_or(0.5 * radius_m),
            })),
            None if tolerance.is_some() => Err(find.missing(
                "radius_m",
                "the radius of what is to be found, such as 0.008",
            )),
            None => Ok(None),
        }
    }

    fn direction(traction: &Keys<'_>) -> Result<Option<([f64; 3], f64)>, Error> {
        let tolerance = traction.number("direction_tolerance_rad")?;
        match traction.direction("direction")? {
            Some(direction) => Ok(Some((direction, tolerance.unwrap_or(PI / 6.0)))),
            None if tolerance.is_some() => {
                Err(traction.missing("direction", "a direction, such as [0.0, -1.0, 0.0]"))
            }
            None => Ok(None),
        }
    }

    fn tear_force(traction: &Keys<'_>) -> Result<Option<f64>, Error> {
        let tear = traction.number("tear_force_n")?;
        let wanted = traction.required_number("force_n")?;
        match tear {
            Some(tear) if tear <= wanted => Err(traction.bad(
                "tear_force_n",
                "a force above `force_n`, for tissue that tears before cannot be held",
            )),
            tear => Ok(tear),
        }
    }

    fn cut(cut: &Keys<'_>, layers: usize) -> Result<Self, Error> {
        let (from_m, to_m) = (cut.required_vector("from_m")?, cut.required_vector("to_m")?);
        if from_m == to_m {
            return Err(cut.bad("to_m", "another place than `from_m`"));
        }
        let wanted = cut.integer_within("layers", 1..=layers.max(1) as u64)?;
        let wanted = wanted.map_or(layers.saturating_sub(1).max(1), |wanted| wanted as usize);
        Ok(Self::Cut {
            from_m,
            to_m,
            tolerance_m: cut.required_number("tolerance_m")?,
            layers: (layers > 0).then_some(wanted),
        })
    }
}
