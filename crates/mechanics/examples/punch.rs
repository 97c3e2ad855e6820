#![allow(
    missing_docs,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "scratch"
)]
use palpate_mechanics::finite_elements::indentation::*;
use palpate_mechanics::*;
use std::sync::Arc;
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let halvings: u32 = args[0].parse().unwrap();
    let to: f64 = args[1].parse().unwrap();
    let has = |w: &str| args.iter().any(|a| a == w);
    let c10 = 1000.0;
    let q: f64 = std::env::var("Q").map_or(0.0, |q| q.parse().unwrap());
    let law: Arc<dyn Law> = if has("mr") {
        Arc::new(MooneyRivlin::incompressible(c10 * 0.4 * (1.0 + q), 0.6 * c10).unwrap())
    } else if has("blatz") {
        Arc::new(Blatz::incompressible(2.0 * c10, 1.0 + q).unwrap())
    } else if has("lin") {
        Arc::new(LinearElastic::new(6.0 * c10, 0.4999).unwrap())
    } else {
        Arc::new(NeoHookean::incompressible(c10).unwrap())
    };
    let a = 1e-3;
    let grip = |name: &str| if has(name) { Grip::Slide } else { Grip::Stick };
    let shape = if has("sphere") {
        IndenterShape::Sphere
    } else {
        IndenterShape::Flat {
            side: if has("none") {
                Side::Absent
            } else {
                Side::Touches(grip("sideslide"))
            },
        }
    };
    let settings = IndentationSettings {
        block: Block {
            radius: 0.05642,
            height: 0.1,
        },
        indenter: Indenter {
            shape,
            radius: a,
            face: grip("faceslide"),
        },
        prony: if has("prony") {
            PronySeries::new(&[(0.3, 1.0), (0.2, 10.0)]).unwrap()
        } else {
            PronySeries::default()
        },
        law,
        halvings,
    };
    if has("solve") {
        let problem = IndentationProblem {
            block: settings.block,
            indenter: settings.indenter,
            law: settings.law.clone(),
        };
        let t = std::time::Instant::now();
        if has("prony") {
            let times: Vec<f64> = (0..=40).map(|i| f64::from(i) * 0.1).collect();
            let depths: Vec<f64> = times.iter().map(|t| to * a * t.min(1.0)).collect();
            let history = History { times, depths };
            let mut all = Vec::new();
            for how in [Relaxing::Convolution, Relaxing::Full] {
                let answer = solve_history(
                    &problem,
                    (&settings.prony, how),
                    &history,
                    0.05,
                    &mut |_| {},
                )
                .unwrap();
                println!("{how:?} {} {:?}", answer.error, t.elapsed());
                all.push(answer.answer.points);
            }
            for (c, f) in all[0].iter().zip(&all[1]) {
                println!(
                    "{:.2} {:.6e} {:.6e} {:.4}",
                    c.time,
                    c.force,
                    f.force,
                    c.force / f.force - 1.0
                );
            }
            return;
        }
        match solve(&problem, &[0.5 * a, a, 2.0 * a, to * a], 0.01, &mut |_| {}) {
            Ok(answer) => {
                for p in &answer.answer.points {
                    println!("{} {}", p.depth / a, p.force / (c10 * a * a));
                }
                println!(
                    "error {} unknowns {} {:?}",
                    answer.error,
                    answer.answer.unknowns,
                    t.elapsed()
                );
            }
            Err(e) => println!("{e}"),
        }
        return;
    }
    let t = std::time::Instant::now();
    let mut run = IndentationRun::new(&settings).unwrap();
    if has("sens") {
        run = run.with_sensitivities();
    }
    println!("unknowns {} setup {:?}", run.model().size(), t.elapsed());
    let mut depths: Vec<f64> = vec![0.02, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    depths.retain(|d| *d <= to);
    let mut steps = 0;
    for d in depths {
        match run.press(d, d * a, |_| {
            steps += 1;
        }) {
            Ok(p) => {
                if has("show") {
                    for (i, x) in run.model().mesh().nodes.iter().enumerate() {
                        if x.y == 0.0 && x.x < 2.0 * a && x.x > 0.5 * a {
                            let u = run.state().displacement(run.model(), i);
                            println!(
                                "   {:.3} -> {:.4} {:.4}",
                                x.x / a,
                                (x.x + u.x) / a,
                                (u.y + p.depth) / a
                            );
                        }
                    }
                }
                println!(
                    "d/a {d}: F/(C10 a2) {:.6} E {:.6e}  steps {steps} t {:?} {:?}",
                    p.force / (c10 * a * a),
                    p.energy,
                    t.elapsed(),
                    p.by_parameter
                )
            }
            Err(e) => {
                println!("{e}");
                break;
            }
        }
    }
}
