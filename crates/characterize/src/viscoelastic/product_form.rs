use palpate_mechanics::PronySeries;

/// Relaxation as the transfer function (6.10) of a chain of three-parameter solids,
/// F(s)/δ(s) = F_∞ Π (1 + αᵢ τᵢ s)/(1 + τᵢ s): the same function as a Prony series, in other numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ProductForm {
    /// Pairs of αᵢ [-] and τᵢ [s], ascending in τ.
    pub terms: Vec<(f64, f64)>,
}

impl ProductForm {
    /// That of `series`; terms of the same time are one, and terms of no weight none.
    ///
    /// Relative to the instantaneous response a series is 1 − Σ gᵢ/(1 + τᵢ s). In x = −1/s it is zero where
    /// 1 = Σ gᵢ x/(x − τᵢ), which happens once between each two times and once beyond the last, at
    /// x = αᵢ τᵢ.
    pub fn of(series: &PronySeries) -> Self {
        let poles = distinct(series);
        let missing = |x: f64| 1.0 - poles.iter().map(|(g, tau)| g * x / (x - tau)).sum::<f64>();
        let left: f64 = 1.0 - poles.iter().map(|(g, _)| g).sum::<f64>();
        let zero = |place: usize| {
            let tau = poles[place].1;
            // Beyond the last time the sum is at most Σ g x/(x − τ), which gives a bound.
            let far = poles
                .get(place + 1)
                .map_or(tau / left * (1.0 + 1e-9), |next| next.1);
            bisect(tau, far, missing)
        };
        let terms = (0..poles.len()).map(|place| (zero(place) / poles[place].1, poles[place].1));
        Self {
            terms: terms.collect(),
        }
    }
}

/// Terms that have a weight, ascending in τ, those of one time added.
fn distinct(series: &PronySeries) -> Vec<(f64, f64)> {
    let mut terms: Vec<_> = series
        .terms()
        .iter()
        .copied()
        .filter(|(g, _)| *g > 0.0)
        .collect();
    terms.sort_by(|a, b| a.1.total_cmp(&b.1));
    terms.dedup_by(|later, first| {
        let same = later.1 == first.1;
        if same {
            first.0 += later.0;
        }
        same
    });
    terms
}

/// The zero of `value`, which rises from −∞ at `low` to a positive number at `high`.
fn bisect(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if value(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}
