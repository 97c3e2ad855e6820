use super::ForeignColumns;
use crate::Error;
use crate::table::{Column, Row, TableText};
use crate::units::Unit;
use crate::words::or_list;

/// A quantity of a recording: the name of its column, its unit if the user states one, and its SI unit.
struct Quantity<'c> {
    name: &'c str,
    stated: Option<&'c str>,
    si: &'static str,
}

/// The columns of time, depth and force with their units, and whether a row below the names holds
/// the units.
pub(super) fn columns(
    table: &TableText<'_>,
    wanted: &ForeignColumns,
) -> Result<([Column; 3], bool), Error> {
    let [time, depth, force] = wanted.wanted().map(|quantity| quantity.choose(table));
    let quantities = [
        (time?, None, "s"),
        (depth?, wanted.depth_unit.as_deref(), "m"),
        (force?, wanted.force_unit.as_deref(), "n"),
    ]
    .map(|(name, stated, si)| Quantity::new(name, stated, si));
    let [time, depth, force] = quantities.each_ref().map(|quantity| {
        let unit = Unit::named(quantity.si).expect("SI units are in the table");
        table.foreign_column(quantity.name, unit, unit)
    });
    let plain = [time?, depth?, force?];
    let row_units = match table.rows().next()? {
        Some(row) => of_row(&row, &plain),
        None => None,
    };
    let column = |number: usize| {
        let quantity = &quantities[number];
        let below = row_units.map(|units: [&'static Unit; 3]| units[number]);
        let from = quantity.unit(table, below)?;
        let to = Unit::named(quantity.si).expect("SI units are in the table");
        table.foreign_column(quantity.name, from, to)
    };
    Ok(([column(0)?, column(1)?, column(2)?], row_units.is_some()))
}

/// The units of the columns of a displacement and a force, by their names, by a row of units below or as they are stated;
/// and whether there is such a row.
pub(super) fn displacement_and_force(
    table: &TableText<'_>,
    [depth, force]: [&str; 2],
    wanted: &ForeignColumns,
) -> Result<([&'static Unit; 2], bool), Error> {
    let depth = Quantity::new(depth, wanted.depth_unit.as_deref(), "m");
    let force = Quantity::new(force, wanted.force_unit.as_deref(), "n");
    pair(table, [depth, force])
}

/// The same of a stretch or a strain, and a stress, whose unit is stated as that of forces.
pub(super) fn stretch_and_stress(
    table: &TableText<'_>,
    [stretch, stress]: [&str; 2],
    wanted: &ForeignColumns,
) -> Result<([&'static Unit; 2], bool), Error> {
    let stretch = Quantity::new(stretch, None, "one");
    let stress = Quantity::new(stress, wanted.force_unit.as_deref(), "pa");
    pair(table, [stretch, stress])
}

fn pair(
    table: &TableText<'_>,
    quantities: [Quantity<'_>; 2],
) -> Result<([&'static Unit; 2], bool), Error> {
    let [first, second] = quantities.each_ref().map(|quantity| {
        let unit = Unit::named(quantity.si).expect("SI units are in the table");
        table.foreign_column(quantity.name, unit, unit)
    });
    let plain = [first?, second?];
    let below = match table.rows().next()? {
        Some(row) => of_row(&row, &plain),
        None => None,
    };
    let of = |place: usize| quantities[place].unit(table, below.map(|units| units[place]));
    Ok(([of(0)?, of(1)?], below.is_some()))
}

/// The units in a row that holds units in place of numbers.
pub(super) fn of_row<const COLUMNS: usize>(
    row: &Row<'_>,
    columns: &[Column; COLUMNS],
) -> Option<[&'static Unit; COLUMNS]> {
    let units = columns.each_ref().map(|column| {
        let word = row.text(column);
        named(word.trim_matches(['(', ')', '[', ']']))
    });
    let found: Vec<_> = units.into_iter().flatten().collect();
    found.try_into().ok()
}

/// The unit of a force in place of that of a mass: the weight of the mass.
fn of_weight(unit: &'static Unit) -> &'static Unit {
    let weight = match unit.suffix {
        "g" => Unit::named("gf"),
        "kg" => Unit::named("kgf"),
        _ => None,
    };
    weight.unwrap_or(unit)
}

impl<'c> Quantity<'c> {
    fn new(name: &'c str, stated: Option<&'c str>, si: &'static str) -> Self {
        Self { name, stated, si }
    }

    fn unit(
        &self,
        table: &TableText<'_>,
        below: Option<&'static Unit>,
    ) -> Result<&'static Unit, Error> {
        let written = match in_name(self.name) {
            Some(Written::Unit(unit)) => Some(unit),
            Some(Written::Strange) => return Err(self.unknown(table, self.name)),
            None => below,
        };
        let stated = match self.stated {
            None => None,
            Some(text) => Some(
                named(text)
                    .ok_or_else(|| self.unknown(table, &format!("{} [{text}]", self.name)))?,
            ),
        };
        let unit = match (written, stated) {
            (Some(written), Some(stated)) if written != stated => {
                return Err(Error::GivenTwice {
                    place: table.column_place(),
                    first: format!("{} in {}", self.name, written.spelling),
                    second: format!("{} in {}", self.name, stated.spelling),
                });
            }
            (written, stated) => stated.or(written),
        };
        let unit = match self.si {
            "n" => unit.map(of_weight),
            _ => unit,
        };
        match unit {
            Some(unit) if unit.si == self.si => Ok(unit),
            // Programs rarely state that time is in seconds, or that a ratio has no unit.
            None if ["s", "one"].contains(&self.si) => {
                Ok(Unit::named(self.si).expect("SI units are in the table"))
            }
            _ => Err(self.unknown(table, self.name)),
        }
    }

    fn unknown(&self, table: &TableText<'_>, key: &str) -> Error {
        let si = Unit::named(self.si).expect("SI units are in the table");
        let units: Vec<_> = si.alternatives().map(|unit| unit.spelling).collect();
        Error::UnknownUnit {
            place: table.column_place(),
            key: key.to_owned(),
            accepted: format!(
                "{}, in brackets behind the name or next to it",
                or_list(&units)
            ),
        }
    }
}

/// The part of a name that may hold a unit.
enum Written {
    Unit(&'static Unit),
    /// Brackets around something else.
    Strange,
}

/// The unit of `Load (mN)`, `Load [mN]`, `load_mn` or `Load mN`.
fn in_name(name: &str) -> Option<Written> {
    let (_, unit, in_brackets) = parts(name)?;
    match named(unit) {
        Some(unit) => Some(Written::Unit(unit)),
        None => in_brackets.then_some(Written::Strange),
    }
}

/// A name without the unit that it carries.
pub(super) fn base(name: &str) -> &str {
    match parts(name) {
        Some((base, unit, in_brackets)) if in_brackets || named(unit).is_some() => base,
        _ => name,
    }
}

/// The text before a unit, the text of the unit, and whether that is in brackets.
fn parts(name: &str) -> Option<(&str, &str, bool)> {
    if let Some(inner) = name.strip_suffix([')', ']'])
        && let Some((base, unit)) = inner.rsplit_once(['(', '['])
    {
        return Some((base, unit.trim(), true));
    }
    let (base, end) = name.rsplit_once(['_', ' '])?;
    Some((base, end, false))
}

/// A unit as programs write it, some of them in words.
fn named(text: &str) -> Option<&'static Unit> {
    let text = match text.to_lowercase().as_str() {
        "sec" | "second" | "seconds" => "s",
        "msec" => "ms",
        "newton" => "N",
        _ => text,
    };
    Unit::named(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_names() {
        let spelling = |name| match in_name(name) {
            Some(Written::Unit(unit)) => unit.spelling,
            Some(Written::Strange) => "strange",
            None => "none",
        };
        assert_eq!(spelling("Compression (mm)"), "mm");
        assert_eq!(spelling("Load [ mN ]"), "mN");
        assert_eq!(spelling("force_N"), "N");
        assert_eq!(spelling("Time s"), "s");
        assert_eq!(spelling("Time (sec)"), "s");
        assert_eq!(spelling("Load (lbf)"), "strange");
        assert_eq!(spelling("Load"), "none");
        assert_eq!(spelling("raw_load"), "none");
        assert_eq!(base("Load (lbf)").trim(), "Load");
        assert_eq!(base("raw_load"), "raw_load");
    }
}
