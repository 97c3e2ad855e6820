//! Warnings for slits outside of the range validated with finite elements.
//!
//! *How we know*: `slit::the_rim_is_that_of_finite_elements`, `slit_held_out::…`; the numbers stand in
//! `docs/theory/cutting.md`.
//!
//! *Limits*: checks shapes only. Poisson's ratio was validated from 0.3 to 0.45, and walls at least half as thick as
//! the tip is wide.

use super::Slit;
use super::facet::CrackGeometry;
use crate::boundary_elements::Precision;

/// Least radius of the middle of a wall over its thickness [-]: 2.5 was validated, and triangles give a radius to a
/// fifth.
const MIN_RADIUS: f64 = 2.0;
/// Greatest of a tube that is cut through [-]: at 4.5 a rim was met within a quarter, at 5.5 it was 36 % too stiff.
const GREATEST_RADIUS: f64 = 5.0;
/// Walls with a radius of so many thicknesses are flat [-]: the last table of `curvature`.
const FLAT: f64 = 30.0;
/// Greatest length of a slit in a tube over √(R w) [-], through the wall and not. At R = 6.25 mm and w = 2.5 mm rims
/// were met within a quarter up to 18 mm (4.6) through the wall, and 33 % too stiff at 24 mm (6.1); half through it
/// at 24 mm, and a fifth more is allowed.
const LONGEST_THROUGH: f64 = 5.0;
const LONGEST: f64 = 7.3;

impl<T: Precision> Slit<T> {
    /// Warnings, as sentences, where the slit lies outside of the range validated with finite elements, or an
    /// error of more than a quarter was found.
    pub fn warnings(&self) -> Vec<String> {
        let (mut roundest, mut slimmest, mut hollow) = (f64::INFINITY, 0.0_f64, false);
        // Lengths over √(R w) and in metres: of the facets that hang together, and the longest that is too long.
        let (mut run, mut longest) = ([0.0; 2], [0.0; 2]);
        for (number, cut) in self.facets.iter().enumerate() {
            let facet = &cut.facet;
            let CrackGeometry::Wall { thickness, part } = facet.geometry else {
                continue;
            };
            let radius = 1.0 / (facet.curvature.abs() * thickness).max(1e-6);
            if radius > FLAT {
                continue;
            }
            let through = part >= 1.0;
            hollow |= facet.curvature < 0.0;
            roundest = roundest.min(radius);
            if through {
                slimmest = slimmest.max(radius);
            }
            let before = number
                .checked_sub(1)
                .map(|before| &self.facets[before].facet);
            if !before.is_some_and(|before| facet.meets(before).contains(&true)) {
                run = [0.0; 2];
            }
            run[0] += facet.length / (thickness * radius.sqrt());
            run[1] += facet.length;
            let most = if through { LONGEST_THROUGH } else { LONGEST };
            if run[0] > most.max(longest[0]) {
                longest = run;
            }
        }
        let mut warnings = Vec::new();
        let beyond = "the force at its rim may be off by more than a quarter";
        if roundest < MIN_RADIUS {
            warnings.push(format!(
                "a cut goes into a wall whose radius is {roundest:.1} times its thickness, and finite elements judged \
                 2.5 and more: {beyond}"
            ));
        }
        if slimmest > GREATEST_RADIUS {
            warnings.push(format!(
                "a cut goes through a wall whose radius is {slimmest:.1} times its thickness, where its rim is too \
                 stiff by a third beside finite elements: {beyond}"
            ));
        }
        if hollow {
            warnings.push(format!(
                "a cut goes into the hollow side of a wall, and finite elements judged the outer side: {beyond}"
            ));
        }
        if longest[0] > 0.0 {
            warnings.push(format!(
                "a cut in a tube is {:.0} mm long, {:.1} times the root of radius and thickness, where finite elements \
                 found a rim too stiff by a third or judged none: {beyond}",
                1e3 * longest[1],
                longest[0]
            ));
        }
        warnings
    }
}
