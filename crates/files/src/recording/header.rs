use super::header_keys::header_keys;
use crate::scene::{LengthUnit, Region};
use crate::table::ExtraKey;
use crate::words::words;
use crate::{Domain, Error, Key, Keys, ValueType};

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
        /// It pulled a strip between clamps along one axis, its sides free.
        UniaxialTension = "uniaxial_tension",
        /// It pulled a wide sheet whose clamps keep its width.
        PlanarTension = "planar_tension",
        /// It moved one face of a piece along itself, parallel to the opposite face.
        SimpleShear = "simple_shear",
        /// Something else.
        Other = "other",
    }
}

impl StimulusKind {
    /// Whether a whole piece was deformed evenly, and not indented.
    pub fn is_of_piece(self) -> bool {
        matches!(self, Self::Uniaxial) || self.is_clamped()
    }

    /// Whether such a piece is clamped from the first sample, so that its displacement counts from there, with either
    /// sign.
    pub fn is_clamped(self) -> bool {
        matches!(
            self,
            Self::UniaxialTension | Self::PlanarTension | Self::SimpleShear
        )
    }
}

words! {
    /// Whether tissue moves along the indenter.
    pub enum IndenterFriction {
        /// Tissue that it touches moves with it.
        Bonded = "bonded",
        /// Tissue slides along it without friction.
        Frictionless = "frictionless",
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
        /// A layer of `thickness_m` that is bonded on a softer or stiffer base.
        Layer = "layer",
    }
}

header_keys! {
    /// The comments above a recording; none where they state nothing. The fields have the names of the keys.
    pub struct RecordingHeader {
        /// The organ.
        organ: String = ValueType::Text,
        /// The animal, person or body.
        subject: String = ValueType::Label,
        /// The subject's weight [kg].
        weight_kg: f64 = ValueType::Number(Domain::WEIGHT),
        /// The place on the organ.
        site: String = ValueType::Label,
        /// Which repetition it is.
        repeat: u64 = ValueType::Integer(0, u64::MAX),
        /// The state of the tissue.
        condition: Condition = ValueType::Word(Condition::MEANINGS),
        /// Time since death [s].
        post_mortem_s: f64 = ValueType::Number(Domain::POST_MORTEM),
        /// Whether breath was held.
        breath_held: bool = ValueType::Boolean,
        /// What the indenter did.
        stimulus: StimulusKind = ValueType::Word(StimulusKind::MEANINGS),
        /// Duration of the ramp [s].
        ramp_s: f64 = ValueType::Number(Domain::DURATION_OR_NONE),
        /// Depth of the hold, or amplitude of the swing [m].
        amplitude_m: f64 = ValueType::Number(Domain::DEPTH_OR_NONE),
        /// Depth around which the indenter swings [m].
        pre_indentation_m: f64 = ValueType::Number(Domain::DEPTH_OR_NONE),
        /// Frequency of a sine, or that with which a chirp begins [Hz].
        frequency_hz: f64 = ValueType::Number(Domain::FREQUENCY),
        /// Frequency with which a chirp ends [Hz].
        end_frequency_hz: f64 = ValueType::Number(Domain::FREQUENCY),
        /// Samples per second [Hz].
        sample_rate_hz: f64 = ValueType::Number(Domain::FREQUENCY),
        /// The shape of the indenter.
        indenter_shape: IndenterShape = ValueType::Word(IndenterShape::MEANINGS),
        /// The radius, not the diameter, of the indenter [m].
        indenter_radius_m: f64 = ValueType::Number(Domain::TIP_RADIUS),
        /// The angle between a cone's axis and its side [degrees].
        indenter_half_angle_deg: f64 = ValueType::Number(Domain::HALF_ANGLE),
        /// Whether tissue moves along the indenter; not stated, it sticks to a flat one and slides along a sphere or a cone.
        indenter_friction: IndenterFriction = ValueType::Word(IndenterFriction::MEANINGS),
        /// What measured the force.
        force_sensor: String = ValueType::Text,
        /// The spring constant of the cantilever that measured the force, where an instrument's file does not state it [N/m].
        spring_constant_n_per_m: f64 = ValueType::Number(Domain::STIFFNESS),
        /// How far the cantilever bends for each volt of its optical lever, where an instrument's file does not state it [m/V].
        sensitivity_m_per_v: f64 = ValueType::Number(Domain::SENSITIVITY),
        /// Where on the specimen's surface it was pressed, in the axes of the instrument's stage [m].
        position_m: [f64; 3] = ValueType::Vector(Domain::COORDINATE),
        /// The direction out of the tissue along which the indenter was moved, in the rig's axes [-].
        approach_normal: [f64; 3] = ValueType::Direction,
        /// The direction from the indenter's tip to the device, in the rig's axes [-].
        indenter_axis: [f64; 3] = ValueType::Direction,
        /// From the sensor's origin, about which torques are, to the tip [m].
        tip_distance_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Thickness of the specimen under the indenter [m].
        thickness_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Radius of a round specimen, indented in its middle [m].
        specimen_radius_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Width of a square specimen, indented in its middle [m].
        specimen_width_m: f64 = ValueType::Number(Domain::LENGTH),
        /// What the specimen rests on.
        support: Support = ValueType::Word(Support::MEANINGS),
        /// Density of the specimen [kg/m³].
        density_kg_per_m3: f64 = ValueType::Number(Domain::DENSITY),
        /// Cross-section of a piece that is pressed or pulled along one axis; of a sheet, its width times its thickness; in
        /// simple shear, the face that moves [m²].
        area_m2: f64 = ValueType::Number(Domain::AREA),
        /// Height of a piece that is pressed or pulled along one axis; of a strip or a sheet, between its clamps; in simple
        /// shear, between its faces [m].
        height_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Angle from the direction in which a piece is pulled, pressed or sheared to the reference axis of its fibres, in the
        /// plane of the fibres; in simple shear positive towards the face that moves [degrees].
        fibre_axis_angle_deg: f64 = ValueType::Number(Domain::AXIS_ANGLE),
        /// Angle of the two families of fibres to that axis, where it is known; fitted if not stated [degrees].
        fibre_angle_deg: f64 = ValueType::Number(Domain::FIBRE_ANGLE),
        /// Dispersion of the fibres of a family around its direction, where it is known; fitted if not stated [-].
        dispersion: f64 = ValueType::Number(Domain::DISPERSION),
        /// The shape of the specimen.
        specimen: Specimen = ValueType::Word(Specimen::MEANINGS),
        /// Young's modulus of the base under a layer, at the speed of the press [Pa].
        base_modulus_pa: f64 = ValueType::Number(Domain::MODULUS),
        /// The modulus of the base over that of the layer, where only that is known [-].
        base_modulus_ratio: f64 = ValueType::Number(Domain::BASE_RATIO),
        /// Standard error of the base's modulus or ratio, over that [-]; exact if not stated.
        base_modulus_error: f64 = ValueType::Number(Domain::FRACTION),
        /// Thickness of the base, which is on a rigid plate [m]; large if not stated.
        base_thickness_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Inner radius of a tube [m].
        inner_radius_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Outer radius of a tube [m].
        outer_radius_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Length of a tube [m].
        length_m: f64 = ValueType::Number(Domain::LENGTH),
        /// Pressure inside a tube [Pa].
        pressure_pa: f64 = ValueType::Number(Domain::PRESSURE_OR_SUCTION),
        /// The surface of a whole organ, a mesh file, from the recording's own folder.
        mesh: String = ValueType::Path,
        /// The unit of its coordinates.
        mesh_unit: LengthUnit = ValueType::Word(LengthUnit::MEANINGS),
        /// Where the indenter touches it, in its coordinates [m].
        location_m: [f64; 3] = ValueType::Vector(Domain::COORDINATE),
        /// Where it is fixed: its triangles whose centroid lies in these regions.
        fixed: Region = ValueType::Table(Region::KEYS),
        /// Where the recording comes from.
        source: String = ValueType::Text,
        /// How it ended: `whole`, `unfinished` while it is made, or why it was cut short.
        ended: String = ValueType::Text,
    }
}

/// The expected value of the key `fixed`.
const FIXED: &str = "where the organ is fixed, such as `{ planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }`";

impl RecordingHeader {
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let header = Self::read(keys)?;
        header.check_wall(keys)?;
        header.check_specimen(keys)?;
        header.check_organ(keys)?;
        Ok(header)
    }

    fn check_wall(&self, keys: &Keys<'_>) -> Result<(), Error> {
        match (self.inner_radius_m, self.outer_radius_m) {
            (Some(inner), Some(outer)) if outer <= inner => Err(keys.invalid(
                "outer_radius_m",
                format!("a radius above inner_radius_m, {inner:?} m"),
            )),
            _ => Ok(()),
        }
    }

    fn check_specimen(&self, keys: &Keys<'_>) -> Result<(), Error> {
        if self.specimen_radius_m.is_some() && self.specimen_width_m.is_some() {
            return Err(keys.given_twice("specimen_radius_m", "specimen_width_m"));
        }
        match self.contradiction() {
            Some((key, expected)) => Err(keys.invalid(key, expected)),
            None => Ok(()),
        }
    }

    /// A key that contradicts another one on the specimen, and what to give; none where none does.
    fn contradiction(&self) -> Option<(&'static str, &'static str)> {
        if self.base_modulus_pa.is_some() && self.base_modulus_ratio.is_some() {
            return Some((
                "base_modulus_ratio",
                "no ratio, for `base_modulus_pa` says how stiff the base is",
            ));
        }
        if self.specimen == Some(Specimen::Layer) {
            return (self.support == Some(Support::Lubricated)).then_some((
                "support",
                "`bonded`, or no support, for a layer is glued to its base",
            ));
        }
        let is_other = self.specimen.is_some() || self.mesh.is_some();
        let key = self.base_key().filter(|_| is_other)?;
        Some((key, "`specimen = \"layer\"`, for only a layer has a base"))
    }

    /// The first key on a base that is given.
    fn base_key(&self) -> Option<&'static str> {
        let each = [
            ("base_modulus_pa", self.base_modulus_pa),
            ("base_modulus_ratio", self.base_modulus_ratio),
            ("base_modulus_error", self.base_modulus_error),
            ("base_thickness_m", self.base_thickness_m),
        ];
        let mut given = each.into_iter().filter(|(_, value)| value.is_some());
        given.next().map(|(key, _)| key)
    }

    /// The error of a complete header that states a layer on a base: a key and what to give; none where nothing is missing
    /// and nothing contradicts.
    pub fn layer_error(&self) -> Option<(&'static str, &'static str)> {
        if let Some(found) = self.contradiction() {
            return Some(found);
        }
        if self.specimen != Some(Specimen::Layer) {
            let key = self.base_key()?;
            return Some((
                key,
                "`specimen = \"layer\"` too, for only a layer has a base",
            ));
        }
        if self.thickness_m.is_none() {
            return Some(("thickness_m", "the thickness of the layer, in metres"));
        }
        let is_known = self.base_modulus_pa.or(self.base_modulus_ratio).is_some();
        let expected = "Young's modulus of the base in pascals, or `base_modulus_ratio`, what it is over the layer's";
        (!is_known).then_some(("base_modulus_pa", expected))
    }

    fn check_organ(&self, keys: &Keys<'_>) -> Result<(), Error> {
        if self.mesh.is_none() {
            for key in ["mesh_unit", "location_m", "fixed"] {
                keys.refuse(key, "`mesh` too, for it says something of a mesh")?;
            }
            return Ok(());
        }
        for key in [
            "thickness_m",
            "specimen_radius_m",
            "specimen_width_m",
            "support",
            "specimen",
        ] {
            keys.refuse(key, "no other shape, for `mesh` is that of the specimen")?;
        }
        if self.location_m.is_none() {
            let expected = "the place of the indenter on the mesh, three coordinates in metres";
            return Err(keys.missing("location_m", expected));
        }
        match &self.fixed {
            Some(region) if !region.is_empty() => Ok(()),
            _ => Err(keys.missing("fixed", FIXED)),
        }
    }

    /// [`ended`](Self::ended) of a recording with all its samples.
    pub const COMPLETE: &str = "whole";

    /// Why it ends before its stimulus; none when it is whole, or does not state it.
    pub fn cut_short(&self) -> Option<&str> {
        self.ended
            .as_deref()
            .filter(|ended| *ended != Self::COMPLETE)
    }

    /// The same, with missing entries taken from `other`.
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
            indenter_shape indenter_radius_m indenter_half_angle_deg indenter_friction
            force_sensor spring_constant_n_per_m sensitivity_m_per_v position_m approach_normal indenter_axis tip_distance_m
            thickness_m specimen_radius_m specimen_width_m support density_kg_per_m3
            area_m2 height_m fibre_axis_angle_deg fibre_angle_deg dispersion
            specimen base_modulus_pa base_modulus_ratio base_modulus_error base_thickness_m
            inner_radius_m outer_radius_m length_m pressure_pa
            mesh mesh_unit location_m fixed
            source ended
        );
        self.extra.extend(other.extra.iter().cloned());
        self
    }
}
