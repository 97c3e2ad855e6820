//! Additional compliance of the rim of a cut that elements larger than a tip do not resolve.
//!
//! A force next to the edge of a quarter space displaces its point by G/(E x) more than on a half-space, x being its
//! distance from the edge ([`RIM_COMPLIANCE`]). The elements include that for their load, whose centre lies farther
//! from the edge, at x + m R on one side of it; a cut of the depth d adds none where x is beyond d. So
//!
//! ```text
//! G/E (1/x − 1/min(x + m R, d)),   x ≥ 0.8 a
//! ```
//!
//! is added, for a tip of radius a, reduced where the ends of the cut deviate from a straight edge.
//!
//! *How we know*: `nonlinear_cuts::…`, compared with the hybrid model; G is judged in `mechanics`, `slit::…`.

use nalgebra::Matrix3;
use palpate_geometry::{SlitPoint, Vec3};
use palpate_mechanics::nonlinear::SpreadLoad;
use palpate_mechanics::surface_response::slit::RIM_COMPLIANCE;

use super::slits::CutPaths;
use super::{Body, NonlinearOrgan};

/// Mean distance of one half of a load (1 − (r/R)²)² from its diameter, over R: 2/π · 16/35 [-].
const MIDDLE: f64 = 0.291;

/// Least distance of a tip from an edge, relative to its radius [-].
const CLOSEST: f64 = 0.8;

/// A cut deeper than this part of a wall bends it: the wall's elements include the outward compliance of its rim [-].
const OF_WALL: f64 = 0.4;

impl NonlinearOrgan {
    /// Additional compliance of the load of tool `number`, with a radius [m], next to cuts, at rest [m/N].
    pub(super) fn rim(&self, body: &Body, number: usize, radius: f64) -> Matrix3<f64> {
        let piece = &self.composition.pieces[body.on[number]];
        let rim = self
            .cuts
            .rim(&body.loads[number], radius, OF_WALL * piece.wall);
        rim / piece.law().youngs_modulus()
    }
}

impl CutPaths {
    /// That times Young's modulus [1/m]; outwards only next to cuts that are less deep than `shallow` [m].
    fn rim(&self, load: &SpreadLoad, radius: f64, shallow: f64) -> Matrix3<f64> {
        let pairs = self.each().flat_map(|path| path.windows(2));
        let each = pairs.filter_map(|pair| {
            let [from, to]: &[SlitPoint; 2] = pair.first_chunk()?;
            let depth = 0.5 * (from.depth + to.depth);
            let off = load.place - from.place;
            let by = to.place - from.place;
            if off.norm_squared() > (depth + by.norm()).powi(2) {
                return None;
            }
            let length = by.norm();
            let along = by / length;
            let across = (from.normal + to.normal).cross(&along).normalize();
            let outward = along.cross(&across);
            let x = off.dot(&across).abs();
            let near = x.max(CLOSEST * radius);
            let far = depth.min(near + MIDDLE * load.radius);
            let more = (1.0 / near - 1.0 / far).max(0.0);
            let part = |end: Vec3| {
                let end = end.dot(&along);
                0.5 * end / near.hypot(end)
            };
            let [g_across, g_along, g_outward] = RIM_COMPLIANCE;
            let g_outward = if depth < shallow { g_outward } else { 0.0 };
            let own = across * across.transpose() * g_across
                + along * along.transpose() * g_along
                + outward * outward.transpose() * g_outward;
            Some(own * (more * (part(to.place - load.place) - part(-off))))
        });
        each.sum()
    }
}
