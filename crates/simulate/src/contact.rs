//! Contact of a tip: the first contact point by a global search, the next ones among neighbouring triangles.
//!
//! A tip below the rest surface is in contact, from the first step with positive depth until the depth is zero. The
//! contact point of a slipping tip follows the surface below it; a sticking tip keeps its first contact point for as
//! long as it is pressed against the organ. Where the organ would pull on a sticking tip, its contact point is
//! released: it follows the tip, and sticks again where the tip is pressed again. With friction a tip sticks relative
//! to the surface point below it, and slides where the force leaves the friction cone.
//!
//! *How we know*: `invariants::real_organs_under_random_pokes_and_slides`.
//!
//! *Limits*: over ridges and thin walls the rate of change of the depth is limited, so that a slide there lags behind
//! the nearest point of the surface.

use nalgebra::{Matrix3, Rotation3};
use palpate_geometry::{
    AabbTree, ContactPoint, Nearest, PatchField, Surface, Vec3, follow, project_contact_point,
};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{LocalContact, Placement, Surroundings, first_direction};

use crate::simulation::Simulation;
use crate::tool::Tool;

/// A tip below this depth [m] whose closest surface point is on another side has passed through the organ.
const PASSED_THROUGH: f64 = 0.025;

/// The rest surface for one tip.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RestSurface<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) tree: &'a AabbTree,
    /// Its normals and curvatures, averaged over the tip.
    pub(crate) patches: &'a PatchField,
    /// Radius of a hemisphere of its volume [m].
    pub(crate) radius: f64,
    /// Its compliance beyond a half-space at each vertex [1/m]; none if only its volume is known.
    pub(crate) structural_compliance: Option<&'a [Matrix3<f64>]>,
}

impl Simulation {
    /// The organ's rest surface for `tool`.
    pub(crate) fn rest_surface<'a>(&'a self, tool: &'a Tool) -> RestSurface<'a> {
        RestSurface {
            surface: &self.surface,
            tree: &self.tree,
            patches: &tool.patches,
            radius: self.organ_radius,
            structural_compliance: tool.structural_compliance.as_deref(),
        }
    }
}

/// A contact of one tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The current contact point below the tip on the rest surface.
    pub(crate) contact_point: ContactPoint,
    /// The location of the local model: the contact point, or the first contact point of a tip that sticks.
    pub(crate) place: LocalContact,
    /// Reference point of the tool [m].
    pub(crate) tip: Vec3,
    /// Its signed distance to the rest surface [m], negative inside.
    pub(crate) signed: f64,
    /// Depth below the rest surface [m].
    pub depth: f64,
    /// The rotation of the organ there since rest; only the nonlinear model rotates it.
    pub(crate) turn: Rotation3<f64>,
    /// Whether the tip pressed on the organ in the last step; a tip that sticks is released otherwise.
    pub(crate) is_pressed: bool,
    /// Offset due to friction, relative to the contact point below the tip, along the surface [m].
    sheared: Vec3,
    /// Whether it slid against friction in its last step.
    pub(crate) slides: bool,
}

impl Contact {
    /// Unit outward normal of the surface at the contact [-].
    pub fn normal(&self) -> Vec3 {
        self.turn * self.rest_normal()
    }

    /// The same at rest.
    pub(crate) fn rest_normal(&self) -> Vec3 {
        self.place.frame.column(2).into_owned()
    }

    /// Two tangents and the normal of the surface there [-].
    pub(crate) fn frame(&self) -> Matrix3<f64> {
        self.turn * self.place.frame
    }

    /// The contact location on the rest surface [m].
    pub fn point(&self) -> Vec3 {
        self.place.point
    }

    /// Displacement of the contact location by `tool` at `tip` [m], in the contact frame: tangents, normal.
    pub(crate) fn displacement(&self, tool: &Tool, tip: &Vec3) -> Vec3 {
        let mut local = self.place.frame.tr_mul(&(tip - self.place.point));
        local.z -= tool.overhang();
        if tool.slides() {
            local = self.place.frame.tr_mul(&self.sheared);
            local.z = -self.depth;
        }
        local
    }

    /// Slides a tip whose `force` [N] is outside its friction cone; the remaining force is inside.
    pub(crate) fn slide(&mut self, tool: &Tool, force: &mut Vec3) {
        self.slides = false;
        let Some(friction) = tool.friction else {
            return;
        };
        let normal = self.normal();
        let outward = normal * normal.dot(force);
        let along = *force - outward;
        let most = friction * normal.dot(force).max(0.0);
        if along.norm() > most {
            let part = most / along.norm();
            self.slides = true;
            self.sheared *= part;
            *force = outward + along * part;
        }
    }
}

/// A ball in which a tool does not touch a surface: a signed distance changes no more than its point moves. It saves
/// searches and changes no result.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Clearance {
    /// Its centre and radius [m].
    tip: Vec3,
    room: f64,
}

/// Margin for rounding [m].
const ROUNDING: f64 = 1e-9;

impl Clearance {
    /// The contact of `tool` at `tip` [m], given its last one. Valid only for one and the same surface and tool.
    pub(crate) fn detect(
        &mut self,
        rest: &RestSurface<'_>,
        tool: &Tool,
        last: Option<&Contact>,
        tip: &Vec3,
    ) -> Option<Contact> {
        match last {
            Some(last) => detect_after(rest, tool, last, tip),
            None if (tip - self.tip).norm() < self.room => None,
            None => {
                let (nearest, signed) = rest.surface.signed_distance(rest.tree, tip);
                (self.tip, self.room) = (*tip, signed - tool.overhang() - ROUNDING);
                begin(rest, tool, tip, nearest, signed)
            }
        }
    }
}

/// The contact of `tool` at `tip` [m], given its last one.
pub(crate) fn detect(
    rest: &RestSurface<'_>,
    tool: &Tool,
    last: Option<&Contact>,
    tip: &Vec3,
) -> Option<Contact> {
    Clearance::default().detect(rest, tool, last, tip)
}

fn detect_after(
    rest: &RestSurface<'_>,
    tool: &Tool,
    last: &Contact,
    tip: &Vec3,
) -> Option<Contact> {
    let anew = || {
        let (nearest, signed) = rest.surface.signed_distance(rest.tree, tip);
        begin(rest, tool, tip, nearest, signed)
    };
    let Some(contact_point) = follow(
        rest.surface,
        rest.patches,
        &last.contact_point,
        &last.tip,
        tip,
    ) else {
        return anew();
    };
    let (below, signed) = depth_of_tip(rest, &contact_point, tip);
    let run = (contact_point.point - last.contact_point.point).norm();
    let depth = limit_depth_rate(last, tool.overhang() + below, signed, tip, run);
    if depth > PASSED_THROUGH && signed > tool.overhang() {
        return None;
    }
    if depth <= 0.0 {
        return go_on_elsewhere(anew()?, tool, last, tip);
    }
    let mut contact = Contact {
        contact_point,
        place: last.place,
        tip: *tip,
        signed,
        depth,
        turn: last.turn,
        is_pressed: last.is_pressed,
        sheared: Vec3::zeros(),
        slides: last.slides,
    };
    if tool.slides() || !last.is_pressed {
        contact.place = place(rest, tool, &contact_point, depth, Some(&last.place.frame));
    }
    match tool.tip_friction {
        Friction::Frictionless => {}
        Friction::Bonded if tool.slides() => {
            let normal = contact.rest_normal();
            let moved = last.sheared + (tip - last.tip);
            contact.sheared = moved - normal * normal.dot(&moved);
        }
        Friction::Bonded if contact.displacement(tool, tip).z >= 0.0 => return None,
        Friction::Bonded => {
            let tip = tool.tip.on_curved_surface(contact.place.mean_curvature());
            contact.place.radius = tip.contact_radius(depth);
        }
    }
    Some(contact)
}

/// A tip that has left the side that it touched and is below another side touches that one, and its depth grows from
/// zero.
fn go_on_elsewhere(
    mut contact: Contact,
    tool: &Tool,
    last: &Contact,
    tip: &Vec3,
) -> Option<Contact> {
    if tool.slides() {
        contact.depth = limit_depth_rate(last, contact.depth, contact.signed, tip, 0.0);
    }
    (contact.depth > 0.0).then_some(contact)
}

/// Largest change of depth per travel of a tip along the surface, in parts of the depth [1/m]: 2.5 %
/// in a tenth of a millimetre.
const LARGEST_DEPTH_RATE: f64 = 250.0;

/// The next depth after `last` when `measured` [m] is measured at `tip` [m]. Where the closest surface changes, the
/// measured depth jumps; the returned depth approaches it as fast as the tip approaches or leaves the surface, plus a
/// small part of itself for motion along it: half of that part while the contact point moves twice as fast as the tip,
/// by `run` [m], since the organ below it then changes as well.
fn limit_depth_rate(last: &Contact, measured: f64, signed: f64, tip: &Vec3, run: f64) -> f64 {
    let travel = (tip - last.tip).norm();
    let slid = travel - 0.5 * (run - travel).clamp(0.0, travel);
    let most =
        (signed - last.signed).abs() + LARGEST_DEPTH_RATE * last.depth * slid + 0.05 * travel;
    measured.clamp(last.depth - most, last.depth + most)
}

/// Depth of the tool's reference point below the rest surface [m]: its distance, if the closest point of the surface is
/// the contact point. Otherwise (below a thin wall, or behind a ridge) it is the depth below the contact point, with a
/// continuous transition between the two. Also returns the signed distance.
fn depth_of_tip(rest: &RestSurface<'_>, contact_point: &ContactPoint, tip: &Vec3) -> (f64, f64) {
    let surface = rest.surface;
    let (nearest, signed) = surface.signed_distance(rest.tree, tip);
    let outward = (tip - nearest.on.position) * signed.signum();
    let cosine = outward.dot(&contact_point.normal) / nearest.distance.max(f64::MIN_POSITIVE);
    let apart = (signed + contact_point.depth).abs() / signed.abs().max(contact_point.depth.abs());
    // Full weight within 60 degrees and half the depth, none at 90 degrees or nine tenths.
    let same_side = (2.0 * cosine).clamp(0.0, 1.0);
    let same_depth = ((0.9 - apart) / 0.4).clamp(0.0, 1.0);
    let trust = same_side * same_depth;
    let below = if trust > 0.0 {
        trust * -signed + (1.0 - trust) * contact_point.depth
    } else {
        contact_point.depth
    };
    (below, signed)
}

/// The first contact: at the `nearest` point of the rest surface, if the tip is below it.
fn begin(
    rest: &RestSurface<'_>,
    tool: &Tool,
    tip: &Vec3,
    nearest: Nearest,
    signed: f64,
) -> Option<Contact> {
    let depth = tool.overhang() - signed;
    if depth <= 0.0 {
        return None;
    }
    let found = ContactPoint {
        triangle: nearest.triangle,
        barycentric: nearest.on.barycentric,
        point: nearest.on.position,
        normal: rest
            .patches
            .at(rest.surface, nearest.triangle, &nearest.on.barycentric)
            .normal,
        depth: -signed,
    };
    // The closest point of a mesh jumps at its edges; the point below the averaged normal does not.
    let normals = rest.patches.vertex_normals();
    let contact_point = project_contact_point(rest.surface, normals, &found, tip).unwrap_or(found);
    Some(Contact {
        contact_point,
        place: place(rest, tool, &contact_point, depth, None),
        tip: *tip,
        signed,
        depth,
        turn: Rotation3::identity(),
        is_pressed: true,
        sheared: Vec3::zeros(),
        slides: false,
    })
}

/// The contact frame at `contact_point`: tangents transported from `last`, so that the particles do not turn under a
/// sliding tip; initially along an edge of the triangle, so that they turn with the organ.
pub(crate) fn place(
    rest: &RestSurface<'_>,
    tool: &Tool,
    contact_point: &ContactPoint,
    depth: f64,
    last: Option<&Matrix3<f64>>,
) -> LocalContact {
    let patch = rest.patches.at(
        rest.surface,
        contact_point.triangle,
        &contact_point.barycentric,
    );
    let along = match (tool.placement, last) {
        (Placement::Template, Some(frame)) => frame.column(0).into_owned(),
        (Placement::Template, None) => {
            let [a, b, _] = rest.surface.mesh().positions(contact_point.triangle);
            b - a
        }
        (Placement::Source, _) => first_direction(rest.surface, contact_point.triangle),
    };
    let flat = |v: &Vec3| (v - patch.normal * patch.normal.dot(v)).try_normalize(1e-9 * v.norm());
    // A tangent parallel to the normal is useless; any other will do.
    let first = flat(&along)
        .or_else(|| flat(&Vec3::x()))
        .or_else(|| flat(&Vec3::y()))
        .unwrap_or_else(Vec3::z);
    let second = patch.normal.cross(&first);
    let between = |a: &Vec3, b: &Vec3| a.dot(&(patch.curvature * b));
    let frame = Matrix3::from_columns(&[first, second, patch.normal]);
    let curvature = Vec3::new(
        between(&first, &first),
        between(&first, &second),
        between(&second, &second),
    );
    let mean = 0.5 * (curvature.x + curvature.z);
    LocalContact {
        point: contact_point.point,
        frame,
        curvature,
        triangle: contact_point.triangle,
        radius: tool.tip.on_curved_surface(mean).contact_radius(depth),
        surroundings: surroundings(rest, tool, contact_point, &frame),
        // As in the calibrated model: fixed like a hemisphere of its volume.
        thickness: rest.radius,
    }
}

/// The surroundings of a location, in its frame.
fn surroundings(
    rest: &RestSurface<'_>,
    tool: &Tool,
    contact_point: &ContactPoint,
    frame: &Matrix3<f64>,
) -> Surroundings {
    let Some(at) = rest.structural_compliance else {
        return tool.model.by_volume(rest.radius);
    };
    let nodes = rest.surface.mesh().corners(contact_point.triangle);
    let further: Matrix3<f64> = nodes
        .iter()
        .zip(contact_point.barycentric)
        .map(|(node, weight)| at[node.index()] * weight)
        .sum();
    Surroundings::Known(frame.tr_mul(&further) * frame)
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_files::Scene;

    const SCENE: &str = "format = 1\n[organ]\nbuiltin = \"liver\"\ntriangles = 800\nbuiltin_tissue = \"pig-liver\"\n\
        [model]\nkind = \"local\"\n[[tool]]\nname = \"right\"\ndevice = \"mouse\"\n\
        tip = { shape = \"flat\", radius_m = 0.002, contact = \"slip\" }\n";

    /// Judge: a search at every location. Forty locations within 2 cm of one, then of another: most are in the air.
    #[test]
    fn a_tip_in_the_air_is_found_when_it_touches() {
        let scene = Scene::parse(SCENE, "scene.toml").unwrap();
        let simulation = Simulation::new(&scene).unwrap();
        let (tool, mesh) = (&simulation.tools()[0], simulation.surface().mesh());
        let rest = simulation.rest_surface(tool);
        let (mut clearance, mut last, mut skipped, mut touched) =
            (Clearance::default(), None, 0, 0);
        let middle = mesh.vertices().iter().sum::<Vec3>() / mesh.vertices().len() as f64;
        for step in 0..20_000_u32 {
            // By the fractions of irrational numbers: forty places around one at some height over a vertex.
            let part = |by: f64| (f64::from(step) * by).fract() - 0.5;
            let walk = (f64::from(step / 40) * 0.7548776662).fract() * 0.08;
            let aside = Vec3::new(part(0.6180339887), part(0.4142135624), part(0.7320508076));
            let from = mesh.vertices()[(step / 40 * 7919) as usize % mesh.vertices().len()];
            let outward = (from - middle).normalize();
            let tip = from + outward * walk + aside * 0.02;
            skipped += usize::from((tip - clearance.tip).norm() < clearance.room);
            let found = clearance.detect(&rest, tool, last.as_ref(), &tip);
            assert_eq!(found, detect(&rest, tool, last.as_ref(), &tip), "{step}");
            touched += usize::from(found.is_some());
            last = found;
        }
        println!("{skipped} places were not sought, {touched} touched");
        assert!(skipped > 500 && touched > 500);
    }
}
