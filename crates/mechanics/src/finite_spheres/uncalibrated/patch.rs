//! Patch tests of the assembled equations: a state of constant strain, in two dimensions and in three, on a block of
//! scattered particles without the map of the region, with the boundary's tractions as loads.

use faer::linalg::matmul::matmul;
use faer::prelude::Solve;
use faer::{Accum, Mat, Par};
use nalgebra::Matrix3;

use super::EnergyRows;
use crate::finite_spheres::shape_function::{Particles, ShapeFunctions};
use crate::gauss::gauss_points;
use crate::{LinearElastic, Vec3};

/// Particles along each edge of the block, whose edges are 1 long.
const ALONG: usize = 4;

/// Scattered by a tenth of their distance, without chance.
fn particles() -> Particles {
    let mut particles = Particles::with_capacity(ALONG.pow(3));
    let step = 1.0 / (ALONG - 1) as f64;
    for k in 0..ALONG.pow(3) {
        let grid = [k % ALONG, (k / ALONG) % ALONG, k / ALONG / ALONG];
        let scatter = |axis: usize| 0.1 * step * ((7 * k + 5 * axis) as f64 * 1.7).sin();
        particles.positions.push(Vec3::from_fn(|axis, _| {
            grid[axis] as f64 * step + scatter(axis)
        }));
    }
    particles.size_spheres(1.9);
    particles
}

/// The gradient of the displacement that the equations of a block under the tractions of `gradient` have, and how far
/// it is from that [-], with so many Gauss points along each of the block's cells.
fn error(gradient: &Matrix3<f64>, plane: bool, count: usize) -> f64 {
    let law = LinearElastic::new(1.0, 0.3).unwrap();
    let particles = particles();
    let unknowns = 3 * particles.positions.len();
    let strain = 0.5 * (gradient + gradient.transpose());
    let stress = 2.0 * law.shear_modulus() * strain
        + Matrix3::from_diagonal_element(law.lame_modulus() * strain.trace());
    let cells = ALONG - 1;
    let axis: Vec<(f64, f64)> = (0..cells)
        .flat_map(|cell| {
            let cell_points = gauss_points(count).into_iter();
            cell_points.map(move |(p, w)| ((cell as f64 + p) / cells as f64, w / cells as f64))
        })
        .collect();
    let mut functions = ShapeFunctions::with_capacity(particles.positions.len());
    let mut matrix = Mat::<f64>::zeros(unknowns, unknowns);
    let mut loads = vec![0.0; unknowns];
    for &(x, wx) in &axis {
        for &(y, wy) in &axis {
            let mut strains = Mat::<f64>::zeros(6 * axis.len(), unknowns);
            for (at, &(z, wz)) in axis.iter().enumerate() {
                functions.evaluate(&particles, &Vec3::new(x, y, z));
                let rows = EnergyRows::new(&law, wx * wy * wz);
                for (&j, slope) in functions.particles.iter().zip(&functions.gradients) {
                    for k in 0..3 {
                        let mut field = Matrix3::zeros();
                        field.set_row(k, &slope.transpose());
                        rows.write(&field, 6 * at, 3 * j as usize + k, &mut strains);
                    }
                }
            }
            let sum = matrix.as_mut();
            matmul(
                sum,
                Accum::Add,
                strains.transpose(),
                &strains,
                1.0,
                Par::Seq,
            );
            // The six faces.
            for normal in 0..3 {
                for (end, sign) in [(0.0, -1.0), (1.0, 1.0)] {
                    let mut place = Vec3::repeat(end);
                    place[(normal + 1) % 3] = x;
                    place[(normal + 2) % 3] = y;
                    functions.evaluate_values(&particles, &place);
                    let traction = stress.column(normal) * (sign * wx * wy);
                    for (&j, value) in functions.particles.iter().zip(&functions.values) {
                        for k in 0..3 {
                            loads[3 * j as usize + k] += traction[k] * value;
                        }
                    }
                }
            }
        }
    }
    // Rigid motions, and in the plane all motion across it, have no energy or none that is wanted.
    let exact = |j: usize| gradient * particles.positions[j];
    let mut hold = |mode: &dyn Fn(usize) -> Vec3, factor: f64| {
        let of = |row: usize| mode(row / 3)[row % 3];
        let value: f64 = (0..unknowns)
            .map(|row| of(row) * exact(row / 3)[row % 3])
            .sum();
        for (row, load) in loads.iter_mut().enumerate() {
            *load += factor * of(row) * value;
            for column in 0..unknowns {
                matrix[(row, column)] += factor * of(row) * of(column);
            }
        }
    };
    for axis in 0..3 {
        let mut unit = Vec3::zeros();
        unit[axis] = 1.0;
        hold(&|_| unit, 1.0);
        hold(&|j| unit.cross(&particles.positions[j]), 1.0);
    }
    if plane {
        for j in 0..particles.positions.len() {
            hold(
                &|other| if other == j { Vec3::z() } else { Vec3::zeros() },
                1e6,
            );
        }
    }
    let right = Mat::from_fn(unknowns, 1, |row, _| loads[row]);
    let solution = matrix.partial_piv_lu().solve(&right);
    let scale = gradient.norm();
    let mut worst = 0.0_f64;
    for place in [
        Vec3::new(0.5, 0.5, 0.5),
        Vec3::new(0.2, 0.7, 0.4),
        Vec3::new(0.9, 0.1, 0.6),
    ] {
        functions.evaluate(&particles, &place);
        let mut found = Matrix3::zeros();
        for (&j, slope) in functions.particles.iter().zip(&functions.gradients) {
            let own = Vec3::from_fn(|k, _| solution[(3 * j as usize + k, 0)]);
            found += own * slope.transpose();
        }
        worst = worst.max((found - gradient).norm() / scale);
    }
    worst
}

/// Judge: the constant gradient. Functions reproduce linear fields, so what is left is the integration of functions
/// that are no polynomials. Each Gauss point more in every cell and direction leaves less than a quarter of it.
fn passes(name: &str, gradient: &Matrix3<f64>, plane: bool) {
    let errors = [2, 3, 4].map(|count| error(gradient, plane, count));
    println!("{name}: {errors:?}");
    assert!(errors[2] < 1e-3, "{name}: {errors:?}");
    assert!(
        errors.windows(2).all(|pair| pair[1] < 0.25 * pair[0]),
        "{name}: {errors:?}"
    );
}

#[test]
fn constant_strain_in_the_plane_is_constant() {
    let gradient = Matrix3::new(0.3, -0.4, 0.0, 0.9, 0.2, 0.0, 0.0, 0.0, 0.0);
    passes("plane strain", &gradient, true);
}

#[test]
fn constant_strain_in_space_is_constant() {
    let gradient = Matrix3::new(0.3, -0.4, 0.2, 0.9, 0.2, -0.3, -0.1, 0.6, -0.5);
    passes("space", &gradient, false);
}
