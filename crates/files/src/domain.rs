/// The numbers that a key or a column may hold, with the words that say so in an error.
#[derive(Debug, Clone, Copy)]
pub struct Domain {
    /// The end of the sentence "give ...".
    pub expected: &'static str,
    /// Whether a number belongs to it. Asked only for finite numbers.
    pub holds: fn(f64) -> bool,
}

impl Domain {
    /// Any finite number.
    pub const FINITE: Self = Self {
        expected: "a finite number",
        holds: |_| true,
    };
    /// A finite number above zero.
    pub const POSITIVE: Self = Self {
        expected: "a number above 0",
        holds: |x| x > 0.0,
    };
    /// Zero or a finite number above it.
    pub const NOT_NEGATIVE: Self = Self {
        expected: "0 or a number above 0",
        holds: |x| x >= 0.0,
    };
    /// From zero to one, both included.
    pub const FRACTION: Self = Self {
        expected: "a number from 0 to 1",
        holds: |x| (0.0..=1.0).contains(&x),
    };

    /// An angle between an axis and a side [degrees].
    pub const HALF_ANGLE: Self = Self {
        expected: "an angle above 0 and below 90 degrees",
        holds: |angle| 0.0 < angle && angle < 90.0,
    };

    /// Whether `value` may be used: finite and inside.
    pub fn contains(&self, value: f64) -> bool {
        value.is_finite() && (self.holds)(value)
    }
}
