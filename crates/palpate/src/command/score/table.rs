use palpate_files::printable;
use palpate_files::quantity::number;
use palpate_files::scene::Task;
use palpate_simulate::performance::{Comparison, Outcome, Score, outcome_words};

/// The score for a person.
pub(super) fn text(task: &Task, score: &Score, compared: &[Comparison]) -> String {
    let mut lines = Vec::new();
    if let Some(title) = &task.title {
        lines.push(printable(title).into_owned());
    }
    if score.outcome != Outcome::Free {
        lines.push(outcome_words(&score.outcome));
    }
    let heading = match compared {
        [] => format!("{:32} {:>12}", "measure", "value"),
        _ => format!(
            "{:32} {:>12} {:>12} {:>11} {:>7}  proficient",
            "measure", "value", "expert", "deviation", "ratio"
        ),
    };
    lines.push(heading);
    for measure in score.measures() {
        let mut line = format!(
            "{:32} {:>12}",
            printable(&measure.key),
            number(measure.value)
        );
        if let Some(own) = compared.iter().find(|own| own.measure.key == measure.key) {
            let or_dash = |value: Option<String>| value.unwrap_or_else(|| "-".to_owned());
            line += &format!(
                " {:>12} {:>11} {:>7}  {}",
                number(own.standard.mean),
                or_dash(own.standard.standard_deviation.map(number)),
                or_dash(own.ratio.map(|ratio| format!("{ratio:.2}"))),
                or_dash(
                    own.proficient
                        .map(|is| if is { "yes" } else { "no" }.to_owned())
                ),
            );
        }
        lines.push(line);
    }
    lines.join("\n")
}
