//! Attempts without personal data.

use std::path::PathBuf;

use palpate_record::Attempt;

/// Replaces names by numbers in the order of first attempts and times by those since the trainee's own first attempt,
/// and clears sessions. Rare values in a small cohort can still identify a trainee.
pub(super) fn anonymous(attempts: &mut [Attempt]) {
    let mut names: Vec<(String, i64)> = Vec::new();
    for own in attempts {
        let known = names.iter().position(|(name, _)| *name == own.trainee);
        let number = known.unwrap_or_else(|| {
            names.push((own.trainee.clone(), own.when));
            names.len() - 1
        });
        own.trainee = format!("trainee {}", number + 1);
        own.when -= names[number].1;
        own.session = PathBuf::new();
        own.session_digest = String::new();
    }
}
