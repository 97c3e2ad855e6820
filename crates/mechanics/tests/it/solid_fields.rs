//! What a solid answers besides its force, and what holds it.

use nalgebra::Matrix3;
use palpate_files::scene::{Region, RegionBox, RegionSphere};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Friction;

use crate::solid::{HALF, MODULUS, at, cube};

/// Judge: the plane that holds the same triangles.
#[test]
#[ignore = "long"]
fn boxes_and_balls_hold_as_planes_do() {
    let mut problem = cube(0.02, 0.3, Friction::Bonded);
    let expected = at(&problem, 0);
    let bottom = Region {
        boxes: vec![RegionBox {
            min_m: [-1.1 * HALF; 3],
            max_m: [1.1 * HALF, 1.1 * HALF, -0.999 * HALF],
        }],
        ..Region::default()
    };
    // So large that it is 0.2 mm lower at the corners than in the middle.
    let ball = Region {
        spheres: vec![RegionSphere {
            center_m: [0.0, 0.0, -10.0 - 0.99 * HALF],
            radius_m: 10.0,
        }],
        ..Region::default()
    };
    for anchor in [bottom, ball] {
        problem.anchor = anchor;
        assert_eq!(at(&problem, 0), expected);
    }
}

/// Judges: where the supports are, and ∫ p/κ = ∫ div u, which equilibrium of the pressures asks for.
#[test]
fn the_fields_are_those_of_the_body() {
    let nu = 0.3;
    let problem = cube(0.02, nu, Friction::Bonded);
    let fields = at(&problem, 0).fields;
    let each = || fields.positions.iter().zip(&fields.displacements);
    assert_eq!(fields.pressures.len(), fields.positions.len());
    assert_eq!(fields.equivalent_stresses.len(), fields.cells.len() / 10);
    assert!(fields.equivalent_stresses.iter().all(|s| *s > 0.0));
    for (x, u) in each() {
        let center = (x - problem.patch.unwrap().center).norm();
        if x.z == HALF && center < 0.99 * problem.patch.unwrap().radius {
            assert!(
                (u - problem.patch.unwrap().displacement).norm() < 1e-12,
                "{x} {u}"
            );
        }
        assert!(x.z > -HALF || u.norm() == 0.0, "{x} {u}");
    }
    let bulk = MODULUS / (3.0 * (1.0 - 2.0 * nu));
    let ends = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];
    let (mut from_pressure, mut from_displacement) = (0.0, 0.0);
    for cell in fields.cells.chunks_exact(10) {
        let at = |k: usize| cell[k] as usize;
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| fields.positions[at(k)]);
        let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
        let volume = edges.determinant() / 6.0;
        let inverse = edges.try_inverse().unwrap();
        let mut gradients = vec![Vec3::zeros()];
        gradients.extend((0..3).map(|k| inverse.row(k).transpose()));
        gradients[0] = -(gradients[1] + gradients[2] + gradients[3]);
        // The functions of the corners have no mean gradient.
        for (k, [i, j]) in ends.into_iter().enumerate() {
            let u = fields.displacements[at(4 + k)];
            from_displacement += volume * u.dot(&(gradients[i] + gradients[j]));
        }
        let corners = (0..4).map(|k| fields.pressures[at(k)]);
        from_pressure += 0.25 * volume * corners.sum::<f64>() / bulk;
    }
    println!("volume lost: {from_pressure:e} and {from_displacement:e}");
    assert!(from_displacement < 0.0);
    // To what the linear solution is refined.
    assert!((from_pressure / from_displacement - 1.0).abs() < 1e-9);
}
