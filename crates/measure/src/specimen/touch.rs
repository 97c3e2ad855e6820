//! Force and torque of a curved and tilted surface on a bonded flat punch.
//!
//! Along the surface's normal m under the tip, the law's force F(d) at depth d. Across it the punch carries the surface
//! with it: −κ F/d u, where u is the tangential displacement of the tip since first contact and κ the ratio of tangential to
//! normal stiffness of a bonded punch, [8 G a / (2 − ν)] / [4 G a ln(3 − 4ν) / (1 − 2ν)], two thirds for ν = ½
//! [Mindlin 1949, Spence 1968]. A face that is not parallel to the surface is pressed on more on one side: a torque
//! F e about the tip with e = ⅔ a² sin θ / d, that of a punch that rocks on a half-space [Johnson 1985], and not beyond
//! its edge, e ≤ a.
//!
//! *How we know*: `six_axes::…`: a tilted rig over a tilted plane feels what an upright one does; lateral force and
//! torque at the sensor by the closed forms above.
//!
//! *Limits*: curvature turns the normal and leaves F(d) that of a half-space; the punch neither slips nor twists.

use palpate_mechanics::Vec3;
use palpate_servo::ForceTorque;

use super::{Elastic, VirtualSpecimen};

/// The shape of a surface at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Its normal under the rig's zero, of length one [-].
    pub normal: Vec3,
    /// The radius of its curvature [m]; none for a plane.
    pub radius: Option<f64>,
}

impl Shape {
    /// A level plane.
    pub fn level() -> Self {
        Self {
            normal: Vec3::z(),
            radius: None,
        }
    }

    /// How deep a point is [m], from the surface's point under the rig's zero [m], and the normal there.
    fn depth(&self, from_surface: &Vec3) -> (f64, Vec3) {
        let Some(radius) = self.radius else {
            return (-self.normal.dot(from_surface), self.normal);
        };
        let from_center = from_surface + radius * self.normal;
        let distance = from_center.norm();
        let normal = from_center.try_normalize(0.0).unwrap_or(self.normal);
        (radius - distance, normal)
    }
}

impl VirtualSpecimen {
    /// The force on a tip [N], in the rig's axes, and the torque about the tip [N m], with the middle of its face at
    /// `tip` [m] at `time` [s], `step` [s] after the last.
    pub fn touch(&mut self, time: f64, tip: &Vec3, step: f64) -> ForceTorque {
        let top = Vec3::new(0.0, 0.0, self.height(time, step));
        let from_surface = tip - top;
        let (depth, normal) = self.shape.depth(&from_surface);
        let elastic = match depth > 0.0 {
            true => self.elastic_force(depth, &normal, &from_surface),
            false => {
                self.first_contact = None;
                Vec3::zeros()
            }
        };
        let relaxed = self.history.advance(&self.series, elastic, step);
        // Tissue that has given way does not pull a tip that leaves it.
        if depth <= 0.0 || relaxed.dot(&normal) <= 0.0 {
            return ForceTorque::zero();
        }
        let tilt = self.indenter_axis.cross(&normal);
        let sine = tilt.norm();
        let (radius, pressed) = (self.radius, relaxed.dot(&normal));
        // Of a face that is parallel there is none, and no division by zero.
        let arm = match sine > 0.0 {
            true => (2.0 / 3.0 * radius * radius * sine / depth).min(radius) / sine,
            false => 0.0,
        };
        ForceTorque {
            force: relaxed,
            torque: pressed * arm * tilt,
        }
    }

    fn elastic_force(&mut self, depth: f64, normal: &Vec3, from_surface: &Vec3) -> Vec3 {
        let along = match &self.elastic {
            Elastic::Law { law, stiffness } => law.normal_force(depth, *stiffness).force,
            Elastic::Response(response) => response.force(depth),
        };
        let along = self.factor * along;
        let first = *self.first_contact.get_or_insert(*from_surface);
        let gone = from_surface - first;
        let across = gone - normal * normal.dot(&gone);
        normal * along - across * (self.tangential * along / depth)
    }
}
