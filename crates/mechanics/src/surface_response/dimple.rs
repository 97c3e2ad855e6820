//! The surface around a tip, as the tip deforms it rather than the load that it is spread to (section
//! 4.4).
//!
//! With s the tip's own part of its displacement and p the closed form of its dimple on a half-space, the
//! dimple of the tip, which the mesh cannot resolve, replaces that of the spread load on the same
//! half-space:
//!
//! ```text
//! u = Ξ w F/E + φ (s p − u_load),   s = d − c_ext F/E
//! u_load = (1 + ν)/π Σ w ⟨1/r⟩ ((1 − ν) F_n + (1 − ν/2) F_t)/E
//! ```
//!
//! φ goes from one to zero between R and 2 R from the contact. Both terms have the same force, so that they
//! differ by less than a hundredth of the depth there, and the patch passes over into the organ's field.
//!
//! *How we know*: `tip_field::the_dimple_of_a_tip_is_that_of_finite_elements`,
//! `real_organs::real_kidney_at_ten_places`; derivation: `docs/theory/boundary_elements.md`.
//!
//! *Limits*: the directions along which a tangential force moves the surface more and less are those of the
//! spread load; that of a normal force to move it along itself (not at ν = ½) is too.

use std::f64::consts::PI;

use palpate_geometry::Surface;

use super::response::SurfaceResponse;
use super::tip_field::TipLoad;
use crate::Vec3;
use crate::boundary_elements::Precision;
use crate::contact::Tip;
use crate::enhance::profile;
use crate::finite_spheres::quartic;

/// A tip that presses an organ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressedTip {
    /// Its form.
    pub tip: Tip,
    /// Radius of its touching area [m].
    pub radius: f64,
    /// The middle of that, at rest [m].
    pub place: Vec3,
    /// Outward unit normal there [-].
    pub normal: Vec3,
    /// The tip's own part of its displacement: its half-space part [m].
    pub own: Vec3,
    /// Force on the organ over Young's modulus [m²].
    pub force: Vec3,
}

impl<T: Precision> SurfaceResponse<T> {
    /// Replaces the dimple of its spread `load` by that of `tip` in `field`, three numbers for each
    /// triangle of `surface` [m], to which the load's was added before ([`Self::add_field_of_tip`]).
    pub fn sharpen(
        &self,
        surface: &Surface,
        load: &TipLoad<'_>,
        tip: &PressedTip,
        field: &mut [T],
    ) {
        let nu = self.parts().poissons_ratio;
        let along = tip.normal * tip.normal.dot(&tip.force);
        let across = tip.force - along;
        let [more_across, more_along] = load.compliance_ratios();
        let along = along * (more_along * (1.0 - nu));
        let across = across * (more_across * (1.0 - 0.5 * nu));
        let yields = (along + across) * ((1.0 + nu) / PI);
        let reach = load.reach();
        for (triangle, part, inverse) in load.around() {
            let centroid = surface.mesh().positions(triangle).iter().sum::<Vec3>() / 3.0;
            let away = (centroid - tip.place).norm();
            let part = part * quartic((away / reach - 1.0).max(0.0));
            if part == 0.0 {
                continue;
            }
            let own = tip.own * profile(&tip.tip, tip.radius, away);
            let sharper = (own - yields * inverse) * part;
            let moved = &mut field[3 * triangle.index()..][..3];
            for (value, change) in moved.iter_mut().zip(&sharper) {
                *value += T::of(*change);
            }
        }
    }
}
