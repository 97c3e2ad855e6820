//! An expert's session that a trainee follows: how far the trainee has come along the expert's path, and where the
//! expert's tools were a little later.
//!
//! The expert's way is followed forth, never back: of the expert's next seconds that moment counts at which
//! all tools were nearest to the trainee's, a little dearer the later it is. So a trainee may take more time
//! or less, and a pause is no progress.
//!
//! *How we know*: `tutor::…`.
//!
//! *Limits*: who takes another way than the expert stays where they left it; an organ that moves is not followed.

use palpate_files::{Event, Session};
use palpate_geometry::Vec3;

/// Seconds of the expert's that are looked through from where the trainee is [s].
const AHEAD: f64 = 3.0;

/// How far ahead the expert's tools are shown [s].
const LEAD: f64 = 0.5;

/// What a second further on costs, as if the tools were so far apart [m/s].
const DEARER: f64 = 2e-3;

/// Between the expert's moments that are kept [s].
const APART: f64 = 0.02;

/// An expert's session that is followed.
#[derive(Debug, Clone)]
pub struct Tutor {
    moments: Vec<Moment>,
    at: usize,
}

/// Tools at one time.
#[derive(Debug, Clone)]
struct Moment {
    time: f64,
    tools: Vec<Option<Ghost>>,
}

/// Where an expert's tool was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ghost {
    /// Its tip [m].
    pub position: [f64; 3],
    /// The quaternion (qx, qy, qz, qw) that maps tool to scene [-].
    pub orientation: [f64; 4],
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
}

impl Tutor {
    /// An expert's `session` for a scene with tools of those names; none if it has no row of any of them.
    pub fn new(expert: &Session, tools: &[String]) -> Option<Self> {
        let number = |name: &String| tools.iter().position(|tool| tool == name);
        let numbers: Vec<Option<usize>> = expert.tools.iter().map(number).collect();
        let mut moments: Vec<Moment> = Vec::new();
        for row in &expert.rows {
            let Some(number) = numbers[row.tool] else {
                continue;
            };
            let is_new = moments
                .last()
                .is_none_or(|last| row.time_s >= last.time + APART);
            if is_new {
                moments.push(Moment {
                    time: row.time_s,
                    tools: vec![None; tools.len()],
                });
            }
            let held = (!row.events.contains(Event::Lifted)).then_some(Ghost {
                position: row.position_m,
                orientation: row.orientation,
                grip: row.grip,
            });
            if let Some(moment) = moments.last_mut() {
                // The first row of a moment counts.
                let own = &mut moment.tools[number];
                *own = own.or(held);
            }
        }
        (!moments.is_empty()).then_some(Self { moments, at: 0 })
    }

    /// From the beginning again.
    pub fn reset(&mut self) {
        self.at = 0;
    }

    /// Where the expert's tools were a little after the moment to which the trainee's have come. `tips` [m] are in
    /// the order of the scene's tools; none while nobody holds one.
    pub fn follow(&mut self, tips: &[Option<[f64; 3]>]) -> Vec<Option<Ghost>> {
        let now = self.moments[self.at].time;
        let ahead = self.moments[self.at..].iter();
        let near = ahead.take_while(|moment| moment.time <= now + AHEAD);
        let costs = near.map(|moment| moment.distance(tips) + DEARER * (moment.time - now));
        let nearest = costs
            .enumerate()
            .min_by(|(_, one), (_, other)| one.total_cmp(other));
        self.at += nearest.map_or(0, |(further, _)| further);
        let now = self.moments[self.at].time;
        let later = self.moments[self.at..]
            .iter()
            .find(|moment| moment.time >= now + LEAD);
        let later = later.unwrap_or(&self.moments[self.moments.len() - 1]);
        later.tools.clone()
    }
}

impl Moment {
    /// How far the tools are from a trainee's [m]; a tool that only one of them holds does not count.
    fn distance(&self, tips: &[Option<[f64; 3]>]) -> f64 {
        let both = self.tools.iter().zip(tips).filter_map(|(own, tip)| {
            Some((Vec3::from(own.as_ref()?.position) - Vec3::from(*tip.as_ref()?)).norm_squared())
        });
        both.sum::<f64>().sqrt()
    }
}
