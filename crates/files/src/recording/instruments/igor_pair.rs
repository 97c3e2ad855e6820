//! Two waves of one column that are one curve: the deflection, and beside it the position of the base. In their names one
//! says `Defl` where the other says `ZSnsr`: `Curve0007Defl.ibw`, `Curve0007ZSnsr.ibw`.

use std::path::{Path, PathBuf};

use super::igor::{DEFLECTIONS, POSITIONS, VOLTS};
use super::igor_wave::columns;
use crate::whole_file::{MOST_OF_TABLE, read_bytes};

/// The file with the position of the base that belongs to the file of a deflection; none where there is no such file.
pub fn position_beside(deflection: &Path) -> Option<PathBuf> {
    position_named(deflection, &POSITIONS).map(|(_, path)| path)
}

/// As [`position_beside`], with one of these names of positions, and which one.
pub(super) fn position_named<'n>(
    deflection: &Path,
    positions: &[&'n str],
) -> Option<(&'n str, PathBuf)> {
    renamed(deflection, &deflection_names(), positions)
}

/// The file with the deflection to which the position of the base in a file belongs; none where the file has more than
/// one column, or no deflection is beside it.
pub fn deflection_beside(position: &Path) -> Option<PathBuf> {
    let (_, deflection) = renamed(position, &POSITIONS, &deflection_names())?;
    let bytes = read_bytes(position, MOST_OF_TABLE).ok()?;
    (columns(&bytes)? == 1).then_some(deflection)
}

/// What a deflection is called, the longest names first: one of them begins another.
fn deflection_names() -> [&'static str; 4] {
    [VOLTS[1], DEFLECTIONS[1], VOLTS[0], DEFLECTIONS[0]]
}

/// The first file that is there with a new name in place of an old one, where that stands last, and the new name.
fn renamed<'n>(path: &Path, old: &[&str], new: &[&'n str]) -> Option<(&'n str, PathBuf)> {
    let is_wave = path
        .extension()
        .is_some_and(|own| own.eq_ignore_ascii_case("ibw"));
    let name = path.file_name()?.to_str().filter(|_| is_wave)?;
    let found = old.iter().find_map(|old| Some((name.rfind(old)?, old)));
    let (at, old) = found?;
    let (before, after) = (&name[..at], &name[at + old.len()..]);
    let other = |new: &&'n str| (*new, path.with_file_name(format!("{before}{new}{after}")));
    new.iter().map(other).find(|(_, other)| other.is_file())
}
