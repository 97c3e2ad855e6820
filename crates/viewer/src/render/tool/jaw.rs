use std::f64::consts::PI;

use palpate_geometry::Vec3;

use super::JawSize;
use super::hinge::GAP;
use super::solid::Solid;

/// From tooth to tooth [m], and how high they are [m].
const TOOTH: f64 = 0.0009;
const HIGH: f64 = 0.00022;

/// Points of the frame's way around its window, and around its section.
const WAY: usize = 168;
const SECTION: usize = 12;

/// One jaw of a grasper, shut: a frame around a window, with teeth inside; `side` selects the jaw.
pub(super) fn corners(jaws: &JawSize, side: f64) -> Vec<[f32; 6]> {
    let solid = frame(jaws).with(lug(jaws));
    match side > 0.0 {
        true => solid.corners(),
        false => solid.turned_over().corners(),
    }
}

/// Where the frame ends towards the hinge [m].
fn root(jaws: &JawSize) -> f64 {
    0.76 * jaws.length
}

/// A bar that goes around the window: flat with teeth inside, round outside, slenderer at the tip.
fn frame(jaws: &JawSize) -> Solid {
    let bar = 0.29 * jaws.width;
    let turn = 0.5 * (jaws.width - bar);
    let (low, high) = (0.5 * bar + turn, root(jaws) - turn);
    let straight = high - low;
    let whole = 2.0 * straight + 2.0 * PI * turn;
    let rings: Vec<Vec<Vec3>> = (0..WAY)
        .rev()
        .map(|k| {
            let (center, out) = stadium(whole * k as f64 / WAY as f64, turn, low, straight);
            let part = ((center.z - low) / straight).clamp(0.0, 1.0);
            let height = jaws.width * (0.24 + 0.14 * part);
            section(center, out, bar, height)
        })
        .collect();
    Solid::loop_of(&rings)
}

/// A point of a way with two straight sides along z, so far along it [m], and the direction out of its
/// window [-]: up the +y side, around the upper end, and down again.
fn stadium(along: f64, turn: f64, low: f64, straight: f64) -> (Vec3, Vec3) {
    let arc = PI * turn;
    if along < straight {
        return (Vec3::new(0.0, turn, low + along), Vec3::y());
    }
    if along < straight + arc {
        let (sin, cos) = ((along - straight) / turn).sin_cos();
        let out = Vec3::new(0.0, cos, sin);
        return (turn * out + (low + straight) * Vec3::z(), out);
    }
    if along < 2.0 * straight + arc {
        let down = along - straight - arc;
        return (Vec3::new(0.0, -turn, low + straight - down), -Vec3::y());
    }
    let (sin, cos) = ((along - 2.0 * straight - arc) / turn).sin_cos();
    let out = Vec3::new(0.0, -cos, -sin);
    (turn * out + low * Vec3::z(), out)
}

/// The bar's section, `wide` across and `high` along x.
fn section(center: Vec3, out: Vec3, wide: f64, high: f64) -> Vec<Vec3> {
    let round = (0..SECTION).map(|k| {
        let angle = PI * k as f64 / (SECTION - 1) as f64;
        let (sin, cos) = angle.sin_cos();
        // Between an ellipse and a box.
        let (x, across) = (
            high * sin.powf(0.7),
            0.5 * wide * cos.signum() * cos.abs().powf(0.7),
        );
        center + (x + HIGH) * Vec3::x() + across * out
    });
    let mut points: Vec<Vec3> = round.collect();
    // The flat side, whose teeth are straight across the jaw.
    for across in [-0.46, 0.46] {
        let place = center + across * wide * out;
        let saw = (place.z / TOOTH).rem_euclid(1.0);
        let tooth = HIGH * (2.0 * saw - 1.0).abs();
        points.push(place + (tooth + 2e-5) * Vec3::x());
    }
    points
}

/// Joint of the frame and the hinge, on one side of which it turns.
fn lug(jaws: &JawSize) -> Solid {
    let hinge = jaws.length * Vec3::z();
    let radius = 0.0018;
    let disc = Solid::disc(hinge, radius, 3e-5, GAP - 5e-5);
    let (low, high) = (root(jaws) - 0.35 * jaws.width, jaws.length + 0.4 * radius);
    let box_at = |z: f64, (left, right): (f64, f64), (inner, outer): (f64, f64)| {
        vec![
            Vec3::new(inner, left, z),
            Vec3::new(outer, left, z),
            Vec3::new(outer, right, z),
            Vec3::new(inner, right, z),
        ]
    };
    let (narrow, top) = (0.40 * jaws.width, 0.36 * jaws.width);
    let neck = Solid::skin(&[
        box_at(low, (-narrow, narrow), (HIGH, 0.7 * top)),
        box_at(low + 0.12 * jaws.width, (-narrow, narrow), (2e-4, top)),
        box_at(
            root(jaws) + 0.25 * jaws.width,
            (-0.8 * GAP, GAP - 5e-5),
            (0.0, 1.1 * top),
        ),
        box_at(
            jaws.length - 0.7 * radius,
            (3e-5, GAP - 5e-5),
            (-0.6 * radius, 0.95 * radius),
        ),
        box_at(high, (3e-5, GAP - 5e-5), (-0.5 * radius, 0.7 * radius)),
    ]);
    disc.with(neck)
}
