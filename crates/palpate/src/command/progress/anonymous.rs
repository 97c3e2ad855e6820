//! Attempts without what tells who made them.

use std::path::PathBuf;

use palpate_record::Attempt;

/// Names become numbers in the order of first attempts, times those since the trainee's own first attempt, and
/// sessions nothing. What is rare in a small cohort can still be told by who knows it.
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
