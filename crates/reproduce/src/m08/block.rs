//! The block under the punch, with the laws that the source found for it.

use palpate_mechanics::contact::FrictionLaw;
use std::sync::{Arc, OnceLock};

use palpate_characterize::inverse::CandidateLaw;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationProblem, Indenter, IndenterShape, Side, solve,
};
use palpate_mechanics::{IndentationCurve, Law, MooneyRivlin, NeoHookean};

use crate::Error;
use crate::published::{cell, prony};
use crate::row::Rows;

/// The source's cube of 100 mm, as a cylinder of the same height and volume.
const BLOCK: Block = Block {
    radius: 0.056_418_958_354_775_63,
    height: 0.1,
    base: Base::Bonded,
};

/// The source's probe is 2 mm in diameter.
const RADIUS: f64 = 1e-3;

/// Depths of table 5-1 [mm].
pub(super) const DEPTHS_MM: [u32; 6] = [1, 2, 4, 5, 6, 8];

/// Organs of tables 6-4 and 6-5, with their depths [mm].
pub(super) const ORGANS: [(&str, u32); 2] = [("kidney", 5), ("liver", 6)];

/// Of the whole curve [-]; the readings differ by tens of per cent.
const ACCURACY: f64 = 0.03;

/// A law that the source published, with the curve it gives.
pub(super) struct Published {
    pub(super) organ: &'static str,
    pub(super) law: &'static str,
    /// Its parameters [Pa], as printed.
    pub(super) parameters: Vec<f64>,
    /// Relaxed part of the instantaneous force [-], from table 6-3.
    pub(super) relaxed: f64,
    /// Elastic force [N] over depth [m] with the printed parameters.
    pub(super) curve: IndentationCurve,
    /// Relative error of the curve [-].
    pub(super) error: f64,
}

/// The four sets of tables 6-4 and 6-5. They take minutes, and are solved once for all figures.
pub(super) fn published(rows: &Rows<'_>) -> Result<&'static [Published], Error> {
    static SOLVED: OnceLock<Vec<Published>> = OnceLock::new();
    match SOLVED.get() {
        Some(solved) => Ok(solved),
        None => {
            let solved = solved(rows)?;
            Ok(SOLVED.get_or_init(|| solved))
        }
    }
}

fn solved(rows: &Rows<'_>) -> Result<Vec<Published>, Error> {
    let unit: Arc<dyn Law> = Arc::new(NeoHookean::incompressible(1.0)?);
    let (unit_curve, unit_error) = curve(rows, "neo-Hookean", unit)?;
    let mut all = Vec::new();
    for (organ, depth_mm) in ORGANS {
        let relaxed = prony(organ, depth_mm)?.relaxation(f64::INFINITY);
        for (law, word) in LAWS {
            let parameters = printed(law, organ, "final")?;
            let (curve, error) = match parameters.as_slice() {
                // One modulus: the force is proportional to it.
                [c10] => (unit_curve.scaled(1.0, *c10), unit_error),
                both => {
                    let law = Arc::new(MooneyRivlin::incompressible(both[0], both[1])?);
                    curve(rows, "Mooney-Rivlin", law)?
                }
            };
            all.push(Published {
                organ,
                law: word,
                parameters,
                relaxed,
                curve,
                error,
            });
        }
    }
    Ok(all)
}

/// The laws of tables 6-4 and 6-5, with their words.
pub(super) const LAWS: [(CandidateLaw, &str); 2] = [
    (CandidateLaw::NeoHookean, "neo_hookean"),
    (CandidateLaw::MooneyRivlin, "mooney_rivlin"),
];

/// The table that a law is in.
pub(super) fn table(law: CandidateLaw) -> &'static str {
    match law {
        CandidateLaw::NeoHookean => "table-6-4",
        _ => "table-6-5",
    }
}

/// The moduli of a law.
pub(super) fn moduli(law: CandidateLaw) -> &'static [&'static str] {
    match law {
        CandidateLaw::NeoHookean => &["c10"],
        _ => &["c10", "c01"],
    }
}

/// The printed moduli [Pa] of `organ`, of those `when`: `initial` or `final`.
pub(super) fn printed(law: CandidateLaw, organ: &str, when: &str) -> Result<Vec<f64>, Error> {
    let printed = |modulus| cell(&format!("{} {organ} {when}_{modulus}_pa", table(law)));
    moduli(law).iter().map(printed).collect()
}

/// The elastic curve [N over m] of `law` and its relative error [-].
fn curve(rows: &Rows<'_>, name: &str, law: Arc<dyn Law>) -> Result<(IndentationCurve, f64), Error> {
    let problem = IndentationProblem {
        block: BLOCK,
        indenter: Indenter {
            shape: IndenterShape::Flat {
                side: Side::Touches(FrictionLaw::Bonded),
            },
            radius: RADIUS,
            face: FrictionLaw::Bonded,
        },
        law,
    };
    let depths = DEPTHS_MM.map(|depth| 1e-3 * f64::from(depth));
    let what = format!("{name} on ");
    let mut say = rows.meshes(&what);
    let found = solve(&problem, &depths, ACCURACY, &mut say)?;
    Ok((found.answer.curve, found.error))
}
