use palpate_files::quantity::without_unit;

use super::Markup;

/// The symbol of a parameter by its key: C₁₀ of `c10_pa`, τ₁ of `tau_1_s`.
pub(crate) fn symbol(key: &str) -> Markup {
    let bare = without_unit(key);
    let letters = bare.trim_end_matches(|c: char| c.is_ascii_digit());
    let index = &bare[letters.len()..];
    let name = match letters.trim_end_matches('_') {
        "tau" => "τ",
        "gamma" => "γ",
        "alpha" => "α",
        "c" => "C",
        "youngs_modulus" => "E",
        "work_of_adhesion" => "w",
        "pull_off" => "pull-off force",
        "contact" => "contact at",
        "effective_area" => "area",
        "effective_length" => "length",
        other => other,
    };
    let word = if name.chars().count() == 1 {
        "i"
    } else {
        "span"
    };
    let name = Markup::plain(word, name);
    match index {
        "" => name,
        index => name.and(Markup::plain("sub", index)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_those_of_formulas() {
        let shown = |key: &str| symbol(key).to_string();
        assert_eq!(shown("c10_pa"), "<i>C</i><sub>10</sub>");
        assert_eq!(shown("tau_2_s"), "<i>τ</i><sub>2</sub>");
        assert_eq!(shown("tau_s"), "<i>τ</i>");
        assert_eq!(shown("effective_area_m2"), "<span>area</span>");
    }
}
