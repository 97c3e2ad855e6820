use super::Characterization;
use crate::fit::simplest;
use crate::inverse::CandidateLaw;

impl Characterization {
    /// What the laws that were found come to by the information criterion [-]: the least is the best, and the
    /// simplest is preferred that none beats by more than [`MIN_IMPROVEMENT`](crate::fit::MIN_IMPROVEMENT).
    pub fn criteria(&self) -> Vec<(CandidateLaw, f64)> {
        let pressed = self.laws.iter().filter_map(|(law, found)| {
            let found = found.as_ref().ok()?;
            Some((
                *law,
                &found.found.fit,
                found.misfit,
                found.uncertainty.effective_samples,
            ))
        });
        let pulled = self.uniaxial.iter().filter_map(|(law, found)| {
            let found = found.as_ref().ok()?;
            let samples = found.uncertainty.effective_samples;
            Some((*law, &found.fit, found.misfit, samples))
        });
        let pressed: Vec<_> = pressed.collect();
        let each = if pressed.is_empty() {
            pulled.collect()
        } else {
            pressed
        };
        let nearest = each.iter().min_by(|a, b| a.2.total_cmp(&b.2));
        let samples = nearest.map_or(1.0, |nearest| nearest.3);
        let fits: Vec<_> = each.iter().map(|own| own.1).collect();
        let (_, criteria) = simplest(&fits, samples);
        each.iter().map(|own| own.0).zip(criteria).collect()
    }
}
