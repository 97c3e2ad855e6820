//! Numbers for people: with as many digits as their errors allow, in a unit of suitable size.

/// Between a number and its unit, where no line may break.
const SPACE: char = '\u{202f}';
/// From this exponent of ten on, either way, numbers are written in scientific notation.
const LONG: i32 = 5;

/// An error this many times the value means that the value is unknown.
const FAR: f64 = 3.0;

/// A unit, and the factor from SI to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Factor on a number in SI [1/unit].
    pub factor: f64,
    /// As people write it.
    pub unit: &'static str,
}

/// Units by the ending of a key, with the smaller and larger ones that people read.
const UNITS: [(&str, &[(f64, &str)]); 12] = [
    (
        "_j_per_m2",
        &[(1e6, "µJ/m²"), (1e3, "mJ/m²"), (1.0, "J/m²")],
    ),
    ("_n_s_per_m", &[(1.0, "N s/m")]),
    ("_n_per_m", &[(1.0, "N/m"), (1e-3, "kN/m")]),
    ("_pa", &[(1.0, "Pa"), (1e-3, "kPa"), (1e-6, "MPa")]),
    ("_m2", &[(1e12, "µm²"), (1e6, "mm²")]),
    ("_hz", &[(1.0, "Hz")]),
    ("_m", &[(1e9, "nm"), (1e6, "µm"), (1e3, "mm")]),
    ("_n_s", &[(1e3, "mN s"), (1.0, "N s")]),
    ("_rad", &[(1.0, "rad")]),
    ("_s", &[(1.0, "s")]),
    ("_n", &[(1e9, "nN"), (1e6, "µN"), (1e3, "mN"), (1.0, "N")]),
    ("", &[(1.0, "")]),
];

/// The unit for numbers as large as `size`, whose `key` ends with its unit in SI: `c10_pa`.
pub fn unit(key: &str, size: f64) -> Scale {
    let of_key = UNITS.iter().find(|(ending, _)| key.ends_with(ending));
    let (_, units) = of_key.unwrap_or(&UNITS[UNITS.len() - 1]);
    let (factor, unit) = units
        .iter()
        .rev()
        .find(|(factor, _)| size.abs() * factor >= 1.0)
        .unwrap_or(&units[0]);
    Scale {
        factor: *factor,
        unit,
    }
}

/// A value with its error, both in SI, and its unit: `1.30 ± 0.05 kPa`.
pub fn quantity(key: &str, value: f64, error: Option<f64>) -> String {
    let Scale { factor, unit } = unit(key, value);
    let error = error.map(|error| factor * error);
    let number = with_error(factor * value, error);
    match unit {
        "" => number,
        unit => format!("{number}{SPACE}{unit}"),
    }
}

/// The same with an ordinary space, for sentences and tables of plain text.
pub fn plain_quantity(key: &str, value: f64, error: Option<f64>) -> String {
    quantity(key, value, error).replace(SPACE, " ")
}

fn with_error(value: f64, error: Option<f64>) -> String {
    let Some(error) = error.filter(|error| error.is_finite() && *error > 0.0) else {
        return rounded(value, 4);
    };
    if error > FAR * value.abs() {
        return format!("{} ± {}", rounded(value, 2), rounded(error, 2));
    }
    // Two digits of an error that begins with a one or a two, which one digit would round by much.
    let first = exponent(error);
    let last = first - i32::from(error / 10_f64.powi(first) < 2.95);
    let power = exponent(value).max(last);
    if !value.is_finite() || (-3..LONG).contains(&power) && last >= -6 {
        return format!("{} ± {}", to_place(value, last), to_place(error, last));
    }
    let [value, error] = [value, error].map(|x| to_place(x / 10_f64.powi(power), last - power));
    format!("({value} ± {error}) × 10{}", superscript(power))
}

/// A number to so many digits.
pub fn rounded(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let power = exponent(value);
    if (-4..LONG).contains(&power) || !value.is_finite() {
        return to_place(value, power + 1 - digits);
    }
    let value = to_place(value / 10_f64.powi(power), 1 - digits);
    format!("{value} × 10{}", superscript(power))
}

/// A number without a unit: a whole number as it is, else to four digits.
pub fn number(value: f64) -> String {
    match value.fract() == 0.0 && value.abs() < 1e4 {
        true => format!("{value}"),
        false => rounded(value, 4),
    }
}

/// A number rounded to the given power of ten, with a real minus sign.
fn to_place(value: f64, place: i32) -> String {
    if !value.is_finite() {
        return "unknown".to_owned();
    }
    let unit = 10_f64.powi(place);
    let rounded = (value / unit).round() * unit;
    let decimals = (-place).max(0) as usize;
    let text = format!("{rounded:.decimals$}");
    match text.strip_prefix('-') {
        Some(positive) if positive.contains(|c| ('1'..='9').contains(&c)) => format!("−{positive}"),
        Some(zero) => zero.to_owned(),
        None => text,
    }
}

fn exponent(value: f64) -> i32 {
    match value == 0.0 || !value.is_finite() {
        true => i32::MIN / 2,
        false => value.abs().log10().floor() as i32,
    }
}

fn superscript(power: i32) -> String {
    let raised = |letter: char| match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + (digit as u32 - '0' as u32)).unwrap_or(digit),
    };
    power.to_string().chars().map(raised).collect()
}

/// A `key` without its unit: `tau_1` of `tau_1_s`.
pub fn without_unit(key: &str) -> &str {
    let ending = UNITS.iter().find(|(ending, _)| key.ends_with(ending));
    key.trim_end_matches(ending.map_or("", |(ending, _)| ending))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_their_errors_allow() {
        let cases = [
            ("c10_pa", 453.3652, Some(0.036), "453.37 ± 0.04\u{202f}Pa"),
            ("c10_pa", 4533.0, Some(52.0), "4.53 ± 0.05\u{202f}kPa"),
            ("c01_pa", 0.0, None, "0\u{202f}Pa"),
            ("tau_1_s", 1.5285, Some(0.14), "1.53 ± 0.14\u{202f}s"),
            ("alpha", -2.0, Some(30.0), "−2.0 ± 30"),
            ("c10_pa", 13.0, Some(4e34), "13 ± 4.0 × 10³⁴\u{202f}Pa"),
            ("k01", 2.5e-8, Some(1e-9), "(2.50 ± 0.10) × 10⁻⁸"),
            ("tau_s", 1.2e7, None, "1.200 × 10⁷\u{202f}s"),
            ("effective_area_m2", 3.1416e-6, None, "3.142\u{202f}mm²"),
            ("damage_n_s", 0.0321, None, "32.10\u{202f}mN s"),
            ("tau_s", f64::NAN, None, "unknown\u{202f}s"),
        ];
        for (key, value, error, expected) in cases {
            assert_eq!(quantity(key, value, error), expected);
        }
    }
}
