//! An expert's session that a trainee follows: how far the trainee has come along the expert's path, and where the
//! expert's tools were a little later.
//!
//! The tutor follows the expert's path forwards, never backwards: among the next seconds of the expert it selects the
//! moment at which all tools were nearest to the trainee's, with a small penalty for later moments. So a trainee may
//! take more time or less, and a pause is no progress.
//!
//! *How we know*: `tutor::…`.
//!
//! *Limits*: a trainee who takes another path than the expert's keeps the moment at which they left it; the motion of
//! the organ is ignored.

use palpate_files::{Event, Session};
use palpate_geometry::Vec3;

/// Length of the search window from the trainee's moment [s].
const AHEAD: f64 = 3.0;

/// How far ahead the expert's tools are shown [s].
const LEAD: f64 = 0.5;

/// Penalty of a later moment, as a distance of the tools per second [m/s].
const DEARER: f64 = 2e-3;

/// Interval of the stored moments of the expert [s].
const APART: f64 = 0.02;

/// A followed session of an expert.
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

/// The pose of an expert's tool.
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
    /// From an expert's `session` for a scene with tools of those names; none if it has no row of any of them.
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
                // The first row of a time counts.
                let own = &mut moment.tools[number];
                *own = own.or(held);
            }
        }
        (!moments.is_empty()).then_some(Self { moments, at: 0 })
    }

    /// Restarts from the beginning.
    pub fn reset(&mut self) {
        self.at = 0;
    }

    /// The expert's tools a little after the moment that corresponds to the trainee's. `tips` [m] are in the order of
    /// the scene's tools; none for a tool without a hand.
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
    /// Distance of the tools from a trainee's [m]; a tool that only one of them holds does not count.
    fn distance(&self, tips: &[Option<[f64; 3]>]) -> f64 {
        let both = self.tools.iter().zip(tips).filter_map(|(own, tip)| {
            Some((Vec3::from(own.as_ref()?.position) - Vec3::from(*tip.as_ref()?)).norm_squared())
        });
        both.sum::<f64>().sqrt()
    }
}
