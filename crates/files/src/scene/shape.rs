use std::path::{Path, PathBuf};

use crate::words::words;
use crate::{Error, Key, Keys};

words! {
    /// A shape that comes with the program.
    pub enum BuiltinOrgan {
        /// The lower esophagus.
        Esophagus = "esophagus",
        /// The liver.
        Liver = "liver",
        /// A kidney.
        Kidney = "kidney",
        /// The stomach.
        Stomach = "stomach",
        /// The spleen.
        Spleen = "spleen",
        /// The diaphragm around the esophagus.
        Diaphragm = "diaphragm",
        /// Radius 0.05 m, base at z = 0 centred on the origin and fixed, pole at +z.
        Hemisphere = "hemisphere",
        /// Edge 0.1 m, from -0.05 m to 0.05 m along each axis, bottom fixed.
        Cube = "cube",
        /// 0.1 m along x and y, 15 mm thick, bottom face at z = 0 centred on the origin and fixed.
        Slab = "slab",
    }
}

words! {
    /// The unit of the coordinates in a mesh file.
    pub enum LengthUnit {
        /// Metres.
        Metre = "m",
        /// Centimetres.
        Centimetre = "cm",
        /// Millimetres.
        Millimetre = "mm",
        /// Micrometres.
        Micrometre = "um",
        /// Inches.
        Inch = "in",
    }
}

/// Where a surface comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A mesh file.
    Mesh {
        /// The file.
        path: PathBuf,
        /// Its unit; none when the scene does not state it.
        unit: Option<LengthUnit>,
    },
    /// A shape that comes with the program.
    Builtin {
        /// Which one.
        organ: BuiltinOrgan,
        /// About how many triangles; none for the shape's own number.
        triangles: Option<usize>,
    },
}

impl Shape {
    /// The keys of a shape, among those of a table that has one.
    pub const KEYS: [Key; 4] = [
        Key::path("mesh", "A mesh file: STL, OBJ, PLY or glTF.")
            .optional("\"liver.stl\"", "`builtin` names a shape"),
        Key::word(
            "mesh_unit",
            LengthUnit::MEANINGS,
            "The unit of the coordinates in the mesh file.",
        )
        .optional(
            "\"mm\"",
            "the file's own unit, or a guess from its size, with a warning",
        ),
        Key::word(
            "builtin",
            BuiltinOrgan::MEANINGS,
            "A shape that comes with the program.",
        )
        .required_without("mesh", "\"liver\""),
        // A closed surface has at least the four triangles of a tetrahedron.
        Key::integer(
            "triangles",
            4,
            10_000_000,
            "About how many triangles a built-in shape has.",
        )
        .optional("2000", "the shape's own number"),
    ];

    /// The shape of a table with the keys `mesh`, `mesh_unit`, `builtin` and `triangles`; the path of a
    /// mesh begins in `folder`.
    ///
    /// # Errors
    /// When the table names no shape or two, or a key does not fit the other.
    pub fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let mesh = keys.text("mesh")?;
        let builtin = keys.word("builtin", BuiltinOrgan::WORDS)?;
        let unit = keys.word("mesh_unit", LengthUnit::WORDS)?;
        let triangles = keys.integer("triangles")?;
        match (mesh, builtin) {
            (Some(mesh), None) => {
                keys.refuse(
                    "triangles",
                    "no number of triangles, for a mesh file has its own",
                )?;
                let path = folder.join(mesh);
                Ok(Self::Mesh { path, unit })
            }
            (None, Some(organ)) => {
                keys.refuse("mesh_unit", "no unit, for a built-in shape is in metres")?;
                Ok(Self::Builtin {
                    organ,
                    triangles: triangles.map(|number| number as usize),
                })
            }
            (Some(_), Some(_)) => Err(keys.given_twice("mesh", "builtin")),
            (None, None) => Err(keys.missing(
                "mesh",
                "`mesh = \"file.stl\"` or `builtin = \"esophagus\"` (or another built-in shape)",
            )),
        }
    }
}
