//! A rig that is operated, on a virtual clock. Judges: the order in which orders were given, limits, and the
//! time from a stop to no force.

use palpate_measure::live::{CommandedRig, Console, RigCommand, RigEvent};
use palpate_measure::{Ended, Error, Phase, RigSample, RigSettings};
use palpate_servo::{Fault, Vec3, log};

use crate::rig::{rig, soft, usual};

/// A rig over soft tissue, and its console.
struct Bench {
    operated: CommandedRig,
    console: Console,
    told: log::Reader<RigEvent>,
}

impl Bench {
    fn new(settings: RigSettings) -> Self {
        let (operated, console, told) = CommandedRig::new(rig(soft(), settings, 1));
        let mut bench = Self {
            operated,
            console,
            told,
        };
        bench.idle(600);
        bench
    }

    /// Waits for some ticks.
    fn idle(&mut self, ticks: usize) -> Vec<RigSample> {
        let mut seen = Vec::new();
        for _ in 0..ticks {
            assert!(self.operated.process_next(&mut |sample| seen.push(*sample)));
        }
        self.told.drain().for_each(drop);
        seen
    }

    /// Sends `press` and a rest, and does `act` in the hold: the events but for samples, and the samples of the press.
    fn press_and_act(
        &mut self,
        press: RigCommand,
        act: &dyn Fn(&Console),
    ) -> (Vec<RigEvent>, Vec<RigSample>) {
        self.console.send(press);
        self.console.send(RigCommand::Rest);
        let (console, mut samples) = (&self.console, Vec::new());
        self.operated.process_next(&mut |sample| {
            if sample.phase == Phase::Pressing && sample.depth.unwrap() > 3.9e-3 {
                act(console);
            }
            samples.push(*sample);
        });
        self.operated.process_next(&mut |_| ());
        let events = self.told.drain();
        let events = events.filter(|event| !matches!(event, RigEvent::Sample(_)));
        (events.collect(), samples)
    }

    /// Carries out `orders`, and tells what was said but for samples.
    fn carry_out(&mut self, commands: &[RigCommand]) -> Vec<RigEvent> {
        commands
            .iter()
            .for_each(|command| self.console.send(*command));
        let mut said = Vec::new();
        for _ in 0..=commands.len() {
            self.operated.process_next(&mut |_| ());
            said.extend(
                self.told
                    .drain()
                    .filter(|t| !matches!(t, RigEvent::Sample(_))),
            );
        }
        said
    }
}

fn ended(command: RigCommand) -> [RigEvent; 2] {
    [
        RigEvent::Begun(command),
        RigEvent::Ended(command, Ok(Ended::Complete)),
    ]
}

#[test]
fn orders_are_carried_out_in_their_order() {
    let mut bench = Bench::new(RigSettings {
        recovery: 1.0,
        ..RigSettings::default()
    });
    let commands = [
        RigCommand::Jog(-1e-3 * Vec3::z()),
        RigCommand::Jog(5e-4 * Vec3::z()),
        RigCommand::Approach,
        RigCommand::Rest,
        RigCommand::Press(usual(), 7),
        RigCommand::Withdraw,
    ];
    let said = bench.carry_out(&commands);
    assert_eq!(said, commands.map(ended).concat());
}

/// What is pressed without an approach is refused, and what was planned after it is dropped.
#[test]
fn what_waits_behind_a_failure_is_dropped() {
    let mut bench = Bench::new(RigSettings::default());
    let commands = [RigCommand::Press(usual(), 1), RigCommand::Approach];
    let said = bench.carry_out(&commands);
    let refused = RigEvent::Ended(commands[0], Err(Error::NotApproached));
    assert_eq!(
        said,
        [
            RigEvent::Begun(commands[0]),
            refused,
            RigEvent::Dropped(commands[1])
        ]
    );
}

/// Enough in mid-hold: that press ends out of the tissue, the commands after it are carried out.
#[test]
fn a_press_that_is_enough_leaves_the_queue() {
    let mut bench = Bench::new(RigSettings {
        recovery: 0.1,
        ..RigSettings::default()
    });
    bench.carry_out(&[RigCommand::Approach]);
    let press = RigCommand::Press(usual(), 3);
    bench.console.end_press(2);
    let (said, after) = bench.press_and_act(press, &|console| console.end_press(3));
    let expected = [
        RigEvent::Begun(press),
        RigEvent::Ended(press, Ok(Ended::Enough)),
        RigEvent::Begun(RigCommand::Rest),
        RigEvent::Ended(RigCommand::Rest, Ok(Ended::Complete)),
    ];
    assert_eq!(said, expected);
    assert!(after.last().unwrap().depth.unwrap() < -1e-3);
}

/// Stop in mid-hold: pressing ends with that tick, the tip is out of the tissue, later orders are stale.
#[test]
fn a_stop_withdraws_and_makes_orders_stale() {
    let mut bench = Bench::new(RigSettings::default());
    bench.carry_out(&[RigCommand::Approach]);
    let press = RigCommand::Press(usual(), 1);
    let (said, after) = bench.press_and_act(press, &|console| console.stop());
    let expected = [
        RigEvent::Begun(press),
        RigEvent::Ended(press, Ok(Ended::Stopped)),
        RigEvent::Dropped(RigCommand::Rest),
    ];
    assert_eq!(said, expected);
    let stopped =
        |sample: &&RigSample| sample.phase == Phase::Pressing && sample.depth.unwrap() > 3.9e-3;
    assert_eq!(after.iter().filter(stopped).count(), 1);
    assert!(after.last().unwrap().depth.unwrap() < -1e-3);
}

/// Judge: the force on the device, which is zero with the tick after the switch; what the sensor still feels is
/// tissue that pushes a free tip out. Nothing moves it until somebody arms, and then it stays where it is.
#[test]
fn an_emergency_stop_is_latched_until_somebody_arms() {
    let mut bench = Bench::new(RigSettings::default());
    bench.carry_out(&[RigCommand::Approach]);
    let press = RigCommand::Press(usual(), 1);
    bench.console.send(press);
    bench.console.send(RigCommand::Rest);
    let (console, mut pressed, mut last) = (&bench.console, None, 0.0);
    bench.operated.process_next(&mut |sample| {
        last = sample.time;
        if sample.phase == Phase::Pressing && sample.depth.unwrap() > 3.9e-3 {
            pressed.get_or_insert(sample.time);
            console.emergency_stop();
        }
    });
    // No tick of that stimulus comes after the one of the switch.
    assert_eq!(pressed, Some(last));
    let fault = Fault::EmergencyStop;
    let said = |bench: &mut Bench| {
        let said = bench
            .told
            .drain()
            .filter(|t| !matches!(t, RigEvent::Sample(_)));
        said.collect::<Vec<_>>()
    };
    let faulted = [
        RigEvent::Begun(press),
        RigEvent::Ended(press, Err(Error::Device(fault))),
        RigEvent::Faulted(fault),
    ];
    assert_eq!(said(&mut bench), faulted);
    bench.operated.process_next(&mut |_| ());
    assert_eq!(said(&mut bench), [RigEvent::Dropped(RigCommand::Rest)]);
    let free = bench.idle(3000);
    assert!(free.iter().all(|sample| sample.phase == Phase::ForceOff));
    // Tissue pushes the tip out of it: what is left is the friction of the device (0.04 N) at most.
    assert!(free[2999].force < 0.05, "{:?}", free[2999]);
    assert_eq!(
        bench.carry_out(&[RigCommand::Withdraw]),
        [RigEvent::Dropped(RigCommand::Withdraw)]
    );
    bench.console.arm();
    let arming = bench.idle(1500);
    let (before, after) = (free[2999], arming[1499]);
    assert_eq!(after.phase, Phase::Waiting);
    // Two steps of the encoder.
    assert!((after.height - before.height).abs() < 6e-5, "{after:?}");
    let out = bench.carry_out(&[RigCommand::Withdraw]);
    assert_eq!(out, ended(RigCommand::Withdraw));
}

/// A step beyond a limit is refused before anything moves; held down it goes no deeper than a stimulus may, and up no
/// further than tissue is looked for.
#[test]
fn a_jog_ends_at_the_limits() {
    let mut bench = Bench::new(RigSettings::default());
    bench.carry_out(&[RigCommand::Approach]);
    let before = bench.idle(10).last().unwrap().height;
    for way in [
        -Vec3::z(),
        Vec3::x() * 0.031,
        Vec3::y() * -0.031,
        Vec3::z() * f64::NAN,
    ] {
        let said = bench.carry_out(&[RigCommand::Jog(way)]);
        assert!(
            matches!(said[1], RigEvent::Ended(_, Err(Error::OutOfReach { .. }))),
            "{way:?}: {said:?}"
        );
    }
    let after = bench.idle(10).last().unwrap().height;
    // Two steps of the encoder.
    assert!((after - before).abs() < 6e-5, "{before} {after}");
    for (direction, end) in [(-1.0, 0.012), (1.0, -0.030)] {
        let drive = RigCommand::Drive(direction * Vec3::z());
        let (console, mut depth) = (&mut bench.console, 0.0);
        console.send(drive);
        let (mut ticks, mut farthest) = (0, 0.0_f64);
        bench.operated.process_next(&mut |sample| {
            ticks += 1;
            if ticks % 100 == 0 {
                console.send(drive);
            }
            depth = match direction > 0.0 {
                true => -sample.height,
                false => sample.depth.unwrap(),
            };
            farthest = if end > 0.0 {
                farthest.max(depth)
            } else {
                farthest.min(depth)
            };
        });
        let said: Vec<RigEvent> = bench
            .told
            .drain()
            .filter(|t| !matches!(t, RigEvent::Sample(_)))
            .collect();
        assert!(
            matches!(said[1], RigEvent::Ended(_, Err(Error::OutOfReach { .. }))),
            "{said:?}"
        );
        // What the drive is off by at most when it comes to rest (0.034 mm), and two steps of the encoder.
        assert!((farthest - end).abs() < 1e-4, "{farthest}");
    }
}

/// Judge: the encoders. A millimetre in each direction and back is where it began; sideways the contact is forgotten,
/// and in tissue it is refused.
#[test]
fn a_jog_goes_along_all_three_axes() {
    let mut bench = Bench::new(RigSettings::default());
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
        let before = bench.idle(200).last().unwrap().position;
        let out = RigCommand::Jog(3e-3 * axis);
        assert_eq!(bench.carry_out(&[out]), ended(out));
        let there = bench.idle(300).last().unwrap().position;
        // Dry friction holds the PID a step of the encoder or two away.
        assert!((there - before - 3e-3 * axis).norm() < 1.2e-4, "{there:?}");
        let back = RigCommand::Jog(-3e-3 * axis);
        assert_eq!(bench.carry_out(&[back]), ended(back));
    }
    bench.carry_out(&[RigCommand::Approach]);
    assert!(bench.idle(1)[0].depth.is_some());
    bench.carry_out(&[RigCommand::Jog(-5e-3 * Vec3::z())]);
    let said = bench.carry_out(&[RigCommand::Jog(1e-3 * Vec3::x())]);
    assert!(
        matches!(said[1], RigEvent::Ended(_, Err(Error::InTissue { .. }))),
        "{said:?}"
    );
    bench.carry_out(&[RigCommand::Withdraw, RigCommand::Jog(1e-3 * Vec3::x())]);
    assert_eq!(bench.idle(1)[0].depth, None);
}

/// Driving lasts as long as the order comes again, and ends within its time when it does not.
#[test]
fn a_held_jog_ends_when_nobody_holds_it() {
    let mut bench = Bench::new(RigSettings::default());
    let (console, mut moved) = (&mut bench.console, 0);
    let drive = RigCommand::Drive(Vec3::z());
    console.send(drive);
    let mut next = 0.1;
    let mut began = None;
    bench.operated.process_next(&mut |sample| {
        let begun = *began.get_or_insert(sample.time);
        if sample.time - begun > next && next < 0.95 {
            console.send(drive);
            next += 0.1;
        }
        moved += 1;
    });
    // The last of ten orders comes 0.9 s after the first and lasts for 0.16 s more.
    assert!((1050..1075).contains(&moved), "{moved}");
    let height = bench.idle(200).last().unwrap().height;
    assert!((height - 0.005 * 1.06).abs() < 1e-4, "{height}");
}

/// Too much force by hand: it is withdrawn.
#[test]
fn a_jog_into_too_much_force_is_withdrawn() {
    let mut bench = Bench::new(RigSettings {
        force_limit: 0.05,
        ..RigSettings::default()
    });
    let said = bench.carry_out(&[RigCommand::Jog(-0.02 * Vec3::z())]);
    assert!(
        matches!(said[1], RigEvent::Ended(_, Err(Error::TooMuchForce { .. }))),
        "{said:?}"
    );
    let height = bench.idle(200).last().unwrap().height;
    assert!(height.abs() < 1e-4, "{height}");
}
