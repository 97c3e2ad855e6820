//! The estimated error of every kind of problem against the true one; `patch_on_hemisphere` has that of the
//! hemisphere.

use palpate_mechanics::contact::Friction;
use std::sync::Arc;

use palpate_mechanics::finite_elements::estimate::Estimated;
use palpate_mechanics::finite_elements::indentation::{
    self, Base, Block, IndentationProblem, Indenter, IndenterShape, Side,
};
use palpate_mechanics::finite_elements::solid::SolidAnswer;
use palpate_mechanics::finite_elements::tube::{Ends, inflate};
use palpate_mechanics::{LinearElastic, NeoHookean};

use crate::path::closed_form;
use crate::solid::{HALF, at, cube};
use crate::tube::{INNER, OUTER, tube};

/// Half of the true error to five times it, or above with a warning.
fn assert_honest<T>(found: &Estimated<T>, error: f64, what: &str) {
    let ratio = found.error / error;
    println!(
        "{what}: estimated {:.3e}, true {error:.3e}, ratio {ratio:.2}, order {:?}, {:?}",
        found.error, found.observed_order, found.warnings
    );
    assert!(ratio >= 0.5, "{what}: {ratio}");
    assert!(
        ratio <= 5.0 || !found.warnings.is_empty(),
        "{what}: {ratio}"
    );
}

/// Judges: Lamé's cylinder, and the closed form of an incompressible tube in plane strain.
#[test]
fn the_error_of_an_endless_tube_is_honest() {
    let (young, nu, pressure) = (5200.0, 0.3, 100.0);
    let law = LinearElastic::new(young, nu).unwrap();
    let problem = tube(0.01, Ends::Guided, law);
    let exact = (1.0 + nu) / young * pressure * INNER.powi(2) / (OUTER.powi(2) - INNER.powi(2))
        * ((1.0 - 2.0 * nu) * INNER + OUTER.powi(2) / INNER);
    let found = inflate(&problem, &[pressure], 0.02, &mut |_| {}).unwrap();
    let moved = found.answer.inner_displacements[0].unwrap();
    assert_honest(&found, (moved / exact - 1.0).abs(), "linear");

    let law = NeoHookean::incompressible(young / 6.0).unwrap();
    let problem = tube(0.001, Ends::Guided, law);
    let pressure = 650.0;
    let found = inflate(&problem, &[pressure], 0.02, &mut |_| {}).unwrap();
    let moved = found.answer.inner_displacements[0].unwrap();
    // The displacement at which the closed form has this pressure.
    let (mut low, mut high) = (0.5 * moved, 2.0 * moved);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if closed_form(&law, INNER, OUTER, INNER + middle) < pressure {
            low = middle;
        } else {
            high = middle;
        }
    }
    assert_honest(&found, (moved / low - 1.0).abs(), "neo-Hookean");
}

/// Judges: a punch on a half-space, frictionless [Sneddon 1965] and bonded [Spence 1968]; the block ends 50,000 radii away,
/// which changes less than 0.002 %.
#[test]
fn the_error_of_a_punch_is_honest() {
    let (radius, depth, young) = (1e-3, 1e-4, 6000.0);
    for (face, nu) in [(Friction::Bonded, 0.3), (Friction::Frictionless, 0.4999)] {
        let problem = IndentationProblem {
            block: Block {
                radius: 50000.0 * radius,
                height: 50000.0 * radius,
                base: Base::Bonded,
            },
            indenter: Indenter {
                shape: IndenterShape::Flat { side: Side::Absent },
                radius,
                face: face.into(),
            },
            law: Arc::new(LinearElastic::new(young, nu).unwrap()),
        };
        let found = indentation::solve(&problem, &[depth], 0.01, &mut |_| {}).unwrap();
        let force = found.answer.points[0].force;
        let exact = match face {
            Friction::Frictionless => 2.0 * young * radius * depth / (1.0 - nu * nu),
            Friction::Bonded => {
                let shear = young / (2.0 + 2.0 * nu);
                4.0 * shear * radius * depth * (3.0 - 4.0 * nu).ln() / (1.0 - 2.0 * nu)
            }
        };
        assert_honest(
            &found,
            (force / exact - 1.0).abs(),
            &format!("{face:?} {nu}"),
        );
    }
}

/// The end of an anchor makes stress infinite like the edge of a patch: its elements are halved from mesh to
/// mesh too, or its error is not in the change. Judge: where the tetrahedra are.
#[test]
#[ignore = "long"]
fn the_end_of_the_anchor_is_refined_like_the_patch() {
    let problem = cube(0.02, 0.3, Friction::Bonded);
    let [coarse, fine] = [0, 1].map(|halvings| longest_at_anchor(&at(&problem, halvings)));
    println!("{coarse} m, halved {fine} m");
    // The filling's longest edges are diagonals of cells of 25 mm.
    let filling = 0.025 * 3.0_f64.sqrt() * (1.0 + 1e-6);
    assert!(coarse <= 0.5 * filling && fine <= 0.25 * filling);
}

/// Longest edge of a tetrahedron with a corner where the held bottom of the cube ends [m].
fn longest_at_anchor(answer: &SolidAnswer) -> f64 {
    let at = |node: u32| answer.fields.positions[node as usize];
    let ends = |node: u32| {
        let x = at(node);
        let side = x.x.abs().max(x.y.abs());
        (x.z + HALF).abs() < 1e-9 && (side - HALF).abs() < 1e-9
    };
    let cells = answer.fields.cells.chunks_exact(10);
    cells
        .filter(|cell| cell[..4].iter().any(|&node| ends(node)))
        .flat_map(|cell| {
            let pairs = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];
            pairs.map(|[a, b]| (at(cell[a]) - at(cell[b])).norm())
        })
        .fold(0.0, f64::max)
}

/// The limit of a tube with fixed ends carries what no mesh shows, and three meshes at least stand behind
/// its error. Judge: the mesh with elements half as long.
#[test]
fn the_limit_of_a_tube_says_what_it_leaves_out() {
    let law = NeoHookean::incompressible(5200.0 / 6.0).unwrap();
    let problem = tube(0.02, Ends::Fixed, law);
    let found = inflate(&problem, &[300.0], 0.02, &mut |_| {}).unwrap();
    let fine = inflate(&problem, &[300.0], 0.0, &mut |_| {}).unwrap();
    let warnings = &found.answer.warnings;
    assert!(
        warnings.len() == 1 && warnings[0].contains("creases"),
        "{warnings:?}"
    );
    let off = |a: Option<f64>, b: Option<f64>| (a.unwrap() / b.unwrap() - 1.0).abs();
    let (found_u, fine_u) = (
        found.answer.inner_displacements[0],
        fine.answer.inner_displacements[0],
    );
    let error =
        off(found_u, fine_u).max(off(found.answer.limit_pressure, fine.answer.limit_pressure));
    println!("changes by {error:.2e}: {found:?}");
    assert!(error < found.error && found.error < 0.05);
}
