//! Tissue that moves by itself, as a heart moves it, seen by the swing of the force in a hold.

use palpate_files::recording::IndenterShape;

use super::{Ripple, Segment};

/// Time at the beginning of a hold whose mean force belongs to its depth [s].
const BEGINNING: f64 = 0.1;

/// A press of tissue that moves by itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingTissue<'a> {
    /// Times [s], ascending.
    pub(crate) time: &'a [f64],
    /// Depths [m].
    pub(crate) depth: &'a [f64],
    /// Forces [N].
    pub(crate) force: &'a [f64],
    /// What the indenter does.
    pub(crate) segments: &'a [Segment],
    /// How the force swings.
    pub(crate) ripple: &'a Ripple,
    /// Flat, unless it is known.
    pub(crate) shape: Option<IndenterShape>,
}

impl MovingTissue<'_> {
    /// The force [N] as if the tissue did not move: without the swing of the hold, which is taken to go on in the ramp before it
    /// as the stiffness of an elastic contact grows with the depth.
    pub(crate) fn force_at_rest(&self) -> Vec<f64> {
        let (mut force, ripple) = (self.force.to_vec(), self.ripple);
        ripple.remove(self.time, &mut force);
        let hold_depth = self.depth[ripple.first];
        let ramp = self.segments.iter().find(|own| own.end == ripple.first);
        for sample in ramp.map_or(0..0, |ramp| ramp.first..ramp.end) {
            let part = (self.depth[sample] / hold_depth).clamp(0.0, 1.0);
            if part > 0.0 {
                force[sample] -= part.powf(self.power() - 1.0) * ripple.force(self.time[sample]);
            }
        }
        force
    }

    /// The amplitude of the motion [m]: that of the force over the stiffness of an elastic contact at the beginning of the hold,
    /// where the error of the amplitude is added. A slow ramp leaves tissue that relaxes less force than its stiffness suggests, and then
    /// the motion comes out too large. None where there is no force.
    pub(crate) fn amplitude(&self) -> Option<f64> {
        let ripple = self.ripple;
        let until = self.time[ripple.first] + BEGINNING;
        let force = self.force_at_rest();
        let hold = ripple.first..ripple.end;
        let begins: Vec<f64> = hold
            .take_while(|sample| self.time[*sample] <= until)
            .map(|sample| force[sample])
            .collect();
        let force = begins.iter().sum::<f64>() / begins.len() as f64;
        let stiffness = self.power() * force / self.depth[ripple.first];
        let amplitude = (ripple.amplitude_n + ripple.amplitude_error_n) / stiffness;
        (stiffness > 0.0 && amplitude.is_finite()).then_some(amplitude)
    }

    /// The power of the depth with which the force of an elastic contact rises [-].
    fn power(&self) -> f64 {
        match self.shape {
            None | Some(IndenterShape::Flat) => 1.0,
            Some(IndenterShape::Sphere) => 1.5,
            Some(IndenterShape::Cone) => 2.0,
        }
    }
}
