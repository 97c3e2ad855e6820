use palpate_mechanics::Error as MechanicsError;
use palpate_mechanics::boundary_elements::BoundaryProblem;

use super::body::Body;
use super::timing::{OffLine, OnLine, solve, touch};
use crate::Error;
use crate::machine::processor;
use crate::{Item, Rows};
use palpate_jobs::plot::{Axis, Plot, Series, Style};

pub(crate) const GROWTH: Item = Item {
    name: "table-4-1/growth",
    title: "how time and memory grow with the triangles of a kidney; takes minutes",
    seconds: 200.0,
    run,
};

/// Triangles of the kidneys.
const SIZES: [usize; 4] = [700, 1_500, 3_000, 5_146];

/// Those of them that can be touched.
const TOUCHABLE: usize = 500;

/// Those that are moved at once.
const MOVED: usize = 12;

/// What one kidney takes.
struct Measured {
    triangles: f64,
    off_line: OffLine,
    on_line: OnLine,
    /// What stays, and the most at a time [byte].
    memory: [f64; 2],
}

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut measured = Vec::new();
    let mut left_out = String::new();
    for size in SIZES {
        rows.say(format!("{size} triangles"));
        match measure(rows, &Body::kidney(size)?) {
            Ok(found) => measured.extend(found),
            Err(why @ MechanicsError::NotEnoughMemory { .. }) => {
                left_out = format!("; {size} triangles are left out: {why}");
            }
            Err(error) => return Err(error.into()),
        }
    }
    for (name, note, plot) in plots(&measured) {
        let note = format!(
            "kidneys of one shape, {TOUCHABLE} triangles touchable, ν = 0.45, on {}: {note}{left_out}",
            processor()
        );
        rows.add_figure(Some(name), &plot, note)?;
    }
    Ok(())
}

fn measure(rows: &Rows<'_>, body: &Body) -> Result<Option<Measured>, MechanicsError> {
    let mut touchable: Vec<_> = body.opposite().into_iter().take(TOUCHABLE).collect();
    touchable.sort_unstable();
    let problem = BoundaryProblem {
        touchable: &touchable,
        ..body.problem()
    };
    let (response, off_line) = solve(rows, &problem)?;
    let memory = problem.memory::<f32>();
    Ok(touch(body, &response, MOVED).map(|on_line| Measured {
        triangles: body.surface.mesh().triangles().len() as f64,
        off_line,
        on_line,
        memory: [memory.response as f64, memory.most as f64],
    }))
}

/// A name, what is told of it, and the picture.
fn plots(measured: &[Measured]) -> [(&'static str, String, Plot); 3] {
    let line = |name: &str, color, value: &dyn Fn(&Measured) -> f64| Series {
        name: name.to_owned(),
        points: measured
            .iter()
            .map(|one| (one.triangles, value(one)))
            .collect(),
        style: Style::LineWithDots,
        color,
    };
    let plot = |title: &str, y_label: &str, series: Vec<Series>| Plot {
        title: title.to_owned(),
        x_label: "triangles".to_owned(),
        y_label: y_label.to_owned(),
        x_axis: Axis::Logarithmic,
        y_axis: Axis::Logarithmic,
        series,
        ..Plot::default()
    };
    let off_line = vec![
        line("influences", 0, &|one| one.off_line.assembly),
        line("factors", 1, &|one| one.off_line.factors),
        line("answers", 2, &|one| one.off_line.columns),
    ];
    let memory = vec![
        line("most at a time", 0, &|one| 1e-6 * one.memory[1]),
        line("kept", 1, &|one| 1e-6 * one.memory[0]),
    ];
    let on_line = vec![
        line("force and field", 0, &|one| {
            1e6 * one.on_line.force_and_field
        }),
        line("force", 1, &|one| 1e6 * one.on_line.force),
    ];
    [
        (
            "beforehand",
            powers(&off_line),
            plot("Solved beforehand", "time [s]", off_line),
        ),
        (
            "memory",
            powers(&memory),
            plot("Memory", "memory [MB]", memory),
        ),
        (
            "on_line",
            format!(
                "{MOVED} triangles that are moved and stick; {}",
                powers(&on_line)
            ),
            plot("Each step", "time [µs]", on_line),
        ),
    ]
}

/// With which power of the number of triangles each line ends.
fn powers(series: &[Series]) -> String {
    let told = series.iter().filter_map(|line| {
        let [.., before, last] = line.points.as_slice() else {
            return None;
        };
        let power = (last.1 / before.1).ln() / (last.0 / before.0).ln();
        Some(format!("{} with the power {power:.1}", line.name))
    });
    told.collect::<Vec<_>>().join(", ")
}
