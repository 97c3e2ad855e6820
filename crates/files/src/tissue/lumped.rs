use crate::{Domain, Error, Estimate, Key, Keys};

/// Parameters of models without geometry. They apply to one indenter on one specimen.
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
    pub(super) const KEYS: &[Key] = &[
        Key::table("kelvin", Kelvin::KEYS, "Two springs and a damper (6.3).").optional("", "none"),
        Key::table(
            "column",
            EffectiveColumn::KEYS,
            "The exponential law on a column of effective size (6.2).",
        )
        .optional("", "none"),
        // The first version called the column `blatz`, as if it were the tissue's law.
        Key::table(
            "blatz",
            EffectiveColumn::KEYS,
            "What earlier versions call `column`.",
        )
        .optional("", "none"),
        Key::table(
            "nonlinear_springs",
            NonlinearSprings::KEYS,
            "Three nonlinear springs (6.4), in newtons, millimetres and seconds.",
        )
        .optional("", "none"),
    ];

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let Some(lumped) = keys.table("lumped")? else {
            return Ok(Self::default());
        };
        let kelvin = lumped.table("kelvin")?;
        let column = lumped.table("column")?;
        let former = lumped.table("blatz")?;
        if column.is_some() && former.is_some() {
            return Err(lumped.given_twice("column", "blatz"));
        }
        let springs = lumped.table("nonlinear_springs")?;
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
    const KEYS: &[Key] = &[
        Key::estimate("k1_n_per_m", Domain::STIFFNESS, "Instantaneous stiffness.").required("50.0"),
        Key::estimate(
            "k2_n_per_m",
            Domain::STIFFNESS_OR_NONE,
            "Stiffness after relaxation.",
        )
        .required("30.0"),
        Key::estimate("b_n_s_per_m", Domain::DAMPING, "Damping.").required("40.0"),
        Key::estimate(
            "tau_s",
            Domain::TIME_CONSTANT,
            "Time constant, when it was fitted.",
        )
        .optional("0.8", "it was not fitted"),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            k1_n_per_m: keys.required_estimate("k1_n_per_m")?,
            k2_n_per_m: keys.required_estimate("k2_n_per_m")?,
            b_n_s_per_m: keys.required_estimate("b_n_s_per_m")?,
            tau_s: keys.estimate("tau_s")?,
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
    const KEYS: &[Key] = &[
        Key::estimate("gamma_pa", Domain::MODULUS, "gamma.").required("2667.0"),
        Key::estimate("alpha", Domain::EXPONENT, "alpha.").required("0.5"),
        Key::estimate(
            "effective_area_m2",
            Domain::AREA,
            "Cross-section of the column.",
        )
        .required("3.0e-5"),
        Key::estimate(
            "effective_length_m",
            Domain::LENGTH,
            "Length of the column.",
        )
        .required("0.01"),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            gamma_pa: keys.required_estimate("gamma_pa")?,
            alpha: keys.required_estimate("alpha")?,
            effective_area_m2: keys.required_estimate("effective_area_m2")?,
            effective_length_m: keys.required_estimate("effective_length_m")?,
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

const fn parameter(name: &'static str, meaning: &'static str) -> Key {
    Key::estimate(name, Domain::FINITE, meaning).required("1.0")
}

impl NonlinearSprings {
    /// The names of the parameters, in their order.
    pub const NAMES: [&str; 8] = ["k01", "k02", "k11", "k12", "k13", "k21", "k22", "k23"];

    const KEYS: &[Key] = &[
        parameter(
            "k01",
            "Factor of the spring of the static force, in N/mm^k02.",
        ),
        parameter("k02", "Exponent of the spring of the static force."),
        parameter("k11", "First parameter of the first relaxing spring."),
        parameter("k12", "Second parameter of the first relaxing spring."),
        parameter("k13", "Third parameter of the first relaxing spring."),
        parameter("k21", "First parameter of the second relaxing spring."),
        parameter("k22", "Second parameter of the second relaxing spring."),
        parameter("k23", "Third parameter of the second relaxing spring."),
    ];

    /// With these parameters [N, mm, s], in the order of [`Self::NAMES`].
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

    /// The parameters [N, mm, s], in the order of [`Self::NAMES`].
    pub fn values(&self) -> [Estimate; 8] {
        [
            self.k01, self.k02, self.k11, self.k12, self.k13, self.k21, self.k22, self.k23,
        ]
    }

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let mut values = [Estimate::exactly(0.0); 8];
        for (value, key) in values.iter_mut().zip(Self::NAMES) {
            *value = keys.required_estimate(key)?;
        }
        Ok(Self::of(values))
    }

    fn parameters(&self) -> Vec<(&'static str, Estimate)> {
        Self::NAMES.into_iter().zip(self.values()).collect()
    }
}
