use crate::Error;

/// A parameter of a fit. All its numbers are in the unit that its name ends with.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name, ending with its unit as the keys of files do: `c10_pa`.
    pub name: String,
    /// Start value, and after the fit its result.
    pub value: f64,
    /// The least it may be.
    pub lower: f64,
    /// The most it may be.
    pub upper: f64,
    /// The size of a significant change, above zero.
    pub scale: f64,
    /// Whether the fit leaves it unchanged.
    pub fixed: bool,
}

impl Parameter {
    /// A free parameter without bounds. Its scale is its size, or one when it starts at zero.
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        Self {
            name: name.into(),
            value,
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            scale: if value == 0.0 { 1.0 } else { value.abs() },
            fixed: false,
        }
    }

    /// The same between bounds.
    pub fn within(self, lower: f64, upper: f64) -> Self {
        Self {
            lower,
            upper,
            ..self
        }
    }

    /// The same with another scale.
    pub fn scaled(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    /// The same, fixed at its value.
    pub fn fixed(self) -> Self {
        Self {
            fixed: true,
            ..self
        }
    }

    /// Whether it has come to lie on one of its bounds.
    pub fn at_bound(&self) -> bool {
        self.value <= self.lower || self.value >= self.upper
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        let ordered = self.lower <= self.value && self.value <= self.upper;
        if ordered && self.value.is_finite() && self.scale > 0.0 && self.scale.is_finite() {
            return Ok(());
        }
        Err(Error::BadParameter {
            parameter: Box::new(self.clone()),
        })
    }
}
