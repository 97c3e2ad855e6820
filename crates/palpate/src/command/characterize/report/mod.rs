//! `--report`: what was found, as a page for people. It is made of the answer and of portraits alone.

mod convergence;
mod curves;
mod laws;
mod lumped;
mod overview;
mod recorded;
mod relaxation;
mod specimen;
mod strips;
mod words;

use super::answer::Answer;
use super::portrait::Portrait;
use crate::output::VERSION;
use crate::report::{Markup, Page, Table};

/// The page on `answer`, whose specimens have `portraits`, in their order. `settings` say how it was asked for:
/// names and values.
pub(super) fn html(
    answer: &Answer,
    portraits: &[Portrait],
    settings: &[(String, String)],
) -> String {
    let several = answer.specimens.len() > 1;
    let title = match answer.specimens.as_slice() {
        [only] => only.title.clone(),
        all => format!("{} specimens", all.len()),
    };
    let overview = match several || !answer.unusable.is_empty() {
        true => overview::section(answer),
        false => Markup::default(),
    };
    let each = answer.specimens.iter().zip(portraits).enumerate();
    let specimens: Markup = each
        .map(|(place, (own, portrait))| specimen::section(place, (own, several), portrait))
        .collect();
    Page {
        lead: Markup::of_class("p", "lead", lead(answer)),
        title,
        body: overview.and(specimens),
        foot: foot(portraits, settings),
    }
    .html()
}

fn lead(answer: &Answer) -> String {
    let recordings: usize = answer.specimens.iter().map(|own| own.files.len()).sum();
    let unusable = match answer.unusable.len() {
        0 => String::new(),
        1 => "; one file could not be used".to_owned(),
        count => format!("; {count} files could not be used"),
    };
    let recordings = words::count(recordings, "recording");
    format!("Mechanical parameters of soft tissue, found from {recordings}{unusable}.")
}

/// Where all this comes from.
fn foot(portraits: &[Portrait], settings: &[(String, String)]) -> Markup {
    let mut table = Table::new([
        "recording",
        "samples",
        "rate",
        "filter",
        "first contact",
        "SHA-256",
    ]);
    for own in portraits.iter().flat_map(|portrait| &portrait.recordings) {
        let (time, depth, error) = own.contact;
        let error = error.map_or(String::new(), |error| format!(" ± {:.3}", 1e3 * error));
        table.row(vec![
            Markup::plain("code", &*own.file),
            own.samples.to_string().into(),
            format!("{:.4} Hz", own.rate_hz).into(),
            own.cutoff_hz
                .map_or("none".to_owned(), |hz| format!("{hz:.4} Hz"))
                .into(),
            format!("{time:.3} s, {:.3}{error} mm", 1e3 * depth).into(),
            Markup::plain("code", &*own.digest),
        ]);
    }
    let mut asked = Table::new(["setting", "value"]);
    asked.row(vec!["palpate".into(), VERSION.into()]);
    for (name, value) in settings {
        asked.row(vec![
            Markup::plain("code", &**name),
            Markup::plain("code", &**value),
        ]);
    }
    Markup::plain("h3", "Provenance")
        .and(asked)
        .and(table)
        .and(Markup::plain("p", CONVENTIONS))
}

/// What holds of all numbers.
const CONVENTIONS: &str = "Moduli are instantaneous, and g is relative to them: G(t) = G(0) (1 − Σ g (1 − exp(−t/τ))). \
Errors after ± are standard errors by noise, whose correlation is taken from the residuals; what the model may be off, by its \
elements and by the product of force and G(t), stands apart. Bands hold the model's curve with a probability of 95 %; measured noise lies outside of them.";
