use palpate_characterize::analyze::{StaticPoint, StaticRow, static_response};
use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::fit::Random;
use palpate_characterize::{CleanRecording, analyze};
use palpate_files::protocol::Stimulus;
use palpate_geometry::collect_on_all_cores;
use palpate_measure::VirtualSpecimen;

use super::organ::{STEADY, beating, specimen};
use super::rig::measured;
use super::subjects::Spread;
use crate::Error;
use crate::m06::Printed;
use crate::published::{animals, cell};
use crate::row::Rows;
use crate::virtual_rig::RAMP;
use palpate_jobs::plot::{Series, Style};

/// How often each depth is pressed in each animal.
const REPEATS: u64 = 2;

/// Deviation from one press of an animal to the next [-]: "small" in section 5.5.
const WITHIN: f64 = 0.03;

/// A press to be made.
struct Job<'a> {
    animal: usize,
    subject: &'static str,
    specimen: &'a VirtualSpecimen,
    depth_mm: u32,
    repeat: u64,
}

/// What came of it.
struct Pressed {
    depth_mm: u32,
    point: StaticPoint,
    /// How far from the surface at rest the tissue was met [m].
    missed: f64,
    /// Force at the end of a breath over the one at the end [-].
    at_breath: f64,
}

/// The organ that the item is named for.
pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let organ = rows.part();
    let animals = animals(organ);
    let spreads = Spread::all(organ, animals.len());
    let specimens = specimens(organ, &animals, &spreads)?;
    let mut found = Vec::new();
    for (animal, (subject, own)) in animals.iter().zip(&specimens).enumerate() {
        rows.report_step(format_args!(
            "animal {subject}, {} of {}",
            animal + 1,
            animals.len()
        ));
        let jobs = Printed::all(organ).into_iter().flat_map(|row| {
            (1..=REPEATS).map(move |repeat| Job {
                animal,
                subject,
                specimen: own,
                depth_mm: row.depth_mm,
                repeat,
            })
        });
        let jobs: Vec<_> = jobs.collect();
        for pressed in collect_on_all_cores(&jobs, |_, job| pressed(job)) {
            found.extend(pressed?);
        }
    }
    rows.row("animals")
        .published(animals.len() as f64)
        .is(specimens.len() as f64);
    let mut drawn = Vec::new();
    let mut squares = Vec::new();
    for (printed, spread) in Printed::all(organ).iter().zip(&spreads) {
        let points: Vec<StaticPoint> = found
            .iter()
            .filter(|own| own.depth_mm == printed.depth_mm)
            .map(|own| own.point.clone())
            .collect();
        let groups = static_response(&points);
        let Some(row) = groups.first().and_then(|group| group.rows.first()) else {
            rows.row(&format!("{}_mm/mean", printed.depth_mm))
                .missing("no hold is seen in the recordings");
            continue;
        };
        squares.push((row.mean_n / spread.mean() - 1.0).powi(2));
        add_static(rows, printed, spread, row);
        drawn.push((*printed, *row));
    }
    let root = f64::sqrt(squares.iter().sum::<f64>() / squares.len() as f64);
    rows.add("given_back", 100.0 * root);
    add_causes(rows, &found);
    rows.figure("").draw(curves(&drawn))
}

/// The animals.
fn specimens(
    organ: &'static str,
    animals: &[&'static str],
    spreads: &[Spread],
) -> Result<Vec<VirtualSpecimen>, Error> {
    let depths: Vec<u32> = Printed::all(organ).iter().map(|row| row.depth_mm).collect();
    let of_animal = |(number, subject): (usize, &&'static str)| {
        let force = |row: &Printed| {
            let place = depths.iter().position(|depth| *depth == row.depth_mm);
            place.map_or(row.mean, |place| spreads[place].force(number))
        };
        let mut own = specimen(organ, force)?;
        own.header.subject = Some((*subject).to_owned());
        own.header.weight_kg = Some(cell(&format!("appendix-a {subject} weight_kg"))?);
        Ok(own)
    };
    animals.iter().enumerate().map(of_animal).collect()
}

/// One press; none when no hold is seen in it.
fn pressed(job: &Job<'_>) -> Result<Option<Pressed>, Error> {
    let seed = 1000 * job.animal as u64 + 10 * u64::from(job.depth_mm) + job.repeat;
    let mut specimen = job.specimen.clone();
    specimen.factor = 1.0 + WITHIN * Random::new(seed).normal();
    let surface = specimen.surface;
    // The heart is somewhere else each time.
    let specimen = beating(specimen, seed);
    let stimulus = Stimulus::RampAndHold {
        depth_m: 1e-3 * f64::from(job.depth_mm),
        ramp_s: RAMP,
        hold_s: STEADY - RAMP,
    };
    let found = measured(&specimen, stimulus, job.repeat, seed)?;
    let clean = clean(&found.recording, &CleanSettings::default())?;
    let analysis = analyze(&clean);
    let Some(hold) = analysis.holds.first() else {
        return Ok(None);
    };
    let mut point = StaticPoint::of(&clean.header, hold);
    point.subject = Some(job.subject.to_owned());
    Ok(Some(Pressed {
        depth_mm: job.depth_mm,
        missed: found.contact - surface,
        at_breath: at_breath(&clean, hold.steady_n)?,
        point,
    }))
}

/// What a hold of 20 s reads as steady, over `steady` [N].
fn at_breath(clean: &CleanRecording, steady: f64) -> Result<f64, Error> {
    let breath = cell("section-5-5 shortest_breath")?;
    let last = |time: &f64| (0.9 * breath..breath).contains(time);
    let each = clean.time.iter().zip(&clean.force);
    let forces: Vec<f64> = each
        .filter(|(time, _)| last(time))
        .map(|(_, force)| *force)
        .collect();
    Ok(forces.iter().sum::<f64>() / forces.len() as f64 / steady)
}

fn add_static(rows: &mut Rows<'_>, printed: &Printed, spread: &Spread, row: &StaticRow) {
    let depth = printed.depth_mm;
    for (word, put_in, ours) in [
        ("min", spread.force(0), row.min_n),
        ("mean", spread.mean(), row.mean_n),
        ("max", spread.force(row.subjects - 1), row.max_n),
    ] {
        rows.row(&format!("{depth}_mm/{word}"))
            .with("animals", row.subjects)
            .with("put_in", format!("{:.1}", 1e3 * put_in))
            .with("misprint", printed.suspect)
            .is(ours);
    }
    rows.add(&format!("{depth}_mm/within"), row.within_n);
    rows.add(&format!("{depth}_mm/between"), row.between_n);
}

/// What the errors come from.
fn add_causes(rows: &mut Rows<'_>, found: &[Pressed]) {
    let count = found.len() as f64;
    let mean = found.iter().map(|own| own.missed).sum::<f64>() / count;
    let squares = found.iter().map(|own| (own.missed - mean).powi(2));
    let spread = f64::sqrt(squares.sum::<f64>() / (count - 1.0));
    rows.add("contact/mean", 1e3 * mean);
    rows.add("contact/spread", 1e3 * spread);
    let breath = found.iter().map(|own| own.at_breath).sum::<f64>() / count;
    rows.add("breath", 100.0 * (breath - 1.0));
}

/// Printed and measured, side by side.
fn curves(drawn: &[(Printed, StaticRow)]) -> Vec<Series> {
    // Bars must not lie on one another.
    const ASIDE: f64 = 0.06;
    let mut series = Vec::new();
    let printed = drawn.iter().map(|(row, _)| row.drawn());
    let printed = printed.collect();
    series.push(Series::new("table 5-1", printed, Style::LineWithDots, 0));
    let own = drawn
        .iter()
        .map(|(row, own)| (f64::from(row.depth_mm) + ASIDE, 1e3 * own.mean_n));
    let style = Style::DashedLineWithSquares;
    series.push(Series::new("virtual animals", own.collect(), style, 1));
    for (row, own) in drawn {
        let depth = f64::from(row.depth_mm);
        let mut bar = |x: f64, ends: [f64; 2], color| {
            let points = ends.map(|force| (x, 1e3 * force)).to_vec();
            series.push(Series::new("", points, Style::Line, color));
        };
        if !row.suspect {
            bar(depth, [row.min, row.max], 0);
        }
        bar(depth + ASIDE, [own.min_n, own.max_n], 1);
    }
    series
}
