use serde::Serialize;

/// The figures of an answer, by kind, under the names of the contract.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Figures {
    /// A block under an indenter.
    Indentation {
        /// [m]
        depth_m: Vec<f64>,
        /// [N]
        force_n: Vec<f64>,
        /// Of a ramp [s].
        #[serde(skip_serializing_if = "Option::is_none")]
        time_s: Option<Vec<f64>>,
        /// Of an indenter with Coulomb friction.
        #[serde(flatten)]
        friction: Option<FrictionFigures>,
    },
    /// A patch of a hemisphere.
    Hemisphere {
        /// [m]
        depth_m: f64,
        /// [N]
        force_n: f64,
        /// Displacement of the surface.
        profile: Profile,
    },
    /// A tube under pressure, perhaps indented.
    Tube(TubeFigures),
    /// A bar.
    Uniaxial {
        /// [-]
        stretch: Vec<f64>,
        /// [Pa]
        nominal_stress_pa: Vec<f64>,
        /// Where the tissue has fibres, of the two of axis, across and normal that the bar is not pulled along, in this
        /// order [-].
        #[serde(skip_serializing_if = "Option::is_none")]
        lateral_stretch: Option<Vec<[f64; 2]>>,
    },
    /// An organ of any shape.
    Solid(SolidFigures),
}

impl Figures {
    /// Whether all are finite.
    pub(crate) fn are_numbers(&self) -> bool {
        let all = |lists: &[&[f64]]| lists.iter().all(|list| list.iter().all(|x| x.is_finite()));
        match self {
            Self::Indentation {
                force_n, friction, ..
            } => {
                let along = friction.as_ref().map_or(&[][..], |f| &f.tangential_force_n);
                all(&[force_n, along])
            }
            Self::Hemisphere {
                force_n, profile, ..
            } => all(&[&[*force_n], &profile.normal_displacement_m]),
            Self::Tube(tube) => {
                let known = |list: &[Option<f64>]| list.iter().copied().flatten().collect();
                let moved: Vec<f64> = known(&tube.inner_displacement_m);
                let forces: Vec<f64> = known(tube.force_n.as_deref().unwrap_or(&[]));
                all(&[&moved, &forces, &[tube.limit_pressure_pa.unwrap_or(0.0)]])
            }
            Self::Uniaxial {
                nominal_stress_pa, ..
            } => all(&[nominal_stress_pa]),
            Self::Solid(solid) => {
                let points = solid.points.iter();
                let force = solid.patch.as_ref().map_or([0.0; 3], |patch| patch.force_n);
                let tools = solid.tools.iter();
                all(&[&force, &solid.reaction_n])
                    && tools
                        .flat_map(|tool| tool.force_n.iter().flatten())
                        .all(|x| x.is_finite())
                    && points
                        .flat_map(|point| point.displacement_m)
                        .all(f64::is_finite)
            }
        }
    }
}

/// Contact of an indenter with Coulomb friction, at each depth or time.
#[derive(Debug, Clone, Serialize)]
pub struct FrictionFigures {
    /// Radius of the contact circle [m].
    pub contact_radius_m: Vec<f64>,
    /// Radius of the sticking circle [m].
    pub stick_radius_m: Vec<f64>,
    /// On the tissue along the surface, away from the axis, summed around it [N].
    pub tangential_force_n: Vec<f64>,
}

/// The surface of the hemisphere, from the pole to the equator.
#[derive(Debug, Clone, Serialize)]
pub struct Profile {
    /// From the pole along the surface [m].
    pub arc_m: Vec<f64>,
    /// Outward positive [m].
    pub normal_displacement_m: Vec<f64>,
}

/// The figures of a tube.
#[derive(Debug, Clone, Serialize)]
pub struct TubeFigures {
    /// [Pa]
    pub pressure_pa: Vec<f64>,
    /// Of the inner wall at mid-length; none beyond the limit.
    pub inner_displacement_m: Vec<Option<f64>>,
    /// None for a linear law, and where there is no limit.
    pub limit_pressure_pa: Option<f64>,
    /// [m]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth_m: Option<Vec<f64>>,
    /// [N]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<Vec<Option<f64>>>,
}

/// The figures of an organ of any shape.
#[derive(Debug, Clone, Serialize)]
pub struct SolidFigures {
    /// Of the patch, where there is one.
    #[serde(flatten)]
    pub patch: Option<PatchFigures>,
    /// Of the points of `points_m`, in their order, or else of the patch [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacement_m: Option<Displacements>,
    /// Reaction on the tissue at the fixed boundary [N].
    pub reaction_n: [f64; 3],
    /// Force on each tool, or on each of its jaws, at the positions of its path.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tools: Vec<ToolFigures>,
    /// Requested displacements.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<PointFigures>,
    /// The parts of the body, after the remainder.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionFigures>,
    /// The cavities.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cavities: Vec<CavityFigures>,
    /// Factor on the moduli of the tissues, where they were fitted [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_factor: Option<f64>,
    /// The fitted tissue.
    #[serde(skip)]
    pub tissue: Option<Box<palpate_files::Tissue>>,
}

/// A part of the body.
#[derive(Debug, Clone, Serialize)]
pub struct RegionFigures {
    /// Its name; `body` for the remainder.
    pub name: String,
    /// The name of its law.
    pub law: &'static str,
    /// On the finest mesh [m³].
    pub volume_m3: f64,
}

/// A cavity in the body.
#[derive(Debug, Clone, Serialize)]
pub struct CavityFigures {
    /// Its name.
    pub name: String,
    /// The pressure on its wall [Pa].
    pub pressure_pa: f64,
    /// Enclosed volume at rest, on the finest mesh [m³].
    pub volume_at_rest_m3: f64,
    /// Enclosed volume in the deformed body [m³].
    pub volume_m3: f64,
}

/// The figures of a rigid tool, or of one of its jaws, at each position of its path.
#[derive(Debug, Clone, Serialize)]
pub struct ToolFigures {
    /// Its name.
    pub name: String,
    /// Its position [m].
    pub position_m: Vec<[f64; 3]>,
    /// On the tool [N].
    pub force_n: Vec<[f64; 3]>,
    /// On the tool, about its position [N m].
    pub moment_n_m: Vec<[f64; 3]>,
    /// Normal to the tool's surface, summed over the contact [N].
    pub normal_force_n: Vec<f64>,
    /// Contact area at rest [m²].
    pub contact_area_m2: Vec<f64>,
    /// Slipping part of the contact area [m²].
    pub slipping_area_m2: Vec<f64>,
}

/// The figures of a patch that is moved.
#[derive(Debug, Clone, Serialize)]
pub struct PatchFigures {
    /// On the tool.
    pub force_n: [f64; 3],
    /// On the tissue, along the displacement: positive where the tissue resists.
    pub force_along_displacement_n: f64,
    /// Of the patch [m].
    pub patch_displacement_m: [f64; 3],
}

/// Displacements of a solid [m].
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Displacements {
    /// Of the patch.
    Patch([f64; 3]),
    /// Of points, in the order of `points_m`.
    Points(Vec<[f64; 3]>),
}

/// The figures of a point.
#[derive(Debug, Clone, Serialize)]
pub struct PointFigures {
    /// Its name.
    pub name: String,
    /// At rest [m].
    pub at_m: [f64; 3],
    /// [m]
    pub displacement_m: [f64; 3],
    /// Measured displacement along its direction [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_m: Option<f64>,
    /// The displacement along that direction, minus the measured one [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_m: Option<f64>,
}
