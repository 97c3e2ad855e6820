use palpate_files::protocol::{Stimulus, Sweep};
use palpate_files::recording::RecordingHeader;

/// What a stimulus is called: `ramp-and-hold-4mm`, `sine-2hz`.
pub fn stimulus_name(stimulus: &Stimulus) -> String {
    let kind = stimulus.kind();
    // To the micrometre: no encoder resolves less.
    let millimetres = |metres: f64| (1e6 * metres).round() / 1e3;
    let name = match *stimulus {
        Stimulus::RampAndHold { depth_m, .. } => format!("{kind}-{}mm", millimetres(depth_m)),
        Stimulus::Swing { sweep, .. } => match sweep {
            Sweep::Constant(frequency) => format!("{kind}-{frequency}hz"),
            Sweep::Linear([first, last]) | Sweep::Exponential([first, last]) => {
                format!("{kind}-{first}-{last}hz")
            }
        },
    };
    plain(&name)
}

/// What a recording is called, without its ending: specimen, stimulus, repetition. A specimen without a subject
/// is known by its `place` among the others.
pub fn recording_name(
    specimen: &RecordingHeader,
    place: usize,
    stimulus: &str,
    repeat: u64,
) -> String {
    let organ = specimen.organ.as_deref().unwrap_or("specimen");
    let subject = specimen.subject.clone();
    let subject = subject.unwrap_or_else(|| place.to_string());
    plain(&format!("{organ}-{subject}-{stimulus}-{repeat}"))
}

/// As the name of a file.
fn plain(name: &str) -> String {
    let letter = |c: char| {
        if c.is_alphanumeric() || c == '.' {
            c
        } else {
            '-'
        }
    };
    name.chars().map(letter).collect()
}
