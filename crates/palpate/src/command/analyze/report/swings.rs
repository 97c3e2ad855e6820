use palpate_characterize::Analysis;
use palpate_characterize::analyze::{COHERENT, Sinusoid, SweepPoint};

use super::{CURVES, some_of, title};
use crate::plot::{Axis, Plot, Series, Style, thinned_indices};
use crate::report::{Markup, Table, figure, quantity, unit};
use palpate_jobs::ReadRecording;

type Own = (ReadRecording, Analysis);

/// Loops, and stiffness, phase and coherence over frequency; each where there is data.
pub(super) fn figures(own: &[&Own]) -> Markup {
    let answers: [(&str, &str, Of); 2] = [
        (
            "Stiffness",
            "stiffness [N/m]",
            Of {
                sine: |own| own.stiffness_n_per_m,
                chirp: |own| own.stiffness_n_per_m,
            },
        ),
        (
            "Phase",
            "phase [degrees]",
            Of {
                sine: |own| own.phase_rad.to_degrees(),
                chirp: |own| own.phase_rad.to_degrees(),
            },
        ),
    ];
    let over_frequency = answers
        .into_iter()
        .map(|(name, label, of)| over_frequency(own, name, label, of));
    loops(own)
        .and(over_frequency.collect::<Markup>())
        .and(coherence(own))
}

/// A number of the response to a sine, and of that to a chirp.
struct Of {
    sine: fn(&Sinusoid) -> f64,
    chirp: fn(&SweepPoint) -> f64,
}

/// Filtered force over depth in the last period but one of each sine: the filter has no neighbours at the end.
fn loops(own: &[&Own]) -> Markup {
    let sines: Vec<_> = sines(own).collect();
    if sines.is_empty() {
        return Markup::default();
    }
    let most = sines
        .iter()
        .map(|(_, sine)| sine.stiffness_n_per_m * (sine.depth_m + sine.amplitude_m));
    let scale = unit("_n", most.fold(0.0, f64::max));
    let drawn = sines
        .iter()
        .take(CURVES)
        .enumerate()
        .map(|(color, (read, sine))| {
            let clean = &read.clean;
            let period = 1.0 / sine.frequency_hz;
            let end = clean.time[sine.end - 1] - if sine.periods > 1 { period } else { 0.0 };
            let first = clean
                .time
                .partition_point(|time| *time < end - period - 1e-6);
            let last = clean.time.partition_point(|time| *time <= end + 1e-6);
            let [time, depth, force] =
                [&clean.time, &clean.depth, &clean.filtered_force].map(|all| &all[first..last]);
            let points = thinned_indices(time, depth, force).into_iter();
            let points = points.map(|place| (1e3 * depth[place], scale.factor * force[place]));
            let name = format!("{}, {:.3} Hz", title(read), sine.frequency_hz);
            Series::new(name, points.collect(), Style::Line, color)
        });
    let plot = Plot {
        title: "Hysteresis".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: format!("force [{}]", scale.unit),
        series: drawn.collect(),
        ..Plot::default()
    };
    let caption = format!(
        "One period of each sine, after the filter; the area of a loop is the energy lost in it.{}",
        some_of(sines.len())
    );
    figure(&plot, caption)
}

fn sines<'a>(own: &'a [&'a Own]) -> impl Iterator<Item = (&'a ReadRecording, &'a Sinusoid)> {
    own.iter()
        .flat_map(|(read, analysis)| analysis.sinusoids.iter().map(move |sine| (read, sine)))
}

fn chirps<'a>(own: &'a [&'a Own]) -> impl Iterator<Item = (&'a ReadRecording, &'a [SweepPoint])> {
    own.iter().flat_map(|(read, analysis)| {
        analysis
            .sweeps
            .iter()
            .map(move |sweep| (read, sweep.points.as_slice()))
    })
}

/// Sines as dots, chirps as lines where they are coherent.
fn over_frequency(own: &[&Own], name: &str, label: &str, of: Of) -> Markup {
    let dots: Vec<_> = sines(own)
        .map(|(_, sine)| (sine.frequency_hz, (of.sine)(sine)))
        .collect();
    let mut series = Vec::new();
    if !dots.is_empty() {
        series.push(Series::new("sines", dots, Style::Dots, 0));
    }
    for (color, (read, points)) in chirps(own).take(CURVES).enumerate() {
        let trusted = points.iter().filter(|point| point.is_coherent);
        let trusted: Vec<_> = trusted
            .map(|point| (point.frequency_hz, (of.chirp)(point)))
            .collect();
        series.push(Series::new(
            format!("chirp, {}", title(read)),
            trusted,
            Style::Line,
            color + 1,
        ));
    }
    if series.is_empty() {
        return Markup::default();
    }
    let caption =
        "Each sine is a dot. A chirp is drawn where 90 % of the force's power goes with the depth.";
    figure(
        &of_frequency(&format!("{name} over frequency"), label, series),
        caption,
    )
}

fn coherence(own: &[&Own]) -> Markup {
    let series = chirps(own)
        .take(CURVES)
        .enumerate()
        .map(|(color, (read, points))| {
            let points = points
                .iter()
                .map(|point| (point.frequency_hz, point.coherence));
            Series::new(title(read), points.collect(), Style::Line, color + 1)
        });
    let mut series: Vec<_> = series.collect();
    if series.is_empty() {
        return Markup::default();
    }
    let points = series.iter().flat_map(|own: &Series| &own.points);
    let ends = points.fold([f64::INFINITY, 0.0], |[low, high], (frequency, _)| {
        [low.min(*frequency), high.max(*frequency)]
    });
    let least = ends.map(|frequency| (frequency, COHERENT)).to_vec();
    series.push(Series::new(
        "trusted from here",
        least,
        Style::DashedLine,
        5,
    ));
    let plot = of_frequency("Coherence of the chirps", "coherence [-]", series);
    figure(
        &plot,
        "The part of the force's power that goes with the depth; the rest is noise, or no straight line.",
    )
}

fn of_frequency(title: &str, label: &str, series: Vec<Series>) -> Plot {
    Plot {
        title: title.to_owned(),
        x_label: "frequency [Hz]".to_owned(),
        y_label: label.to_owned(),
        x_axis: Axis::Logarithmic,
        series,
        ..Plot::default()
    }
}

/// The responses to sines as numbers.
pub(super) fn table(own: &[&Own]) -> Markup {
    let head = [
        "recording",
        "frequency",
        "about",
        "amplitude",
        "stiffness",
        "phase",
        "lost in a period",
        "distortion",
    ];
    let mut table = Table::new(head);
    for (read, sine) in sines(own) {
        let turned = [sine.phase_rad, sine.phase_error_rad].map(f64::to_degrees);
        table.row(vec![
            Markup::plain("code", read.path.display().to_string()),
            format!("{:.3} Hz", sine.frequency_hz).into(),
            quantity("_m", sine.depth_m, None).into(),
            quantity("_m", sine.amplitude_m, None).into(),
            quantity(
                "_n_per_m",
                sine.stiffness_n_per_m,
                Some(sine.stiffness_error_n_per_m),
            )
            .into(),
            format!("{:.2} ± {:.2}°", turned[0], turned[1]).into(),
            format!("{:.3} µJ", 1e6 * sine.hysteresis_j).into(),
            format!("{:.1} %", 100.0 * sine.distortion).into(),
        ]);
    }
    match table.is_empty() {
        true => Markup::default(),
        false => Markup::plain("h3", "Swings").and(table),
    }
}
