//! Finite elements condensed to the surface.

use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::ControlFlow;

use nalgebra::DMatrix;
use palpate_geometry::{Organ, TriangleId};
use palpate_mechanics::boundary_elements::{Precision, Stage};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::condensed::CondensedProblem;
use palpate_mechanics::finite_elements::hemisphere::{HemisphereProblem, Patch};
use palpate_mechanics::surface_response::{Sampling, SurfaceResponse, TipField, TouchId};
use palpate_mechanics::{Error, LinearElastic, Vec3};

use crate::boundary_response::Held;
use crate::boundary_tubes::{LENGTH, NU, PUNCH, by_finite_elements, tube};
use crate::contacts::RADIUS;
use crate::tip_field::{FlatTip, stiffness, under};

fn problem<'a>(solid: &'a Held, touchable: &'a [TriangleId], edge: f64) -> CondensedProblem<'a> {
    CondensedProblem {
        surface: &solid.surface,
        poissons_ratio: solid.nu,
        fixed: &solid.held,
        touchable,
        edge,
        regions: None,
    }
}

fn response<T: Precision>(problem: &CondensedProblem<'_>) -> SurfaceResponse<T> {
    problem
        .solve(usize::MAX, &mut |_| ControlFlow::Continue(()))
        .unwrap()
}

fn hemisphere(nu: f64, triangles: usize) -> Held {
    Held::organ(Organ::Hemisphere, triangles, nu)
}

/// Force per depth over E [m] of a tip of radius `a` [m] at `place`, along `normal`.
fn felt<T: Precision>(
    solid: &Held,
    response: &SurfaceResponse<T>,
    place: &Vec3,
    normal: &Vec3,
    a: f64,
    bond: Friction,
) -> f64 {
    let field = TipField::new(response, &solid.surface, a).unwrap();
    let (triangle, at) = under(&solid.surface, place);
    let load = field.at(&solid.surface, triangle, &at);
    let nu = solid.nu;
    stiffness(&load, normal, FlatTip { a, nu, bond })
}

/// Judges: fine axisymmetric elements, and boundary elements of the same triangles. Tolerances: 5 %, which is
/// asked of a tip on a hemisphere, and 2 % between the two methods, which share their triangles and the
/// law of the tip.
#[test]
fn a_tip_on_a_thick_body_feels_the_same() {
    let (place, normal) = (RADIUS * Vec3::z(), Vec3::z());
    for nu in [0.3, 0.49] {
        let solid = hemisphere(nu, 500);
        let touchable = solid.near_point(&place, 160);
        let by_tetrahedra = response::<f32>(&problem(&solid, &touchable, 0.0125));
        let by_boundary = solid.response::<f32>(&touchable);
        for (a, patch, bond) in [
            (2e-3, Patch::Slip, Friction::Frictionless),
            (5e-3, Patch::Bonded, Friction::Bonded),
        ] {
            let judge = HemisphereProblem {
                radius: RADIUS,
                patch_radius: a,
                patch,
                law: LinearElastic::new(1.0, nu).unwrap(),
                depth: 1.0,
            };
            let expected = judge.solve_on(0.02, 0).unwrap().force;
            let found = felt(&solid, &by_tetrahedra, &place, &normal, a, bond) / expected;
            let other = felt(&solid, &by_boundary, &place, &normal, a, bond) / expected;
            println!("nu {nu}, a {a}, {bond:?}: {found:.4}, boundary elements {other:.4}");
            assert!((found - 1.0).abs() < 0.05, "{found}");
            assert!((found / other - 1.0).abs() < 0.02, "{found} {other}");
        }
    }
}

/// Judge: reciprocity and work, which Galerkin's method keeps for every mesh. Tolerance: rounding, as the
/// pressures' block carries 10⁻⁷.
#[test]
fn a_response_is_symmetric_and_takes_work() {
    let solid = hemisphere(0.49, 200);
    let touchable = solid.near_point(&(RADIUS * Vec3::z()), 30);
    let response = response::<f64>(&problem(&solid, &touchable, 0.015));
    assert_eq!(response.parts().sampling, Sampling::Means);
    let ids: Vec<TouchId> = touchable
        .iter()
        .map(|&triangle| response.find(triangle).unwrap())
        .collect();
    let size = 3 * ids.len();
    let mut whole = DMatrix::zeros(size, size);
    for (i, &moved) in ids.iter().enumerate() {
        for (j, &loaded) in ids.iter().enumerate() {
            let block = response.influence(moved, loaded);
            whole.view_mut((3 * i, 3 * j), (3, 3)).copy_from(&block);
        }
    }
    let asymmetry = (&whole - whole.transpose()).amax() / whole.amax();
    println!("asymmetry {asymmetry:.1e}");
    assert!(asymmetry < 1e-9, "{asymmetry}");
    let least = whole.symmetric_eigenvalues().min();
    assert!(least > 1e-3 * whole.amax(), "{least}");
}

/// Judge: the same solid turned and as it was; the lattice of the tetrahedra does not turn along. Tolerance:
/// what tetrahedra of the size of a triangle miss.
#[test]
fn a_turned_solid_feels_the_same() {
    let place = RADIUS * Vec3::new(0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
    let about = nalgebra::Rotation3::new(Vec3::new(0.3, 0.7, -0.4));
    let felt_when = |turn: nalgebra::Rotation3<f64>| {
        let mesh = Organ::Hemisphere.surface_mesh(300).unwrap();
        let mesh = mesh.map_vertices(|x| turn * x).unwrap();
        let surface = palpate_geometry::Surface::new(mesh).unwrap();
        let solid = Held::new(surface, 0.45, |x| (turn.inverse() * x).z < 1e-6);
        let place = turn * place;
        let touchable = solid.near_point(&place, 60);
        let response = response::<f32>(&problem(&solid, &touchable, 0.0125));
        felt(
            &solid,
            &response,
            &place,
            &place.normalize(),
            5e-3,
            Friction::Frictionless,
        )
    };
    let [still, turned] = [nalgebra::Rotation3::identity(), about].map(felt_when);
    println!("turned: {:.5}", turned / still);
    assert!((turned / still - 1.0).abs() < 0.01, "{still} {turned}");
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let solid = hemisphere(0.45, 200);
    let touchable = solid.near_point(&(RADIUS * Vec3::z()), 5);
    let good = problem(&solid, &touchable, 0.02);
    let refused = |problem: &CondensedProblem<'_>, memory: usize, word: &str| {
        let solved = problem.solve::<f32>(memory, &mut |_| ControlFlow::Continue(()));
        let error = solved.unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    };
    let most = good.memory::<f32>().most;
    refused(&good, most - 1, "GB of memory");
    let lost = CondensedProblem { edge: 1.0, ..good };
    refused(&lost, usize::MAX, "edge");
    let loose = CondensedProblem { fixed: &[], ..good };
    refused(&loose, usize::MAX, "anchor holds no triangle");
    let both = CondensedProblem {
        fixed: &touchable,
        ..good
    };
    refused(&both, usize::MAX, "lie in the anchor");
}

#[test]
fn a_solution_tells_how_far_it_is_and_can_be_cancelled() {
    let solid = hemisphere(0.45, 200);
    let touchable = solid.near_point(&(RADIUS * Vec3::z()), 40);
    let problem = problem(&solid, &touchable, 0.02);
    let mut parts = Vec::new();
    let watched = problem.solve::<f32>(usize::MAX, &mut |progress| {
        parts.push((progress.stage, progress.part));
        ControlFlow::Continue(())
    });
    watched.unwrap();
    assert!(parts.is_sorted_by(|a, b| a.1 <= b.1), "{parts:?}");
    assert_eq!(parts.last(), Some(&(Stage::Columns, 1.0)));
    for stage in [Stage::Assembly, Stage::Factors, Stage::Columns] {
        assert!(parts.iter().any(|part| part.0 == stage));
        let broken = problem.solve::<f32>(usize::MAX, &mut |progress| {
            if progress.stage == stage {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        assert!(matches!(broken, Err(Error::Cancelled)));
    }
}

/// Error against `tube::indent` of a punch on the side of a tube, `parts` as of [`tube`].
fn tube_error([inner, outer]: [f64; 2], expected: f64, parts: [usize; 3], edge: f64) -> f64 {
    let surface = tube(inner, outer, parts);
    let solid = Held::new(surface, NU, |x| x.z.abs() > 0.5 * LENGTH * (1.0 - 1e-9));
    let place = outer * Vec3::x();
    let touchable = solid.near_point(&place, 100);
    let response = response::<f32>(&problem(&solid, &touchable, edge));
    let slip = Friction::Frictionless;
    let found = felt(&solid, &response, &place, &Vec3::x(), PUNCH, slip);
    let error = found / expected - 1.0;
    println!(
        "{inner} {outer}, {} triangles, edge {edge}: {:+.1} %",
        solid.surface.mesh().triangles().len(),
        100.0 * error
    );
    error
}

/// Judge: `tube::indent` [m], which the slow test beside this one makes again. Tolerance: triangles of two
/// thirds of the wall, on which boundary elements are off by 9 %.
#[test]
fn a_wall_bends_as_it_should() {
    let error = tube_error([5e-3, 8e-3], 1.142e-3, [24, 24, 2], 2.1e-3);
    assert!(error.abs() < 0.06, "{error}");
}

/// Judge: quadratic hexahedra with a pressure field, graded to the punch's edge, good to 2 % and in the
/// thinnest wall to 6 %. Tolerance: 5 % and what the judge misses, on as many triangles as are used;
/// boundary elements are off by 6, 4 and 21 % there.
#[test]
#[ignore = "slow: minutes"]
fn walls_thick_and_thin_are_met() {
    for (radii, allowed) in [
        ([5e-3, 7.5e-3], 0.05),
        ([5e-3, 8e-3], 0.05),
        ([6.5e-3, 8e-3], 0.1),
    ] {
        let expected = by_finite_elements(radii[0], radii[1]);
        let edge = 0.7 * (radii[1] - radii[0]);
        let error = tube_error(radii, expected, [36, 36, 2], edge);
        assert!(error.abs() < allowed, "{radii:?}: {error}");
    }
}
