use super::{Condition, IndenterShape, RecordingHeader, Specimen, StimulusKind, Support};
use crate::toml_document::{quoted, toml_number};
use crate::{Domain, Error, Keys};

impl RecordingHeader {
    /// The keys that mean something in a recording.
    pub const KEYS: &'static [&'static str] = &[
        "organ",
        "subject",
        "weight_kg",
        "site",
        "repeat",
        "condition",
        "post_mortem_s",
        "breath_held",
        "stimulus",
        "ramp_s",
        "amplitude_m",
        "pre_indentation_m",
        "frequency_hz",
        "end_frequency_hz",
        "sample_rate_hz",
        "indenter_shape",
        "indenter_radius_m",
        "indenter_half_angle_deg",
        "force_sensor",
        "approach_normal",
        "indenter_axis",
        "tip_distance_m",
        "thickness_m",
        "specimen_radius_m",
        "specimen_width_m",
        "support",
        "density_kg_per_m3",
        "area_m2",
        "height_m",
        "specimen",
        "inner_radius_m",
        "outer_radius_m",
        "length_m",
        "pressure_pa",
        "source",
        "ended",
    ];

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let number = |key, domain| keys.number(key, domain);
        let header = Self {
            organ: keys.text("organ")?,
            subject: keys.text_or_integer("subject")?,
            weight_kg: number("weight_kg", Domain::WEIGHT)?,
            site: keys.text_or_integer("site")?,
            repeat: keys.integer("repeat", 0..=u64::MAX)?,
            condition: keys.word("condition", Condition::WORDS)?,
            post_mortem_s: number("post_mortem_s", Domain::POST_MORTEM)?,
            breath_held: keys.truth("breath_held")?,
            stimulus: keys.word("stimulus", StimulusKind::WORDS)?,
            ramp_s: number("ramp_s", Domain::DURATION_OR_NONE)?,
            amplitude_m: number("amplitude_m", Domain::DEPTH_OR_NONE)?,
            pre_indentation_m: number("pre_indentation_m", Domain::DEPTH_OR_NONE)?,
            frequency_hz: number("frequency_hz", Domain::FREQUENCY)?,
            end_frequency_hz: number("end_frequency_hz", Domain::FREQUENCY)?,
            sample_rate_hz: number("sample_rate_hz", Domain::FREQUENCY)?,
            indenter_shape: keys.word("indenter_shape", IndenterShape::WORDS)?,
            indenter_radius_m: number("indenter_radius_m", Domain::TIP_RADIUS)?,
            indenter_half_angle_deg: number("indenter_half_angle_deg", Domain::HALF_ANGLE)?,
            force_sensor: keys.text("force_sensor")?,
            approach_normal: keys.direction("approach_normal")?,
            indenter_axis: keys.direction("indenter_axis")?,
            tip_distance_m: number("tip_distance_m", Domain::LENGTH)?,
            thickness_m: number("thickness_m", Domain::LENGTH)?,
            specimen_radius_m: number("specimen_radius_m", Domain::LENGTH)?,
            specimen_width_m: number("specimen_width_m", Domain::LENGTH)?,
            support: keys.word("support", Support::WORDS)?,
            density_kg_per_m3: number("density_kg_per_m3", Domain::DENSITY)?,
            area_m2: number("area_m2", Domain::AREA)?,
            height_m: number("height_m", Domain::LENGTH)?,
            specimen: keys.word("specimen", Specimen::WORDS)?,
            inner_radius_m: number("inner_radius_m", Domain::LENGTH)?,
            outer_radius_m: number("outer_radius_m", Domain::LENGTH)?,
            length_m: number("length_m", Domain::LENGTH)?,
            pressure_pa: number("pressure_pa", Domain::PRESSURE_OR_SUCTION)?,
            source: keys.text("source")?,
            ended: keys.text("ended")?,
            extra: Vec::new(),
        };
        header.check_wall(keys)?;
        header.check_specimen(keys)?;
        Ok(header)
    }

    fn check_wall(&self, keys: &Keys<'_>) -> Result<(), Error> {
        match (self.inner_radius_m, self.outer_radius_m) {
            (Some(inner), Some(outer)) if outer <= inner => Err(keys.bad(
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
        Ok(())
    }

    /// What it says, by key, each value as TOML writes it.
    pub fn entries(&self) -> Vec<(&'static str, String)> {
        let text = |text: &Option<String>| text.as_deref().map(quoted);
        let number = |number: Option<f64>| number.map(toml_number);
        let direction = |direction: Option<[f64; 3]>| {
            direction.map(|along| format!("[{}]", along.map(toml_number).join(", ")))
        };
        let values = [
            text(&self.organ),
            text(&self.subject),
            number(self.weight_kg),
            text(&self.site),
            self.repeat.map(|repeat| repeat.to_string()),
            self.condition.map(|word| quoted(word.word())),
            number(self.post_mortem_s),
            self.breath_held.map(|held| held.to_string()),
            self.stimulus.map(|word| quoted(word.word())),
            number(self.ramp_s),
            number(self.amplitude_m),
            number(self.pre_indentation_m),
            number(self.frequency_hz),
            number(self.end_frequency_hz),
            number(self.sample_rate_hz),
            self.indenter_shape.map(|word| quoted(word.word())),
            number(self.indenter_radius_m),
            number(self.indenter_half_angle_deg),
            text(&self.force_sensor),
            direction(self.approach_normal),
            direction(self.indenter_axis),
            number(self.tip_distance_m),
            number(self.thickness_m),
            number(self.specimen_radius_m),
            number(self.specimen_width_m),
            self.support.map(|word| quoted(word.word())),
            number(self.density_kg_per_m3),
            number(self.area_m2),
            number(self.height_m),
            self.specimen.map(|word| quoted(word.word())),
            number(self.inner_radius_m),
            number(self.outer_radius_m),
            number(self.length_m),
            number(self.pressure_pa),
            text(&self.source),
            text(&self.ended),
        ];
        let keys = Self::KEYS.iter().copied();
        keys.zip(values)
            .filter_map(|(key, value)| Some((key, value?)))
            .collect()
    }
}
