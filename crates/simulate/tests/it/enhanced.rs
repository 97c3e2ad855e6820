//! The surface that is seen of a whole organ: finer triangles around a tip, from a step to what is drawn.

use palpate_files::scene::Enhancement;
use palpate_geometry::{AabbTree, Surface, TriangleMesh, Vec3};
use palpate_simulate::{EnhancedSurface, Simulation};

use crate::no_allocation::track;
use crate::scenes::{Hand, Setting, nearest};

const OWN: Setting<'_> = Setting {
    organ: "builtin = \"kidney\"\ntriangles = 800",
    kind: "hybrid",
    model: "enhancement = { area = \"vertex\", smoothing = \"shepard\" }",
    poissons_ratio: 0.45,
    shape: "flat",
    radius: 3e-3,
    contact: "slip",
    prony: "[]",
};

/// Seen finer than it is solved.
const CARRIED: Setting<'_> = Setting {
    organ: "builtin = \"liver\"\ntriangles = 1500",
    model: "mechanical_triangles = 500\nenhancement = { area = \"vertex\" }",
    ..OWN
};

fn enhanced(simulation: &Simulation, levels: usize) -> EnhancedSurface {
    let wanted = Enhancement {
        levels,
        ..*simulation.enhancement().unwrap()
    };
    EnhancedSurface::new(simulation, wanted).unwrap().unwrap()
}

/// What a display draws: single precision, each vertex once.
fn drawn(seen: &EnhancedSurface) -> Surface {
    let places = seen.places().iter();
    let single = places.map(|place| place.map(|x| f64::from(x as f32)));
    let triangles = seen.mesh().triangles().to_vec();
    Surface::new(TriangleMesh::new(single.collect(), triangles).unwrap()).unwrap()
}

/// Judge: the checks of a surface, which has to be closed, manifold and oriented at every step of a slide,
/// at rest and as it is drawn.
#[test]
#[ignore = "long"]
fn a_slide_is_seen_without_cracks() {
    for setting in [OWN, CARRIED] {
        let simulation = setting.simulation();
        let mut seen = enhanced(&simulation, 2);
        let mut hand = Hand::new(&simulation);
        let (mut patches, mut touching) = (0, 0);
        for tip in track(&simulation).iter().step_by(5) {
            hand.at(tip);
            let anew = seen.follow(hand.state.organ_field.as_ref().unwrap());
            let own = hand.state.deformed.vertices();
            assert_eq!(
                simulation.surface().mesh().vertices(),
                &seen.mesh().vertices()[..own.len()]
            );
            patches += usize::from(anew);
            if hand.row().contact {
                touching += 1;
                assert!(seen.places().len() > own.len());
                let new = seen.new_vertices().count();
                assert_eq!(new, seen.places().len() - own.len());
            }
            if anew {
                Surface::new(seen.mesh().clone()).unwrap();
            }
            drawn(&seen);
        }
        println!("{patches} patches in {touching} steps in contact");
        assert!(patches > 5 && touching > 100);
        // And nothing is left of it.
        hand.at(&Vec3::new(0.0, 0.0, 1.0));
        seen.follow(hand.state.organ_field.as_ref().unwrap());
        assert_eq!(seen.places(), simulation.surface().mesh().vertices());
    }
}

/// Judge: the tip, which the surface has to meet; 5 % of the depth is a pixel of an organ that fills a
/// window. Coarse triangles are drawn between vertices that the tip may miss altogether.
#[test]
#[ignore = "long"]
fn the_drawn_dimple_is_as_deep_as_the_tip() {
    for setting in [OWN, CARRIED] {
        let simulation = setting.simulation();
        let tree = AabbTree::new(simulation.surface().mesh());
        let depth = 3e-3;
        let (mut coarse, mut finer) = (0.0_f64, 0.0_f64);
        for tip in track(&simulation).iter().step_by(40) {
            let (point, normal) = nearest(&simulation, &tree, tip);
            let tip = point - normal * depth;
            let mut hand = Hand::new(&simulation);
            hand.at(&tip);
            let gap = |surface: &TriangleMesh| {
                AabbTree::new(surface).nearest(surface, &tip).distance / depth
            };
            coarse = coarse.max(gap(&hand.state.deformed));
            let mut seen = enhanced(&simulation, 3);
            seen.follow(hand.state.organ_field.as_ref().unwrap());
            finer = finer.max(gap(drawn(&seen).mesh()));
        }
        println!("{coarse:.3} of the depth is not reached, {finer:.3} with finer triangles");
        assert!(coarse > 0.2 && finer < 0.05, "{coarse} {finer}");
    }
}
