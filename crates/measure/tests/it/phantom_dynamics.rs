//! How the virtual PHANTOM moves. Judges: energy, virtual work, masses that were published, closed forms of the modes.

use palpate_measure::phantom::{FlexibleBody, FlexibleJoints, Joints, RigidBody, TwoMass};
use palpate_servo::Vec3;

/// Masses at rest: lateral 77 g, upright 52 g, radial 32 g, of the published model; to the digits.
#[test]
fn masses_at_rest_are_those_published() {
    let masses = RigidBody::premium().apparent_mass(&Vec3::zeros()).unwrap();
    for (found, known) in masses.iter().zip([0.077, 0.0525, 0.032]) {
        assert!((found - known).abs() < 0.0006, "{masses}");
    }
}

/// Without damping, energy stays within 0.1 % over 10 s of wide swings under gravity.
#[test]
fn energy_stays() {
    let machine = RigidBody::premium();
    let mut joints = Joints {
        angles: Vec3::new(0.2, 0.4, 0.3),
        rates: Vec3::new(3.0, -2.0, 2.5),
    };
    // Gravity turns the links over; a potential alone has no scale, the first motion has.
    let (began, scale) = (machine.energy(&joints), {
        let still = Joints {
            rates: Vec3::zeros(),
            ..joints
        };
        machine.energy(&joints) - machine.energy(&still)
    });
    for _ in 0..100 {
        machine.advance(&mut joints, &Vec3::zeros(), &Vec3::zeros(), 0.1);
        let drift = (machine.energy(&joints) - began).abs();
        assert!(drift < 1e-3 * scale, "{drift} of {scale}");
    }
}

/// A force on the handle and the torques that belong to it by the principle of virtual work hold each other;
/// the Jacobian is that of the positions.
#[test]
fn forces_and_torques_are_in_balance() {
    let mut machine = RigidBody::premium();
    machine.linkage.gravity = 0.0;
    let angles = Vec3::new(0.3, -0.2, 0.5);
    let jacobian = machine.linkage.jacobian(&angles);
    for joint in 0..3 {
        let mut beside = [angles; 2];
        beside[0][joint] -= 1e-6;
        beside[1][joint] += 1e-6;
        let slope =
            (machine.linkage.position(&beside[1]) - machine.linkage.position(&beside[0])) / 2e-6;
        // The square of the step and rounding.
        assert!((slope - jacobian.column(joint)).norm() < 1e-9);
    }
    let force = Vec3::new(0.4, -1.0, 0.7);
    let mut joints = Joints {
        angles,
        rates: Vec3::zeros(),
    };
    machine.advance(&mut joints, &(-jacobian.transpose() * force), &force, 1e-3);
    assert!(joints.rates.norm() < 1e-9, "{}", joints.rates);
}

/// Judge: √(k (1/M + 1/J))/2π of each joint, which do not know one another at rest. The twist of a joint that was
/// let go changes its sign twice in a period.
#[test]
fn each_joint_has_its_mode() {
    let mut body = FlexibleBody::premium();
    body.links.linkage.gravity = 0.0;
    body.damping = Vec3::zeros();
    let expected = body.structural_frequencies(&Vec3::zeros());
    for joint in 0..3 {
        let mut joints = FlexibleBody::at_rest();
        joints.rotors.angles[joint] = 1e-6;
        let (mut last, mut signs, mut between) = (1e-6, 0, [0.0; 2]);
        for step in 1..20_000 {
            body.advance(&mut joints, &Vec3::zeros(), &Vec3::zeros(), 10e-6);
            let twist = joints.rotors.angles[joint] - joints.links.angles[joint];
            if twist * last < 0.0 {
                between[usize::from(signs > 0)] = f64::from(step) * 10e-6;
                signs += 1;
            }
            last = twist;
        }
        let found = 0.5 * f64::from(signs - 1) / (between[1] - between[0]);
        println!(
            "joint {joint}: {found:.2} Hz, closed form {:.2} Hz",
            expected[joint]
        );
        // A step of 10 µs at each end of 0.2 s.
        assert!(
            (found / expected[joint] - 1.0).abs() < 1e-3,
            "{found} {expected}"
        );
    }
    // Of the two masses and of the joint about the upright axis, within what the printed masses are rounded by.
    let known = TwoMass::consistent().structural_frequency();
    assert!(
        (expected.x / known - 1.0).abs() < 0.01,
        "{expected} {known}"
    );
}

/// Undamped, the flexible machine keeps its energy too: that of the links, the rotors and the springs between.
#[test]
fn energy_stays_in_springs_too() {
    let mut body = FlexibleBody::premium();
    body.damping = Vec3::zeros();
    let energy = |joints: &FlexibleJoints| {
        let twist = joints.rotors.angles - joints.links.angles;
        let turning = joints.rotors.rates.component_mul(&joints.rotors.rates);
        body.links.energy(&joints.links)
            + 0.5 * turning.dot(&body.rotors)
            + 0.5 * twist.component_mul(&twist).dot(&body.stiffness)
    };
    let mut joints = FlexibleBody::at_rest();
    joints.links.rates = Vec3::new(3.0, -2.0, 2.5);
    joints.rotors.rates = joints.links.rates * 0.9;
    let began = energy(&joints);
    for _ in 0..20 {
        body.advance(&mut joints, &Vec3::zeros(), &Vec3::zeros(), 0.1);
        let drift = (energy(&joints) - began).abs();
        // 0.1 % over 10 s is asked for; here a fifth of that time.
        assert!(drift < 1e-3 * began, "{drift} of {began}");
    }
}
