//! Two waves of one column that form one curve: the deflection, and in the same folder the position of the base.
//! Where one name has `Defl` the other has `ZSnsr`: `Curve0007Defl.ibw`, `Curve0007ZSnsr.ibw`.

use std::path::{Path, PathBuf};

use super::igor::{DEFLECTIONS, POSITIONS, VOLTS};
use super::igor_wave::columns;
use crate::atomic_write::{MAX_TABLE_BYTES, read_bytes};

/// The file with the position of the base that belongs to the file of a deflection; none where there is no such file.
pub fn position_beside(deflection: &Path) -> Option<PathBuf> {
    position_named(deflection, &POSITIONS).map(|(_, path)| path)
}

/// As [`position_beside`], for these names of positions; also returns the matching name.
pub(super) fn position_named<'n>(
    deflection: &Path,
    positions: &[&'n str],
) -> Option<(&'n str, PathBuf)> {
    renamed(deflection, &deflection_names(), positions)
}

/// The file with the deflection that belongs to the file of a position; none where the file has more than one column,
/// or no deflection is in the same folder.
pub fn deflection_beside(position: &Path) -> Option<PathBuf> {
    let (_, deflection) = renamed(position, &POSITIONS, &deflection_names())?;
    let bytes = read_bytes(position, MAX_TABLE_BYTES).ok()?;
    (columns(&bytes)? == 1).then_some(deflection)
}

/// Names of a deflection, the longest first: one of them begins another.
fn deflection_names() -> [&'static str; 4] {
    [VOLTS[1], DEFLECTIONS[1], VOLTS[0], DEFLECTIONS[0]]
}

/// The first existing file with a new name in place of the last occurrence of an old one, and the new name.
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
