use palpate_files::recording::{RecordingHeader, StimulusKind};

/// Which recordings are of one specimen: the same organ, subject, site and state under the same indenter, in
/// the order of their first recordings. A recording that names neither organ, subject nor site is one for
/// itself.
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
            h.stimulus == Some(StimulusKind::PlanarTension),
            h.condition,
            h.post_mortem_s,
            [h.area_m2, h.height_m],
        )
    };
    is_named && of(a) == of(b)
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
}
