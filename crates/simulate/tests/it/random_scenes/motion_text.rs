//! A random motion of the tools of a scene, as its document: gestures at the organ, and now and then what no hand does.

use std::fmt::Write as _;

use nalgebra::UnitQuaternion;
use palpate_files::Scene;
use palpate_geometry::Vec3;
use palpate_simulate::Simulation;

use crate::scenes::Random;

/// Steps of a motion, about.
const STEPS: usize = 80;

pub(super) fn motion_text(random: &mut Random, scene: &Scene, simulation: &Simulation) -> String {
    let has_orientation = random.chance(0.6);
    let mut text = "# format = 1\ntime_s,tool,x_m,y_m,z_m".to_owned();
    text += if has_orientation {
        ",qx,qy,qz,qw,grip,cut\n"
    } else {
        ",grip,cut\n"
    };
    // Tools meet, so that they feel each other.
    let meet = random.place(simulation);
    let end = STEPS as f64 * simulation.step();
    for tool in &scene.tools {
        let mut hand = Hand {
            place: meet,
            time: random.between(0.0, 0.2 * end),
            cut: false,
            grip: 0.0,
            has_orientation,
            name: &tool.name,
        };
        if random.chance(0.4) {
            hand.place = random.place(simulation);
        }
        while hand.time < end {
            hand.gesture(random, simulation, &mut text);
        }
    }
    text
}

struct Hand<'a> {
    /// The place of the organ about which it moves [m], the outward normal there and a direction along the surface.
    place: (Vec3, Vec3, Vec3),
    time: f64,
    grip: f64,
    cut: bool,
    has_orientation: bool,
    name: &'a str,
}

impl Hand<'_> {
    /// Some rows: to or near the place, deep or not, along, off, with jaws and blade doing what they like.
    fn gesture(&mut self, random: &mut Random, simulation: &Simulation, text: &mut String) {
        if random.chance(0.2) {
            self.place = random.place(simulation);
        }
        let (place, normal, along) = self.place;
        let step = simulation.step();
        for _ in 0..1 + random.below(4) {
            let height = match random.below(10) {
                0..2 => random.between(0.0, 0.02),
                2..8 => -random.spread(1e-5, 6e-3),
                8 => -random.spread(5e-3, 4e-2),
                // Through it, or pulled far off.
                _ => random.between(-0.2, 0.2),
            };
            let across = normal.cross(&along);
            let mut at = place + normal * height;
            at += along * random.between(-0.01, 0.01) + across * random.between(-0.01, 0.01);
            if random.chance(0.03) {
                // Where no hand gets in a step.
                at *= random.spread(0.1, 1e3);
            }
            self.grip = match random.below(3) {
                0 => self.grip,
                1 => 1.0,
                _ => random.unit(),
            };
            self.cut = if random.chance(0.4) {
                !self.cut
            } else {
                self.cut
            };
            self.write(random, &at, &normal, text);
            // Slowly, as a hand does, or within a step.
            self.time += match random.below(8) {
                0 => 0.5 * step,
                _ => step * random.spread(1.0, 30.0),
            };
        }
        if random.chance(0.3) {
            self.grip = 0.0;
        }
    }

    fn write(&self, random: &mut Random, at: &Vec3, normal: &Vec3, text: &mut String) {
        write!(
            text,
            "{:?},{},{:?},{:?},{:?}",
            self.time, self.name, at.x, at.y, at.z
        )
        .unwrap();
        if self.has_orientation {
            let upright = UnitQuaternion::rotation_between(&Vec3::z(), normal);
            let upright = upright.unwrap_or_else(UnitQuaternion::identity);
            let lean = Vec3::from_fn(|_, _| random.between(-1.0, 1.0));
            let turned = upright * UnitQuaternion::from_scaled_axis(lean);
            write!(
                text,
                ",{:?},{:?},{:?},{:?}",
                turned.i, turned.j, turned.k, turned.w
            )
            .unwrap();
        }
        writeln!(text, ",{:?},{}", self.grip, u8::from(self.cut)).unwrap();
    }
}
