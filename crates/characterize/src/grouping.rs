use palpate_files::recording::{RecordingHeader, StimulusKind};

/// Which recordings are of one specimen: the same organ, subject, site and state under the same indenter, in
/// the order of their first recordings. A recording that names neither organ, subject nor site is one for
/// itself. Pieces that state the angle of their fibres are of one tissue also where they differ in size, angle and test.
pub fn specimens(headers: &[&RecordingHeader]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (place, header) in headers.iter().enumerate() {
        let same = |group: &&mut Vec<usize>| is_same(headers[group[0]], header);
        match groups.iter_mut().find(same) {
            Some(group) => group.push(place),
            None => groups.push(vec![place]),
        }
    }
    groups
}

fn is_same(a: &RecordingHeader, b: &RecordingHeader) -> bool {
    let is_named = a.organ.is_some() || a.subject.is_some() || a.site.is_some();
    let of = |h: &RecordingHeader| {
        let specimen = (
            h.organ.clone(),
            h.subject.clone(),
            h.site.clone(),
            h.specimen,
        );
        let piece = [
            h.thickness_m,
            h.specimen_radius_m,
            h.specimen_width_m,
            h.density_kg_per_m3,
        ];
        let base = [
            h.base_modulus_pa,
            h.base_modulus_ratio,
            h.base_modulus_error,
            h.base_thickness_m,
        ];
        let shape = [
            h.inner_radius_m,
            h.outer_radius_m,
            h.length_m,
            h.pressure_pa,
        ];
        let indenter = (
            h.indenter_shape,
            h.indenter_radius_m,
            h.indenter_half_angle_deg,
            h.indenter_friction,
        );
        (
            specimen,
            (shape, piece, base, h.support),
            (h.mesh.clone(), h.location_m, h.fixed.clone()),
            indenter,
            of_piece(h),
            [h.fibre_angle_deg, h.dispersion],
            h.condition,
            h.post_mortem_s,
        )
    };
    is_named && of(a) == of(b)
}

/// What pieces of one specimen have alike: all of their test, or that they state how their fibres lie.
fn of_piece(h: &RecordingHeader) -> Option<(Option<StimulusKind>, [Option<f64>; 2])> {
    let is_piece = h.stimulus.is_some_and(StimulusKind::is_of_piece);
    if is_piece && h.fibre_axis_angle_deg.is_some() {
        return None;
    }
    let test = h.stimulus.filter(|own| own.is_clamped());
    Some((test, [h.area_m2, h.height_m]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_are_grouped_by_what_they_say() {
        let named = |organ: &str, subject: &str| RecordingHeader {
            organ: Some(organ.into()),
            subject: Some(subject.into()),
            ..RecordingHeader::default()
        };
        let deeper = RecordingHeader {
            amplitude_m: Some(8e-3),
            ..named("liver", "1")
        };
        let nameless = RecordingHeader::default();
        let all = [
            &named("liver", "1"),
            &nameless,
            &named("liver", "2"),
            &deeper,
            &nameless,
        ];
        assert_eq!(specimens(&all), [vec![0, 3], vec![1], vec![2], vec![4]]);
    }

    #[test]
    fn strips_of_one_tissue_are_one_specimen() {
        let strip = |angle: Option<f64>, height: f64| RecordingHeader {
            organ: Some("esophagus".into()),
            stimulus: Some(StimulusKind::UniaxialTension),
            fibre_axis_angle_deg: angle,
            height_m: Some(height),
            ..RecordingHeader::default()
        };
        let sheared = RecordingHeader {
            stimulus: Some(StimulusKind::SimpleShear),
            ..strip(Some(0.0), 0.004)
        };
        let aligned = RecordingHeader {
            fibre_angle_deg: Some(0.0),
            ..strip(Some(0.0), 0.02)
        };
        let all = [
            &strip(Some(0.0), 0.02),
            &strip(Some(90.0), 0.03),
            &sheared,
            &aligned,
            &strip(None, 0.02),
            &strip(None, 0.03),
        ];
        assert_eq!(specimens(&all), [vec![0, 1, 2], vec![3], vec![4], vec![5]]);
    }
}
