//! Tabulated forces against runs of finite elements on the same mesh, and on a finer one.

use std::sync::Arc;

use palpate_characterize::inverse::{Body, PUNCH, SHAPES};
use palpate_mechanics::finite_elements::indentation::{IndentationRun, IndentationSettings};
use palpate_mechanics::{Law, MooneyRivlin, PronySeries};

fn forces(shape: f64, halvings: u32, deepest: f64) -> Vec<f64> {
    let Body::Block { block, indenter } = Body::under_punch(1.0) else {
        panic!("a punch is pressed into a block");
    };
    let law: Arc<dyn Law> = Arc::new(MooneyRivlin::incompressible(1.0 - shape, shape).unwrap());
    let mut run = IndentationRun::new(&IndentationSettings {
        block,
        indenter,
        law,
        prony: PronySeries::default(),
        halvings,
    })
    .unwrap();
    let depths = PUNCH.iter().map(|row| row.0).take_while(|x| *x <= deepest);
    depths
        .map(|x| run.press(x, x, |_| ()).unwrap().force)
        .collect()
}

/// The coarsest mesh gives the column of a shape: to the digits of the table.
fn assert_column(place: usize, deepest: f64) {
    for (row, force) in PUNCH.iter().zip(forces(SHAPES[place], 0, deepest)) {
        let tabulated = row.2[place];
        assert!(
            (force - tabulated).abs() < 1e-3 * tabulated,
            "{} {}: {force}",
            SHAPES[place],
            row.0
        );
    }
}

#[test]
fn the_first_rows_are_those_of_finite_elements() {
    assert_column(3, 1.0);
}

#[test]
#[ignore = "slow: five runs to eight radii"]
fn the_table_is_that_of_finite_elements() {
    (0..SHAPES.len()).for_each(|place| assert_column(place, 8.0));
}

/// Of two meshes, errors fall with the power 1.2 of the size of the elements, as in the reference.
#[test]
#[ignore = "slow: a run on the finer mesh takes minutes"]
fn the_extrapolated_column_is_that_of_two_meshes() {
    let [coarse, fine] = [0, 1].map(|halvings| forces(0.0, halvings, 8.0));
    for ((row, coarse), fine) in PUNCH.iter().zip(coarse).zip(fine) {
        let limit = fine + (fine - coarse) / (2_f64.powf(1.2) - 1.0);
        assert!((limit - row.1).abs() < 1e-3 * limit, "{}: {limit}", row.0);
    }
}
