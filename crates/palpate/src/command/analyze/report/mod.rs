//! `--report`: the analysis as a page for people.

mod pressed;
mod relaxation;
mod sideways;
mod statics;
mod swings;

use palpate_characterize::analyze::{OrganResponse, StaticGroup};

use crate::report::{Markup, Page, Provenance, Table, count, provenance, warning_list};
use palpate_jobs::analyze::{Analyzed, warnings_of};
use palpate_jobs::{ReadRecording, Unusable};

/// Curves that are drawn in one plot, at most.
const CURVES: usize = 12;

/// The page on `analyzed`; `settings` are the options of the command: names and values.
pub(super) fn html(analyzed: &Analyzed, settings: &[(String, String)]) -> String {
    let several = analyzed.responses.len() > 1;
    let title = match analyzed.responses.as_slice() {
        [only] => name(only).to_owned(),
        all => format!("{} organs", all.len()),
    };
    let overview = match several {
        true => Markup::of_class("div", "figures", statics::overview(&analyzed.groups)),
        false => Markup::default(),
    };
    let each = analyzed.responses.iter();
    let organs: Markup = each
        .map(|response| section(analyzed, response, several))
        .collect();
    let unusable: Vec<_> = analyzed.unusable.iter().map(Unusable::sentence).collect();
    let unusable = warning_list("Files that could not be used", &unusable);
    let recordings = analyzed.recordings.iter().map(|(read, _)| source(read));
    Page {
        title,
        summary: Markup::of_class("p", "lead", lead(analyzed)),
        body: overview.and(organs).and(unusable).and(warned(analyzed)),
        footer: provenance(settings, recordings).and(Markup::plain("p", CONVENTIONS)),
    }
    .html()
}

/// Conventions for all numbers.
const CONVENTIONS: &str = "Steady force is the mean of the last tenth of a hold. A phase is positive when force leads depth, a hysteresis when \
energy is lost. Within: standard deviation from press to press of one subject; between: of the subjects' means.";

fn lead(analyzed: &Analyzed) -> String {
    let recordings = count(analyzed.recordings.len(), "recording");
    let unusable = match analyzed.unusable.len() {
        0 => String::new(),
        files => format!("; {} could not be used", count(files, "file")),
    };
    format!("What {recordings} of soft tissue show, without a model{unusable}.")
}

fn name(response: &OrganResponse) -> &str {
    response
        .organ
        .as_deref()
        .unwrap_or("recordings without an organ")
}

/// The section on one organ, with its title if it is one of `several`.
fn section(analyzed: &Analyzed, response: &OrganResponse, several: bool) -> Markup {
    let title = match several {
        true => Markup::plain("h2", name(response)),
        false => Markup::default(),
    };
    let groups: Vec<&StaticGroup> = analyzed
        .groups
        .iter()
        .filter(|own| own.organ == response.organ)
        .collect();
    let own: Vec<_> = analyzed
        .recordings
        .iter()
        .filter(|(read, _)| read.clean.header.organ == response.organ)
        .collect();
    let figures = statics::figure_of(&groups, &analyzed.points)
        .and(pressed::figure_of(&own))
        .and(relaxation::figure_of(&own))
        .and(swings::figures(&own));
    let inside = title
        .and(Markup::of_class("div", "figures", figures))
        .and(statics::table(&groups))
        .and(relaxation::table(&own))
        .and(swings::table(&own))
        .and(sideways::table(&own));
    Markup::plain("section", inside)
}

/// Warnings, recording by recording.
fn warned(analyzed: &Analyzed) -> Markup {
    let mut table = Table::new(["recording", "warning"]).of_class("text");
    for (read, analysis) in &analyzed.recordings {
        let warnings: Vec<&str> = warnings_of(read, analysis).map(String::as_str).collect();
        if !warnings.is_empty() {
            let file = Markup::plain("code", read.path.display().to_string());
            table.row(vec![file, warnings.join("; ").into()]);
        }
    }
    match table.is_empty() {
        true => Markup::default(),
        false => Markup::plain("h3", "Warnings").and(table),
    }
}

fn source(read: &ReadRecording) -> Provenance {
    let handling = &read.clean.handling;
    Provenance {
        file: read.path.display().to_string(),
        digest: read.digest.clone(),
        samples: read.clean.time.len(),
        rate_hz: handling.sampling.rate_hz,
        cutoff_hz: handling.cutoff_hz,
        contact: (
            handling.contact.time_s,
            handling.contact.depth_m,
            handling.contact.depth_error_m,
        ),
    }
}

/// The title of a recording among others: its subject and repeat where it has them, else its file.
fn title(read: &ReadRecording) -> String {
    let header = &read.clean.header;
    let file = read
        .path
        .file_stem()
        .map(|stem| stem.to_string_lossy().into_owned());
    match (&header.subject, header.repeat) {
        (Some(subject), Some(repeat)) => format!("{subject}, {repeat}"),
        (Some(subject), None) => subject.clone(),
        _ => file.unwrap_or_default(),
    }
}

/// The note that not all curves are drawn, if so.
fn some_of(curves: usize) -> String {
    match curves > CURVES {
        true => format!(" Of {curves} the first {CURVES} are drawn."),
        false => String::new(),
    }
}
