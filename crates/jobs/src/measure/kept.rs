//! Specimens that took a minute to solve are kept by their content:
//!
//! ```text
//! palpate specimen 1
//! key = <64 hexadecimal digits>     what it was solved from
//! depth_m,force_n
//! <a line for each depth>
//! <SHA-256 of all that stands before, 64 hexadecimal digits>
//! ```
//!
//! A file that does not fit, or is damaged, is made again.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use palpate_files::tissue::LawName;
use palpate_files::{MOST_OF_DOCUMENT, Tissue, read_text, write_whole};
use palpate_measure::{Error, VirtualSpecimen};
use palpate_mechanics::IndentationCurve;
use sha2::{Digest, Sha256};

use crate::preparation;

/// Change with the equations, so that what was kept before is solved anew.
const METHOD: &str = "finite elements under a punch 2";

/// A specimen of `tissue` under a punch of a radius [m], down to a depth [m]; from its file when it was solved
/// before.
pub(crate) fn of_tissue(
    tissue: &Tissue,
    radius: f64,
    deepest: f64,
    at_step: &mut dyn FnMut(f64),
) -> Result<VirtualSpecimen, Error> {
    let linear = tissue.elasticity.law() == LawName::Linear;
    let Some(folder) = preparation::folder().filter(|_| !linear) else {
        return VirtualSpecimen::of_tissue(tissue, radius, deepest, at_step);
    };
    let from = format!(
        "{METHOD} {:?} {:?} {radius:?} {deepest:?}",
        tissue.elasticity, tissue.prony
    );
    let key = digest(&from);
    let file = folder.join(format!("{key}.specimen"));
    if let Some(curve) = read(&file, &key) {
        return VirtualSpecimen::of_solved(tissue, radius, curve);
    }
    let specimen = VirtualSpecimen::of_tissue(tissue, radius, deepest, at_step)?;
    if let Some(curve) = specimen.solved() {
        keep(&file, &print(&key, curve));
    }
    Ok(specimen)
}

/// Writes what can always be made again, if that is possible.
fn keep(file: &Path, text: &str) {
    if let Some(folder) = file.parent()
        && fs::create_dir_all(folder).is_ok()
    {
        // Without it the next time takes a minute again.
        let _ = write_whole(file, text.as_bytes());
    }
}

fn print(key: &str, curve: &IndentationCurve) -> String {
    let mut text = format!("palpate specimen 1\nkey = {key}\ndepth_m,force_n\n");
    for (depth, force) in curve.points() {
        writeln!(text, "{depth:?},{force:?}").expect("a string takes every text");
    }
    let checksum = digest(&text);
    text + &checksum + "\n"
}

fn read(file: &Path, key: &str) -> Option<IndentationCurve> {
    parse(&read_text(file, MOST_OF_DOCUMENT).ok()?, key)
}

/// The curve in `text`; none when it is another's or not whole.
fn parse(text: &str, key: &str) -> Option<IndentationCurve> {
    let before = text.strip_suffix('\n')?;
    let (_, checksum) = before.rsplit_once('\n')?;
    let said = text.strip_suffix(&format!("{checksum}\n"))?;
    let head = format!("palpate specimen 1\nkey = {key}\ndepth_m,force_n\n");
    let rows = said
        .strip_prefix(&head)
        .filter(|_| digest(said) == checksum)?;
    let number = |text: &str| text.parse::<f64>().ok();
    let points = rows.lines().map(|line| {
        let (depth, force) = line.split_once(',')?;
        Some((number(depth)?, number(force)?))
    });
    let (depths, forces): (Vec<f64>, Vec<f64>) =
        points.collect::<Option<Vec<_>>>()?.into_iter().unzip();
    Some(IndentationCurve::through(&depths, &forces))
}

fn digest(text: &str) -> String {
    let bytes = Sha256::digest(text);
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is read back is what was kept, to the bit; any change of a byte is seen.
    #[test]
    fn a_curve_comes_back_or_not_at_all() {
        let curve = IndentationCurve::through(&[1e-4, 1.1e-3, 0.0043], &[1.0 / 3.0, 0.7, 1.9]);
        let text = print("abc", &curve);
        assert_eq!(parse(&text, "abc"), Some(curve));
        assert_eq!(parse(&text, "abd"), None);
        for place in 0..text.len() {
            let mut damaged = text.clone().into_bytes();
            damaged[place] ^= 1;
            let damaged = String::from_utf8(damaged).unwrap();
            assert_eq!(parse(&damaged, "abc"), None, "{place}");
            assert_eq!(parse(&text[..place], "abc"), None, "{place}");
        }
    }
}
