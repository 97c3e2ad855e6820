use crate::Spread;

/// A point of the learning curve: one number over all trainees at the same attempt.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct CurvePoint {
    /// The attempt, counted from one.
    pub attempt: usize,
    /// Over the trainees with that many attempts.
    #[serde(flatten)]
    pub spread: Spread,
}

/// The learning curve: each of `trainees` has one trainee's numbers in the order of the attempts, none where an attempt
/// lacks the number. Points without a value are left out. Where the number of trainees decreases, the end of the curve
/// shows only those who continued.
pub fn learning_curve(trainees: &[Vec<Option<f64>>]) -> Vec<CurvePoint> {
    let longest = trainees.iter().map(Vec::len).max().unwrap_or(0);
    let point = |place: usize| {
        let values = trainees.iter().filter_map(|own| *own.get(place)?);
        let spread = Spread::of(&values.collect::<Vec<_>>())?;
        Some(CurvePoint {
            attempt: place + 1,
            spread,
        })
    };
    (0..longest).filter_map(point).collect()
}
