//! Times of the off-line and the on-line computation.

use std::ops::ControlFlow;
use std::time::Instant;

use palpate_mechanics::Error;
use palpate_mechanics::boundary_elements::{BoundaryProblem, Stage};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::surface_response::{
    MovedTriangle, PatchContact, PatchWorkspace, Reciprocity, SurfaceResponse, TouchId,
};

use super::body::Body;
use crate::machine::median;
use crate::row::Rows;
use palpate_jobs::{ProgressCallback, preparation};

/// Times of the off-line computation [s].
#[derive(Debug, Clone, Copy)]
pub(super) struct OffLine {
    pub(super) assembly: f64,
    pub(super) factors: f64,
    pub(super) columns: f64,
}

/// Median times of an on-line step [s].
#[derive(Debug, Clone, Copy)]
pub(super) struct OnLine {
    pub(super) force: f64,
    pub(super) force_and_field: f64,
    /// How many were measured.
    pub(super) steps: usize,
}

/// Steps that are thrown away, and that are measured: an odd number has a middle.
const WARM_UP: usize = 100;
const STEPS: usize = 1001;

/// What the touched triangles are moved by [m].
const DEPTH: f64 = 1e-3;

/// Young's modulus [Pa]; no time depends on it.
const YOUNGS_MODULUS: f64 = 1e4;

/// Solves for all touchable triangles.
pub(super) fn solve(
    rows: &Rows<'_>,
    problem: &BoundaryProblem<'_>,
) -> Result<(SurfaceResponse, OffLine), Error> {
    let memory = preparation::resources().memory;
    let start = Instant::now();
    let mut ends = [0.0; 3];
    let solved = problem.solve(memory, &mut |progress| {
        let (stage, words) = match progress.stage {
            Stage::Assembly => (0, "the matrix"),
            Stage::Factors => (1, "its factors"),
            Stage::Columns => (2, "its columns"),
        };
        ends[stage] = start.elapsed().as_secs_f64();
        rows.report_step(format!("{words}, {:.0} %", 100.0 * progress.part));
        match rows.should_stop() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    let times = OffLine {
        assembly: ends[0],
        factors: ends[1] - ends[0],
        columns: ends[2] - ends[1],
    };
    Ok((solved?, times))
}

/// Moves so many triangles of `body` at once, time and again. None when their influences are no body's.
pub(super) fn touch(body: &Body, response: &SurfaceResponse, triangles: usize) -> Option<OnLine> {
    let near = body.opposite();
    let displacement = -DEPTH * body.touched_normal();
    let touched: Option<Vec<TouchId>> = near
        .iter()
        .take(triangles)
        .map(|&id| response.find(id))
        .collect();
    let moved: Vec<MovedTriangle> = touched?
        .into_iter()
        .map(|triangle| MovedTriangle {
            triangle,
            displacement,
        })
        .collect();
    let contact = PatchContact {
        friction: Friction::Bonded,
        reciprocity: Reciprocity::Imposed,
        youngs_modulus: YOUNGS_MODULUS,
    };
    let mut workspace = PatchWorkspace::new(moved.len());
    let mut field = vec![0.0_f32; 3 * response.parts().triangles];
    let (mut forces, mut wholes) = (Vec::with_capacity(STEPS), Vec::with_capacity(STEPS));
    for step in 0..WARM_UP + STEPS {
        let start = Instant::now();
        let found = response.press(std::hint::black_box(&moved), &contact, &mut workspace)?;
        let pressed = start.elapsed().as_secs_f64();
        field.fill(0.0);
        let moved = moved.iter().map(|one| one.triangle);
        response.add_fields(moved.zip(found.iter().copied()), &mut field);
        std::hint::black_box(&field);
        if step >= WARM_UP {
            forces.push(pressed);
            wholes.push(start.elapsed().as_secs_f64());
        }
    }
    Some(OnLine {
        force: median(&mut forces),
        force_and_field: median(&mut wholes),
        steps: STEPS,
    })
}
