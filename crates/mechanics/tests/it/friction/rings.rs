//! Spence's self-similar indentation of a half-space with friction, by rings of traction.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

/// Complete elliptic integrals K and E of 1 − m = `rest`, by the arithmetic-geometric mean.
fn elliptic(rest: f64) -> (f64, f64) {
    let (mut a, mut g, mut sum, mut factor) =
        (1.0, rest.max(1e-15).sqrt(), 0.5 * (1.0 - rest), 1.0);
    for _ in 0..8 {
        let c: f64 = 0.5 * (a - g);
        (a, g) = (0.5 * (a + g), f64::sqrt(a * g));
        sum += factor * c * c;
        factor *= 2.0;
    }
    let k = PI / (2.0 * a);
    (k, k * (1.0 - sum))
}

/// Self-similar indentation of a half-space with friction [Spence 1968, 1975], by rings of constant traction on its
/// surface: another method, which has the influence of each ring in closed form. Radius and depth are 1, as is the shear
/// modulus.
pub(super) struct Rings {
    edges: Vec<f64>,
    nu: f64,
    /// Normal displacement by pressure, radial by radial traction.
    direct: [DMatrix<f64>; 2],
    /// Normal displacement by radial traction, radial by pressure.
    cross: [DMatrix<f64>; 2],
}

impl Rings {
    pub(super) fn new(nu: f64, count: usize) -> Self {
        let edges: Vec<f64> = (0..=count)
            .map(|i| 1.0 - (1.0 - i as f64 / count as f64).powi(2))
            .collect();
        let middle = |i: usize| 0.5 * (edges[i] + edges[i + 1]);
        let ring = |field: fn(f64, f64) -> f64| {
            DMatrix::from_fn(count, count, |i, j| {
                (1.0 - nu) * integral(field, middle(i), edges[j], edges[j + 1])
            })
        };
        let coupling = 0.5 * (1.0 - 2.0 * nu);
        // u_z(r) = −(1 − 2ν)/(2G) ∫ q ds from r outward.
        let lifted = DMatrix::from_fn(count, count, |i, j| {
            -coupling * (edges[j + 1] - edges[j].max(middle(i))).max(0.0)
        });
        // u_r(r) = −(1 − 2ν)/(2G r) ∫ p s ds from the axis to r.
        let drawn = DMatrix::from_fn(count, count, |i, j| {
            let r = middle(i);
            let outer = edges[j + 1].min(r);
            -coupling / r * 0.5 * (outer * outer - edges[j] * edges[j]).max(0.0)
        });
        Self {
            direct: [ring(normal_kernel), ring(radial_kernel)],
            cross: [lifted, drawn],
            edges,
            nu,
        }
    }

    /// Pressures and tractions when the first `stuck` rings stick.
    fn tractions(&self, mu: f64, stuck: usize) -> (Vec<f64>, Vec<f64>) {
        let count = self.edges.len() - 1;
        let size = count + stuck;
        let mut system = DMatrix::zeros(size, size);
        for row in 0..size {
            let (part, i) = if row < count {
                (0, row)
            } else {
                (1, row - count)
            };
            let by_pressure = |j: usize| [&self.direct[0], &self.cross[1]][part][(i, j)];
            let by_traction = |j: usize| [&self.cross[0], &self.direct[1]][part][(i, j)];
            for j in 0..count {
                system[(row, j)] = by_pressure(j);
                if j < stuck {
                    system[(row, count + j)] = by_traction(j);
                } else {
                    system[(row, j)] += mu * by_traction(j);
                }
            }
        }
        let right = DVector::from_fn(size, |row, _| if row < count { 1.0 } else { 0.0 });
        let found = system.lu().solve(&right).unwrap();
        let pressures: Vec<f64> = found.iter().take(count).copied().collect();
        let stick = found.iter().skip(count).copied();
        let slip = pressures[stuck..].iter().map(|p| mu * p);
        let tractions = stick.chain(slip).collect();
        (pressures, tractions)
    }

    /// Takes no notice of what traction does to pressure.
    pub(super) fn uncouple(&mut self) {
        self.cross[0].fill(0.0);
    }

    /// c/a [-], and the force over that without friction [-].
    pub(super) fn solve(&self, mu: f64) -> (f64, f64) {
        let count = self.edges.len() - 1;
        let (mut low, mut high) = (0, count);
        while high - low > 1 {
            let stuck = (low + high) / 2;
            let (p, q) = self.tractions(mu, stuck);
            if q[stuck - 1] > mu * p[stuck - 1] {
                high = stuck;
            } else {
                low = stuck;
            }
        }
        let (p, _) = self.tractions(mu, low);
        let force: f64 = p
            .iter()
            .zip(self.edges.windows(2))
            .map(|(p, ring)| p * PI * (ring[1] * ring[1] - ring[0] * ring[0]))
            .sum();
        let stick = 0.5 * (self.edges[low] + self.edges[high]);
        (stick, force * (1.0 - self.nu) / 4.0)
    }
}

impl Rings {
    /// κ of a sphere, d = κ a²/R.
    pub(super) fn kappa(&self, mu: f64) -> f64 {
        let count = self.edges.len() - 1;
        let stuck = self.edges.partition_point(|&edge| edge < self.solve(mu).0) - 1;
        let (p, _) = self.tractions(mu, stuck);
        let outside = |x: f64| -> f64 {
            let ring =
                |j: usize| integral(normal_kernel, 1.0 / x, self.edges[j], self.edges[j + 1]);
            (1.0 - self.nu) * (0..count).map(|j| p[j] * ring(j)).sum::<f64>()
        };
        let steps = 200;
        let middle = |i: usize| 1.0 - ((i as f64 + 0.5) / steps as f64).powi(2);
        let width = |i: usize| (2.0 * i as f64 + 1.0) / (steps * steps) as f64;
        let sum: f64 = (0..steps)
            .map(|i| outside(middle(i)) * middle(i) * width(i))
            .sum();
        1.0 / (2.0 - 4.0 * sum)
    }
}

/// ∫ J₀(ξr) J₀(ξs) dξ.
fn normal_kernel(r: f64, s: f64) -> f64 {
    let rest = ((r - s) / (r + s)).powi(2);
    2.0 / (PI * (r + s)) * elliptic(rest).0
}

/// ∫ J₁(ξr) J₁(ξs) dξ.
fn radial_kernel(r: f64, s: f64) -> f64 {
    let rest = ((r - s) / (r + s)).powi(2);
    let (k, e) = elliptic(rest);
    let m = 1.0 - rest;
    2.0 / (PI * (r + s)) * ((2.0 / m - 1.0) * k - 2.0 / m * e)
}

/// ∫ kernel s ds over a ring, with the points of Gauss drawn to the end where it is infinite as a logarithm.
fn integral(kernel: fn(f64, f64) -> f64, r: f64, low: f64, high: f64) -> f64 {
    const GAUSS: [(f64, f64); 5] = [
        (0.1488743389816312, 0.2955242247147529),
        (0.4333953941292472, 0.2692667193099963),
        (0.6794095682990244, 0.219086362515982),
        (0.8650633666889845, 0.1494513491505806),
        (0.9739065285171717, 0.0666713443086881),
    ];
    if low < r && r < high {
        return integral(kernel, r, low, r) + integral(kernel, r, r, high);
    }
    let length = high - low;
    let both = GAUSS.iter().flat_map(|&(x, w)| [(x, w), (-x, w)]);
    both.map(|(x, w)| {
        let x = 0.5 * (1.0 + x);
        let s = if (r - low).abs() < (r - high).abs() {
            low + length * x.powi(3)
        } else {
            high - length * x.powi(3)
        };
        0.5 * w * 3.0 * x * x * length * kernel(r, s) * s
    })
    .sum()
}

/// c/a where the tractions do not change the pressure [Goodman 1962, Spence 1975]:
/// a/(2c) ln((a + c)/(a − c)) = μ/β K(1 − c²/a²), β = (1 − 2ν)/(2 − 2ν).
pub(super) fn uncoupled(mu: f64, nu: f64) -> f64 {
    let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
    let off = |c: f64| ((1.0 + c) / (1.0 - c)).ln() / (2.0 * c) - mu / beta * elliptic(c * c).0;
    let (mut low, mut high) = (1e-9, 1.0 - 1e-12);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if off(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}
