//! Boundary elements on walls: where constant triangles are good enough for a hollow organ.

use std::f64::consts::TAU;
use std::sync::Arc;

use palpate_geometry::{NodeId, Surface, TriangleMesh};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::tube::{Ends, Tube, TubeProblem, TubePunch, indent};
use palpate_mechanics::surface_response::TipField;
use palpate_mechanics::{LinearElastic, Vec3};

use crate::boundary_response::Held;
use crate::tip_field::{FlatTip, stiffness, under};

pub(crate) const LENGTH: f64 = 0.04;
pub(crate) const NU: f64 = 0.45;
/// Radius of the punch [m].
pub(crate) const PUNCH: f64 = 2e-3;

/// A tube along z, its middle at the origin: `around` by `along` squares in two triangles each, inside and
/// outside, and `across` rings on its ends.
pub(crate) fn tube(inner: f64, outer: f64, [around, along, across]: [usize; 3]) -> Surface {
    // A closed line through the wall, from the inner edge of the lower end up the outside and back.
    let part = |k: usize, of: usize| k as f64 / of as f64;
    let low = -0.5 * LENGTH;
    let mut line = Vec::new();
    line.extend((0..across).map(|k| (inner + (outer - inner) * part(k, across), low)));
    line.extend((0..along).map(|k| (outer, low + LENGTH * part(k, along))));
    line.extend((0..across).map(|k| (outer - (outer - inner) * part(k, across), -low)));
    line.extend((0..along).map(|k| (inner, -low - LENGTH * part(k, along))));
    let mut vertices = Vec::new();
    for k in 0..around {
        let (sine, cosine) = (TAU * part(k, around)).sin_cos();
        vertices.extend(
            line.iter()
                .map(|&(r, z)| Vec3::new(r * cosine, r * sine, z)),
        );
    }
    let node = |k: usize, i: usize| NodeId((k % around * line.len() + i % line.len()) as u32);
    let mut triangles = Vec::new();
    for k in 0..around {
        for i in 0..line.len() {
            let [a, b] = [node(k, i), node(k + 1, i)];
            let [c, d] = [node(k, i + 1), node(k + 1, i + 1)];
            triangles.push([a, b, d]);
            triangles.push([a, d, c]);
        }
    }
    Surface::new(TriangleMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// Force per depth of a sliding punch at mid-length over E [m], by finite elements: the slope once the
/// whole face touches.
pub(crate) fn by_finite_elements(inner_radius: f64, outer_radius: f64) -> f64 {
    let problem = TubeProblem {
        tube: Tube {
            length: LENGTH,
            inner_radius,
            outer_radius,
        },
        law: Arc::new(LinearElastic::new(1.0, NU).unwrap()),
        ends: Ends::Fixed,
    };
    let punch = TubePunch {
        radius: PUNCH,
        face: Friction::Frictionless,
        pressure: 0.0,
        depths: vec![1e-3, 1.2e-3],
    };
    let found = indent(&problem, &punch, 1.0, &mut |_| {}).unwrap();
    println!("finite elements: error {:.3}", found.error);
    let [shallow, deep] = [0, 1].map(|k| found.answer.forces[k]);
    (deep - shallow) / 0.2e-3
}

fn by_boundary_elements(inner: f64, outer: f64, parts: [usize; 3]) -> f64 {
    let surface = tube(inner, outer, parts);
    let solid = Held::new(surface, NU, |x| x.z.abs() > 0.5 * LENGTH * (1.0 - 1e-9));
    let place = outer * Vec3::x();
    let response = solid.response::<f32>(&solid.near_point(&place, 200));
    let field = TipField::new(&response, &solid.surface, PUNCH).unwrap();
    let (triangle, at) = under(&solid.surface, &place);
    let load = field.at(&solid.surface, triangle, &at);
    let tip = FlatTip {
        a: PUNCH,
        nu: NU,
        bond: Friction::Frictionless,
    };
    let found = stiffness(&load, &Vec3::x(), tip);
    println!(
        "{} triangles: {found:.3e}",
        solid.surface.mesh().triangles().len()
    );
    found
}

/// Quick form of the test below, on two coarser meshes of one wall. Judge: the finite elements of that test, whose force
/// per depth over E [m] stands here. Tolerance: the error goes with the square of the triangles over the wall; of 36
/// around it is 3 %, so of 24 it is 7 %, to the 2 % that the judge may miss.
#[test]
#[ignore = "long"]
fn a_thick_wall_is_met_better_by_smaller_triangles() {
    let errors = [[16, 16, 1], [24, 24, 2]]
        .map(|parts| by_boundary_elements(5e-3, 8e-3, parts) / 1.142e-3 - 1.0);
    println!("{errors:+.3?}");
    assert!(errors[0] > errors[1]);
    assert!((0.05..0.09).contains(&errors[1]), "{errors:?}");
}

/// Judge: quadratic elements with a pressure field, good to some percent. Constant triangles are too stiff
/// in bending, by the second power of their size over the wall: on 5,472 triangles a wall of 2.5 mm is 5 %
/// too stiff, one of 3 mm 3 %, and one of 1.5 mm 17 %.
#[test]
#[ignore = "slow: minutes"]
fn thick_walls_are_met_and_thin_ones_are_not() {
    for (inner, outer, allowed) in [
        (5e-3, 7.5e-3, 0.0..0.1),
        (5e-3, 8e-3, 0.0..0.1),
        (6.5e-3, 8e-3, 0.1..0.3),
    ] {
        let expected = by_finite_elements(inner, outer);
        let errors = [[16, 16, 1], [24, 24, 2], [36, 36, 2]]
            .map(|parts| by_boundary_elements(inner, outer, parts) / expected - 1.0);
        println!("{inner} {outer}: {expected:.3e}, {errors:+.3?}");
        assert!(errors[0] > errors[1] && errors[1] > errors[2]);
        assert!(allowed.contains(&errors[2]));
    }
}
