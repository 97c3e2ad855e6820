//! The kernel against energies by another route.

use nalgebra::Matrix3;
use palpate_geometry::{NodeId, TetrahedronMesh};

use super::elements::{Nodal, Pack};
use super::kernel::Deformed;
use super::law::Moduli;
use crate::Vec3;
use crate::finite_elements::ElementMesh;

fn two_tetrahedra() -> TetrahedronMesh {
    let vertices = [
        [0.0, 0.1, 0.0],
        [1.0, 0.0, 0.2],
        [0.1, 1.1, 0.0],
        [0.0, 0.2, 0.9],
        [1.0, 1.0, 1.2],
    ];
    let vertices = vertices.map(Vec3::from).to_vec();
    let tetrahedra = vec![[0, 1, 2, 3].map(NodeId), [1, 4, 2, 3].map(NodeId)];
    TetrahedronMesh::new(vertices, tetrahedra).unwrap()
}

/// Displacements that bend, turn and stretch.
fn displacement(place: &Vec3) -> Vec3 {
    let [x, y, z] = [place.x, place.y, place.z];
    Vec3::new(
        0.2 * x * y - 0.3 * z,
        0.15 * z * z + 0.1 * x,
        0.3 * x - 0.2 * y * z + 0.1 * z,
    )
}

/// Energy [J] written with invariants of C and determinants of nalgebra, in `f64`.
fn energy(pack: &Pack<f64>, nodal: &Nodal<f64>, lane: usize) -> f64 {
    let (mut sum, mut dilation) = (0.0, 0.0);
    let moduli = [pack.moduli.c10, pack.moduli.c01, pack.moduli.dilation];
    let [c10, c01, lambda] = moduli.map(|value| value.0[lane]);
    let at_points = lambda.min(4.0 * (c10 + c01));
    for point in 0..4 {
        let h = pack.gradient(nodal, point);
        let f = Matrix3::from_fn(|i, j| h[j][i].0[lane]) + Matrix3::identity();
        let c = f.transpose() * f;
        let first = c.trace();
        let second = 0.5 * (first * first - (c * c).trace());
        let j = f.determinant();
        sum += c10 * (first - 3.0) + c01 * (second - 3.0) - (2.0 * c10 + 4.0 * c01) * (j - 1.0);
        sum += (c10 + 0.5 * at_points) * (j - 1.0).powi(2);
        dilation += 0.25 * (j - 1.0);
    }
    pack.quarter.0[lane] * (sum + 2.0 * (lambda - at_points) * dilation * dilation)
}

fn pack_and_nodes() -> (Pack<f64>, Nodal<f64>) {
    let mesh = two_tetrahedra();
    let moduli = [
        Moduli::mooney_rivlin(3.0, 1.0, 0.45).unwrap(),
        Moduli::mooney_rivlin(2.0, 0.0, 0.3).unwrap(),
    ];
    let elements = ElementMesh::from_tetrahedra(&mesh);
    let pack = Pack::all(&mesh, &elements.elements, &moduli).remove(0);
    let places = &elements.nodes;
    let values: Vec<f64> = places
        .iter()
        .flat_map(|place| <[f64; 3]>::from(displacement(place)))
        .collect();
    let nodal = pack.gather(&values);
    (pack, nodal)
}

/// Judge: central differences of the energy, whose error falls with the square of the step.
#[test]
fn forces_are_the_slope_of_the_energy() {
    let (pack, nodal) = pack_and_nodes();
    let mut deformed = Deformed::default();
    pack.deform(&nodal, &mut deformed);
    let forces = pack.resist(&deformed);
    for lane in 0..2 {
        for (node, axis) in (0..30).map(|k| (k / 3, k % 3)) {
            let slope = |step: f64| {
                let [more, less] = [step, -step].map(|step| {
                    let mut nodal = nodal;
                    nodal[node][axis].0[lane] += step;
                    energy(&pack, &nodal, lane)
                });
                (more - less) / (2.0 * step)
            };
            let found = forces[node][axis].0[lane];
            // The energy is a polynomial of the sixth degree: Richardson's value is good to 1e-10.
            let expected = (4.0 * slope(1e-3) - slope(2e-3)) / 3.0;
            assert!((found - expected).abs() < 1e-8, "{found} {expected}");
        }
    }
}

/// Judge: central differences of the forces.
#[test]
fn change_of_forces_is_their_derivative() {
    let (pack, nodal) = pack_and_nodes();
    let mut deformed = Deformed::default();
    pack.deform(&nodal, &mut deformed);
    let direction: Nodal<f64> = std::array::from_fn(|node| {
        std::array::from_fn(|axis| super::lanes::Lanes::splat(((3 * node + axis) as f64).sin()))
    });
    let change = pack.change(&deformed, &direction);
    let derivative = |step: f64| {
        let [more, less] = [step, -step].map(|step| {
            let mut nodal = nodal;
            for (own, along) in nodal.iter_mut().flatten().zip(direction.iter().flatten()) {
                *own += *along * super::lanes::Lanes::splat(step);
            }
            let mut deformed = Deformed::default();
            pack.deform(&nodal, &mut deformed);
            pack.resist(&deformed)
        });
        move |node: usize, axis: usize, lane: usize| {
            (more[node][axis].0[lane] - less[node][axis].0[lane]) / (2.0 * step)
        }
    };
    let (fine, coarse) = (derivative(1e-3), derivative(2e-3));
    for lane in 0..2 {
        for (node, axis) in (0..30).map(|k| (k / 3, k % 3)) {
            let expected = (4.0 * fine(node, axis, lane) - coarse(node, axis, lane)) / 3.0;
            let found = change[node][axis].0[lane];
            assert!((found - expected).abs() < 1e-8, "{found} {expected}");
        }
    }
}
