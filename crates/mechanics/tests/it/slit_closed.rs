//! The mechanics of a cut that closes.

use std::f64::consts::TAU;

use palpate_mechanics::Vec3;
use palpate_mechanics::surface_response::slit::{CutBody, Slit, SlitFacet};

use crate::slit_bodies::{MM, Table, block, block_table, mm, on_bottom, square, squares};
use crate::slit_judge::{Cut, CutShape, Grid, mirrored};

/// A square with sides of 12 mm, cut to 3 mm.
const AROUND: Cut = Cut {
    length: 12.0 * MM,
    depth: 3.0 * MM,
    shape: CutShape::Square,
};

/// How far the stiffness, cut over uncut, is off that of finite elements on a grid, inside of the slit, in its middle and
/// outside [-]; the largest.
fn off(table: &Table, grid: &Grid) -> f64 {
    let squares = [
        square([3.75, 6.0], [-1.25, 1.25]),
        square([-1.25, 1.25], [-1.25, 1.25]),
        square([6.0, 8.5], [-1.25, 1.25]),
    ];
    let [uncut, cut] = [None, Some(AROUND)].map(|cut| grid.compliances(cut, on_bottom, &squares));
    let slit = table.cut(&AROUND, 32);
    let mut largest: f64 = 0.0;
    for (number, square) in squares.iter().enumerate() {
        let [own, more] = table.felt(&slit, square);
        for axis in 0..3 {
            let found = own[axis] / (own[axis] + more[axis]);
            let expected = uncut[number][axis] / cut[number][axis];
            let off = found / expected - 1.0;
            println!(
                "square {number}, axis {axis}: {found:.3} ({expected:.3}), {:+.1} %",
                100.0 * off
            );
            largest = largest.max(off.abs());
        }
    }
    largest
}

/// Judge: finite elements whose nodes on the slit are doubled. Tolerance: what is asked of a rim.
#[test]
#[ignore = "slow: some minutes"]
fn a_closed_slit_is_that_of_finite_elements() {
    let off = off(&block_table(2.0), &block());
    assert!(off < 0.25, "{off}");
}

/// As above, on a coarser grid.
#[test]
#[ignore = "long"]
fn a_closed_slit_is_nearly_that_of_finite_elements() {
    let lines = mirrored(&mm(&[1.25, 2.5, 3.75, 6.0, 8.5, 13.0, 20.0]));
    let z = mm(&[-20.0, -12.0, -6.5, -4.0, -3.0, -2.0, -1.0, 0.0]);
    let grid = Grid {
        lines: [lines.clone(), lines, z],
        ..block()
    };
    let off = off(&block_table(3.0), &grid);
    assert!(off < 0.25, "{off}");
}

/// Judge: a circle is the same from whichever facet on, and in either direction. Tolerance: a tenth, as for facets of
/// other lengths: the first facet, one of 30, keeps the free end that the last one closes.
#[test]
fn a_closed_slit_may_begin_anywhere() {
    const COUNT: u32 = 30;
    let table = block_table(3.0);
    let body = CutBody {
        surface: &table.solid.surface,
        tree: &table.tree,
        response: &table.response,
    };
    let radius = 6.0 * MM;
    let facet = |number: u32| {
        let angle = TAU * f64::from(number % COUNT) / f64::from(COUNT);
        SlitFacet {
            middle: radius * Vec3::new(angle.cos(), angle.sin(), 0.0),
            along: Vec3::new(-angle.sin(), angle.cos(), 0.0),
            normal: Vec3::z(),
            length: TAU * radius / f64::from(COUNT),
            depth: 1.5 * MM,
        }
    };
    let around = |numbers: &mut dyn Iterator<Item = u32>| {
        let mut slit = Slit::new(&table.response, COUNT as usize);
        numbers.for_each(|number| slit.open(&body, &facet(number)).unwrap());
        slit
    };
    let first = around(&mut (0..COUNT));
    let others = [around(&mut (11..11 + COUNT)), around(&mut (0..COUNT).rev())];
    for square in &squares() {
        let [own, more] = table.felt(&first, square);
        for other in &others {
            let found = table.felt(other, square)[1];
            for axis in 0..3 {
                assert!(
                    more[axis] > 0.0 && more[axis] < own[axis],
                    "{more:?} {own:?}"
                );
                let off = found[axis] / more[axis] - 1.0;
                assert!(off.abs() < 0.1, "{axis}: {off}");
            }
        }
    }
}
