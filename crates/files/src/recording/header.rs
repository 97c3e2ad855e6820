use crate::table::ExtraKey;
use crate::words::words;

words! {
    /// The state of the tissue.
    pub enum Condition {
        /// In the living body.
        InVivo = "in_vivo",
        /// Taken out of the body.
        ExVivo = "ex_vivo",
        /// A piece in the laboratory.
        InVitro = "in_vitro",
    }
}

words! {
    /// What the indenter did.
    pub enum StimulusKind {
        /// It went to a depth and stayed there.
        RampAndHold = "ramp_and_hold",
        /// It swung with one frequency.
        Sine = "sine",
        /// It swung with a frequency that grew linearly.
        ChirpLinear = "chirp_linear",
        /// It swung with a frequency that grew exponentially.
        ChirpExponential = "chirp_exponential",
        /// It pressed or pulled a whole piece along one axis.
        Uniaxial = "uniaxial",
        /// Something else.
        Other = "other",
    }
}

words! {
    /// The shape of the indenter.
    pub enum IndenterShape {
        /// A round flat face.
        Flat = "flat",
        /// A ball.
        Sphere = "sphere",
        /// A cone.
        Cone = "cone",
    }
}

words! {
    /// What a specimen rests on.
    pub enum Support {
        /// Glued to a rigid plate, or held to it by friction.
        Bonded = "bonded",
        /// On a rigid plate, along which it slides without friction.
        Lubricated = "lubricated",
    }
}

words! {
    /// The shape of the specimen, where it matters.
    pub enum Specimen {
        /// A hollow organ between fixed ends.
        Tube = "tube",
    }
}

/// What the comments above a recording say; none where they say nothing. The fields bear the names
/// of the keys.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecordingHeader {
    /// The organ.
    pub organ: Option<String>,
    /// The animal, person or body.
    pub subject: Option<String>,
    /// The subject's weight [kg].
    pub weight_kg: Option<f64>,
    /// The place on the organ.
    pub site: Option<String>,
    /// Which repetition it is.
    pub repeat: Option<u64>,
    /// The state of the tissue.
    pub condition: Option<Condition>,
    /// Time since death [s].
    pub post_mortem_s: Option<f64>,
    /// Whether breath was held.
    pub breath_held: Option<bool>,
    /// What the indenter did.
    pub stimulus: Option<StimulusKind>,
    /// Duration of the ramp [s].
    pub ramp_s: Option<f64>,
    /// Depth of the hold, or amplitude of the swing [m].
    pub amplitude_m: Option<f64>,
    /// Depth around which the indenter swings [m].
    pub pre_indentation_m: Option<f64>,
    /// Frequency of a sine, or that with which a chirp begins [Hz].
    pub frequency_hz: Option<f64>,
    /// Frequency with which a chirp ends [Hz].
    pub end_frequency_hz: Option<f64>,
    /// Samples per second [Hz].
    pub sample_rate_hz: Option<f64>,
    /// The shape of the indenter.
    pub indenter_shape: Option<IndenterShape>,
    /// The radius, not the diameter, of the indenter [m].
    pub indenter_radius_m: Option<f64>,
    /// The angle between a cone's axis and its side [degrees].
    pub indenter_half_angle_deg: Option<f64>,
    /// What measured the force.
    pub force_sensor: Option<String>,
    /// The direction out of the tissue along which the indenter was moved, in the rig's axes [-].
    pub approach_normal: Option<[f64; 3]>,
    /// The direction from the indenter's tip to the device, in the rig's axes [-].
    pub indenter_axis: Option<[f64; 3]>,
    /// From the sensor's origin, about which torques are, to the tip [m].
    pub tip_distance_m: Option<f64>,
    /// Thickness of the specimen under the indenter [m].
    pub thickness_m: Option<f64>,
    /// Radius of a round specimen, indented in its middle [m].
    pub specimen_radius_m: Option<f64>,
    /// Width of a square specimen, indented in its middle [m].
    pub specimen_width_m: Option<f64>,
    /// What the specimen rests on.
    pub support: Option<Support>,
    /// Density of the specimen [kg/m³].
    pub density_kg_per_m3: Option<f64>,
    /// Cross-section of a piece that is pressed or pulled along one axis [m²].
    pub area_m2: Option<f64>,
    /// Height of a piece that is pressed or pulled along one axis [m].
    pub height_m: Option<f64>,
    /// The shape of the specimen.
    pub specimen: Option<Specimen>,
    /// Inner radius of a tube [m].
    pub inner_radius_m: Option<f64>,
    /// Outer radius of a tube [m].
    pub outer_radius_m: Option<f64>,
    /// Length of a tube [m].
    pub length_m: Option<f64>,
    /// Pressure inside a tube [Pa].
    pub pressure_pa: Option<f64>,
    /// Where the recording comes from.
    pub source: Option<String>,
    /// How it ended: `whole`, `unfinished` while it is made, or why it was cut short.
    pub ended: Option<String>,
    /// Keys that mean nothing here and are kept.
    pub extra: Vec<ExtraKey>,
}

impl RecordingHeader {
    /// [`ended`](Self::ended) of a recording with all its samples.
    pub const WHOLE: &str = "whole";

    /// Why it ends before its stimulus; none when it is whole, or says nothing.
    pub fn cut_short(&self) -> Option<&str> {
        self.ended.as_deref().filter(|ended| *ended != Self::WHOLE)
    }

    /// The same, with what it does not say taken from `other`.
    pub fn completed_by(mut self, other: &Self) -> Self {
        macro_rules! complete {
            ($($field:ident)*) => {
                $(if self.$field.is_none() {
                    self.$field.clone_from(&other.$field);
                })*
            };
        }
        complete!(
            organ subject weight_kg site repeat
            condition post_mortem_s breath_held stimulus ramp_s
            amplitude_m pre_indentation_m frequency_hz end_frequency_hz sample_rate_hz
            indenter_shape indenter_radius_m indenter_half_angle_deg
            force_sensor approach_normal indenter_axis tip_distance_m
            thickness_m specimen_radius_m specimen_width_m support density_kg_per_m3
            area_m2 height_m
            specimen inner_radius_m outer_radius_m length_m pressure_pa
            source ended
        );
        self.extra.extend(other.extra.iter().cloned());
        self
    }
}
