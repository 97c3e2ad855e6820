//! Layers on an elastic base by axisymmetric elements.

use std::sync::Arc;

use palpate_mechanics::contact::{Friction, FrictionLaw};
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, ElasticBase, IndentationRun, IndentationSettings, Indenter, IndenterShape, Side,
};
use palpate_mechanics::layered::{LayeredHalfSpace, LoadShape};
use palpate_mechanics::{Law, LinearElastic, MooneyRivlin, PronySeries};

const RADIUS: f64 = 1e-3;
/// Radius of a block [m] that is as good as a half-space under a layer of this `thickness` [m], also of one that is a hundred
/// times as stiff.
fn wide(thickness: f64) -> f64 {
    (56.42 * RADIUS).max(25.0 * thickness)
}

/// Thickness of a base over that [-]: what it holds back is what the free side yields.
const DEEP: f64 = 100.0 / 56.42;

fn settings(law: Arc<dyn Law>, thickness: f64, face: Friction) -> IndentationSettings {
    let side = match face {
        Friction::Bonded => Side::Touches(FrictionLaw::Bonded),
        Friction::Frictionless => Side::Absent,
    };
    IndentationSettings {
        block: Block {
            radius: wide(thickness),
            height: thickness,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: IndenterShape::Flat { side },
            radius: RADIUS,
            face: face.into(),
        },
        law,
        prony: PronySeries::default(),
        deepest: RADIUS,
        halvings: 0,
    }
}

fn base(thickness: f64, stiffness: f64) -> ElasticBase {
    ElasticBase {
        thickness: DEEP * wide(thickness),
        stiffness,
    }
}

/// Judge: a smooth punch on a layered half-space by transfer matrices. The force is over that of the same mesh with one
/// tissue, so that errors at the punch's edge and of the block's size cancel. Tolerance: 0.3 % of the transfer matrices beside
/// Hayes' factors, and elements that are even in the layer and not halved.
#[test]
fn a_layer_on_a_base_pushes_back_as_transfer_matrices_say() {
    let own = LinearElastic::new(1000.0, 0.49).unwrap();
    for of_radius in [0.5, 1.0, 2.0, 5.0] {
        let thickness = of_radius * RADIUS;
        let force = |stiffness: f64| {
            let settings = settings(Arc::new(own), thickness, Friction::Frictionless);
            let run = IndentationRun::on_base(&settings, base(thickness, stiffness));
            let depth = 1e-3 * RADIUS;
            run.unwrap().press(depth, depth, |_| ()).unwrap().force
        };
        let of_one = force(1.0);
        for stiffness in [0.01, 0.1, 0.3, 3.0, 10.0, 100.0] {
            let layered = LayeredHalfSpace {
                layers: vec![(thickness, own)],
                base: LinearElastic::new(1000.0 * stiffness, 0.49).unwrap(),
            };
            let expected = 1.0 / layered.compliance_ratios(LoadShape::Punch, RADIUS)[1];
            let found = force(stiffness) / of_one;
            println!(
                "{of_radius} {stiffness}: {found} {expected} {}",
                found / expected - 1.0
            );
            assert!((found / expected - 1.0).abs() < 0.005);
        }
    }
}

/// Judges: central differences of runs with other stiffnesses, right to the square of their step; and that force grows with
/// all moduli alike, F = Σ q ∂F/∂q.
#[test]
fn the_change_with_the_base_is_that_of_moved_runs() {
    let law = MooneyRivlin::incompressible(300.0, 200.0).unwrap();
    let settings = settings(Arc::new(law), 1.5 * RADIUS, Friction::Bonded);
    let depth = 0.8 * RADIUS;
    let press = |stiffness: f64| {
        let run = IndentationRun::on_base(&settings, base(1.5 * RADIUS, stiffness)).unwrap();
        let mut run = run.with_sensitivities();
        run.press(depth, depth, |_| ()).unwrap()
    };
    for stiffness in [0.2, 5.0_f64] {
        let point = press(stiffness);
        let step = 0.02_f64;
        let moved = [step, -step].map(|by| press(stiffness * by.exp()).force);
        let expected = (moved[0] - moved[1]) / (2.0 * step);
        let found = point.sensitivities[2];
        assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
        let whole = 300.0 * point.sensitivities[0] + 200.0 * point.sensitivities[1] + found;
        assert!(
            (whole / point.force - 1.0).abs() < 1e-4,
            "{whole} {}",
            point.force
        );
    }
}

/// A base without thickness or stiffness is none.
#[test]
fn a_base_that_is_none_is_refused() {
    let law = LinearElastic::new(1000.0, 0.49).unwrap();
    let settings = settings(Arc::new(law), 2.0 * RADIUS, Friction::Bonded);
    for (thickness, stiffness) in [(0.0, 1.0), (1.0, 0.0), (f64::NAN, 1.0), (1.0, f64::NAN)] {
        let base = ElasticBase {
            thickness,
            stiffness,
        };
        assert!(IndentationRun::on_base(&settings, base).is_err());
    }
}
