use std::collections::BTreeMap;

use palpate_jobs::Unusable;
use palpate_jobs::characterize::Answer;

/// Up to this many specimens, all warnings are shown.
const FEW: usize = 4;

/// A warning that several specimens share, except for numbers.
struct SharedWarning<'a> {
    title: &'a str,
    warning: &'a str,
    times: usize,
    is_same: bool,
}

/// The warnings of `answer` as lines on a screen: a shared warning once, with the numbers of its first specimen; for
/// many specimens, the number of the remaining warnings.
pub(super) fn for_people(answer: &Answer) -> Vec<String> {
    let count = answer.specimens.len();
    if count == 1 {
        return answer.warnings.clone();
    }
    // In the order in which they come.
    let mut grouped: Vec<SharedWarning<'_>> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for specimen in &answer.specimens {
        for warning in &specimen.warnings {
            let place = *places.entry(without_numbers(warning)).or_insert_with(|| {
                grouped.push(SharedWarning {
                    title: &specimen.title,
                    warning,
                    times: 0,
                    is_same: true,
                });
                grouped.len() - 1
            });
            let own = &mut grouped[place];
            own.times += 1;
            own.is_same &= own.warning == warning;
        }
    }
    let (common, single): (Vec<_>, Vec<_>) = grouped.iter().partition(|own| own.times > 1);
    let mut lines: Vec<String> = common.into_iter().map(|own| own.sentence(count)).collect();
    if count <= FEW {
        let each = single.iter();
        lines.extend(each.map(|own| format!("{}: {}", own.title, own.warning)));
    } else if !single.is_empty() {
        let more = single.len();
        lines.push(format!(
            "{more} more warnings concern single specimens; see them with --json, or in the files of --study"
        ));
    }
    lines.extend(answer.unusable.iter().map(Unusable::sentence));
    lines
}

impl SharedWarning<'_> {
    fn sentence(&self, count: usize) -> String {
        let Self {
            title,
            warning,
            times,
            ..
        } = self;
        match self.is_same {
            true => format!("{times} times in {count} specimens: {warning}"),
            false => format!("{times} times in {count} specimens, such as {title}: {warning}"),
        }
    }
}

/// A warning with one sign in place of each number.
fn without_numbers(warning: &str) -> String {
    let mut plain = String::with_capacity(warning.len());
    let mut letters = warning.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_sign = matches!(letter, '-' | '+' | '−');
        if is_sign && letters.peek().is_some_and(char::is_ascii_digit) {
            continue;
        }
        let is_of_number = letter.is_ascii_digit() || letter == '.';
        match is_of_number && plain.ends_with('#') {
            true => {}
            false if letter.is_ascii_digit() => plain.push('#'),
            false => plain.push(letter),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_in_numbers_are_the_same() {
        let [a, b] = ["at 0.25 s, -1.5e-6 m", "at 13 s, 2e+10 m"].map(without_numbers);
        assert_eq!(a, b);
        assert_ne!(a, without_numbers("at 0.25 N"));
    }
}
