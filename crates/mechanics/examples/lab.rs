#![allow(warnings, missing_docs, clippy::all, reason = "lab")]
//! lab
use std::sync::Arc;
use palpate_mechanics::finite_elements::indentation::*;
use palpate_mechanics::*;
fn env(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().and_then(|s| s.parse().ok()).unwrap_or(default)
}
fn main() {
    let a = 1e-3;
    let w = env("W", 0.0);
    let g = 1000.0;
    let law: Arc<dyn Law> = if std::env::var("EXP").is_ok() {
        Arc::new(Exponential::incompressible(6.0 * g / 3.0, env("EXP", 0.5)).unwrap())
    } else if w > 0.0 {
        Arc::new(MooneyRivlin::incompressible(g * (1.0 - w), g * w).unwrap())
    } else {
        Arc::new(NeoHookean::incompressible(g).unwrap())
    };
    let side = match std::env::var("SIDE").as_deref() { Ok("stick") => Grip::Stick, _ => Grip::Slide };
    let mut run = IndentationRun::new(&IndentationSettings {
        block: Block { radius: 0.05642, height: 0.1, base: Base::Bonded },
        indenter: Indenter { shape: IndenterShape::Flat { side: Side::Touches(side) }, radius: a, face: Grip::Stick },
        law, prony: PronySeries::default(), deepest: env("DEEP", 8.0) * a, halvings: env("HALV", 0.0) as i32,
    }).unwrap();
    println!("{} unknowns", run.model().size());
    let start = std::time::Instant::now();
    let mut steps = 0;
    let verbose = std::env::var("VERB").is_ok();
    for i in 1..=(env("DEEP", 8.0) as i32 * 2) {
        let d = 0.5 * f64::from(i) * a;
        let r = run.press(d, d, |p| { steps += 1; if verbose { println!("   {:.5} {:.4}", p.depth / a, p.force / (g * a * a)); } });
        match r {
            Ok(p) => println!("{:.2} {:.4} E {:.5} steps {steps} solves {} t {:.2}", p.depth / a, p.force / (g * a * a), p.energy / (g * a * a * a), palpate_mechanics::finite_elements::solves(), start.elapsed().as_secs_f64()),
            Err(e) => { println!("{e}"); break; }
        }
    }
    if let Ok(path) = std::env::var("SVG") { svg(&run, &path, a); }
}
fn svg(run: &IndentationRun, path: &str, a: f64) {
    let (m, s) = (run.model().mesh(), run.state());
    let at = |n: u32| { let x = m.nodes[n as usize] + s.displacement(run.model(), n as usize); (x.x / a, x.y / a) };
    let (x0, x1, y0, y1) = (env("X0", 0.0), env("X1", 4.0), env("Y0", -12.0), env("Y1", 0.5));
    let k = env("PX", 1000.0) / (x1 - x0).max(y1 - y0);
    let mut out = format!("<svg xmlns='http://www.w3.org/2000/svg' width='{}' height='{}'><rect width='100%' height='100%' fill='white'/>", k * (x1 - x0), k * (y1 - y0));
    for e in 0..m.len() {
        let n = m.element(e);
        let ring: Vec<String> = [0, 1, 2, 5, 8, 7, 6, 3, 0].iter().map(|&i| { let (x, y) = at(n[i]); format!("{:.3},{:.3}", k * (x - x0), k * (y1 - y)) }).collect();
        if ring.len() > 0 { out += &format!("<polyline points='{}' fill='none' stroke='black' stroke-width='0.5'/>", ring.join(" ")); }
    }
    out += "</svg>";
    std::fs::write(path, out).unwrap();
}
