//! Progress of touching a target in front of which the organ lies.

use palpate_files::scene::TouchGoal;
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

use super::goal::{Advice, Cue, Outcome};

/// Evaluates two tools: one that touches, and one that may hold the organ out of its way.
#[derive(Debug, Clone)]
pub(super) struct TouchTracker {
    goal: TouchGoal,
    tool: Option<usize>,
    holder: Option<usize>,
    /// Whether the holder holds tissue.
    holds: bool,
    /// The force on the holder [N].
    pull: f64,
    /// Whether the shaft of the tool touches the organ.
    shaft_touches: bool,
    /// Last position of the tool; none before it is present, and after it is lifted.
    tip: Option<Tip>,
    /// Time [s] and cue of its row before.
    last: Option<(f64, Cue)>,
    within: f64,
    /// [m]
    target_distance: Option<f64>,
    /// [N]
    injured: Option<f64>,
    torn: Option<f64>,
}

/// The tip of the tool.
#[derive(Debug, Clone, Copy)]
struct Tip {
    /// Distance from the target [m].
    distance: f64,
    /// [N]
    force: f64,
    touches_organ: bool,
}

impl TouchTracker {
    pub(super) fn new(goal: &TouchGoal, tools: &[String]) -> Self {
        let number = |name: &String| tools.iter().position(|tool| tool == name);
        Self {
            tool: number(&goal.tool),
            holder: goal.holder.as_ref().and_then(number),
            goal: goal.clone(),
            holds: false,
            pull: 0.0,
            shaft_touches: false,
            tip: None,
            last: None,
            within: 0.0,
            target_distance: None,
            injured: None,
            torn: None,
        }
    }

    pub(super) fn add(&mut self, row: &SessionRow) {
        let force = Vec3::from(row.force_n).norm();
        if self.holder == Some(row.tool) {
            self.follow_holder(row, force);
        }
        if self.tool == Some(row.tool) {
            self.follow_tool(row, force);
        }
    }

    fn follow_holder(&mut self, row: &SessionRow, force: f64) {
        let happened = |event| row.events.contains(event);
        let releases = [
            Event::GripRelease,
            Event::Lifted,
            Event::Jump,
            Event::Restart,
        ];
        self.holds |= happened(Event::Grip);
        self.holds &= !releases.into_iter().any(happened);
        self.pull = force;
        if self.holds && self.goal.tear_force_n.is_some_and(|tear| force > tear) {
            self.torn = Some(force);
        }
    }

    fn follow_tool(&mut self, row: &SessionRow, force: f64) {
        let happened = |event| row.events.contains(event);
        self.shaft_touches |= happened(Event::ShaftContact);
        self.shaft_touches &= !happened(Event::ShaftRelease) && !happened(Event::Restart);
        let offset = Vec3::from(row.position_m) - Vec3::from(self.goal.target_m);
        self.tip = (!happened(Event::Lifted)).then_some(Tip {
            distance: offset.norm(),
            force,
            touches_organ: row.contact,
        });
        let cue = self.advice().cue;
        if let Some((time, before)) = self.last.replace((row.time_s, cue))
            && (before, cue) == (Cue::Hold, Cue::Hold)
        {
            self.within += row.time_s - time;
        }
        if !matches!(cue, Cue::Grasp | Cue::Lift) {
            let nearer = |distance: f64| distance.min(offset.norm());
            self.target_distance = Some(self.target_distance.map_or(offset.norm(), nearer));
        }
        // A force of the organ is no force on the target.
        let injures = |most: f64| !row.contact && force > most;
        if self.goal.injury_force_n.is_some_and(injures) {
            self.injured = Some(force);
        }
    }

    /// The one thing to change now.
    pub(super) fn advice(&self) -> Advice {
        let goal = &self.goal;
        let pull = |cue| Advice {
            force: self.pull,
            cue,
        };
        if goal.holder.is_some() && !self.holds {
            return pull(Cue::Grasp);
        }
        let Some(tip) = self.tip else {
            return pull(Cue::Reach);
        };
        if self.shaft_touches || tip.touches_organ {
            return pull(Cue::Lift);
        }
        if tip.distance > goal.tolerance_m {
            return pull(Cue::Reach);
        }
        let cue = match tip.force {
            force if force < goal.force_n - goal.tolerance_n => Cue::More,
            force if force > goal.force_n + goal.tolerance_n => Cue::Less,
            _ => Cue::Hold,
        };
        Advice {
            force: tip.force,
            cue,
        }
    }

    pub(super) fn is_done(&self) -> bool {
        self.within >= self.goal.hold_s || self.injured.is_some() || self.torn.is_some()
    }

    /// The completed part of the time [-].
    pub(super) fn part(&self) -> f64 {
        (self.within / self.goal.hold_s).min(1.0)
    }

    pub(super) fn outcome(&self) -> Outcome {
        let harmed = self.injured.is_some() || self.torn.is_some();
        Outcome::Touch {
            within: self.within,
            target_distance: self.target_distance,
            reached: self.within >= self.goal.hold_s && !harmed,
            injured: self.injured,
            torn: self.torn,
        }
    }
}
