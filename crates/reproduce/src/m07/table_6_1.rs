use palpate_characterize::lumped::{Contact, mean_modulus};

use crate::Error;
use crate::m06::Printed;
use crate::row::Rows;
use crate::virtual_rig::RADIUS;

const ORGANS: [&str; 3] = ["liver", "spleen", "kidney"];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for organ in ORGANS {
        let printed = Printed::all(organ);
        // Bounds are part of the rule.
        let Some(deepest) = printed.iter().rev().find(|row| !row.suspect) else {
            return Err(Error::failed("table 5-1 has no row without a misprint"));
        };
        for (word, ours) in ["modulus", "deviation"]
            .into_iter()
            .zip(by_the_rule(deepest)?)
        {
            rows.row(&format!("{organ}/{word}"))
                .with("depth", deepest.depth_mm)
                .with("remark", organ)
                .is(ours);
        }
    }
    rows.without("esophagus");
    Ok(())
}

/// Mean and standard deviation of three moduli [kPa].
fn by_the_rule(row: &Printed) -> Result<[f64; 2], Error> {
    let depth = row.depth();
    let modulus = |force| mean_modulus(Contact::Flat(RADIUS), false, depth, force);
    let moduli = [modulus(row.min)?, modulus(row.mean)?, modulus(row.max)?];
    let mean = moduli.iter().sum::<f64>() / 3.0;
    let squares: f64 = moduli.iter().map(|modulus| (modulus - mean).powi(2)).sum();
    Ok([1e-3 * mean, 1e-3 * (squares / 2.0).sqrt()])
}
