use palpate_mechanics::Error as MechanicsError;

use super::body::{Body, MODELS};
use super::timing::{OffLine, OnLine, solve, touch};
use crate::Error;
use crate::machine::processor;
use crate::published::cell;
use crate::row::Rows;

/// Triangles of a contact; the first has the published table's name.
const CONTACTS: [(usize, &str); 2] = [(12, "update_s"), (1, "update_s/one_triangle")];

/// The body that the item is named for.
pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let Some(model) = MODELS.into_iter().find(|model| model.row == rows.part()) else {
        return Err(Error::failed("the table has no such body"));
    };
    let body = Body::new(model)?;
    let mesh = body.surface.mesh();
    let counts = [
        ("points", mesh.vertices().len()),
        ("triangles", mesh.triangles().len()),
    ];
    for (name, count) in counts {
        rows.row(name)
            .with("body", &body.description)
            .is(count as f64);
    }
    let (response, times) = match solve(rows, &body.problem()) {
        Ok(solved) => solved,
        Err(why @ MechanicsError::NotEnoughMemory { .. }) => {
            rows.row("solution_s").missing(why);
            return Ok(());
        }
        Err(error) => return Err(error.into()),
    };
    add_off_line(rows, model.row, &body, &times)?;
    for (touched, name) in CONTACTS {
        match touch(&body, &response, touched) {
            Some(times) => add_on_line(rows, name, &body, touched, &times),
            None => rows
                .row(name)
                .missing("the triangles there bear no common contact"),
        }
    }
    Ok(())
}

fn add_off_line(rows: &mut Rows<'_>, row: &str, body: &Body, times: &OffLine) -> Result<(), Error> {
    let size = 3.0 * body.surface.mesh().triangles().len() as f64;
    let columns = 3.0 * body.free.len() as f64;
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let machine = processor();
    rows.row("modelling_s")
        .with("body", &body.description)
        .with("equations", size)
        .with("machine", &machine)
        .with("cores", cores)
        .is(times.assembly);
    // Products and sums: of the inverse, of the factors, then of two triangles per column.
    let inverse = 2.0 * size.powi(3);
    let theirs = inverse / cell(&format!("table-4-1 {row} solution_s"))?;
    rows.row("solution_s")
        .with("free", body.free.len())
        .with("columns", columns)
        .with("equations", size)
        .with("share", format!("{:.0}", 100.0 * columns / size))
        .with("operations", format!("{inverse:.2e}"))
        .with("their_rate", format!("{:.0}", 1e-6 * theirs))
        .with("megabytes", format!("{:.1}", 8e-6 * size * size))
        .with("machine", &machine)
        .with("cores", cores)
        .is(times.factors + times.columns);
    for (name, seconds, operations) in [
        ("solution_s/factors", times.factors, size.powi(3) / 1.5),
        (
            "solution_s/columns",
            times.columns,
            2.0 * size * size * columns,
        ),
    ] {
        rows.row(name)
            .with("our_rate", format!("{:.0}", 1e-6 * operations / seconds))
            .with("machine", &machine)
            .with("cores", cores)
            .is(seconds);
    }
    Ok(())
}

fn add_on_line(rows: &mut Rows<'_>, name: &str, body: &Body, touched: usize, times: &OnLine) {
    let triangles = body.surface.mesh().triangles().len();
    for (name, what, ours) in [
        (name.to_owned(), "field", times.force_and_field),
        (format!("{name}/force"), "force", times.force),
    ] {
        rows.row(&name)
            .with("what", what)
            .with("touched", touched)
            .with("triangles", triangles)
            .with("equations", 3 * touched)
            .with("steps", times.steps)
            .with("machine", processor())
            .is(ours);
    }
}
