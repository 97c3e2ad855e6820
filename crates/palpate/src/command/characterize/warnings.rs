use std::collections::BTreeMap;

use palpate_jobs::Unusable;
use palpate_jobs::characterize::Answer;

/// Specimens whose warnings are all said one by one.
const FEW: usize = 4;

/// The warnings of `answer` as lines on a screen: all of a few specimens; of many, what is said of several of
/// them once, and how much else there is.
pub(super) fn for_people(answer: &Answer) -> Vec<String> {
    let count = answer.specimens.len();
    if count <= FEW {
        return answer.warnings.clone();
    }
    let mut said: BTreeMap<&str, usize> = BTreeMap::new();
    let warnings = answer.specimens.iter().flat_map(|own| &own.warnings);
    for warning in warnings {
        *said.entry(warning).or_default() += 1;
    }
    let (common, single): (Vec<_>, Vec<_>) = said.into_iter().partition(|(_, times)| *times > 1);
    let mut lines: Vec<String> = common
        .iter()
        .map(|(warning, times)| format!("{times} of {count} specimens: {warning}"))
        .collect();
    if !single.is_empty() {
        let more = single.len();
        lines.push(format!(
            "{more} more warnings concern single specimens; see them with --json, or in the files of --study"
        ));
    }
    lines.extend(answer.unusable.iter().map(Unusable::sentence));
    lines
}
