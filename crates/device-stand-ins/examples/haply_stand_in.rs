//! A Haply Inverse Service without a device, at the service's own ports, until it is ended: for trying the rest of
//! palpate without hardware. A hand that gives way swings up and down by 25 mm, once in four seconds.
//!
//! In another terminal: `palpate devices haply --self-test`, or a scene whose tool has `device = "haply"`.

#![allow(clippy::print_stdout, reason = "it is there to be watched")]

use std::time::Duration;

use palpate_device_stand_ins::{HaplyStandIn, HaplyStandInSettings, StandInClock};
use palpate_servo::{HandImpedance, Trajectory, Vec3, VirtualDevice};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let swing = Trajectory::Sine {
        center: Vec3::zeros(),
        amplitude: Vec3::y() * 0.025,
        frequency: 0.25,
    };
    let hand = VirtualDevice::new(swing).with_hand(HandImpedance::default())?;
    let settings = HaplyStandInSettings {
        clock: StandInClock::Wall,
        ports: [10_001, 10_020],
        ..HaplyStandInSettings::default()
    };
    let service = HaplyStandIn::start(vec![Box::new(hand)], settings)?;
    println!("states at {}, Ctrl-C ends it", service.address());
    loop {
        std::thread::sleep(Duration::from_secs(1));
        let force = service.force(0);
        if force != Vec3::zeros() {
            println!(
                "{:.2} N right, {:.2} N up, {:.2} N toward the user",
                force.x, force.y, force.z
            );
        }
    }
}
