//! Measures of motions whose measures are known.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Isometry3, UnitQuaternion};
use palpate_files::scene::{CutLine, Goal, Task};
use palpate_files::session::Event;
use palpate_files::{Events, SessionRow};
use palpate_geometry::Vec3;
use palpate_simulate::performance::{
    Advice, Cue, Outcome, Performance, Score, Standard, Status, compare, score,
};

pub(crate) fn row(time: f64, place: Vec3) -> SessionRow {
    SessionRow {
        time_s: time,
        tool: 0,
        position_m: place.into(),
        orientation: [0.0, 0.0, 0.0, 1.0],
        grip: 0.0,
        cut: false,
        force_n: [0.0; 3],
        torque_nm: [0.0; 3],
        contact: false,
        depth_m: 0.0,
        events: Events::NONE,
        grip_force_n: 0.0,
        stated_diameter_m: None,
    }
}

/// Rows of a course over `duration` [s], at a rate [Hz].
fn course(duration: f64, rate: f64, at: impl Fn(f64) -> SessionRow) -> Vec<SessionRow> {
    let rows = (duration * rate).round() as u32;
    (0..=rows)
        .map(|number| at(f64::from(number) / rate))
        .collect()
}

fn measured(task: &Task, rows: &[SessionRow]) -> Score {
    score(task, &["right".to_owned()], rows)
}

fn free(rows: &[SessionRow]) -> Score {
    measured(&Task::default(), rows)
}

/// From rest to rest over a length of one, as smooth as can be [Flash and Hogan 1985].
fn smooth(t: f64) -> f64 {
    t.powi(3) * (10.0 - 15.0 * t + 6.0 * t * t)
}

/// Judge: the way of least jerk has ∫ j² dt = 720 L²/T⁵, whatever L and T. Tolerance: a polynomial of the fourth
/// power in windows of 0.3 s has not the fifth that this way is of.
#[test]
fn the_smoothest_way_has_the_least_jerk() {
    for (time, length) in [(1.0, 0.1), (2.0, 0.03), (3.0, 0.2)] {
        let rows = course(time, 200.0, |t| {
            row(t, Vec3::x() * (length * smooth(t / time)))
        });
        let hand = &free(&rows).hands[0];
        assert!((hand.path / length - 1.0).abs() < 1e-12);
        let jerk = hand.jerk.unwrap() / 360_f64.sqrt();
        assert!((jerk - 1.0).abs() < 0.06, "{time}: {jerk}");
    }
    // Judge: of a circle at an even pace, j = r ω³.
    let (r, omega, time) = (0.02, 4.0, 3.0);
    let circle = |t: f64| Vec3::new((omega * t).cos(), (omega * t).sin(), 0.0) * r;
    let rows = course(time, 200.0, |t| row(t, circle(t)));
    let expected = (0.5 * time.powi(6) / (r * omega * time).powi(2)).sqrt() * r * omega.powi(3);
    let found = free(&rows).hands[0].jerk.unwrap();
    assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
}

/// Judge: the circle's circumference, a turn's angle, the straight line.
#[test]
fn ways_and_turns_are_as_long_as_they_are() {
    let (r, turns, time) = (0.02, 2.0, 4.0);
    let about = |t: f64| UnitQuaternion::from_axis_angle(&Vec3::x_axis(), FRAC_PI_2 * t / time);
    let rows = course(time, 200.0, |t| {
        let angle = TAU * turns * t / time;
        let turned = about(t);
        SessionRow {
            orientation: [turned.i, turned.j, turned.k, turned.w],
            ..row(t, Vec3::new(r * angle.cos(), r * angle.sin(), 0.0))
        }
    });
    let hand = &free(&rows).hands[0];
    assert!((hand.path / (TAU * r * turns) - 1.0).abs() < 1e-3);
    assert!((hand.angular_path / FRAC_PI_2 - 1.0).abs() < 1e-9);
    assert!((hand.time - time).abs() < 1e-9);
    // It comes back to where it began.
    assert!(hand.economy.unwrap() < 1e-3);
    let along = |t: f64| row(t, Vec3::new(0.0, 0.0, 0.01 * (PI * t).sin()));
    let hand = &free(&course(1.0, 400.0, along)).hands[0];
    assert!((hand.path_along_shaft / 0.02 - 1.0).abs() < 1e-3);
}

/// A way with contacts, forces and turns.
fn busy(rate: f64) -> Vec<SessionRow> {
    course(4.0, rate, |t| {
        let place = Vec3::new(
            0.03 * (1.1 * t).sin(),
            0.02 * (0.7 * t).cos(),
            0.01 * (2.0 * t).sin(),
        );
        let turned = UnitQuaternion::from_euler_angles(0.3 * t.sin(), 0.2 * t, 0.1);
        let force = 1.5 * (t - 1.0).max(0.0) * (3.0 - t).max(0.0);
        SessionRow {
            orientation: [turned.i, turned.j, turned.k, turned.w],
            force_n: [0.0, 0.6 * force, 0.8 * force],
            torque_nm: [0.0; 3],
            contact: force > 0.0,
            ..row(t, place)
        }
    })
}

fn limited() -> Task {
    Task {
        force_limit_n: Some(1.0),
        ..Task::default()
    }
}

/// Another frame and another sampling rate are the same performance. Tolerance: rounding; of the rate that of
/// chords for arcs, and of when a contact is seen to begin.
#[test]
fn frames_and_rates_do_not_count() {
    let expected = measured(&limited(), &busy(200.0)).measures();
    let moved = Isometry3::new(Vec3::new(1.0, -2.0, 0.5), Vec3::new(0.4, 1.0, -0.3));
    let turned: Vec<_> = busy(200.0)
        .into_iter()
        .map(|row| {
            let [x, y, z, w] = row.orientation;
            let own = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
            let orientation = moved.rotation * own;
            SessionRow {
                position_m: (moved * nalgebra::Point3::from(row.position_m)).into(),
                force_n: (moved.rotation * Vec3::from(row.force_n)).into(),
                orientation: [orientation.i, orientation.j, orientation.k, orientation.w],
                ..row
            }
        })
        .collect();
    for (other, tolerance) in [(turned, 1e-9), (busy(100.0), 0.01), (busy(1000.0), 0.01)] {
        let found = measured(&limited(), &other).measures();
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            let off = (found.value - expected.value).abs();
            let far = off > tolerance * expected.value.abs().max(1e-3);
            assert!(!far, "{}: {} {}", found.key, found.value, expected.value);
        }
    }
}

/// Judge: the integrals of a parabola. F = 1.5 (t − 1)(3 − t) has ∫ F = 2, a peak of 1.5, and is above 1 for
/// 2 √(1/3) s, in which ∫ (F − 1) = 2/(3 √3).
#[test]
fn forces_are_their_integrals() {
    let score = measured(&limited(), &busy(1000.0));
    let force = score.forces[0];
    let third = (1.0_f64 / 3.0).sqrt();
    for (found, expected) in [
        (force.peak, 1.5),
        (force.force_time, 2.0),
        (force.contact_time, 2.0),
        (force.mean.unwrap(), 1.0),
        (force.time_above_limit.unwrap(), 2.0 * third),
        (force.damage.unwrap(), 2.0 * third / 3.0),
    ] {
        assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
    }
    assert_eq!(score.errors.force_limit, 1);
    // Nothing is above a limit that is not there.
    assert_eq!(free(&busy(200.0)).forces[0].damage, None);
}

/// Two sessions that differ in one quality differ in its measure, and in no other.
#[test]
fn one_quality_is_one_measure() {
    let differ = |other: &[SessionRow]| -> Vec<String> {
        let (one, other) = (
            measured(&limited(), &busy(200.0)),
            measured(&limited(), other),
        );
        let pairs = one.measures().into_iter().zip(other.measures());
        let far = pairs.filter(|(one, other)| (one.value - other.value).abs() > 1e-9);
        far.map(|(one, _)| one.key).collect()
    };
    let changed = |change: &dyn Fn(usize, &mut SessionRow)| {
        let mut rows = busy(200.0);
        rows.iter_mut()
            .enumerate()
            .for_each(|(number, row)| change(number, row));
        differ(&rows)
    };
    assert!(changed(&|_, _| ()).is_empty());
    let harder = changed(&|_, row| row.force_n = row.force_n.map(|f| 1.01 * f));
    assert!(harder.contains(&"right.peak_force_n".to_owned()));
    assert!(
        !harder
            .iter()
            .any(|key| key.contains("path") || key.contains("jerk")),
        "{harder:?}"
    );
    let trembling = changed(&|number, row| row.position_m[2] += 2e-4 * (number as f64).sin());
    assert!(trembling.contains(&"right.jerk".to_owned()));
    assert!(
        !trembling
            .iter()
            .any(|key| key.contains("force") || key.contains("time")),
        "{trembling:?}"
    );
    let perforated = changed(&|number, row| {
        if number == 400 {
            row.events.insert(Event::Perforation);
        }
    });
    assert_eq!(perforated, ["perforations"]);
    let lost = changed(&|number, row| {
        if number == 400 {
            row.events.insert(Event::GripRelease);
            row.grip = 1.0;
        }
    });
    assert_eq!(lost, ["drops"]);
}

/// A cut of 30 mm along x, `beside` [m] of its line, `depth` [m] below it.
fn cutting(beside: f64, depth: f64, to: f64) -> Vec<SessionRow> {
    course(3.0, 200.0, |t| {
        let mut row = row(t, Vec3::new(to * t / 3.0, beside, -depth));
        row.contact = true;
        row.depth_m = depth;
        row.cut = true;
        row.events.insert(Event::Cut);
        row
    })
}

fn line() -> Task {
    Task {
        goal: Goal::Cut {
            line: CutLine::straight([0.0; 3], [0.03, 0.0, 0.0]),
            tolerance_m: 0.002,
            layers: None,
        },
        ..Task::default()
    }
}

/// Judge: what was put in.
#[test]
fn a_cut_is_as_long_and_as_far_off_as_it_is() {
    let score = measured(&line(), &cutting(0.0015, 0.003, 0.03));
    let cut = score.cut.unwrap();
    let along = cut.along_line.unwrap();
    assert_eq!(cut.count, 1);
    // With 97 % of the line the task is over; rows are 0.05 mm apart.
    let whole = 0.97 * 0.03;
    for (found, expected, tolerance) in [
        (cut.length, whole, 6e-5),
        (along.covered, whole, 6e-5),
        (along.mean_deviation, 0.0015, 1e-9),
        (along.largest_deviation, 0.0015, 1e-9),
    ] {
        assert!((found - expected).abs() < tolerance, "{found} {expected}");
    }
    let clean = |rows: &[SessionRow]| measured(&line(), rows).outcome.passed();
    assert_eq!(score.outcome.passed(), Some(true));
    assert_eq!(clean(&cutting(0.0025, 0.003, 0.03)), Some(false));
    assert_eq!(clean(&cutting(0.0, 0.003, 0.02)), Some(false));
    let mut perforated = cutting(0.0, 0.003, 0.03);
    perforated[300].events.insert(Event::Perforation);
    assert_eq!(clean(&perforated), Some(false));
    // Of a line that is whole nothing more would count.
    let mut undone = cutting(0.0, 0.003, 0.02);
    let mut last = row(3.1, Vec3::zeros());
    last.events.insert(Event::UndoCut);
    undone.push(last);
    let score = measured(&line(), &undone);
    assert_eq!((score.cut, score.errors.undone), (None, 1));
}

#[test]
fn goals_are_reached() {
    let tools = ["left".to_owned(), "right".to_owned()];
    let find = Task {
        goal: Goal::Find {
            target_m: [0.01, 0.0, 0.0],
            tolerance_m: 0.004,
            size: None,
        },
        ..Task::default()
    };
    let mut marked = row(1.0, Vec3::new(0.013, 0.0, -0.005));
    marked.events.insert(Event::Mark);
    let mut performance = Performance::new(&find, &tools);
    performance.add(&marked);
    // In the air nothing is meant.
    assert!(matches!(performance.status(), Status::InProgress { .. }));
    marked.contact = true;
    marked.depth_m = 0.005;
    performance.add(&marked);
    assert_eq!(performance.status(), Status::Ended { late: false });
    let Outcome::Find {
        target_distance,
        found,
        ..
    } = performance.score().outcome
    else {
        panic!("{:?}", performance.score().outcome)
    };
    assert!(found && (target_distance.unwrap() - 0.003).abs() < 1e-12);

    let pull = Task {
        time_limit_s: Some(60.0),
        goal: Goal::Traction {
            tool: Some("left".to_owned()),
            force_n: 0.5,
            tolerance_n: 0.1,
            hold_s: 2.0,
            direction: Some(([-1.0, 0.0, 0.0], 0.5)),
            tear_force_n: Some(0.9),
        },
        ..Task::default()
    };
    let pulled = |force: f64, time: f64| {
        let mut performance = Performance::new(&pull, &tools);
        let rows = course(time, 200.0, |t| SessionRow {
            force_n: [force, 0.0, 0.0],
            torque_nm: [0.0; 3],
            contact: true,
            ..row(t, Vec3::zeros())
        });
        rows.iter().for_each(|row| performance.add(row));
        performance
    };
    assert_eq!(pulled(0.45, 2.5).status(), Status::Ended { late: false });
    let Outcome::Traction { error, held, .. } = pulled(0.45, 2.5).score().outcome else {
        panic!("no traction")
    };
    assert!(held && (error.unwrap() - 0.05).abs() < 1e-9);
    let Status::InProgress { part, advice: now } = pulled(0.45, 1.0).status() else {
        panic!("over")
    };
    let hold = Advice {
        force: 0.45,
        cue: Cue::Hold,
    };
    assert!((part.unwrap() - 0.5).abs() < 1e-9 && now == Some(hold));
    assert_eq!(pulled(0.7, 70.0).status(), Status::Ended { late: true });
    assert_eq!(pulled(0.7, 70.0).score().outcome.passed(), Some(false));
    assert!(matches!(
        pulled(0.7, 3.0).status(),
        Status::InProgress {
            part: Some(0.0),
            ..
        }
    ));
}

/// There is one cue for a pull, and time counts while it is to hold. Judge: the band and the cone by hand, 0.5 ± 0.1 N
/// within 30° of x; a pull above 0.9 N tears.
#[test]
fn a_pull_has_one_cue_and_direction_counts() {
    let tools = vec!["left".to_owned()];
    let task = Task {
        goal: Goal::Traction {
            tool: Some("left".to_owned()),
            force_n: 0.5,
            tolerance_n: 0.1,
            hold_s: 1.0,
            direction: Some(([2.0, 0.0, 0.0], 30_f64.to_radians())),
            tear_force_n: Some(0.9),
        },
        ..Task::default()
    };
    let pulled = |force: f64, turned: f64| {
        let turned = turned.to_radians();
        let mut performance = Performance::new(&task, &tools);
        let rows = course(0.5, 200.0, |t| SessionRow {
            // On the tool, against the pull.
            force_n: [-force * turned.cos(), force * turned.sin(), 0.0],
            torque_nm: [0.0; 3],
            contact: true,
            ..row(t, Vec3::zeros())
        });
        rows.iter().for_each(|row| performance.add(row));
        performance
    };
    for (force, turned, expected) in [
        (0.45, 0.0, Cue::Hold),
        (0.45, 29.0, Cue::Hold),
        (0.45, 31.0, Cue::Turn),
        (0.7, 180.0, Cue::Turn),
        (0.39, 0.0, Cue::More),
        (0.61, 0.0, Cue::Less),
        // Without a pull there is no direction to change.
        (0.01, 180.0, Cue::More),
    ] {
        let Status::InProgress { part, advice: pull } = pulled(force, turned).status() else {
            panic!("over at {force} N")
        };
        let cue = pull.unwrap().cue;
        assert_eq!(cue, expected, "{force} N, {turned}°");
        assert_eq!(
            part.unwrap() > 0.4,
            cue == Cue::Hold,
            "{force} N, {turned}°"
        );
    }
    let torn = pulled(0.95, 0.0);
    assert_eq!(torn.status(), Status::Ended { late: false });
    assert_eq!(torn.score().outcome.passed(), Some(false));
}

/// What is left of a line to cut is what no stroke has opened. Judge: the ends by hand; strokes that leave a
/// millimetre are one cut.
#[test]
fn the_uncut_stretches_are_told() {
    let tools = vec!["left".to_owned()];
    let task = Task {
        goal: Goal::Cut {
            line: CutLine::straight([0.0; 3], [0.030, 0.0, 0.0]),
            tolerance_m: 0.003,
            layers: None,
        },
        ..Task::default()
    };
    let after = |cut_paths: &[[f64; 2]]| {
        let mut performance = Performance::new(&task, &tools);
        for (number, [from, to]) in cut_paths.iter().enumerate() {
            for part in 0..=20 {
                let place = from + (to - from) * f64::from(part) / 20.0;
                performance.add(&SessionRow {
                    contact: true,
                    events: Event::Cut.into(),
                    ..row(number as f64, Vec3::x() * place)
                });
            }
            // Lifted between strokes.
            performance.add(&row(number as f64, Vec3::x() * *to));
        }
        let gaps = performance.uncut();
        let micrometres = |end: Vec3| (1e6 * end.x).round() as i64;
        let ends = gaps.iter().map(|gap| gap.map(micrometres));
        ends.collect::<Vec<_>>()
    };
    assert_eq!(after(&[]), [[0, 30_000]]);
    let apart = after(&[[-0.002, 0.004], [0.008, 0.012]]);
    assert_eq!(apart, [[4_000, 8_000], [12_000, 30_000]]);
    assert!(after(&[[0.011, 0.035], [-0.001, 0.010]]).is_empty());
}

/// Judge: mean and deviation by hand.
#[test]
fn experts_are_a_standard() {
    let lasting = |time: f64| free(&course(time, 200.0, |t| row(t, Vec3::x() * (0.01 * t))));
    let experts = [lasting(9.0), lasting(10.0), lasting(11.0)];
    let standards = Standard::of(&experts);
    assert_eq!(standards[0].key, "time_s");
    assert!((standards[0].mean - 10.0).abs() < 1e-9);
    assert!((standards[0].standard_deviation.unwrap() - 1.0).abs() < 1e-9);
    let of_time = |time: f64| compare(&lasting(time), &standards).swap_remove(0);
    assert_eq!(of_time(10.9).proficient, Some(true));
    assert_eq!(of_time(11.2).proficient, Some(false));
    // Faster than an expert is no fault.
    assert_eq!(of_time(5.0).proficient, Some(true));
    assert!((of_time(15.0).ratio.unwrap() - 1.5).abs() < 1e-9);
    let single = Standard::of(&experts[..1]);
    assert_eq!(compare(&lasting(9.0), &single)[0].proficient, None);
}
