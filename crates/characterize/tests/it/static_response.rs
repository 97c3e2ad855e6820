//! The static response over subjects.

use palpate_characterize::analyze::{StaticPoint, static_response};
use palpate_files::recording::Condition;

fn point(organ: &str, subject: &str, depth: f64, force: f64) -> StaticPoint {
    StaticPoint {
        organ: Some(organ.to_owned()),
        condition: Some(Condition::InVivo),
        post_mortem_s: None,
        subject: Some(subject.to_owned()),
        depth_m: depth,
        steady_n: force,
    }
}

/// Forces of the fewest animals that have this least, mean and largest; none when nothing can.
fn animals([least, mean, largest]: [f64; 3]) -> Option<Vec<f64>> {
    if !(least..=largest).contains(&mean) {
        return None;
    }
    // A printed mean may be that of its least by rounding alone.
    let mean = mean.clamp(0.99 * least + 0.01 * largest, 0.01 * least + 0.99 * largest);
    (3..).find_map(|count| {
        let each = (f64::from(count) * mean - least - largest) / f64::from(count - 2);
        let fits = (least..=largest).contains(&each);
        fits.then(|| [vec![least, largest], vec![each; (count - 2) as usize]].concat())
    })
}

/// Judge: table 5-1. Animals are made up whose forces have its least, mean and largest; there are none
/// for three of the rows that the table marks as suspect. Tolerance:
/// half of the last digit printed.
#[test]
fn table_5_1() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../published/table_5_1_static_force.csv"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let mut impossible = 0;
    let mut points = Vec::new();
    let mut expected = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let fields: Vec<_> = line.split(',').collect();
        let [millimetres, least, mean, largest, suspect] =
            [1, 2, 3, 4, 5].map(|field| fields[field].parse::<f64>().unwrap());
        let animals = animals([least, mean, largest]);
        assert!(animals.is_some() || suspect == 1.0, "{line}");
        impossible += usize::from(animals.is_none());
        for (animal, force) in animals.iter().flatten().enumerate() {
            points.push(point(
                fields[0],
                &format!("pig {animal}"),
                1e-3 * millimetres,
                *force,
            ));
        }
        if let Some(animals) = animals {
            expected.push((
                fields[0].to_owned(),
                1e-3 * millimetres,
                [least, mean, largest],
                animals.len(),
            ));
        }
    }
    assert_eq!(impossible, 3);
    points.reverse();
    let groups = static_response(&points);
    let organs: Vec<_> = groups
        .iter()
        .map(|group| group.organ.as_deref().unwrap())
        .collect();
    assert_eq!(organs, ["esophagus", "kidney", "liver", "spleen"]);
    for (organ, depth, [least, mean, largest], animals) in expected {
        let group = groups
            .iter()
            .find(|group| group.organ.as_deref() == Some(&organ))
            .unwrap();
        let row = group
            .rows
            .iter()
            .find(|row| (row.depth_m - depth).abs() < 1e-9)
            .unwrap();
        assert_eq!((row.n, row.subjects), (animals, animals));
        assert_eq!((row.min_n, row.max_n), (least, largest));
        assert!((row.mean_n - mean).abs() < 5e-5 && row.within_n.is_none());
    }
}

/// Judge: two animals touched three times each, by hand: about their means 2 and 6 the squares are 2 and
/// 8, over four; the means lie √8 apart from theirs.
#[test]
fn within_one_animal_and_between_animals() {
    let forces = [
        ("a", 1.0),
        ("a", 2.0),
        ("a", 3.0),
        ("b", 4.0),
        ("b", 6.0),
        ("b", 8.0),
    ];
    let points: Vec<_> = forces
        .iter()
        .map(|(subject, force)| point("liver", subject, 0.004, *force))
        .collect();
    let groups = static_response(&points);
    let [row] = groups[0].rows.as_slice() else {
        panic!("{groups:?}");
    };
    assert_eq!((row.n, row.subjects, row.mean_n), (6, 2, 4.0));
    assert!((row.within_n.unwrap() - (10.0 / 4.0f64).sqrt()).abs() < 1e-15);
    assert!((row.between_n.unwrap() - 8f64.sqrt()).abs() < 1e-15);
}

/// Judge: figure 5-1 keeps hours after death apart; depths that nearly agree are one.
#[test]
fn states_and_depths_are_kept_apart() {
    let hours = [None, Some(6.2), Some(6.8), Some(12.0)];
    let mut points = Vec::new();
    for hour in hours {
        for depth in [0.00399, 0.00402, 0.005] {
            points.push(StaticPoint {
                post_mortem_s: hour.map(|hour: f64| 3600.0 * hour),
                subject: None,
                ..point("liver", "", depth, 1.0)
            });
        }
    }
    let groups = static_response(&points);
    let seen: Vec<_> = groups.iter().map(|group| group.post_mortem_h).collect();
    assert_eq!(seen, [None, Some(6), Some(12)]);
    let counts = groups
        .iter()
        .map(|group| group.rows.iter().map(|row| row.n).collect::<Vec<_>>());
    assert_eq!(counts.collect::<Vec<_>>(), [[2, 1], [4, 2], [2, 1]]);
    assert!(groups[1].rows[0].within_n.is_none());
    assert_eq!(groups[1].rows[0].subjects, 4);
    assert!(static_response(&[]).is_empty());
}
