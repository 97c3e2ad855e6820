//! The convolution with the hereditary factor against full runs with internal variables.

use std::sync::Arc;

use palpate_mechanics::finite_elements::indentation::{
    Base, Block, Grip, IndentationRun, IndentationSettings, Indenter, IndenterShape, Side,
};
use palpate_mechanics::{HereditaryFactor, IndentationCurve, Law, MooneyRivlin, PronySeries};

/// Table 6-3's liver.
const LIVER: [(f64, f64); 2] = [(0.2866, 1.537), (0.2022, 6.090)];

fn settings(shape: f64, prony: PronySeries, deepest: f64, halvings: i32) -> IndentationSettings {
    let law: Arc<dyn Law> = Arc::new(MooneyRivlin::incompressible(1.0 - shape, shape).unwrap());
    IndentationSettings {
        block: Block {
            radius: 56.42,
            height: 100.0,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: IndenterShape::Flat {
                side: Side::Touches(Grip::Stick),
            },
            radius: 1.0,
            face: Grip::Stick,
        },
        law,
        prony,
        deepest,
        halvings,
    }
}

#[test]
fn probe() {
    let env = |name: &str, other: f64| std::env::var(name).ok().and_then(|x| x.parse().ok()).unwrap_or(other);
    let (shape, deepest, ramp, halvings) = (env("SHAPE", 0.0), env("DEPTH", 6.0), env("RAMP", 0.5), env("HALVINGS", -1.0) as i32);
    let begun = std::time::Instant::now();
    let mut run = IndentationRun::new(&settings(shape, PronySeries::default(), deepest, halvings)).unwrap().with_path();
    let depths: Vec<f64> = [0.1, 0.25, 0.5, 0.75, 1.0].into_iter().chain((3..).map(|i| 0.5 * f64::from(i)).take_while(|x| *x <= deepest)).collect();
    let forces: Vec<f64> = depths.iter().map(|d| run.press(*d, *d, |_| ()).unwrap().force).collect();
    println!("elastic {:?}", begun.elapsed());
    let factor = run.hereditary_factor();
    println!("factor {:?} {:?}", factor.coefficients(), begun.elapsed());
    let curve = IndentationCurve::through(&depths, &forces);
    let better = curve.clone().with_hereditary(factor);
    let series = PronySeries::new(&LIVER).unwrap();
    let times: Vec<f64> = (0..=10).map(|i| ramp * f64::from(i) / 10.0).chain([0.1, 0.3, 1.0, 3.0, 10.0, 40.0].map(|t| ramp + t)).collect();
    let pressed: Vec<f64> = times.iter().map(|t| deepest * (t / ramp).min(1.0)).collect();
    let (plain, own) = (curve.relaxed(&series, &times, &pressed), better.relaxed(&series, &times, &pressed));
    let mut full = IndentationRun::new(&settings(shape, series, deepest, halvings)).unwrap();
    for place in 1..times.len() {
        let force = full.press(times[place], pressed[place], |_| ()).unwrap().force;
        println!("{:.3} {:.3}: full {force:.4} plain {:+.4} own {:+.4}", times[place], pressed[place], plain[place] / force - 1.0, own[place] / force - 1.0);
    }
    println!("full {:?}", begun.elapsed());
    let _ = HereditaryFactor::ONE;
}
