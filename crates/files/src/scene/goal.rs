use std::f64::consts::PI;
use std::ops::Bound::{Excluded, Included};

use super::task::TaskScene;
use super::{CutLine, Tool, ToolKind};
use crate::words::or_list;
use crate::{Domain, Error, Key, Keys};

/// The goal of a task.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Goal {
    /// The trainee states that the task is done.
    #[default]
    Free,
    /// The trainee marks a location, which should be the target.
    Find {
        /// The target on or under the surface [m].
        target_m: [f64; 3],
        /// The tolerance from it, along the surface [m].
        tolerance_m: f64,
        /// The size of the target, where the trainee must state it.
        size: Option<SizeGoal>,
    },
    /// A force is held for long enough.
    Traction {
        /// The tool; none for any.
        tool: Option<String>,
        /// Its magnitude [N].
        force_n: f64,
        /// The tolerance of the force [N].
        tolerance_n: f64,
        /// The total duration [s].
        hold_s: f64,
        /// The direction of the pull, and the largest angle from it that counts [rad]; none for any direction.
        direction: Option<([f64; 3], f64)>,
        /// The pull above which the tissue tears [N].
        tear_force_n: Option<f64>,
    },
    /// A line is cut.
    Cut {
        /// The line.
        line: CutLine,
        /// The tolerance from the line [m].
        tolerance_m: f64,
        /// The number of layers from outside; none in an organ without layers.
        layers: Option<usize>,
    },
    /// A location next to the organ is touched for long enough.
    Touch(TouchGoal),
}

/// A location of a neighbour that the trainee touches while holding the organ out of the way. A touch counts while
/// neither the tip nor the shaft of the tool touches the organ.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchGoal {
    /// The tool that touches.
    pub tool: String,
    /// The target location [m].
    pub target_m: [f64; 3],
    /// The largest distance of the tip from it that counts [m].
    pub tolerance_m: f64,
    /// The target force [N].
    pub force_n: f64,
    /// The largest distance from it that counts [N].
    pub tolerance_n: f64,
    /// The total duration [s].
    pub hold_s: f64,
    /// The force above which the touched tissue is injured [N].
    pub injury_force_n: Option<f64>,
    /// The tool that must hold the organ meanwhile; none where this is not required.
    pub holder: Option<String>,
    /// The pull of the holder above which the tissue tears [N].
    pub tear_force_n: Option<f64>,
}

/// The size of the target; the trainee states its diameter after marking it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeGoal {
    /// Its radius [m].
    pub radius_m: f64,
    /// The largest error of the stated diameter that counts [m].
    pub diameter_tolerance_m: f64,
}

impl SizeGoal {
    /// The error of a stated diameter [m]; negative where it is too small.
    pub fn error_of(&self, stated_diameter_m: f64) -> f64 {
        stated_diameter_m - 2.0 * self.radius_m
    }

    /// Whether a stated diameter [m] counts.
    pub fn accepts(&self, stated_diameter_m: f64) -> bool {
        self.error_of(stated_diameter_m).abs() <= self.diameter_tolerance_m
    }
}

/// The largest angle of a pull from its direction [rad].
const ANGLE: Domain = Domain::quantity("an angle", "rad", [Excluded(0.0), Included(PI)]);

impl Goal {
    /// Its word: `free`, or the name of its table.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Find { .. } => "find",
            Self::Traction { .. } => "traction",
            Self::Cut { .. } => "cut",
            Self::Touch(_) => "touch",
        }
    }
}

pub(super) const FIND: &[Key] = &[
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

const FORCE_TOLERANCE: Key = Key::number(
    "tolerance_n",
    Domain::FORCE,
    "The largest distance from it that counts.",
)
.required("0.1");

pub(super) const TRACTION: &[Key] = &[
    Key::text("tool", "The tool that pulls.").optional("\"left\"", "any"),
    Key::number("force_n", Domain::FORCE, "The force that is wanted.").required("0.4"),
    FORCE_TOLERANCE,
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

pub(super) const CUT: &[Key] = &[
    CutLine::FROM,
    CutLine::TO,
    CutLine::CENTER,
    CutLine::RADIUS,
    CutLine::NORMAL,
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

pub(super) const TOUCH: &[Key] = &[
    Key::text("tool", "The tool that touches.").required("\"right\""),
    Key::vector(
        "target_m",
        Domain::POSITION,
        "The place that is meant, on a neighbour that collides.",
    )
    .required("[0.05, 0.013, 0.054]"),
    Key::number(
        "tolerance_m",
        Domain::LENGTH,
        "The largest distance of the tip from it that counts.",
    )
    .required("0.004"),
    Key::number("force_n", Domain::FORCE, "The force that is wanted.").required("0.15"),
    FORCE_TOLERANCE,
    Key::number(
        "hold_s",
        Domain::DURATION,
        "For how long in all, within both tolerances, with neither tip nor shaft of the tool at the organ.",
    )
    .required("3.0"),
    Key::number(
        "injury_force_n",
        Domain::FORCE,
        "A force above it injures what is touched: the attempt is over, and failed.",
    )
    .optional("0.5", "nothing is injured"),
    Key::text("holder", "The grasper that has to hold the organ meanwhile.")
        .optional("\"left\"", "none has to"),
    Key::number(
        "tear_force_n",
        Domain::FORCE,
        "A pull of the holder above it tears the tissue: the attempt is over, and failed.",
    )
    .optional("1.0", "it never tears"),
];

impl Goal {
    const TABLES: [&'static str; 4] = ["find", "traction", "cut", "touch"];

    pub(super) fn from_keys(keys: &Keys<'_>, around: &TaskScene<'_>) -> Result<Self, Error> {
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
                tool: named(&traction, "tool", around.tools)?,
                force_n: traction.required_number("force_n")?,
                tolerance_n: traction.required_number("tolerance_n")?,
                hold_s: traction.required_number("hold_s")?,
                direction: Self::direction(&traction)?,
                tear_force_n: Self::tear_force(&traction)?,
            });
        }
        if let Some(touch) = keys.table("touch")? {
            return TouchGoal::from_keys(&touch, around).map(Self::Touch);
        }
        match keys.table("cut")? {
            Some(cut) => Self::cut(&cut, around.layers),
            None => Ok(Self::Free),
        }
    }

    fn size(find: &Keys<'_>) -> Result<Option<SizeGoal>, Error> {
        let tolerance = find.number("diameter_tolerance_m")?;
        match find.number("radius_m")? {
            Some(radius_m) => Ok(Some(SizeGoal {
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
        let expected = "a force above `force_n`, for tissue that tears before cannot be held";
        above(traction, "tear_force_n", expected)
    }

    fn cut(cut: &Keys<'_>, layers: usize) -> Result<Self, Error> {
        let line = CutLine::from_keys(cut)?;
        let wanted = cut.integer_within("layers", 1..=layers.max(1) as u64)?;
        let wanted = wanted.map_or(layers.saturating_sub(1).max(1), |wanted| wanted as usize);
        Ok(Self::Cut {
            line,
            tolerance_m: cut.required_number("tolerance_m")?,
            layers: (layers > 0).then_some(wanted),
        })
    }
}

impl TouchGoal {
    fn from_keys(keys: &Keys<'_>, around: &TaskScene<'_>) -> Result<Self, Error> {
        let tool = named(keys, "tool", around.tools)?;
        let tool = tool.ok_or_else(|| keys.missing("tool", names(around.tools)))?;
        let holder = named(keys, "holder", around.tools)?;
        let is_grasper = |name: &String| {
            let mut tools = around.tools.iter();
            tools.any(|own| own.name == *name && own.kind == ToolKind::Grasper)
        };
        if holder
            .as_ref()
            .is_some_and(|name| *name == tool || !is_grasper(name))
        {
            return Err(keys.invalid("holder", "the other tool, a grasper"));
        }
        if holder.is_none() {
            keys.refuse("tear_force_n", "no such force, or the `holder` that pulls")?;
        }
        let target_m = keys.required_vector("target_m")?;
        if !around.neighbours.iter().any(|own| own.collides) {
            let expected =
                "a place of a `[[neighbour]]` with `collides = true`, and the scene has none";
            return Err(keys.invalid("target_m", expected));
        }
        Ok(Self {
            tool,
            target_m,
            tolerance_m: keys.required_number("tolerance_m")?,
            force_n: keys.required_number("force_n")?,
            tolerance_n: keys.required_number("tolerance_n")?,
            hold_s: keys.required_number("hold_s")?,
            injury_force_n: above(
                keys,
                "injury_force_n",
                "a force above `force_n`, for what is injured before cannot be touched",
            )?,
            holder,
            tear_force_n: keys.number("tear_force_n")?,
        })
    }
}

/// A force of `key` [N], which has to be above `force_n`.
fn above(keys: &Keys<'_>, key: &'static str, expected: &'static str) -> Result<Option<f64>, Error> {
    let wanted = keys.required_number("force_n")?;
    match keys.number(key)? {
        Some(force) if force <= wanted => Err(keys.invalid(key, expected)),
        force => Ok(force),
    }
}

/// The name of a tool that the scene has.
fn named(keys: &Keys<'_>, key: &'static str, tools: &[Tool]) -> Result<Option<String>, Error> {
    let name = keys.text(key)?;
    let is_known = |name: &String| tools.iter().any(|tool| tool.name == *name);
    match name {
        Some(name) if !is_known(&name) => Err(keys.invalid(key, names(tools))),
        name => Ok(name),
    }
}

fn names(tools: &[Tool]) -> String {
    let names: Vec<String> = tools
        .iter()
        .map(|tool| format!("{:?}", tool.name))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    format!("a tool of the scene, {}", or_list(&names))
}
