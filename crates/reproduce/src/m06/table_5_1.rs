use palpate_characterize::analyze;
use palpate_characterize::analyze::{StaticPoint, StaticRow, static_response};
use palpate_mechanics::{IndentationCurve, PronySeries};

use super::printed::{DEPTHS_MM, ORGANS, Printed};
use crate::Error;
use crate::published::{APPENDIX_A, prony};
use crate::row::Value;
use crate::virtual_rig::{ramp_and_hold, recorded};
use crate::{Item, Rows};

pub(crate) const TABLE_5_1: Item = Item {
    name: "table-5-1",
    title: "steady force over subjects: least, mean and largest",
    seconds: 1.1,
    run,
};

const NOTE: &str = "the source prints no recording; ours: `analyze` on as few virtual recordings as can have the three \
    printed numbers, each a ramp of 0.5 s and a hold until 40 s with the liver's relaxation of table 6-3 and noise of \
    0.225 mN";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let series = prony("liver", 6)?;
    for organ in ORGANS {
        for depth_mm in DEPTHS_MM {
            let name = format!("{organ}/{depth_mm}_mm");
            let Some(printed) = Printed::of(organ, depth_mm) else {
                rows.add_missing(&name, "N", "the source prints no force of this organ there");
                continue;
            };
            match printed.forces() {
                None => add_impossible(rows, &name, &printed),
                Some(forces) => {
                    let measured = measured(organ, depth_mm, &forces, &series)?;
                    add(rows, (organ, &name), &printed, &forces, measured);
                }
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
        let felt = curve.relaxed(series, &course.times, &course.depths);
        let recording = recorded((organ, subject), &course, &felt, subject as u64)?;
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
    (organ, name): (&str, &str),
    printed: &Printed,
    forces: &[f64],
    measured: Option<StaticRow>,
) {
    let note = match printed.suspect {
        false => NOTE.to_owned(),
        true => format!(
            "{NOTE}; the largest, {} N, is above every other of this organ at any depth: with the printed mean it \
             would take {} responses, and so has to be a misprint",
            printed.max,
            forces.len()
        ),
    };
    let numbers = [
        ("min", printed.min, measured.map(|row| row.min_n)),
        ("mean", printed.mean, measured.map(|row| row.mean_n)),
        ("max", printed.max, measured.map(|row| row.max_n)),
    ];
    for (word, published, ours) in numbers {
        let value = Value {
            published: Some(published),
            ours,
            unit: "N",
        };
        rows.add_pipeline_only(&format!("{name}/{word}"), value, note.clone());
    }
    let value = Value::beside(APPENDIX_A.sum(organ), forces.len() as f64, "1");
    let note = "published: animals of this organ in appendix A; ours: the fewest responses that can have the three \
                printed numbers, by arithmetic; more than the animals means several responses of one, or a misprint";
    rows.add(&format!("{name}/responses"), value, note);
}

fn add_impossible(rows: &mut Rows<'_>, name: &str, printed: &Printed) {
    let Printed { min, mean, max, .. } = *printed;
    let reason = format!(
        "printed least {min} N, mean {mean} N and largest {max} N are not in this order, which no responses can have: a \
         misprint of the source; the bounds are not used anywhere"
    );
    for (word, published) in [("min", min), ("mean", mean), ("max", max)] {
        let value = Value {
            published: Some(published),
            ours: None,
            unit: "N",
        };
        rows.add(&format!("{name}/{word}"), value, reason.clone());
    }
}
