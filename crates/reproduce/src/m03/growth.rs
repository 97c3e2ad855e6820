use palpate_mechanics::Error as MechanicsError;
use palpate_mechanics::boundary_elements::BoundaryProblem;

use super::body::Body;
use super::timing::{OffLine, OnLine, solve, touch};
use crate::Error;
use crate::machine::processor;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

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

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut measured = Vec::new();
    let mut left_out = String::new();
    for size in SIZES {
        rows.report_step(format!("{size} triangles"));
        match measure(rows, &Body::kidney(size)?) {
            Ok(found) => measured.extend(found),
            Err(why @ MechanicsError::NotEnoughMemory { .. }) => {
                left_out = format!("; {size} triangles are left out: {why}");
            }
            Err(error) => return Err(error.into()),
        }
    }
    for (name, series) in plots(&measured) {
        rows.figure(name)
            .with("touchable", TOUCHABLE)
            .with("machine", processor())
            .with("moved", MOVED)
            .with("powers", powers(&series))
            .with("left_out", &left_out)
            .draw(series)?;
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

/// The curves of each figure.
fn plots(measured: &[Measured]) -> [(&'static str, Vec<Series>); 3] {
    let line = |name: &str, color, value: &dyn Fn(&Measured) -> f64| {
        let points = measured.iter().map(|one| (one.triangles, value(one)));
        Series::new(name, points.collect(), Style::LineWithDots, color)
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
    let force_and_field = |one: &Measured| 1e6 * one.on_line.force_and_field;
    let on_line = vec![
        line("force and field", 0, &force_and_field),
        line("force", 1, &|one| 1e6 * one.on_line.force),
    ];
    [
        ("beforehand", off_line),
        ("memory", memory),
        ("on_line", on_line),
    ]
}

/// With which power of the number of triangles each line ends.
fn powers(series: &[Series]) -> String {
    let left = series.iter().filter_map(|line| {
        let [.., before, last] = line.points.as_slice() else {
            return None;
        };
        let power = (last.1 / before.1).ln() / (last.0 / before.0).ln();
        Some(format!("{} with the power {power:.1}", line.name))
    });
    left.collect::<Vec<_>>().join(", ")
}
