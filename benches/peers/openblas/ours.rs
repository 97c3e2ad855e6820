//! Our side of the comparison of dense factors; `compare.py` runs it.
//!
//! `peer_openblas TRIANGLES` solves for a kidney of so many triangles, one of them touchable, and prints
//! the number of unknowns and the time of the factors [s].

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a script that fails to unwrap has failed, and tells times"
)]

use std::ops::ControlFlow;
use std::time::Instant;

use palpate_geometry::{Organ, Surface};
use palpate_mechanics::boundary_elements::{BoundaryProblem, Stage};
use palpate_mechanics::surface_response::SurfaceResponse;

fn main() {
    let triangles = std::env::args().nth(1).unwrap().parse().unwrap();
    let surface = Surface::new(Organ::Kidney.surface_mesh(triangles).unwrap()).unwrap();
    let all: Vec<_> = surface.mesh().triangle_ids().collect();
    let (touchable, held) = all.split_at(1);
    let problem = BoundaryProblem {
        surface: &surface,
        poissons_ratio: 0.45,
        fixed: &held[..100],
        touchable,
    };
    let (mut begin, mut end) = (Instant::now(), Instant::now());
    let solved: Result<SurfaceResponse, _> = problem.solve(usize::MAX, &mut |progress| {
        match progress.stage {
            Stage::Assembly => begin = Instant::now(),
            Stage::Factors => end = Instant::now(),
            Stage::Columns => {}
        }
        ControlFlow::Continue(())
    });
    solved.unwrap();
    let unknowns = 3 * all.len();
    let factor_s = (end - begin).as_secs_f64();
    println!("{{\"unknowns\": {unknowns}, \"factor_s\": {factor_s}}}");
}
