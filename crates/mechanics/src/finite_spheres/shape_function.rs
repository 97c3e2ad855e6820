//! Moving least squares over particles, (3-8) to (3-10), with first and second derivatives.
//!
//! The basis is {1, x, y, z} taken about the point of evaluation, which keeps A well conditioned:
//! φ_J = w_J p_J·γ with A γ = e₀, A = Σ w_J p_J p_Jᵀ, p_J = (1, x_J − x). Differentiating A γ = p gives
//! A γ,k = p,k − A,k γ and A γ,kl = −A,k γ,l − A,l γ,k − A,kl γ.
//!
//! A point that no sphere reaches has no functions. Where one is integrated or collocated the functions
//! are NaN, and so is the force, which a simulation reports; `quadrature::every_template_reaches_its_points`
//! shows that no layout of particles has such a point.

use nalgebra::{Matrix3, Matrix4, Vector4};

use super::weight::{curvature_by_distance, quartic, slope_by_distance};
use crate::Vec3;

/// Particles [units of h] with their spheres.
#[derive(Debug, Clone, Default)]
pub(super) struct Particles {
    pub(super) positions: Vec<Vec3>,
    /// 1/radius² of the spheres [1/h²]: all that a weight needs.
    pub(super) inverse_squares: Vec<f64>,
}

/// The functions that do not vanish at a point.
#[derive(Debug, Clone, Default)]
pub(super) struct ShapeFunctions {
    pub(super) particles: Vec<u32>,
    pub(super) values: Vec<f64>,
    pub(super) gradients: Vec<Vec3>,
    /// Filled by [`ShapeFunctions::evaluate_second`] only.
    pub(super) hessians: Vec<Matrix3<f64>>,
    offsets: Vec<Vec3>,
    weights: Vec<f64>,
    slopes: Vec<Vec3>,
}

impl Particles {
    pub(super) fn with_capacity(count: usize) -> Self {
        Self {
            positions: Vec::with_capacity(count),
            inverse_squares: Vec::with_capacity(count),
        }
    }

    /// Sets every radius to `support` times the mean distance of the six nearest particles.
    pub(super) fn size_spheres(&mut self, support: f64) {
        self.inverse_squares.clear();
        for (i, here) in self.positions.iter().enumerate() {
            let mut nearest = [f64::INFINITY; 6];
            for (j, there) in self.positions.iter().enumerate() {
                let squared = (there - here).norm_squared();
                if i == j || squared >= nearest[5] {
                    continue;
                }
                let mut slot = 5;
                while slot > 0 && nearest[slot - 1] > squared {
                    nearest[slot] = nearest[slot - 1];
                    slot -= 1;
                }
                nearest[slot] = squared;
            }
            let mean = nearest.iter().map(|d| d.sqrt()).sum::<f64>() / 6.0;
            self.inverse_squares.push((support * mean).powi(-2));
        }
    }
}

impl ShapeFunctions {
    pub(super) fn with_capacity(count: usize) -> Self {
        Self {
            particles: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
            gradients: Vec::with_capacity(count),
            hessians: Vec::with_capacity(count),
            offsets: Vec::with_capacity(count),
            weights: Vec::with_capacity(count),
            slopes: Vec::with_capacity(count),
        }
    }

    /// Values at `x` [h]; gradients are left empty. None at all where no sphere reaches `x`.
    pub(super) fn evaluate_values(&mut self, particles: &Particles, x: &Vec3) {
        let inverse = self.gather(particles, x);
        let gamma = inverse.column(0).into_owned();
        self.fill_values(&gamma);
    }

    /// Values and gradients at `x` [h]; not numbers where no sphere reaches `x`.
    pub(super) fn evaluate(&mut self, particles: &Particles, x: &Vec3) {
        let inverse = self.gather(particles, x);
        if self.particles.is_empty() {
            self.particles.push(0);
            self.offsets.push(Vec3::repeat(f64::NAN));
            self.weights.push(f64::NAN);
            self.slopes.push(Vec3::repeat(f64::NAN));
        }
        let gamma = inverse.column(0).into_owned();
        self.fill_values(&gamma);
        let first = self.first_derivatives(&inverse, &gamma);
        let spheres = self.offsets.iter().zip(&self.weights).zip(&self.slopes);
        self.gradients
            .extend(spheres.map(|((offset, &weight), slope)| {
                let basis = basis(offset);
                let turned = first.map(|column| basis.dot(&column));
                slope * basis.dot(&gamma) + weight * Vec3::from(turned)
            }));
    }

    /// Values, gradients and Hessians at `x` [h].
    pub(super) fn evaluate_second(&mut self, particles: &Particles, x: &Vec3) {
        self.evaluate(particles, x);
        let inverse = self.inverse_moment();
        let gamma = inverse.column(0).into_owned();
        let first = self.first_derivatives(&inverse, &gamma);
        let weight_hessians =
            |j: usize| weight_hessian(particles, self.particles[j], &self.offsets[j]);
        let mut right = [[Vector4::zeros(); 3]; 3];
        for j in 0..self.particles.len() {
            let basis = basis(&self.offsets[j]);
            let along = basis.dot(&gamma);
            let turned = first.map(|column| basis.dot(&column));
            let second = weight_hessians(j);
            for (k, row) in right.iter_mut().enumerate() {
                for (l, sum) in row.iter_mut().enumerate() {
                    let factor = self.slopes[j][k] * turned[l]
                        + self.slopes[j][l] * turned[k]
                        + second[(k, l)] * along;
                    *sum -= factor * basis;
                }
            }
        }
        let solved = right.map(|row| row.map(|sum| inverse * sum));
        self.hessians.clear();
        for j in 0..self.particles.len() {
            let basis = basis(&self.offsets[j]);
            let along = basis.dot(&gamma);
            let turned = first.map(|column| basis.dot(&column));
            let second = weight_hessians(j);
            self.hessians.push(Matrix3::from_fn(|k, l| {
                second[(k, l)] * along
                    + self.slopes[j][k] * turned[l]
                    + self.slopes[j][l] * turned[k]
                    + self.weights[j] * basis.dot(&solved[k][l])
            }));
        }
    }

    /// Finds the spheres that hold `x` and answers A⁻¹.
    fn gather(&mut self, particles: &Particles, x: &Vec3) -> Matrix4<f64> {
        self.particles.clear();
        self.values.clear();
        self.gradients.clear();
        self.offsets.clear();
        self.weights.clear();
        self.slopes.clear();
        // Half of the spheres hold the point, in no order that a processor could guess: what is in is
        // counted up without a branch.
        self.particles.resize(particles.positions.len(), 0);
        let mut count = 0;
        let spheres = particles.positions.iter().zip(&particles.inverse_squares);
        for (j, (position, inverse_square)) in spheres.enumerate() {
            self.particles[count] = j as u32;
            count += usize::from((position - x).norm_squared() * inverse_square < 1.0);
        }
        self.particles.truncate(count);
        let offset = |&j: &u32| particles.positions[j as usize] - x;
        self.offsets.extend(self.particles.iter().map(offset));
        self.weights.resize(count, 0.0);
        self.slopes.resize(count, Vec3::zeros());
        let written = self.weights.iter_mut().zip(&mut self.slopes);
        for ((&j, offset), (weight, slope)) in self.particles.iter().zip(&self.offsets).zip(written)
        {
            let inverse_square = particles.inverse_squares[j as usize];
            let s = (offset.norm_squared() * inverse_square).sqrt();
            *weight = quartic(s);
            // ∂w/∂x; the offset points from x to the particle.
            *slope = offset * (-slope_by_distance(s) * inverse_square);
        }
        self.inverse_moment()
    }

    /// A⁻¹; not a number where A is singular, as where no sphere reaches.
    fn inverse_moment(&self) -> Matrix4<f64> {
        let inverse = self.moment().try_inverse();
        inverse.unwrap_or_else(|| Matrix4::repeat(f64::NAN))
    }

    fn moment(&self) -> Matrix4<f64> {
        let mut a = [0.0f64; 10];
        for (o, &w) in self.offsets.iter().zip(&self.weights) {
            let (x, y, z) = (w * o.x, w * o.y, w * o.z);
            let terms = [
                w,
                x,
                y,
                z,
                x * o.x,
                x * o.y,
                x * o.z,
                y * o.y,
                y * o.z,
                z * o.z,
            ];
            for (sum, term) in a.iter_mut().zip(terms) {
                *sum += term;
            }
        }
        // Keeps a point with too few spheres around it defined; far below the digits of any other.
        let ridge = 1e-14 * a[0];
        Matrix4::new(
            a[0],
            a[1],
            a[2],
            a[3], //
            a[1],
            a[4] + ridge,
            a[5],
            a[6], //
            a[2],
            a[5],
            a[7] + ridge,
            a[8], //
            a[3],
            a[6],
            a[8],
            a[9] + ridge,
        )
    }

    fn fill_values(&mut self, gamma: &Vector4<f64>) {
        let spheres = self.offsets.iter().zip(&self.weights);
        self.values
            .extend(spheres.map(|(offset, &weight)| weight * basis(offset).dot(gamma)));
    }

    fn first_derivatives(&self, inverse: &Matrix4<f64>, gamma: &Vector4<f64>) -> [Vector4<f64>; 3] {
        let mut right = [Vector4::zeros(); 3];
        for (offset, slope) in self.offsets.iter().zip(&self.slopes) {
            let basis = basis(offset);
            let along = basis.dot(gamma);
            for (k, sum) in right.iter_mut().enumerate() {
                *sum -= slope[k] * along * basis;
            }
        }
        for (k, sum) in right.iter_mut().enumerate() {
            sum[k + 1] += 1.0;
        }
        right.map(|sum| inverse * sum)
    }
}

fn basis(offset: &Vec3) -> Vector4<f64> {
    Vector4::new(1.0, offset.x, offset.y, offset.z)
}

fn weight_hessian(particles: &Particles, particle: u32, offset: &Vec3) -> Matrix3<f64> {
    let inverse_square = particles.inverse_squares[particle as usize];
    let s = (offset.norm_squared() * inverse_square).sqrt();
    let along = Matrix3::identity() * (slope_by_distance(s) * inverse_square);
    let Some(direction) = offset.try_normalize(1e-12) else {
        return along;
    };
    along + direction * direction.transpose() * (curvature_by_distance(s) * s * inverse_square)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic lattice, shaken a little.
    fn particles(support: f64, shake: f64) -> Particles {
        let mut particles = Particles::with_capacity(343);
        for i in 0..343 {
            let lattice = Vec3::new((i % 7) as f64, (i / 7 % 7) as f64, (i / 49) as f64);
            let angle = 2.4 * i as f64;
            let shaken = Vec3::new(angle.sin(), (1.7 * angle).cos(), (0.6 * angle).sin());
            particles
                .positions
                .push(lattice - Vec3::repeat(3.0) + shake * shaken);
        }
        particles.size_spheres(support);
        particles
    }

    fn dense(functions: &ShapeFunctions, of: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut values = vec![0.0; 343];
        for (a, &j) in functions.particles.iter().enumerate() {
            values[j as usize] = of(a);
        }
        values
    }

    #[test]
    fn a_linear_field_is_reproduced_with_its_gradient() {
        let particles = particles(1.8, 0.2);
        let mut functions = ShapeFunctions::with_capacity(343);
        let slope = Vec3::new(0.3, -1.2, 0.7);
        let x = Vec3::new(0.21, -0.33, 0.47);
        functions.evaluate(&particles, &x);
        let field = |j: u32| 2.0 + slope.dot(&particles.positions[j as usize]);
        let pairs = functions.particles.iter().zip(&functions.values);
        let value: f64 = pairs.map(|(&j, v)| field(j) * v).sum();
        let pairs = functions.particles.iter().zip(&functions.gradients);
        let gradient: Vec3 = pairs.map(|(&j, g)| g * field(j)).sum();
        // Rounding.
        assert!((value - 2.0 - slope.dot(&x)).abs() < 1e-13);
        assert!((gradient - slope).norm() < 1e-12);
    }

    /// Central differences; the error falls with the square of the step.
    #[test]
    fn derivatives_are_those_of_the_values() {
        let particles = particles(1.8, 0.2);
        let mut functions = ShapeFunctions::with_capacity(343);
        let x = Vec3::new(0.21, -0.33, 0.47);
        functions.evaluate_second(&particles, &x);
        let exact = functions.clone();
        let error = |step: f64| {
            let mut worst: f64 = 0.0;
            for k in 0..3 {
                let sides = [1.0, -1.0].map(|sign| {
                    let mut moved = x;
                    moved[k] += sign * step;
                    let mut functions = ShapeFunctions::with_capacity(343);
                    functions.evaluate(&particles, &moved);
                    functions
                });
                let difference = |of: &dyn Fn(&ShapeFunctions, usize) -> f64| {
                    let [up, down] =
                        [0, 1].map(|side: usize| dense(&sides[side], |a| of(&sides[side], a)));
                    up.iter()
                        .zip(down)
                        .map(|(u, d)| (u - d) / (2.0 * step))
                        .collect::<Vec<_>>()
                };
                let first = difference(&|f, a| f.values[a]);
                let own = dense(&exact, |a| exact.gradients[a][k]);
                worst = first
                    .iter()
                    .zip(own)
                    .map(|(a, b)| (a - b).abs())
                    .fold(worst, f64::max);
                for l in 0..3 {
                    let second = difference(&|f, a| f.gradients[a][l]);
                    let own = dense(&exact, |a| exact.hessians[a][(l, k)]);
                    worst = second
                        .iter()
                        .zip(own)
                        .map(|(a, b)| (a - b).abs())
                        .fold(worst, f64::max);
                }
            }
            worst
        };
        let order = (error(2e-3) / error(1e-3)).log2();
        assert!((order - 2.0).abs() < 0.2, "observed order {order}");
    }

    /// Why the strong form is delicate: with a linear basis ∇²|x|² is not 6, at any spacing. The values
    /// are second differences of an independent program's shape functions.
    #[test]
    fn the_laplacian_of_a_square_is_wrong_by_the_support() {
        for (support, expected) in [(1.65, 10.7458), (1.8, 7.9971), (2.0, 5.6442), (2.5, 7.5095)] {
            let particles = particles(support, 0.0);
            let mut functions = ShapeFunctions::with_capacity(343);
            functions.evaluate_second(&particles, &Vec3::zeros());
            let pairs = functions.particles.iter().zip(&functions.hessians);
            let squared = |j: u32| particles.positions[j as usize].norm_squared();
            let laplacian: f64 = pairs.map(|(&j, h)| squared(j) * h.trace()).sum();
            // Differences with a step of 5e-5 are good to about 2e-4 here.
            assert!(
                (laplacian - expected).abs() < 5e-4,
                "{support}: {laplacian}"
            );
        }
    }
}
