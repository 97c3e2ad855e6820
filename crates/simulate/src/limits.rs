//! Counts of the model bounds that acted while tools touched, reported afterwards.
//!
//! *How we know*: `limits::…`.

use palpate_mechanics::{Limit, Limits, Reached};

use crate::hand_speed::FASTEST_HAND;

/// Counts and worst cases of each bound under one tool. A step only counts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LimitCounts {
    steps: u64,
    acted: [u64; Limit::ALL.len()],
    worst: Limits,
    /// Steps too long for a hand, and the largest speed among them [m/s].
    jumps: u64,
    fastest: f64,
    energy_gains: u64,
}

impl LimitCounts {
    /// Counts a step that exceeds the speed of a hand, with its `speed` [m/s].
    pub(crate) fn count_jump(&mut self, speed: f64) {
        self.jumps += 1;
        self.fastest = self.fastest.max(speed);
    }

    /// Counts a touch that returned more work than was done.
    pub(crate) fn count_energy_gain(&mut self) {
        self.energy_gains += 1;
    }

    /// Counts one step in contact.
    pub(crate) fn count(&mut self, limits: &Limits) {
        self.steps += 1;
        for limit in Limit::ALL {
            self.acted[limit as usize] += u64::from(limits.reached(limit).is_some());
        }
        self.worst.merge(limits);
    }

    /// Steps in contact in which `limit` acted.
    pub fn steps_limited(&self, limit: Limit) -> u64 {
        self.acted[limit as usize]
    }

    /// The worst case of each bound that acted.
    pub fn worst(&self) -> &Limits {
        &self.worst
    }

    /// One sentence for each bound that acted under the tip of the tool with this name.
    pub fn warnings(&self, tool: &str) -> impl Iterator<Item = String> {
        let jumps = (self.jumps > 0).then(|| {
            format!(
                "the tool {tool:?} moved faster than {FASTEST_HAND} m/s, as no hand does, in {} steps, at most {:.1} m/s \
                 (event `jump`): it lost what it touched and held, and touched anew where it was then; check the \
                 motion's units and times, or the device",
                self.jumps, self.fastest
            )
        });
        let gains = (self.energy_gains > 0).then(|| {
            format!(
                "the organ gave back more work than the tool {tool:?} and others had done on it, {} times (event \
                 `energy_gain`): its forces there are wrong; please report the scene and the motion",
                self.energy_gains
            )
        });
        let limits = Limit::ALL.into_iter().filter_map(move |limit| {
            let reached = self.worst.reached(limit)?;
            let when = format!(
                "in {} of {} steps in contact",
                self.steps_limited(limit),
                self.steps
            );
            Some(sentence(limit, &reached, tool, &when))
        });
        limits.chain(jumps).chain(gains)
    }
}

fn sentence(limit: Limit, reached: &Reached, tool: &str, when: &str) -> String {
    let Reached { unbounded, used } = *reached;
    let lacks = too_low(used / unbounded);
    let times = match unbounded.is_finite() {
        true => format!("where its model asks for {unbounded:.1} times"),
        false => "where its model gives no finite stiffness".to_owned(),
    };
    match limit {
        Limit::Curvature => format!(
            "the curvature of the surface under the tip {tool:?} was limited from {unbounded:.0} to {used:.0} 1/m \
             {when}: the tip is large beside the organ there, and the force is that of the gentler surface; \
             `model.kind = \"hybrid\"` has no such limit"
        ),
        Limit::LocalStiffness => format!(
            "the organ under the tip {tool:?} was taken as {used:.0} times as stiff as a half-space, {times}, \
             {when}{lacks}: the tip is as large as the organ; use a smaller tip or `model.kind = \"hybrid\"`"
        ),
        Limit::LocalShearStiffness => format!(
            "the organ along the surface under the tip {tool:?} was taken as {used:.0} times as stiff as the \
             particles around the tip, {times}, {when}{lacks}: the tip is as large as the organ; use a smaller \
             tip or `model.kind = \"hybrid\"`"
        ),
        Limit::Residual => format!(
            "the iterations of `solver = \"gmres\"` under the tip {tool:?} ended at a relative residual of \
             {unbounded:.1e}, above {used:.1e}, {when}; these steps were solved by factors, as with `solver = \
             \"direct\"`, and their forces are right"
        ),
        Limit::TipStiffness => format!(
            "the organ under the tip {tool:?} was taken as {used:.0} times as stiff as a half-space, {times}, \
             {when}{lacks}: the organ is held right under the tip; touch farther from `organ.anchor` and from \
             the jaws of another tool"
        ),
        Limit::TipShearStiffness => format!(
            "the organ along the surface under the tip {tool:?} was taken as {used:.0} times as stiff as a \
             half-space, {times}, {when}{lacks}: the organ is held right under the tip; touch farther from \
             `organ.anchor` and from the jaws of another tool"
        ),
        Limit::TipDepth => format!(
            "the tip {tool:?} was pressed {:.1} mm into the tissue {when}, and its force is known to {:.1} mm: beyond, it \
             goes on along its tangent; press less, or use a larger tip",
            1e3 * unbounded,
            1e3 * used
        ),
        Limit::Coupling => format!(
            "the forces of tools that touch together, {tool:?} among them, still changed by {unbounded:.1e} of the largest \
             in the last sweep over them, above {used:.1e}, {when}: the tips are on the same spot, or deep beside each other; keep \
             them apart"
        ),
        Limit::Pace => format!(
            "the tool {tool:?} was to move the organ by {:.1} mm in a step, and the model followed by {:.1} mm {when}: \
             the force is that of the organ where it is; move slower, or set `model.nodes` higher if the organ is thin \
             there",
            1e3 * unbounded,
            1e3 * used
        ),
        Limit::NeighbourContacts => format!(
            "while the tool {tool:?} moved the organ, {unbounded:.0} points of it lay beside neighbours or itself, and the \
             {used:.0} nearest were kept out of them {when}: set `model.nodes` lower, or fewer neighbours that collide"
        ),
        Limit::LostContact => format!(
            "while the tool {tool:?} moved the organ, a part of it went {:.1} mm deep into a neighbour that bends or into \
             itself, and nothing pushed it out there {when}: move slower, or set `model.nodes` higher",
            1e3 * unbounded
        ),
        Limit::Carried => format!(
            "what the other tool moves the organ by under the tip {tool:?} was taken as {used:.2} of what it moves it by \
             under itself, where its model asks for {unbounded:.2}, {when}: the tips are on the same spot, or deep beside \
             each other; keep them apart"
        ),
    }
}

/// The missing part of the unbounded stiffness.
fn too_low(part: f64) -> String {
    match part > 0.0 {
        true => format!(
            "; the stiffness there is {:.0} % below that",
            100.0 * (1.0 - part)
        ),
        false => String::new(),
    }
}
