use serde::Serialize;

/// The figures of an answer, by kind, under the names of the contract.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub(in super::super) enum Figures {
    Indentation {
        depth_m: Vec<f64>,
        force_n: Vec<f64>,
        #[serde(skip_serializing_if = "Option::is_none")]
        time_s: Option<Vec<f64>>,
    },
    Hemisphere {
        depth_m: f64,
        force_n: f64,
        profile: Profile,
    },
    Tube(TubeFigures),
    Uniaxial {
        stretch: Vec<f64>,
        nominal_stress_pa: Vec<f64>,
    },
    Solid {
        /// On the tool.
        force_n: [f64; 3],
        /// On the tissue, along the displacement: positive where the tissue resists.
        force_along_displacement_n: f64,
        displacement_m: [f64; 3],
    },
}

impl Figures {
    /// Whether all are finite.
    pub(super) fn are_numbers(&self) -> bool {
        let all = |lists: &[&[f64]]| lists.iter().all(|list| list.iter().all(|x| x.is_finite()));
        match self {
            Self::Indentation { force_n, .. } => all(&[force_n]),
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
            Self::Solid { force_n, .. } => all(&[force_n]),
        }
    }
}

/// The surface of the hemisphere, from the pole to the equator.
#[derive(Debug, Clone, Serialize)]
pub(in super::super) struct Profile {
    pub(in super::super) arc_m: Vec<f64>,
    pub(in super::super) normal_displacement_m: Vec<f64>,
}

#[derive(Debug, Clone, Serialize)]
pub(in super::super) struct TubeFigures {
    pub(in super::super) pressure_pa: Vec<f64>,
    /// Of the inner wall at mid-length; none beyond the limit.
    pub(in super::super) inner_displacement_m: Vec<Option<f64>>,
    /// None for a linear law, and where there is no limit.
    pub(in super::super) limit_pressure_pa: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in super::super) depth_m: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in super::super) force_n: Option<Vec<Option<f64>>>,
}
