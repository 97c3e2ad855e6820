use palpate_mechanics::Error as MechanicsError;

use super::body::{Body, MODELS, Model};
use super::timing::{OffLine, OnLine, solve, touch};
use crate::Error;
use crate::machine::processor;
use crate::published::TABLE_4_1 as PUBLISHED;
use crate::row::Value;
use crate::{Item, Rows};

/// One for each row of the table: the last takes minutes.
pub(crate) const TABLE_4_1: [Item; 3] = [
    Item {
        name: "table-4-1/cube",
        title: "boundary elements of a cube, beforehand and on line",
        seconds: 0.78,
        run: |rows| run(rows, MODELS[0]),
    },
    Item {
        name: "table-4-1/kidney_graphic",
        title: "boundary elements of a coarse kidney",
        seconds: 4.5,
        run: |rows| run(rows, MODELS[1]),
    },
    Item {
        name: "table-4-1/kidney_visible_human",
        title: "boundary elements of a fine kidney; takes minutes",
        seconds: 290.0,
        run: |rows| run(rows, MODELS[2]),
    },
];

/// Triangles of a contact; the first has the published table's name.
const CONTACTS: [(usize, &str); 2] = [(12, "update_s"), (1, "update_s/one_triangle")];

fn run(rows: &mut Rows<'_>, model: Model) -> Result<(), Error> {
    let row = model.row;
    let body = Body::new(model)?;
    add_size(rows, row, &body);
    let (response, times) = match solve(rows, &body.problem()) {
        Ok(solved) => solved,
        Err(why @ MechanicsError::NotEnoughMemory { .. }) => {
            rows.add_missing("solution_s", "s", why.to_string());
            return Ok(());
        }
        Err(error) => return Err(error.into()),
    };
    add_off_line(rows, row, &body, &times);
    for (touched, name) in CONTACTS {
        match touch(&body, &response, touched) {
            Some(times) => add_on_line(rows, (row, name), (&body, touched), &times),
            None => rows.add_missing(name, "s", "the triangles there bear no common contact"),
        }
    }
    Ok(())
}

fn add_size(rows: &mut Rows<'_>, row: &str, body: &Body) {
    let mesh = body.surface.mesh();
    let counts = [
        ("points", mesh.vertices().len()),
        ("triangles", mesh.triangles().len()),
    ];
    for (name, count) in counts {
        let note = format!(
            "{}; a closed surface has an even number of triangles",
            body.told
        );
        rows.add(name, value(row, name, count as f64, "1"), note);
    }
}

fn add_off_line(rows: &mut Rows<'_>, row: &str, body: &Body, times: &OffLine) {
    let size = 3.0 * body.surface.mesh().triangles().len() as f64;
    let columns = 3.0 * body.free.len() as f64;
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let machine = format!(
        "on {}, {cores} cores; published: dual Pentium III of 1 GHz",
        processor()
    );
    let note = format!(
        "{}; the matrix of {size} equations with integrals in closed form, in single precision, {machine}",
        body.told
    );
    let assembly = value(row, "modelling_s", times.assembly, "s");
    rows.add("modelling_s", assembly, note);

    // Products and sums: of the factors, then of two triangles per column.
    let operations = [size.powi(3) / 1.5, 2.0 * size * size * columns];
    let inverse = 2.0 * size.powi(3);
    let published = PUBLISHED.value(row, "solution_s");
    let theirs = published.map_or(String::new(), |seconds| {
        format!("at {:.0} million a second", 1e-6 * inverse / seconds)
    });
    let note = format!(
        "factors and the answers to unit forces on all {} touchable triangles, {columns} of {size} columns: \
         {:.0} % of the inverse's numbers, applied to loads; the source inverts the matrix, {inverse:.2e} \
         operations {theirs}, {:.1} MB in double precision; {machine}",
        body.free.len(),
        100.0 * columns / size,
        8e-6 * size * size,
    );
    let solution = value(row, "solution_s", times.factors + times.columns, "s");
    rows.add("solution_s", solution, note);
    for (name, seconds, operations) in [
        ("solution_s/factors", times.factors, operations[0]),
        ("solution_s/columns", times.columns, operations[1]),
    ] {
        let rate = 1e-6 * operations / seconds;
        let value = Value {
            published: None,
            ours: Some(seconds),
            unit: "s",
        };
        rows.add(
            name,
            value,
            format!("{rate:.0} million operations a second, {machine}"),
        );
    }
}

fn add_on_line(
    rows: &mut Rows<'_>,
    (row, name): (&str, &str),
    (body, touched): (&Body, usize),
    times: &OnLine,
) {
    let note = |what: &str| {
        format!(
            "{what} of {touched} of {} triangles that are moved and stick, {} equations; median of {} steps \
             on {}, one thread; the source does not say how many its contact moved, nor whether its time \
             holds the field",
            body.surface.mesh().triangles().len(),
            3 * touched,
            times.steps,
            processor()
        )
    };
    let whole = value(row, "update_s", times.force_and_field, "s");
    rows.add(
        name,
        whole,
        note("forces and the whole body's displacements"),
    );
    let force = value(row, "update_s", times.force, "s");
    rows.add(&format!("{name}/force"), force, note("forces alone"));
}

/// Ours beside what is published of the body `row`.
fn value(row: &str, column: &str, ours: f64, unit: &'static str) -> Value {
    Value {
        published: PUBLISHED.value(row, column),
        ours: Some(ours),
        unit,
    }
}
