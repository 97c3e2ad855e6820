//! Where a tip touches: the first contact by global search, the successive ones among neighbours.
//!
//! A tip below the rest surface is in contact, from the first step with positive depth until the depth
//! is gone. A tip that slips is met by the surface that it is over; one that sticks carries the place
//! of its first contact with it, as long as it is pressed against the organ. Where the organ would pull on it, nothing
//! holds it to that place: it goes on as one that slips, and sticks where it is pressed again. With friction it sticks
//! beside the place that it is over, and slides where the force leaves the cone.
//!
//! *How we know*: `invariants::real_organs_under_random_pokes_and_slides`.
//!
//! *Limits*: over ridges and thin walls the depth creeps towards its measure, so that a slide there lags
//! behind the nearest point of the surface.

use nalgebra::{Matrix3, Rotation3};
use palpate_geometry::{
    AabbTree, ContactPoint, Nearest, PatchField, Surface, Vec3, follow, project_contact_point,
};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{LocalContact, Placement, Surroundings, first_direction};

use crate::simulation::Simulation;
use crate::tool::Tool;

/// A tip below this depth [m] that has come out of the organ elsewhere has passed through it.
const PASSED_THROUGH: f64 = 0.025;

/// A surface at rest as a tip feels it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RestSurface<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) tree: &'a AabbTree,
    /// Its normals and curvatures over the tip.
    pub(crate) patches: &'a PatchField,
    /// Radius of a hemisphere of its volume [m].
    pub(crate) radius: f64,
    /// What it yields beyond a half-space at each vertex [1/m]; none where only its volume is known.
    pub(crate) further: Option<&'a [Matrix3<f64>]>,
}

impl Simulation {
    /// The organ as `tool` feels it.
    pub(crate) fn ground<'a>(&'a self, tool: &'a Tool) -> RestSurface<'a> {
        RestSurface {
            surface: &self.surface,
            tree: &self.tree,
            patches: &tool.patches,
            radius: self.organ_radius,
            further: tool.further.as_deref(),
        }
    }
}

/// A contact of one tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Where the tip is over the rest surface now.
    pub(crate) contact_point: ContactPoint,
    /// The place that answers: that of the contact point, or of the first contact of a tip that sticks.
    pub(crate) place: LocalContact,
    /// Where the tool is [m].
    pub(crate) tip: Vec3,
    /// Its signed distance to the rest surface [m], negative inside.
    pub(crate) signed: f64,
    /// Depth below the rest surface [m].
    pub depth: f64,
    /// How the organ has turned there since rest; only the nonlinear model turns it.
    pub(crate) turn: Rotation3<f64>,
    /// Whether it was pressed against the organ in its last step, without which nothing holds it there.
    pub(crate) is_pressed: bool,
    /// How far friction holds it back beside the place that it is over [m], along the surface.
    sheared: Vec3,
    /// Whether it slid in its last step, against friction.
    pub(crate) slides: bool,
}

impl Contact {
    /// Unit outward normal of the surface where it is touched [-].
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

    /// The touched point of the rest surface [m].
    pub fn point(&self) -> Vec3 {
        self.place.point
    }

    /// Displacement of the touched place by `tool` at `tip` [m], in the place's frame: tangents, normal.
    pub(crate) fn displacement(&self, tool: &Tool, tip: &Vec3) -> Vec3 {
        let mut local = self.place.frame.tr_mul(&(tip - self.place.point));
        local.z -= tool.overhang();
        if tool.slides() {
            local = self.place.frame.tr_mul(&self.sheared);
            local.z = -self.depth;
        }
        local
    }

    /// Lets a tip slide whose `force` [N] is outside the cone of its friction, which is left inside.
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

/// A ball in which a tool does not touch one surface, because none of it is there: a signed distance changes no more than
/// its point moves. It saves searches and changes no result.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Clearance {
    /// Its centre and radius [m].
    tip: Vec3,
    room: f64,
}

/// Left of the room for rounding [m].
const ROUNDING: f64 = 1e-9;

impl Clearance {
    /// The contact of `tool` at `tip` [m], given its last one. Always for the same surface and tool.
    pub(crate) fn detect(
        &mut self,
        ground: &RestSurface<'_>,
        tool: &Tool,
        last: Option<&Contact>,
        tip: &Vec3,
    ) -> Option<Contact> {
        match last {
            Some(last) => detect_after(ground, tool, last, tip),
            None if (tip - self.tip).norm() < self.room => None,
            None => {
                let (nearest, signed) = ground.surface.signed_distance(ground.tree, tip);
                (self.tip, self.room) = (*tip, signed - tool.overhang() - ROUNDING);
                begin(ground, tool, tip, nearest, signed)
            }
        }
    }
}

/// The contact of `tool` at `tip` [m], given its last one.
pub(crate) fn detect(
    ground: &RestSurface<'_>,
    tool: &Tool,
    last: Option<&Contact>,
    tip: &Vec3,
) -> Option<Contact> {
    Clearance::default().detect(ground, tool, last, tip)
}

fn detect_after(
    ground: &RestSurface<'_>,
    tool: &Tool,
    last: &Contact,
    tip: &Vec3,
) -> Option<Contact> {
    let anew = || {
        let (nearest, signed) = ground.surface.signed_distance(ground.tree, tip);
        begin(ground, tool, tip, nearest, signed)
    };
    let Some(contact_point) = follow(
        ground.surface,
        ground.patches,
        &last.contact_point,
        &last.tip,
        tip,
    ) else {
        return anew();
    };
    let (below, signed) = depth_of_tip(ground, &contact_point, tip);
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
        contact.place = place(ground, tool, &contact_point, depth, Some(&last.place.frame));
    }
    match tool.bond {
        Friction::Frictionless => {}
        Friction::Bonded if tool.slides() => {
            let normal = contact.rest_normal();
            let moved = last.sheared + (tip - last.tip);
            contact.sheared = moved - normal * normal.dot(&moved);
        }
        Friction::Bonded if contact.displacement(tool, tip).z >= 0.0 => return None,
        Friction::Bonded => {
            let tip = tool.tip.beside(contact.place.mean_curvature());
            contact.place.radius = tip.contact_radius(depth);
        }
    }
    Some(contact)
}

/// A tip that has left the side that it touched and is below another one touches that, and its depth
/// grows from nothing.
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

/// The depth that follows `last` when `measured` [m] is measured at `tip` [m]. Where the surface that is
/// touched becomes another one the measure leaps; the depth goes there as fast as the tip comes nearer
/// to the surface or goes away from it, and by a small part of itself along it: by half of that part while
/// the touched point runs twice as fast as the tip, by `run` [m], for then the organ under it changes as well.
fn limit_depth_rate(last: &Contact, measured: f64, signed: f64, tip: &Vec3, run: f64) -> f64 {
    let travel = (tip - last.tip).norm();
    let slid = travel - 0.5 * (run - travel).clamp(0.0, travel);
    let most =
        (signed - last.signed).abs() + LARGEST_DEPTH_RATE * last.depth * slid + 0.05 * travel;
    measured.clamp(last.depth - most, last.depth + most)
}

/// Depth of the tool's reference point below the rest surface [m]: its distance, where the nearest
/// point of the surface is the one that is touched. Where it is another one (below a thin wall, or
/// behind a ridge) it is the depth below the contact point, with a continuous passage between the two. With
/// it the signed distance.
fn depth_of_tip(ground: &RestSurface<'_>, contact_point: &ContactPoint, tip: &Vec3) -> (f64, f64) {
    let surface = ground.surface;
    let (nearest, signed) = surface.signed_distance(ground.tree, tip);
    let outward = (tip - nearest.on.position) * signed.signum();
    let cosine = outward.dot(&contact_point.normal) / nearest.distance.max(f64::MIN_POSITIVE);
    let apart = (signed + contact_point.depth).abs() / signed.abs().max(contact_point.depth.abs());
    // Full trust within 60 degrees and half the depth, none at 90 degrees or nine tenths.
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

/// The first contact: at the `nearest` point of the rest surface, when the tip is below it.
fn begin(
    ground: &RestSurface<'_>,
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
        normal: ground
            .patches
            .at(ground.surface, nearest.triangle, &nearest.on.barycentric)
            .normal,
        depth: -signed,
    };
    // The nearest point of a mesh leaps at its edges; the point under the averaged normal does not.
    let normals = ground.patches.vertex_normals();
    let contact_point =
        project_contact_point(ground.surface, normals, &found, tip).unwrap_or(found);
    Some(Contact {
        contact_point,
        place: place(ground, tool, &contact_point, depth, None),
        tip: *tip,
        signed,
        depth,
        turn: Rotation3::identity(),
        is_pressed: true,
        sheared: Vec3::zeros(),
        slides: false,
    })
}

/// The place at `contact_point`, with tangents carried along from `last`, so that the particles do not turn
/// under a sliding tip; at first along an edge of the triangle, so that they turn with the organ.
pub(crate) fn place(
    ground: &RestSurface<'_>,
    tool: &Tool,
    contact_point: &ContactPoint,
    depth: f64,
    last: Option<&Matrix3<f64>>,
) -> LocalContact {
    let patch = ground.patches.at(
        ground.surface,
        contact_point.triangle,
        &contact_point.barycentric,
    );
    let along = match (tool.placement, last) {
        (Placement::Template, Some(frame)) => frame.column(0).into_owned(),
        (Placement::Template, None) => {
            let [a, b, _] = ground.surface.mesh().positions(contact_point.triangle);
            b - a
        }
        (Placement::Source, _) => first_direction(ground.surface, contact_point.triangle),
    };
    let flat = |v: &Vec3| (v - patch.normal * patch.normal.dot(v)).try_normalize(1e-9 * v.norm());
    // A tangent that has become the normal says nothing any more; any other will do.
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
        radius: tool.tip.beside(mean).contact_radius(depth),
        surroundings: surroundings(ground, tool, contact_point, &frame),
        // As the calibrated model has it: held as a hemisphere of its volume is.
        thickness: ground.radius,
    }
}

/// What the organ is around a place, in its frame.
fn surroundings(
    ground: &RestSurface<'_>,
    tool: &Tool,
    contact_point: &ContactPoint,
    frame: &Matrix3<f64>,
) -> Surroundings {
    let Some(at) = ground.further else {
        return tool.model.by_volume(ground.radius);
    };
    let nodes = ground.surface.mesh().corners(contact_point.triangle);
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

    /// Judge: a search at every place. Forty places within 2 cm of one, then of another: most are in the air.
    #[test]
    fn a_tip_in_the_air_is_found_when_it_touches() {
        let scene = Scene::parse(SCENE, "scene.toml").unwrap();
        let simulation = Simulation::new(&scene).unwrap();
        let (tool, mesh) = (&simulation.tools()[0], simulation.surface().mesh());
        let ground = simulation.ground(tool);
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
            let found = clearance.detect(&ground, tool, last.as_ref(), &tip);
            assert_eq!(found, detect(&ground, tool, last.as_ref(), &tip), "{step}");
            touched += usize::from(found.is_some());
            last = found;
        }
        println!("{skipped} places were not sought, {touched} touched");
        assert!(skipped > 500 && touched > 500);
    }
}
