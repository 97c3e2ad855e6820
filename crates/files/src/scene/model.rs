use super::model_words::{
    Assembly, Calibration, EnhancementArea, Form, HandOver, IntegrationPoints, ModelKind,
    Placement, ResponseMethod, Smoothing, Solver,
};
use super::{Organ, Shape, Tool, ToolKind};
use crate::{Domain, Error, Key, Keys, Word};

/// The model of the organ, with the settings of every kind of model; those of other kinds are stored but not used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model {
    /// The kind of model.
    pub kind: ModelKind,
    /// The reason for the kind, where the scene leaves the choice (`kind = "auto"`).
    pub reason: Option<&'static str>,
    /// The period of the model thread [s].
    pub step_s: f64,
    /// Settings of the finite spheres.
    pub local: LocalSettings,
    /// Settings of the hybrid model's refinement.
    pub enhancement: Enhancement,
    /// The largest number of triangles with the hybrid model's mechanics; the displayed surface has its own. The
    /// model chooses the default.
    pub mechanical_triangles: Option<usize>,
    /// The approximate number of nodes with the nonlinear model's mechanics. The model chooses the default.
    pub nodes: Option<usize>,
    /// Gravitational acceleration on the nonlinear model's organ [m/s²]; none where the mesh is the organ under its
    /// own weight.
    pub gravity_m_per_s2: Option<[f64; 3]>,
    /// The solver of the hybrid model's response.
    pub response: ResponseMethod,
    /// The quantity that the model hands over to the servo loop.
    pub hand_over: HandOver,
    /// Factor on every force that a device displays [-]; the factor itself is shown and recorded, forces are recorded
    /// without it.
    pub force_scale: f64,
}

/// Settings of the finite spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LocalSettings {
    /// The number of particles around a tool.
    pub particles: usize,
    /// The form of the equations.
    pub form: Form,
    /// The placement of the particles.
    pub placement: Placement,
    /// The solver of the equations.
    pub solver: Solver,
    /// When the equations are assembled.
    pub assembly: Assembly,
    /// The number of integration points.
    pub integration_points: IntegrationPoints,
    /// The calibration of the force.
    pub calibration: Calibration,
}

/// Settings of the refinement around a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Enhancement {
    /// The area that is refined.
    pub area: EnhancementArea,
    /// The number of subdivisions of each triangle into four.
    pub levels: usize,
    /// The interpolation of displacements over it.
    pub smoothing: Smoothing,
}

impl Default for LocalSettings {
    fn default() -> Self {
        Self {
            particles: 34,
            form: Form::Weak,
            placement: Placement::Template,
            solver: Solver::Direct,
            assembly: Assembly::EveryStep,
            integration_points: IntegrationPoints::Standard,
            calibration: Calibration::Fitted,
        }
    }
}

impl Default for Enhancement {
    fn default() -> Self {
        Self {
            area: EnhancementArea::None,
            levels: 1,
            smoothing: Smoothing::None,
        }
    }
}

impl Default for Model {
    fn default() -> Self {
        Self {
            kind: ModelKind::Local,
            reason: None,
            // The source's 200 Hz.
            step_s: 0.005,
            local: LocalSettings::default(),
            enhancement: Enhancement::default(),
            mechanical_triangles: None,
            nodes: None,
            gravity_m_per_s2: None,
            response: ResponseMethod::Automatic,
            hand_over: HandOver::LocalModel,
            force_scale: 1.0,
        }
    }
}

/// The kinds of model in a scene; none leaves the choice.
const CHOICES: &[(&str, Option<ModelKind>)] = &[
    ("local", Some(ModelKind::Local)),
    ("hybrid", Some(ModelKind::Hybrid)),
    ("nonlinear", Some(ModelKind::Nonlinear)),
    ("auto", None),
];

const CHOICE_MEANINGS: &[Word] = &[
    ModelKind::MEANINGS[0],
    ModelKind::MEANINGS[1],
    ModelKind::MEANINGS[2],
    (
        "auto",
        "The fastest model that supports these tools; a message states which, and why.",
    ),
];

/// Requirements of a scene on its model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Requirements {
    /// Whether it has settings for cutting.
    pub(super) cuts: bool,
    /// Whether neighbours bend, or the organ touches itself.
    pub(super) bends: bool,
    /// Whether a body has cavities.
    pub(super) is_hollow: bool,
}

/// The simplest model that supports these tools, and the reason.
fn choose(organ: &Organ, tools: &[Tool], requirements: Requirements) -> (ModelKind, &'static str) {
    let any = |kinds: &[ToolKind]| tools.iter().any(|tool| kinds.contains(&tool.kind));
    let is_fixed = organ.anchor.is_some() || matches!(organ.shape, Shape::Builtin { .. });
    if !is_fixed {
        let reason = "the scene does not say where its mesh is fixed (organ.anchor)";
        return (ModelKind::Local, reason);
    }
    if requirements.bends {
        let reason = "it alone has bodies that bend and touch";
        (ModelKind::Nonlinear, reason)
    } else if requirements.is_hollow {
        (ModelKind::Nonlinear, "it alone has cavities")
    } else if requirements.cuts || any(&[ToolKind::Scissors, ToolKind::Hook]) {
        (ModelKind::Hybrid, "its forces change while a blade cuts")
    } else if !organ.layers.is_empty() {
        (
            ModelKind::Hybrid,
            "it feels layers, and its forces change as they open",
        )
    } else if any(&[ToolKind::Grasper]) {
        let reason = "a grasper pulls and lifts, and it alone is right at large deformation";
        (ModelKind::Nonlinear, reason)
    } else if !organ.inclusions.is_empty() {
        (
            ModelKind::Hybrid,
            "it feels inclusions at no cost in a step",
        )
    } else {
        (
            ModelKind::Local,
            "probes press, and it needs no preparation",
        )
    }
}

impl Model {
    pub(super) const KEYS: &'static [Key] = &[
        Key::word("kind", CHOICE_MEANINGS, "Which model.").default("\"local\""),
        Key::number("step_s", Domain::STEP, "The period of the model's steps.").default("0.005"),
        // Fewer than 12 do not fill two shells; the equations are dense, so that more than a few hundred take far
        // longer than a step.
        Key::integer(
            "particles",
            12,
            600,
            "Local model: how many particles stand around a tool.",
        )
        .default("34"),
        Key::word("form", Form::MEANINGS, "Local model: the form of the equations.")
            .default("\"weak\""),
        Key::word("placement", Placement::MEANINGS, "Local model: where the particles stand.")
            .default("\"template\""),
        Key::word("solver", Solver::MEANINGS, "Local model: how the equations are solved.")
            .default("\"direct\""),
        Key::word(
            "assembly",
            Assembly::MEANINGS,
            "Local model: when the equations are put together.",
        )
        .default("\"every_step\""),
        Key::integer(
            "integration_points",
            0,
            u64::MAX,
            "Local model: at how many points the equations are integrated: 130, 415 or 957.",
        )
        .default("415"),
        Key::word(
            "calibration",
            Calibration::MEANINGS,
            "Local model: what makes a force of the solution.",
        )
        .default("\"fitted\""),
        Key::table(
            "enhancement",
            Enhancement::KEYS,
            "Hybrid model: how the area around a contact is refined.",
        )
        .optional("", "it is not"),
        // A few dozen triangles are no organ; with twenty thousand the matrices take gigabytes.
        Key::integer(
            "mechanical_triangles",
            48,
            20_000,
            "Hybrid model: how many triangles carry the mechanics at most; the shown surface keeps its own.",
        )
        .optional("2000", "chosen by the model"),
        // Fewer resolve nothing; with more the influences of the surface take gigabytes, and a step its period.
        Key::integer(
            "nodes",
            200,
            6_000,
            "Nonlinear model: about how many nodes carry the mechanics.",
        )
        .optional("1500", "chosen by the model"),
        Key::vector(
            "gravity_m_per_s2",
            Domain::ACCELERATION,
            "Nonlinear model: the acceleration by which the organ hangs under its own weight.",
        )
        .optional("[0.0, 0.0, -9.81]", "the mesh is the organ as it hangs"),
        Key::word(
            "response",
            ResponseMethod::MEANINGS,
            "Hybrid model: how the response of the organ is solved.",
        )
        .default("\"automatic\""),
        Key::word(
            "hand_over",
            HandOver::MEANINGS,
            "What the servo loop gets between two steps.",
        )
        .default("\"local_model\""),
        Key::number(
            "force_scale",
            Domain::FACTOR,
            "Factor on every force that a device displays; forces are recorded without it.",
        )
        .default("1.0"),
    ];

    /// The model of a scene; organ, tools and the other `requirements` decide the choice of `auto`.
    pub(super) fn from_keys(
        keys: Option<&Keys<'_>>,
        organ: &Organ,
        tools: &[Tool],
        requirements: Requirements,
    ) -> Result<Self, Error> {
        let default = Self::default();
        let Some(keys) = keys else {
            return Ok(default);
        };
        let triangles = keys.integer("mechanical_triangles")?;
        let nodes = keys.integer("nodes")?;
        let or = |key, or: f64| Ok(keys.number(key)?.unwrap_or(or));
        let (kind, reason) = match keys.word("kind", CHOICES)? {
            None => (default.kind, None),
            Some(Some(kind)) => (kind, None),
            Some(None) => {
                let (kind, reason) = choose(organ, tools, requirements);
                (kind, Some(reason))
            }
        };
        Ok(Self {
            kind,
            reason,
            step_s: or("step_s", default.step_s)?,
            local: LocalSettings::from_keys(keys)?,
            enhancement: Enhancement::from_keys(keys)?,
            mechanical_triangles: triangles.map(|number| number as usize),
            nodes: nodes.map(|number| number as usize),
            gravity_m_per_s2: keys.vector("gravity_m_per_s2")?,
            response: keys
                .word("response", ResponseMethod::WORDS)?
                .unwrap_or(default.response),
            hand_over: keys
                .word("hand_over", HandOver::WORDS)?
                .unwrap_or(default.hand_over),
            force_scale: or("force_scale", default.force_scale)?,
        })
    }
}

impl LocalSettings {
    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let default = Self::default();
        let particles = keys.integer("particles")?;
        let settings = Self {
            particles: particles.map_or(default.particles, |number| number as usize),
            form: keys.word("form", Form::WORDS)?.unwrap_or(default.form),
            placement: keys
                .word("placement", Placement::WORDS)?
                .unwrap_or(default.placement),
            solver: keys
                .word("solver", Solver::WORDS)?
                .unwrap_or(default.solver),
            assembly: keys
                .word("assembly", Assembly::WORDS)?
                .unwrap_or(default.assembly),
            integration_points: integration_points(keys)?,
            calibration: keys
                .word("calibration", Calibration::WORDS)?
                .unwrap_or(default.calibration),
        };
        if settings.assembly == Assembly::Reused && settings.placement == Placement::Source {
            return Err(keys.invalid(
                "assembly",
                "\"every_step\", for particles placed on the mesh are elsewhere at each contact",
            ));
        }
        Ok(settings)
    }
}

fn integration_points(keys: &Keys<'_>) -> Result<IntegrationPoints, Error> {
    match keys.integer("integration_points")? {
        None | Some(415) => Ok(IntegrationPoints::Standard),
        Some(130) => Ok(IntegrationPoints::Few),
        Some(957) => Ok(IntegrationPoints::Many),
        Some(_) => Err(keys.invalid("integration_points", "130, 415 or 957")),
    }
}

impl Enhancement {
    const KEYS: &[Key] = &[
        Key::word(
            "area",
            EnhancementArea::MEANINGS,
            "The area that is refined.",
        )
        .default("\"none\""),
        // Each level makes four triangles of one; six make 4096.
        Key::integer(
            "levels",
            0,
            6,
            "How often each triangle is divided into four.",
        )
        .default("1"),
        Key::word(
            "smoothing",
            Smoothing::MEANINGS,
            "How displacements are spread over it.",
        )
        .default("\"none\""),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let default = Self::default();
        let Some(keys) = keys.table("enhancement")? else {
            return Ok(default);
        };
        let levels = keys.integer("levels")?;
        Ok(Self {
            area: keys
                .word("area", EnhancementArea::WORDS)?
                .unwrap_or(default.area),
            levels: levels.map_or(default.levels, |number| number as usize),
            smoothing: keys
                .word("smoothing", Smoothing::WORDS)?
                .unwrap_or(default.smoothing),
        })
    }
}
