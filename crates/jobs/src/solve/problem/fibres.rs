//! Directions of fibres.

use std::path::Path;

use palpate_files::{Domain, Error, FibreDirections, Key, Keys, Tissue};
use palpate_mechanics::{FibreField, FibreFrame, FibreSample, Vec3};

/// Directions of fibres over a body.
#[derive(Debug, Clone)]
pub(crate) struct Fibres {
    pub(crate) field: FibreField,
    /// Whether the plane of the two families is known, and not only their axis.
    has_plane: bool,
}

impl Fibres {
    pub(crate) const KEYS: &'static [Key] = &[
        Key::direction(
            "axis",
            "The reference axis, the same everywhere.",
        )
        .optional("[1.0, 0.0, 0.0]", "`around` or `file` says it")
        .in_template(),
        Key::direction(
            "across",
            "With `axis`: a second direction in the plane of the two families, such as that across the reference axis.",
        )
        .optional("[0.0, 1.0, 0.0]", "none, which is enough for families at 0 degrees")
        .in_template(),
        Key::table(
            "around",
            AROUND,
            "The line that a tube lies around: the reference axis runs around it, and the plane of the families along it.",
        )
        .optional("", "`axis` or `file` says it"),
        Key::path(
            "file",
            "A table (CSV) of directions, such as one at the middle of each cell of a mesh: `x_m`, `y_m`, `z_m`, the reference \
             axis `axis_x`, `axis_y`, `axis_z`, and `across_x`, `across_y`, `across_z`. A place has those of the nearest row.",
        )
        .optional("\"fibres.csv\"", "`axis` or `around` says it"),
    ];

    /// Those of the table `fibres`, if it is there.
    pub(crate) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Option<Self>, Error> {
        let Some(keys) = keys.table("fibres")? else {
            return Ok(None);
        };
        let (axis, around) = (keys.direction("axis")?, keys.table("around")?);
        let (across, file) = (keys.direction("across")?, keys.text("file")?);
        if axis.is_none() {
            keys.refuse("across", "no second direction without `axis`")?;
        }
        match (axis, around, file) {
            (Some(axis), None, None) => Self::constant(&keys, axis, across).map(Some),
            (None, Some(around), None) => {
                let point = around.required_vector("point_m")?.into();
                let line = around.direction("line")?;
                let line = line.and_then(|line| FibreField::around(point, line.into()));
                let field = line.ok_or_else(|| {
                    around.missing("line", "the direction of the line, such as [0.0, 0.0, 1.0]")
                })?;
                Ok(Some(Self {
                    field,
                    has_plane: true,
                }))
            }
            (None, None, Some(file)) => Self::read(&folder.join(file)).map(Some),
            (None, None, None) => Err(keys.missing(
                "axis",
                "a direction such as [1.0, 0.0, 0.0], or `around = { point_m, line }`, or `file = \"fibres.csv\"`",
            )),
            (Some(_), Some(_), _) => Err(keys.given_twice("axis", "around")),
            (Some(_), None, Some(_)) => Err(keys.given_twice("axis", "file")),
            (None, Some(_), Some(_)) => Err(keys.given_twice("around", "file")),
        }
    }

    fn constant(keys: &Keys<'_>, axis: [f64; 3], across: Option<[f64; 3]>) -> Result<Self, Error> {
        let frame = match across {
            Some(across) => FibreFrame::new(&axis.into(), &across.into())
                .ok_or_else(|| keys.invalid("across", "a direction that is not that of `axis`"))?,
            None => FibreFrame::along(&axis.into())
                .ok_or_else(|| keys.invalid("axis", "a direction of finite length"))?,
        };
        Ok(Self {
            field: FibreField::constant(frame),
            has_plane: across.is_some(),
        })
    }

    fn read(path: &Path) -> Result<Self, Error> {
        let directions = FibreDirections::read(path)?;
        let sample = |row: &palpate_files::FibreDirection| {
            let axis = Vec3::from(row.axis);
            let frame = match row.across {
                Some(across) => FibreFrame::new(&axis, &across.into()),
                None => FibreFrame::along(&axis),
            };
            Some(FibreSample {
                place: row.position_m.into(),
                frame: frame?,
            })
        };
        // The reader has refused what gives none.
        let samples = directions.rows.iter().filter_map(sample).collect();
        Ok(Self {
            field: FibreField::nearest(samples)
                .unwrap_or_else(|| FibreField::constant(FibreFrame::ALONG_AXES)),
            has_plane: directions.rows.iter().all(|row| row.across.is_some()),
        })
    }
}

const AROUND: &[Key] = &[
    Key::vector("point_m", Domain::POSITION, "A point of the line.").required("[0.0, 0.0, 0.0]"),
    Key::direction("line", "The direction of the line.").required("[0.0, 0.0, 1.0]"),
];

/// Checks that a solid defines the fibre directions that its tissue needs.
pub(super) fn check<'t>(
    keys: &Keys<'_>,
    fibres: Option<&Fibres>,
    tissues: impl Iterator<Item = &'t Tissue>,
) -> Result<(), Error> {
    let with_fibres: Vec<_> = tissues
        .map(|tissue| &tissue.elasticity)
        .filter(|elasticity| elasticity.law().has_fibres())
        .collect();
    let Some(law) = with_fibres.first().map(|elasticity| elasticity.law()) else {
        return keys.refuse("fibres", "no directions, for the tissues have no fibres");
    };
    let is_one = with_fibres.iter().all(|elasticity| {
        let parameters = elasticity.parameters();
        let angle = parameters.iter().find(|(key, _)| *key == "fibre_angle_deg");
        angle.is_some_and(|(_, angle)| angle.value == 0.0)
    });
    match fibres {
        None => Err(keys.missing(
            "fibres",
            format!(
                "the directions of the fibres of the law {law}, such as `fibres = {{ axis = [1.0, 0.0, 0.0], across = [0.0, \
                 1.0, 0.0] }}`"
            ),
        )),
        Some(fibres) if !(fibres.has_plane || is_one) => Err(keys.missing(
            "fibres.across",
            "a second direction in the plane of the two families, which lie at `fibre_angle_deg` to the axis",
        )),
        Some(_) => Ok(()),
    }
}

/// A kind of problem without fibre directions accepts no tissue with fibres.
pub(super) fn refuse(keys: &Keys<'_>, tissue: &Tissue, why: &'static str) -> Result<(), Error> {
    let law = tissue.elasticity.law();
    if !law.has_fibres() {
        return Ok(());
    }
    Err(Error::BadValue {
        place: keys.place_of_key("tissue"),
        key: keys.full_name("tissue.law"),
        found: format!("\"{law}\""),
        expected: format!("an isotropic law, such as \"neo_hookean\", for {why}").into(),
    })
}
