//! Content-addressed cache of specimens that take a minute to solve:
//!
//! ```text
//! palpate specimen 1
//! key = <64 hexadecimal digits>     what it was solved from
//! depth_m,force_n
//! <a line for each depth>
//! <SHA-256 of all that stands before, 64 hexadecimal digits>
//! ```
//!
//! A file that does not match or is damaged is written again.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use palpate_files::tissue::LawName;
use palpate_files::{MAX_DOCUMENT_BYTES, Tissue, read_text, write_atomically};
use palpate_measure::{Error, VirtualSpecimen};
use palpate_mechanics::IndentationCurve;
use sha2::{Digest, Sha256};

use crate::preparation;

/// Change this with the equations, to invalidate the cache.
const METHOD: &str = "finite elements under a punch 2";

/// A specimen of `tissue` under a punch of a radius [m], down to a depth [m]; from the cache if it is there.
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
        write(&file, &print(&key, curve));
    }
    Ok(specimen)
}

/// Writes a file of the cache, ignoring errors: it can always be computed again.
fn write(file: &Path, text: &str) {
    if let Some(folder) = file.parent()
        && fs::create_dir_all(folder).is_ok()
    {
        // Without it the next run solves for a minute again.
        let _ = write_atomically(file, text.as_bytes());
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
    parse(&read_text(file, MAX_DOCUMENT_BYTES).ok()?, key)
}

/// The curve in `text`; none when it belongs to another key or is incomplete.
fn parse(text: &str, key: &str) -> Option<IndentationCurve> {
    let before = text.strip_suffix('\n')?;
    let (_, checksum) = before.rsplit_once('\n')?;
    let body = text.strip_suffix(&format!("{checksum}\n"))?;
    let head = format!("palpate specimen 1\nkey = {key}\ndepth_m,force_n\n");
    let rows = body
        .strip_prefix(&head)
        .filter(|_| digest(body) == checksum)?;
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

    /// A cached curve is read back to the bit; any changed byte is detected.
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
