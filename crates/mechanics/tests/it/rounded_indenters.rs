//! Punches with a rounded edge and cones with a rounded apex, pressed into a block.

use std::sync::Arc;

use palpate_mechanics::contact::{FrictionLaw, RoundedProfile, rounded_force};
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationProblem, Indenter, IndenterShape, Side, solve,
};
use palpate_mechanics::{Error, Law, LinearElastic, NeoHookean};

const RADIUS: f64 = 1e-3;

/// So large that its ends take about 1 % of the compliance of a contact of the radius.
const BLOCK: Block = Block {
    radius: 0.05642,
    height: 0.1,
    base: Base::Bonded,
};

fn indenter(shape: IndenterShape, face: FrictionLaw) -> Indenter {
    Indenter {
        shape,
        radius: RADIUS,
        face,
    }
}

fn neo_hookean() -> Arc<dyn Law> {
    Arc::new(NeoHookean::incompressible(1000.0).unwrap())
}

fn force(indenter: Indenter, law: Arc<dyn Law>, depth: f64) -> f64 {
    let problem = IndentationProblem {
        block: BLOCK,
        indenter,
        law,
    };
    let found = solve(&problem, &[depth], 0.01, &mut |_| ()).unwrap();
    let force = found.answer.points[0].force;
    println!(
        "{:?} {depth:.1e}: {force:.6} N, error {:.4}",
        indenter.shape, found.error
    );
    force
}

/// Judge: [Sneddon 1965]. Tolerance: the block's 1 %, the answer's own of 1 %.
#[test]
#[ignore = "long"]
fn rounded_indenters_meet_sneddon() {
    let law = LinearElastic::new(6000.0, 0.45).unwrap();
    let cone = IndenterShape::Cone {
        half_angle: 80_f64.to_radians(),
        apex_radius: 2e-4,
    };
    for (shape, part) in [
        (IndenterShape::RoundedPunch { edge_radius: 5e-5 }, 0.05),
        (IndenterShape::RoundedPunch { edge_radius: 3e-4 }, 0.01),
        (IndenterShape::RoundedPunch { edge_radius: 9e-4 }, 0.05),
        (cone, 0.05),
    ] {
        let (indenter, depth) = (indenter(shape, FrictionLaw::Frictionless), part * RADIUS);
        let profile: RoundedProfile = indenter.rounded_profile().unwrap();
        let found = force(indenter, Arc::new(law), depth);
        let off = found / rounded_force(&law, &profile, depth) - 1.0;
        println!("{off:+.4}");
        assert!(off.abs() < 0.02, "{shape:?}, {depth}: {off}");
    }
}

/// Judge: the sphere, whose contact begins at a point; it differs by half a percent of the radius. Tolerance: the error of both.
#[test]
#[ignore = "long"]
fn a_punch_that_is_all_edge_is_a_sphere() {
    for face in [FrictionLaw::Frictionless, FrictionLaw::Coulomb(0.3)] {
        let round = IndenterShape::RoundedPunch {
            edge_radius: 0.995 * RADIUS,
        };
        let [punch, sphere] = [round, IndenterShape::Sphere]
            .map(|shape| force(indenter(shape, face), neo_hookean(), 0.3 * RADIUS));
        assert!(
            (punch / sphere - 1.0).abs() < 0.02,
            "{face:?}: {punch} {sphere}"
        );
    }
}

/// Judge: the sharp punch, whose nodes are on its face from the beginning. At small strain the edge matters as its radius over
/// that of the punch, to some part of 1 %; tissue that is pressed by a fifth of the radius goes around it either way.
#[test]
#[ignore = "long"]
fn a_punch_with_a_small_edge_is_nearly_sharp() {
    let sharp = IndenterShape::Flat {
        side: Side::Touches(FrictionLaw::Bonded),
    };
    let rounded = IndenterShape::RoundedPunch { edge_radius: 2e-5 };
    let [sharp, rounded] = [sharp, rounded].map(|shape| {
        force(
            indenter(shape, FrictionLaw::Bonded),
            neo_hookean(),
            0.2 * RADIUS,
        )
    });
    assert!((rounded / sharp - 1.0).abs() < 0.02, "{rounded} {sharp}");
}

#[test]
fn an_edge_as_large_as_the_punch_is_refused() {
    for shape in [
        IndenterShape::RoundedPunch {
            edge_radius: RADIUS,
        },
        IndenterShape::RoundedPunch {
            edge_radius: f64::NAN,
        },
        IndenterShape::Cone {
            half_angle: 1.2,
            apex_radius: -1e-4,
        },
    ] {
        let problem = IndentationProblem {
            block: BLOCK,
            indenter: indenter(shape, FrictionLaw::Frictionless),
            law: neo_hookean(),
        };
        let refused = solve(&problem, &[1e-4], 0.01, &mut |_| ()).unwrap_err();
        assert!(matches!(refused, Error::Mismatch(_)), "{refused}");
    }
}
