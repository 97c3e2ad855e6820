//! `--report`: the characterization as a page for people, made of the answer and of portraits alone.

mod convergence;
mod curves;
mod laws;
mod lumped;
mod map;
mod overview;
mod recorded;
mod relaxation;
mod specimen;
mod strips;
mod words;

use crate::report::{Markup, Page, Provenance, count, provenance};
use palpate_jobs::characterize::Answer;
use palpate_jobs::characterize::FitPlots;

/// The page on `answer`, whose specimens have `portraits`, in their order. `settings` are the options of the command:
/// names and values.
pub(super) fn html(
    answer: &Answer,
    portraits: &[FitPlots],
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
        .map(|(place, (own, portrait))| specimen::section(place, own, several, portrait))
        .collect();
    Page {
        summary: Markup::of_class("p", "lead", lead(answer)),
        title,
        body: overview.and(specimens),
        footer: foot(portraits, settings),
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
    let recordings = count(recordings, "recording");
    format!("Mechanical parameters of soft tissue, found from {recordings}{unusable}.")
}

/// The provenance of the page.
fn foot(portraits: &[FitPlots], settings: &[(String, String)]) -> Markup {
    let recordings = portraits.iter().flat_map(|portrait| &portrait.recordings);
    let recordings = recordings.map(|own| Provenance {
        file: own.file.clone(),
        digest: own.digest.clone(),
        samples: own.samples,
        rate_hz: own.rate_hz,
        cutoff_hz: own.cutoff_hz,
        contact: own.contact,
    });
    provenance(settings, recordings).and(Markup::plain("p", CONVENTIONS))
}

/// Conventions for all numbers.
const CONVENTIONS: &str = "Moduli are instantaneous, and g is relative to them: G(t) = G(0) (1 − Σ g (1 − exp(−t/τ))). \
Errors after ± are standard errors: by noise, whose correlation is taken from the residuals, by the zeros of the recordings, and by what the model may be off, by its \
elements and by the product of force and G(t), stands apart. Bands hold the model's curve with a probability of 95 %; measured noise lies outside of them.";
