use std::ops::Bound::Excluded;

use super::place::upward;
use crate::words::words;
use crate::{Domain, Error, Key, Keys};

words! {
    /// How hard the indenter is driven.
    pub enum Gains {
        /// As tuned on the virtual device.
        Tuned = "tuned",
        /// Half as hard.
        Gentle = "gentle",
    }
}

words! {
    /// What carries the indenter.
    pub enum RigDevice {
        /// A PHANTOM that is not there.
        Virtual = "virtual",
        /// A Haply device.
        Haply = "haply",
        /// A device of OpenHaptics.
        OpenHaptics = "openhaptics",
        /// A Force Dimension device.
        ForceDimension = "force_dimension",
    }
}

/// Limits and speeds of the rig. None is the rig's own default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RigLimits {
    /// How fast the indenter goes to the tissue [m/s].
    pub approach_speed_m_per_s: Option<f64>,
    /// The force limit on the tissue [N].
    pub force_limit_n: Option<f64>,
    /// The depth limit [m].
    pub depth_limit_m: Option<f64>,
    /// The speed limit [m/s].
    pub speed_limit_m_per_s: Option<f64>,
    /// The longest breath hold [s].
    pub breath_s: Option<f64>,
    /// The recovery time of the tissue between two stimuli [s].
    pub recovery_s: Option<f64>,
    /// The gains of the indenter's controller.
    pub gains: Option<Gains>,
    /// The device that carries the indenter.
    pub device: Option<RigDevice>,
    /// The rise of the force that counts as contact [N].
    pub contact_force_n: Option<f64>,
    /// The largest sideways distance of the indenter from the rig's start position [m].
    pub lateral_limit_m: Option<f64>,
    /// The direction from the tip to the device, in the rig's axes [-].
    pub indenter_axis: Option<[f64; 3]>,
    /// The relative half interval of every parameter at which a ramp and hold ends [-]; none for whole stimuli.
    pub stop_at_relative_interval: Option<f64>,
}

/// Relative half intervals that a protocol may request [-].
const TARGET: Domain =
    Domain::number("a number", [Excluded(0.0), Excluded(1.0)]).usually(0.02, 0.5);

/// Defaults of the rig.
const OWN: &str = "the rig's own";

impl RigLimits {
    pub(super) const KEYS: &[Key] = &[
        Key::number(
            "approach_speed_m_per_s",
            Domain::SPEED,
            "How fast the indenter goes to the tissue.",
        )
        .optional("0.005", OWN),
        Key::number(
            "force_limit_n",
            Domain::FORCE,
            "The largest force on the tissue.",
        )
        .optional("2.0", OWN),
        Key::number(
            "depth_limit_m",
            Domain::DEPTH,
            "The deepest that it may go.",
        )
        .optional("0.01", OWN),
        Key::number(
            "speed_limit_m_per_s",
            Domain::SPEED,
            "The fastest that it may be.",
        )
        .optional("0.1", OWN),
        Key::number(
            "breath_s",
            Domain::DURATION,
            "How long a breath is held at most.",
        )
        .optional("30.0", OWN),
        Key::number(
            "recovery_s",
            Domain::DURATION_OR_NONE,
            "How long tissue rests between two stimuli.",
        )
        .optional("10.0", OWN),
        Key::word("gains", Gains::MEANINGS, "How hard the indenter is driven.")
            .optional("\"tuned\"", OWN),
        Key::word("device", RigDevice::MEANINGS, "What carries the indenter.")
            .optional("\"virtual\"", OWN),
        Key::number(
            "contact_force_n",
            Domain::FORCE,
            "The rise of the force that is a contact.",
        )
        .optional("0.02", OWN),
        Key::number(
            "lateral_limit_m",
            Domain::LENGTH,
            "How far sideways the indenter may be moved from where the rig began.",
        )
        .optional("0.05", OWN),
        Key::direction(
            "indenter_axis",
            "The direction from the tip to the device, in the rig's axes; it leads up.",
        )
        .optional("[0.0, 0.0, 1.0]", OWN),
        Key::number(
            "stop_at_relative_interval",
            TARGET,
            "A ramp and hold ends when half the 95 % interval of the modulus and of each number of the relaxation is at \
             most this part of its value.",
        )
        .optional("0.1", "whole stimuli"),
    ];

    /// Whether the device is a virtual one.
    pub(super) fn has_virtual_device(&self) -> bool {
        matches!(self.device, None | Some(RigDevice::Virtual))
    }

    pub(super) fn from_keys(keys: Option<&Keys<'_>>) -> Result<Self, Error> {
        let Some(keys) = keys else {
            return Ok(Self::default());
        };
        Ok(Self {
            approach_speed_m_per_s: keys.number("approach_speed_m_per_s")?,
            force_limit_n: keys.number("force_limit_n")?,
            depth_limit_m: keys.number("depth_limit_m")?,
            speed_limit_m_per_s: keys.number("speed_limit_m_per_s")?,
            breath_s: keys.number("breath_s")?,
            recovery_s: keys.number("recovery_s")?,
            gains: keys.word("gains", Gains::WORDS)?,
            device: keys.word("device", RigDevice::WORDS)?,
            contact_force_n: keys.number("contact_force_n")?,
            lateral_limit_m: keys.number("lateral_limit_m")?,
            indenter_axis: upward(keys, "indenter_axis")?,
            stop_at_relative_interval: keys.number("stop_at_relative_interval")?,
        })
    }
}
