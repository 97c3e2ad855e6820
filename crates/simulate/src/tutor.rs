//! An expert's session beside a trainee: how far the trainee has come on the expert's way, where the expert's
//! tools were a little later, and whether the force is one that the expert used there.
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

use crate::SimulationState;
use crate::interactive::Snapshot;

/// Seconds of the expert's that are looked through from where the trainee is [s].
const AHEAD: f64 = 3.0;

/// How far ahead the expert's tools are shown [s].
const LEAD: f64 = 0.5;

/// What a second further on costs, as if the tools were so far apart [m/s].
const DEARER: f64 = 2e-3;

/// The expert's forces within this time make the band [s], which has so much room below and above [-] [N].
const AROUND: f64 = 0.5;
const ROOM: f64 = 0.3;
const LEAST_ROOM: f64 = 0.05;

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
    tools: Vec<Option<(Ghost, f64)>>,
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

/// What an expert has to say.
#[derive(Debug, Clone, PartialEq)]
pub struct Guidance {
    /// The part of the expert's time that the trainee has come to [-].
    pub progress: f64,
    /// Where the expert's tools were a little later, one per tool of the scene.
    pub ghosts: Vec<Option<Ghost>>,
    /// The forces that the expert used there [N]: least and largest, with some room.
    pub bands: Vec<Option<[f64; 2]>>,
    /// Which tools press otherwise.
    pub strays: Vec<Option<Stray>>,
}

/// How a force leaves its band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stray {
    /// Harder than the expert.
    Above,
    /// More gently than the expert.
    Below,
}

/// A trainee's tool: its tip [m] and the force on it [N]; none while nobody holds it.
pub type HeldTool = Option<([f64; 3], f64)>;

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
            let held = (!row.events.contains(Event::Lifted)).then(|| {
                let ghost = Ghost {
                    position: row.position_m,
                    orientation: row.orientation,
                    grip: row.grip,
                };
                (ghost, Vec3::from(row.force_n).norm())
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
    pub fn begin_anew(&mut self) {
        self.at = 0;
    }

    /// Follows the trainee's tools, in the order of the scene.
    pub fn follow(&mut self, held: &[HeldTool]) -> Guidance {
        let now = self.moments[self.at].time;
        let ahead = self.moments[self.at..].iter();
        let near = ahead.take_while(|moment| moment.time <= now + AHEAD);
        let costs = near.map(|moment| moment.distance(held) + DEARER * (moment.time - now));
        let nearest = costs
            .enumerate()
            .min_by(|(_, one), (_, other)| one.total_cmp(other));
        self.at += nearest.map_or(0, |(further, _)| further);
        let now = self.moments[self.at].time;
        let (first, last) = (
            self.moments[0].time,
            self.moments[self.moments.len() - 1].time,
        );
        let later = self.moments[self.at..]
            .iter()
            .find(|moment| moment.time >= now + LEAD);
        let later = later.unwrap_or(&self.moments[self.moments.len() - 1]);
        let bands: Vec<_> = (0..held.len()).map(|tool| self.band(tool, now)).collect();
        let strays = held.iter().zip(&bands).map(|(held, band)| {
            let ((_, force), [low, high]) = ((*held)?, (*band)?);
            match force {
                force if force > high => Some(Stray::Above),
                force if force < low => Some(Stray::Below),
                _ => None,
            }
        });
        Guidance {
            progress: if last > first {
                (now - first) / (last - first)
            } else {
                1.0
            },
            ghosts: later
                .tools
                .iter()
                .map(|tool| tool.map(|(ghost, _)| ghost))
                .collect(),
            strays: strays.collect(),
            bands,
        }
    }

    /// As [`Self::follow`], of what there is to see.
    pub fn follow_snapshot(&mut self, seen: &Snapshot) -> Guidance {
        let held = seen
            .tools
            .iter()
            .map(|tool| Some((tool.pose?.position_m, tool.force.norm())));
        self.follow(&held.collect::<Vec<_>>())
    }

    /// As [`Self::follow`], of a state.
    pub fn follow_state(&mut self, state: &SimulationState) -> Guidance {
        let held = state
            .tools
            .iter()
            .map(|tool| Some((tool.pose?.position_m, tool.force.norm())));
        self.follow(&held.collect::<Vec<_>>())
    }

    fn band(&self, tool: usize, now: f64) -> Option<[f64; 2]> {
        let around = self
            .moments
            .iter()
            .filter(|moment| (moment.time - now).abs() <= AROUND);
        let forces = around.filter_map(|moment| Some(moment.tools.get(tool)?.as_ref()?.1));
        let found = forces.fold(None, |band: Option<[f64; 2]>, force| {
            let [low, high] = band.unwrap_or([force, force]);
            Some([low.min(force), high.max(force)])
        });
        found.map(|[low, high]| {
            let low = (1.0 - ROOM) * low - LEAST_ROOM;
            [low.max(0.0), (1.0 + ROOM) * high + LEAST_ROOM]
        })
    }
}

impl Moment {
    /// How far the tools are from a trainee's [m]; a tool that only one of them holds does not count.
    fn distance(&self, held: &[HeldTool]) -> f64 {
        let both = self.tools.iter().zip(held).filter_map(|(own, held)| {
            let ((ghost, _), (position, _)) = (own.as_ref()?, held.as_ref()?);
            Some((Vec3::from(ghost.position) - Vec3::from(*position)).norm_squared())
        });
        both.sum::<f64>().sqrt()
    }
}
