use crate::Spread;

/// What trainees reach in their attempt of one number.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct CurvePoint {
    /// Which attempt, counted from one.
    pub attempt: usize,
    /// Over the trainees who made that many.
    #[serde(flatten)]
    pub spread: Spread,
}

/// From attempt to attempt, over trainees: each of `trainees` has the numbers of one of them in the order of the
/// attempts, none where an attempt has no such number. Points that nobody has are left out. Where fewer and fewer
/// go on, the end of the curve is that of those who did.
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
