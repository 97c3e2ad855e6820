use crate::{Domain, Error, Estimate, Keys};

/// Parameters of models without geometry. They belong to one indenter on one specimen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Lumped {
    /// Two springs and a damper (6.3).
    pub kelvin: Option<Kelvin>,
    /// The exponential law on a column of effective size (6.2).
    pub column: Option<EffectiveColumn>,
    /// Three nonlinear springs (6.4).
    pub nonlinear_springs: Option<NonlinearSprings>,
}

/// A force that falls from `k1` to `k2` times the depth with the time constant b/k1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kelvin {
    /// Instantaneous stiffness [N/m].
    pub k1_n_per_m: Estimate,
    /// Stiffness after relaxation [N/m].
    pub k2_n_per_m: Estimate,
    /// Damping [N s/m].
    pub b_n_s_per_m: Estimate,
    /// Time constant, when it was fitted [s].
    pub tau_s: Option<Estimate>,
}

/// The exponential law of Blatz, Chu and Wayland in compression of a column that stands for the tissue under the indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectiveColumn {
    /// γ [Pa].
    pub gamma_pa: Estimate,
    /// α [-].
    pub alpha: Estimate,
    /// Cross-section of the column [m²].
    pub effective_area_m2: Estimate,
    /// Length of the column [m].
    pub effective_length_m: Estimate,
}

/// The parameters of (6.4) in newtons, millimetres and seconds, as the source prints them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NonlinearSprings {
    /// Factor of the spring of the static force [N/mm^k02].
    pub k01: Estimate,
    /// Exponent of the spring of the static force [-].
    pub k02: Estimate,
    /// First parameter of the first relaxing spring [N, mm, s].
    pub k11: Estimate,
    /// Second parameter of the first relaxing spring [N, mm, s].
    pub k12: Estimate,
    /// Third parameter of the first relaxing spring [N, mm, s].
    pub k13: Estimate,
    /// First parameter of the second relaxing spring [N, mm, s].
    pub k21: Estimate,
    /// Second parameter of the second relaxing spring [N, mm, s].
    pub k22: Estimate,
    /// Third parameter of the second relaxing spring [N, mm, s].
    pub k23: Estimate,
}

impl Lumped {
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        // The first version called the column `blatz`, as if it were the tissue's law.
        let known = &["kelvin", "column", "blatz", "nonlinear_springs"];
        let Some(lumped) = keys.table("lumped", known)? else {
            return Ok(Self::default());
        };
        let kelvin = lumped.table("kelvin", Kelvin::KEYS)?;
        let column = lumped.table("column", EffectiveColumn::KEYS)?;
        let former = lumped.table("blatz", EffectiveColumn::KEYS)?;
        if column.is_some() && former.is_some() {
            return Err(lumped.given_twice("column", "blatz"));
        }
        let springs = lumped.table("nonlinear_springs", &NonlinearSprings::KEYS)?;
        Ok(Self {
            kelvin: kelvin.map(|keys| Kelvin::from_keys(&keys)).transpose()?,
            column: column
                .or(former)
                .map(|keys| EffectiveColumn::from_keys(&keys))
                .transpose()?,
            nonlinear_springs: springs
                .map(|keys| NonlinearSprings::from_keys(&keys))
                .transpose()?,
        })
    }

    /// The tables that are there, each with its keys.
    pub fn tables(&self) -> Vec<(&'static str, Vec<(&'static str, Estimate)>)> {
        [
            self.kelvin.map(|kelvin| ("kelvin", kelvin.parameters())),
            self.column.map(|column| ("column", column.parameters())),
            self.nonlinear_springs
                .map(|springs| ("nonlinear_springs", springs.parameters())),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

impl Kelvin {
    const KEYS: &[&str] = &["k1_n_per_m", "k2_n_per_m", "b_n_s_per_m", "tau_s"];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            k1_n_per_m: keys.required_estimate("k1_n_per_m", Domain::STIFFNESS)?,
            k2_n_per_m: keys.required_estimate("k2_n_per_m", Domain::STIFFNESS_OR_NONE)?,
            b_n_s_per_m: keys.required_estimate("b_n_s_per_m", Domain::DAMPING)?,
            tau_s: keys.estimate("tau_s", Domain::TIME_CONSTANT)?,
        })
    }

    fn parameters(&self) -> Vec<(&'static str, Estimate)> {
        let mut parameters = vec![
            ("k1_n_per_m", self.k1_n_per_m),
            ("k2_n_per_m", self.k2_n_per_m),
            ("b_n_s_per_m", self.b_n_s_per_m),
        ];
        parameters.extend(self.tau_s.map(|tau_s| ("tau_s", tau_s)));
        parameters
    }
}

impl EffectiveColumn {
    const KEYS: &[&str] = &[
        "gamma_pa",
        "alpha",
        "effective_area_m2",
        "effective_length_m",
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            gamma_pa: keys.required_estimate("gamma_pa", Domain::MODULUS)?,
            alpha: keys.required_estimate("alpha", Domain::EXPONENT)?,
            effective_area_m2: keys.required_estimate("effective_area_m2", Domain::AREA)?,
            effective_length_m: keys.required_estimate("effective_length_m", Domain::LENGTH)?,
        })
    }

    fn parameters(&self) -> Vec<(&'static str, Estimate)> {
        vec![
            ("gamma_pa", self.gamma_pa),
            ("alpha", self.alpha),
            ("effective_area_m2", self.effective_area_m2),
            ("effective_length_m", self.effective_length_m),
        ]
    }
}

impl NonlinearSprings {
    /// What the parameters are called, in their order.
    pub const KEYS: [&str; 8] = ["k01", "k02", "k11", "k12", "k13", "k21", "k22", "k23"];

    /// With these parameters [N, mm, s], in the order of [`Self::KEYS`].
    pub fn of(values: [Estimate; 8]) -> Self {
        let [k01, k02, k11, k12, k13, k21, k22, k23] = values;
        Self {
            k01,
            k02,
            k11,
            k12,
            k13,
            k21,
            k22,
            k23,
        }
    }

    /// The parameters [N, mm, s], in the order of [`Self::KEYS`].
    pub fn values(&self) -> [Estimate; 8] {
        [
            self.k01, self.k02, self.k11, self.k12, self.k13, self.k21, self.k22, self.k23,
        ]
    }

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let mut values = [Estimate::exactly(0.0); 8];
        for (value, key) in values.iter_mut().zip(Self::KEYS) {
            *value = keys.required_estimate(key, Domain::FINITE)?;
        }
        Ok(Self::of(values))
    }

    fn parameters(&self) -> Vec<(&'static str, Estimate)> {
        Self::KEYS.into_iter().zip(self.values()).collect()
    }
}
