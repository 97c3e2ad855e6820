use super::{Markup, Table};
use crate::output::VERSION;

/// The source of a page's statements on a recording.
#[derive(Debug, Clone)]
pub(crate) struct Provenance {
    pub(crate) file: String,
    /// SHA-256 of the file.
    pub(crate) digest: String,
    pub(crate) samples: usize,
    pub(crate) rate_hz: f64,
    /// Cut-off of the filter [Hz].
    pub(crate) cutoff_hz: Option<f64>,
    /// First contact, as the recording counts time [s] and depth [m], and the depth's standard error [m].
    pub(crate) contact: (f64, f64, Option<f64>),
}

/// The options of the command, by name and value, and the recordings.
pub(crate) fn provenance(
    settings: &[(String, String)],
    recordings: impl Iterator<Item = Provenance>,
) -> Markup {
    let mut table = Table::new([
        "recording",
        "samples",
        "rate",
        "filter",
        "first contact",
        "SHA-256",
    ]);
    for own in recordings {
        let (time, depth, error) = own.contact;
        let error = error.map_or(String::new(), |error| format!(" ± {:.3}", 1e3 * error));
        table.row(vec![
            Markup::plain("code", own.file),
            own.samples.to_string().into(),
            format!("{:.4} Hz", own.rate_hz).into(),
            own.cutoff_hz
                .map_or("none".to_owned(), |hz| format!("{hz:.4} Hz"))
                .into(),
            format!("{time:.3} s, {:.3}{error} mm", 1e3 * depth).into(),
            Markup::plain("code", own.digest),
        ]);
    }
    let mut options = Table::new(["setting", "value"]);
    options.row(vec!["palpate".into(), VERSION.into()]);
    for (name, value) in settings {
        options.row(vec![
            Markup::plain("code", &**name),
            Markup::plain("code", &**value),
        ]);
    }
    let recordings = match table.is_empty() {
        true => Markup::default(),
        false => table.into(),
    };
    Markup::plain("h3", "Provenance")
        .and(options)
        .and(recordings)
}
