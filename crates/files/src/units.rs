//! Units carried in names: `depth_mm` is read wherever `depth_m` is expected, and converted.
//!
//! A name is a base and the suffix of a unit, `depth` and `mm`. One table holds every unit; those with the same SI
//! unit may replace one another. A suffix is accepted in lower case (`force_mn`) and as the unit is spelled
//! (`force_mN`), in no other way: `mPa` is not read as `MPa`.

/// A unit of measurement: one `spelling` is `multiply / divide` of the SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// The end of a name in this unit, without the underscore: `mm`, `n_per_m`.
    pub suffix: &'static str,
    /// The unit as it is printed: `mm`, `N/m`.
    pub spelling: &'static str,
    /// The suffix of the SI unit that measures the same.
    pub si: &'static str,
    /// Numerator of the unit's size in the SI unit [-].
    pub multiply: f64,
    /// Denominator of the unit's size in the SI unit [-]. Kept apart, because 5 / 1000 is the
    /// number nearest to 0.005 and 5 × 0.001 need not be.
    pub divide: f64,
}

const fn unit(
    suffix: &'static str,
    spelling: &'static str,
    si: &'static str,
    multiply: f64,
    divide: f64,
) -> Unit {
    Unit {
        suffix,
        spelling,
        si,
        multiply,
        divide,
    }
}

/// Every unit that a name may carry.
pub const UNITS: &[Unit] = &[
    unit("m", "m", "m", 1.0, 1.0),
    unit("cm", "cm", "m", 1.0, 100.0),
    unit("mm", "mm", "m", 1.0, 1e3),
    unit("um", "um", "m", 1.0, 1e6),
    unit("nm", "nm", "m", 1.0, 1e9),
    unit("m2", "m^2", "m2", 1.0, 1.0),
    unit("cm2", "cm^2", "m2", 1.0, 1e4),
    unit("mm2", "mm^2", "m2", 1.0, 1e6),
    unit("s", "s", "s", 1.0, 1.0),
    unit("ms", "ms", "s", 1.0, 1e3),
    unit("us", "us", "s", 1.0, 1e6),
    unit("min", "min", "s", 60.0, 1.0),
    unit("h", "h", "s", 3600.0, 1.0),
    unit("hz", "Hz", "hz", 1.0, 1.0),
    unit("khz", "kHz", "hz", 1e3, 1.0),
    unit("n", "N", "n", 1.0, 1.0),
    unit("kn", "kN", "n", 1e3, 1.0),
    unit("mn", "mN", "n", 1.0, 1e3),
    unit("un", "uN", "n", 1.0, 1e6),
    unit("nn", "nN", "n", 1.0, 1e9),
    unit("gf", "gf", "n", 9.806_65, 1e3),
    unit("kgf", "kgf", "n", 9.806_65, 1.0),
    unit("n_m", "N m", "n_m", 1.0, 1.0),
    unit("n_mm", "N mm", "n_m", 1.0, 1e3),
    unit("mn_m", "mN m", "n_m", 1.0, 1e3),
    unit("pa", "Pa", "pa", 1.0, 1.0),
    unit("kpa", "kPa", "pa", 1e3, 1.0),
    unit("mpa", "MPa", "pa", 1e6, 1.0),
    unit("gpa", "GPa", "pa", 1e9, 1.0),
    unit("mmhg", "mmHg", "pa", 133.322_387_415, 1.0),
    unit("kg", "kg", "kg", 1.0, 1.0),
    unit("g", "g", "kg", 1.0, 1e3),
    unit("m_per_s", "m/s", "m_per_s", 1.0, 1.0),
    unit("mm_per_s", "mm/s", "m_per_s", 1.0, 1e3),
    unit("mm_per_min", "mm/min", "m_per_s", 1.0, 6e4),
    unit("kg_m3", "kg/m^3", "kg_m3", 1.0, 1.0),
    unit("g_cm3", "g/cm^3", "kg_m3", 1e3, 1.0),
    unit("kg_per_m3", "kg/m^3", "kg_m3", 1.0, 1.0),
    unit("g_per_cm3", "g/cm^3", "kg_m3", 1e3, 1.0),
    unit("one", "-", "one", 1.0, 1.0),
    unit("percent", "%", "one", 1.0, 100.0),
    unit("rad", "rad", "rad", 1.0, 1.0),
    unit("deg", "deg", "rad", std::f64::consts::PI, 180.0),
    unit("n_per_m", "N/m", "n_per_m", 1.0, 1.0),
    unit("n_per_mm", "N/mm", "n_per_m", 1e3, 1.0),
    unit("n_s_per_m", "N s/m", "n_s_per_m", 1.0, 1.0),
    unit("n_s_per_mm", "N s/mm", "n_s_per_m", 1e3, 1.0),
    unit("m_per_v", "m/V", "m_per_v", 1.0, 1.0),
    unit("nm_per_v", "nm/V", "m_per_v", 1.0, 1e9),
    unit("j_per_m2", "J/m^2", "j_per_m2", 1.0, 1.0),
    unit("kj_per_m2", "kJ/m^2", "j_per_m2", 1e3, 1.0),
    unit("j", "J", "j", 1.0, 1.0),
    unit("mj", "mJ", "j", 1.0, 1e3),
    unit("uj", "uJ", "j", 1.0, 1e6),
];

impl Unit {
    /// The unit that `text` names, by its suffix or its spelling; a micro sign reads as `u`.
    pub fn named(text: &str) -> Option<&'static Self> {
        let text = text.replace(['µ', 'μ'], "u");
        written(&text)
    }

    /// The units that measure the same as this one, itself included.
    pub fn alternatives(&self) -> impl Iterator<Item = &'static Self> + use<> {
        let si = self.si;
        UNITS.iter().filter(move |unit| unit.si == si)
    }

    /// `value` [this unit] expressed in `other`, a unit that measures the same.
    pub fn convert(&self, value: f64, other: &Self) -> f64 {
        // A value already in the unit asked for keeps every bit.
        if self == other {
            return value;
        }
        value * (self.multiply * other.divide) / (self.divide * other.multiply)
    }
}

/// The base and the unit of a `name` such as `depth_mm`; none when it carries no unit.
pub fn split(name: &str) -> Option<(&str, &'static Unit)> {
    // The longest suffix wins, so that `k1_n_per_mm` is not read as millimetres.
    let places = name.match_indices('_').filter(|(place, _)| *place > 0);
    places
        .map(|(place, _)| (&name[..place], &name[place + 1..]))
        .find_map(|(base, end)| Some((base, written(end)?)))
}

fn written(end: &str) -> Option<&'static Unit> {
    UNITS
        .iter()
        .find(|unit| unit.suffix == end || unit.spelling == end)
}

/// The match of a given name with an expected one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Match {
    /// The same name.
    Exact,
    /// The same quantity in the first unit, expected in the second.
    Converted(&'static Unit, &'static Unit),
}

impl Match {
    /// `value` [unit of the given name] in the unit of the expected name.
    pub(crate) fn convert(self, value: f64) -> f64 {
        match self {
            Self::Exact => value,
            Self::Converted(from, to) => from.convert(value, to),
        }
    }
}

/// Whether `given` names the quantity of `expected`, perhaps in another unit.
pub(crate) fn matches(given: &str, expected: &str) -> Option<Match> {
    if given == expected {
        return Some(Match::Exact);
    }
    let (base, to) = split(expected)?;
    let (given_base, from) = split(given)?;
    (base == given_base && from.si == to.si).then_some(Match::Converted(from, to))
}

/// The names that would be accepted instead of `given`, when `given` has the base of `expected` but
/// no unit or one that does not fit: "`depth_m`, `depth_cm` or ...".
pub(crate) fn accepted_instead(given: &str, expected: &str) -> Option<String> {
    let (base, unit) = split(expected)?;
    let end = given.strip_prefix(base)?;
    // `tau_standard_eror_s` is a misspelled key, not `tau` in a strange unit.
    let looks_like_unit = end.is_empty()
        || end
            .strip_prefix('_')
            .is_some_and(|end| Unit::named(end).is_some() || !end.contains('_'));
    (looks_like_unit && matches(given, expected).is_none()).then(|| {
        let names: Vec<_> = unit
            .alternatives()
            .map(|unit| format!("`{base}_{}`", unit.suffix))
            .collect();
        crate::words::or_list(&names)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_suffix_wins() {
        assert_eq!(
            split("k1_n_per_mm").map(|(b, u)| (b, u.spelling)),
            Some(("k1", "N/mm"))
        );
        assert_eq!(split("density_kg_m3").map(|(b, _)| b), Some("density"));
        assert_eq!(
            split("min_mm").map(|(b, u)| (b, u.suffix)),
            Some(("min", "mm"))
        );
        assert_eq!(split("hand_over"), None);
        assert_eq!(split("_mm"), None);
    }

    #[test]
    fn decimal_conversions_are_nearest() {
        let convert = |given, expected, value| matches(given, expected).map(|m| m.convert(value));
        assert_eq!(convert("depth_mm", "depth_m", 5.0), Some(0.005));
        assert_eq!(convert("force_mN", "force_n", 23.0), Some(0.023));
        assert_eq!(convert("force_mn", "force_n", 23.0), Some(0.023));
        assert_eq!(convert("tau_ms", "tau_s", 250.0), Some(0.25));
        assert_eq!(
            convert("pressure_mmhg", "pressure_pa", 30.0),
            Some(3999.67162245)
        );
        assert_eq!(
            convert("angle_rad", "angle_deg", std::f64::consts::PI),
            Some(180.0)
        );
        assert_eq!(
            convert("youngs_modulus_kpa", "youngs_modulus_pa", 10.0),
            Some(1e4)
        );
        assert_eq!(convert("depth_n", "depth_m", 1.0), None);
    }

    #[test]
    fn case_never_changes_the_size() {
        assert_eq!(Unit::named("mPa"), None);
        assert_eq!(Unit::named("MN"), None);
        assert_eq!(Unit::named("µm").map(|u| u.suffix), Some("um"));
    }

    #[test]
    fn strange_units_differ_from_misspelled_keys() {
        let accepted = accepted_instead("depth_inch", "depth_m").unwrap();
        assert!(accepted.starts_with("`depth_m`, `depth_cm`"), "{accepted}");
        assert!(accepted_instead("depth", "depth_m").is_some());
        assert_eq!(accepted_instead("tau_standard_eror_s", "tau_s"), None);
        assert_eq!(accepted_instead("depth_mm", "depth_m"), None);
    }
}
