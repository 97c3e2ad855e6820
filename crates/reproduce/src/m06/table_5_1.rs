use palpate_characterize::analyze;
use palpate_characterize::analyze::{StaticPoint, StaticRow, static_response};
use palpate_mechanics::{IndentationCurve, PronySeries};

use super::printed::{DEPTHS_MM, ORGANS, Printed};
use crate::Error;
use crate::published::{animals, prony};
use crate::row::Rows;
use crate::virtual_rig::{ramp_and_hold, recorded};

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let series = prony("liver", 6)?;
    for organ in ORGANS {
        for depth_mm in DEPTHS_MM {
            let name = format!("{organ}/{depth_mm}_mm");
            let Some(printed) = Printed::of(organ, depth_mm) else {
                rows.without(&name);
                continue;
            };
            let forces = printed.forces();
            let measured = match &forces {
                Some(forces) => measured(organ, depth_mm, forces, &series)?,
                None => None,
            };
            let responses = forces.map_or(0, |forces| forces.len());
            add(rows, &name, &printed, responses, measured);
            if responses > 0 {
                rows.row(&format!("{name}/responses"))
                    .published(animals(organ).len() as f64)
                    .is(responses as f64);
            }
        }
    }
    Ok(())
}

/// The static response of subjects with these steady `forces` [N].
fn measured(
    organ: &str,
    depth_mm: u32,
    forces: &[f64],
    series: &PronySeries,
) -> Result<Option<StaticRow>, Error> {
    let depth = 1e-3 * f64::from(depth_mm);
    let course = ramp_and_hold(depth);
    let mut points = Vec::new();
    for (subject, steady) in forces.iter().enumerate() {
        let elastic = steady / series.relaxation(f64::INFINITY);
        let curve = IndentationCurve::through(&[depth], &[elastic]);
        let relaxed = curve.relaxed(series, &course.times, &course.depths);
        let recording = recorded(organ, subject, &course, &relaxed, subject as u64)?;
        let holds = analyze(&recording).holds;
        points.extend(
            holds
                .iter()
                .map(|hold| StaticPoint::of(&recording.header, hold)),
        );
    }
    let groups = static_response(&points);
    Ok(groups.first().and_then(|group| group.rows.first()).copied())
}

fn add(
    rows: &mut Rows<'_>,
    name: &str,
    printed: &Printed,
    responses: usize,
    measured: Option<StaticRow>,
) {
    let how = match (responses, printed.suspect) {
        (0, _) => "impossible",
        (_, true) => "suspect",
        (_, false) => "right",
    };
    for (word, ours) in [
        ("min", measured.map(|row| row.min_n)),
        ("mean", measured.map(|row| row.mean_n)),
        ("max", measured.map(|row| row.max_n)),
    ] {
        rows.row(&format!("{name}/{word}"))
            .with("how", how)
            .with("min", printed.min)
            .with("mean", printed.mean)
            .with("max", printed.max)
            .with("responses", responses)
            .is(ours);
    }
}
