use palpate_characterize::lumped::{Contact, mean_modulus};

use crate::Error;
use crate::m06::Printed;
use crate::published::TABLE_6_1 as PUBLISHED;
use crate::row::Value;
use crate::virtual_rig::RADIUS;
use crate::{Item, Rows};

pub(crate) const TABLE_6_1: Item = Item {
    name: "table-6-1",
    title: "mean elastic modulus of the organs",
    seconds: 0.1,
    run,
};

const ORGANS: [&str; 3] = ["liver", "spleen", "kidney"];

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for organ in ORGANS {
        let printed = Printed::all(organ);
        // Bounds are part of the rule.
        let Some(deepest) = printed.iter().rev().find(|row| !row.suspect) else {
            rows.add_missing(organ, "kPa", "table 5-1 has no row without a misprint");
            continue;
        };
        let [mean, deviation] = by_the_rule(deepest)?;
        let note = format!(
            "the rule that returns the printed kidney: (6.1) with nu = 0.5 over least, mean and largest force of table 5-1 at \
             {} mm, the mean and the standard deviation of the three; so ± is a spread, and no error of the mean{}",
            deepest.depth_mm,
            remark(organ)
        );
        let cell = |column| PUBLISHED.value(organ, column);
        let modulus = Value::beside(cell("youngs_modulus_kpa"), mean, "kPa");
        rows.add(&format!("{organ}/modulus"), modulus, note.clone());
        let spread = Value::beside(cell("standard_deviation_kpa"), deviation, "kPa");
        rows.add(&format!("{organ}/deviation"), spread, note);
    }
    let reason = "the table leaves it out, since (6.1) says nothing of a hollow organ, and so does `characterize`; \
                  section-6-4-5/youngs_modulus shows the source using it all the same";
    rows.add_missing("esophagus", "kPa", reason);
    Ok(())
}

fn remark(organ: &str) -> &'static str {
    match organ {
        "spleen" => "; the row at 6 mm is misprinted, and no depth returns the printed spread",
        "liver" => "; no depth returns both printed numbers",
        _ => "",
    }
}

/// Mean and standard deviation of three moduli [kPa].
fn by_the_rule(row: &Printed) -> Result<[f64; 2], Error> {
    let depth = 1e-3 * f64::from(row.depth_mm);
    let modulus = |force| mean_modulus(Contact::Flat(RADIUS), false, depth, force);
    let moduli = [modulus(row.min)?, modulus(row.mean)?, modulus(row.max)?];
    let mean = moduli.iter().sum::<f64>() / 3.0;
    let squares: f64 = moduli.iter().map(|modulus| (modulus - mean).powi(2)).sum();
    Ok([1e-3 * mean, 1e-3 * (squares / 2.0).sqrt()])
}
