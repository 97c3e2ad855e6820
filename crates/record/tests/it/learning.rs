//! The learning curve. Judge: means and deviations by hand.

use palpate_record::learning_curve;

#[test]
fn the_curve_is_the_mean_over_those_who_made_the_attempt() {
    let anna = vec![Some(10.0), Some(8.0), Some(6.0)];
    let bela = vec![Some(14.0), None];
    let cleo = vec![Some(12.0), Some(5.0)];
    let curve = learning_curve(&[anna, bela, cleo, Vec::new()]);
    let points: Vec<_> = curve
        .iter()
        .map(|point| (point.attempt, point.spread.mean, point.spread.count))
        .collect();
    // 36 / 3, 13 / 2, 6.
    assert_eq!(points, [(1, 12.0, 3), (2, 6.5, 2), (3, 6.0, 1)]);
    let deviations: Vec<_> = curve
        .iter()
        .map(|point| point.spread.standard_deviation)
        .collect();
    // √((4 + 4 + 0) / 2), √(2 · 1.5²), none.
    assert_eq!(deviations[0], Some(2.0));
    assert!((deviations[1].unwrap() - 4.5_f64.sqrt()).abs() < 1e-15);
    assert_eq!(deviations[2], None);
    assert!(learning_curve(&[]).is_empty());
    let late = learning_curve(&[vec![None, Some(1.0)]]);
    assert_eq!(
        late.iter().map(|point| point.attempt).collect::<Vec<_>>(),
        [2]
    );
}
