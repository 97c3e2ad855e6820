//! Random pokes and slides that follow a surface, and what they must never show.

use std::fmt;

use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::Simulation;

use crate::scenes::{Hand, Random, nearest};

/// Steps of a poke, then of the slide after it.
const POKE: usize = 10;
const SLIDE: usize = 50;

/// Travel of a sliding tip in a step [m].
const TRAVEL: f64 = 1e-4;

/// What was seen.
#[derive(Default)]
pub(crate) struct Count {
    steps: usize,
    in_contact: usize,
    no_number: usize,
    pulling: usize,
    without_contact: usize,
    leaps: usize,
    /// Steps with a force on a tip that is beyond a thin wall, which it pushes in front of it.
    outside: usize,
    /// Largest change of force, in parts of what is allowed.
    worst: f64,
    first_leap: Option<String>,
}

impl Count {
    pub(crate) fn assert_sound(&self, name: &str) {
        assert_eq!(self.no_number, 0, "{name}: forces that are no number");
        assert_eq!(self.pulling, 0, "{name}: forces into the organ");
        assert_eq!(self.without_contact, 0, "{name}: forces without contact");
        assert_eq!(
            self.leaps, 0,
            "{name}: {self}; the first: {:?}",
            self.first_leap
        );
        assert!(2 * self.in_contact > self.steps, "{name}: {self}");
    }

    /// One step: whatever the motion, these hold.
    fn look_at(&mut self, hand: &Hand<'_>) {
        let tool = &hand.state.tools[0];
        self.steps += 1;
        if tool.force.iter().any(|component| !component.is_finite()) {
            self.no_number += 1;
        }
        match &tool.contact {
            Some(contact) => {
                self.in_contact += 1;
                if tool.force.dot(&contact.normal()) < 0.0 {
                    self.pulling += 1;
                }
            }
            None if tool.force != Vec3::zeros() => self.without_contact += 1,
            None => {}
        }
    }

    fn compare(&mut self, before: &Seen, now: &Seen) {
        self.outside += usize::from(now.signed > 0.0 && now.force != Vec3::zeros());
        let change = (now.force - before.force).norm();
        let larger = now.force.norm().max(before.force.norm());
        let travels = ((now.tip - before.tip).norm() / TRAVEL).max(1.0);
        // 5 % and 0.2 mN per 0.1 mm are what a hand does not feel as a click; a force is nearly
        // proportional to the depth, and a tip that goes deeper does not only slide.
        let depth = now.depth.max(before.depth).max(f64::MIN_POSITIVE);
        let deeper = larger * (now.signed - before.signed).abs() / depth;
        let ratio = change / ((0.05 * larger + 2e-4) * travels + deeper);
        self.worst = self.worst.max(ratio);
        if ratio > 1.0 {
            self.leaps += 1;
            self.first_leap.get_or_insert_with(|| {
                let far = before.touched.zip(now.touched).map(|(a, b)| (a - b).norm());
                format!(
                    "{ratio:.2} of what is allowed, the touched point moved by {far:?}, from \
                     {before:?} to {now:?}"
                )
            });
        }
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} steps, {} in contact ({} beyond a thin wall), {} leaps, largest change {:.2} of what is allowed",
            self.steps, self.in_contact, self.outside, self.leaps, self.worst
        )
    }
}

/// A step as it is compared with the next.
#[derive(Debug)]
struct Seen {
    tip: Vec3,
    force: Vec3,
    depth: f64,
    /// The touched point of the rest surface [m].
    touched: Option<Vec3>,
    /// The tip's own signed distance to the rest surface [m].
    signed: f64,
}

/// Slides: down along the normal to a depth of 0.5 to 5 mm, then along the surface at that depth.
pub(crate) fn slides(simulation: &Simulation, number: usize, count: &mut Count) {
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let mut random = Random(7);
    for _ in 0..number {
        let mut hand = Hand::new(simulation);
        let (mut point, _, mut along) = random.place(simulation);
        let depth = 5e-4 + 4.5e-3 * random.unit();
        let mut before: Option<Seen> = None;
        for k in 0..POKE + SLIDE {
            if k >= POKE {
                point += along * TRAVEL;
            }
            let (on, normal) = nearest(simulation, &tree, &point);
            point = on;
            along = (along - normal * along.dot(&normal)).normalize();
            let part = ((k + 1) as f64 / POKE as f64).min(1.0);
            let tip = on - normal * (depth * part);
            let force = hand.at(&tip);
            count.look_at(&hand);
            let now = Seen {
                tip,
                force,
                depth: hand.row().depth_m,
                touched: hand.state.tools[0].contact.map(|contact| contact.point()),
                signed: surface.signed_distance(&tree, &tip).1,
            };
            if let Some(before) = before.as_ref().filter(|_| k > POKE) {
                count.compare(before, &now);
            }
            before = Some(now);
        }
    }
}

/// A tip that sticks: down, aside by as much, and out.
pub(crate) fn pokes_with_a_stuck_tip(simulation: &Simulation, number: usize, count: &mut Count) {
    let mut random = Random(11);
    for _ in 0..number {
        let mut hand = Hand::new(simulation);
        let (point, normal, along) = random.place(simulation);
        let depth = 5e-4 + 4.5e-3 * random.unit();
        for k in 0..=40_u32 {
            let part = f64::from(k) / 10.0;
            let down = part.min(1.0) - (part - 2.0).max(0.0);
            let aside = (part - 1.0).clamp(0.0, 1.0);
            hand.at(&(point + (along * aside - normal * down) * depth));
            count.look_at(&hand);
        }
    }
}
