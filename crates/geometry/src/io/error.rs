use std::path::PathBuf;

use super::text::shortened;
use super::unit::rounded;
use crate::{LengthUnit, MeshError, MeshFormat, TetrahedronError};

/// A mesh file that could not be read: which, and why.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", path.display())]
pub struct ReadError {
    /// The file.
    pub path: PathBuf,
    /// The fault.
    #[source]
    pub fault: ReadFault,
}

impl ReadError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        self.fault.is_input()
    }
}

/// Faults of a mesh file. Each message states what was found, what was expected and the remedy.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum ReadFault {
    /// No file of that name.
    #[error("there is no such file; check the path")]
    Missing,
    /// A folder or a device.
    #[error("this is not a file; give the path of a mesh file")]
    NotAFile,
    /// The system refuses to read it.
    #[error("the file cannot be read ({0}); check its permissions")]
    Unreadable(std::io::Error),
    /// Nothing in it.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// More than a mesh can be.
    #[error("the file holds {found} {what}, at most {most} can be read; simplify the mesh first")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many are allowed.
        most: u64,
    },
    /// The system gives no more memory.
    #[error("there is no memory for {bytes} bytes; close other programs, or give a smaller file")]
    NoMemory {
        /// Memory requested [bytes].
        bytes: u64,
    },
    /// The format is not clear from the name.
    #[error(
        "the extension `{found}` is not one of .stl, .obj, .ply, .gltf, .glb; convert the mesh, or rename the file"
    )]
    UnknownExtension {
        /// The extension, or nothing.
        found: String,
    },
    /// The name gives another format than the content.
    #[error(
        "the extension says {expected}, but the content is {found}; give the file its proper extension"
    )]
    WrongContent {
        /// By the extension.
        expected: MeshFormat,
        /// By the content.
        found: MeshFormat,
    },
    /// A binary STL of the wrong length.
    #[error(
        "{triangles} triangles are announced, which makes {expected} bytes, but {found} were found; the file is damaged, copy or export it again"
    )]
    WrongLength {
        /// The triangles that the file announces.
        triangles: u32,
        /// Bytes for so many triangles.
        expected: u64,
        /// Bytes that are there.
        found: u64,
    },
    /// Binary content that ends too early.
    #[error(
        "{what} needs at least {expected} bytes, but {found} were found; the file is cut short, copy or export it again"
    )]
    Truncated {
        /// The truncated part.
        what: &'static str,
        /// Bytes that are needed at least.
        expected: u64,
        /// Bytes that are there.
        found: u64,
    },
    /// Text that ends too early.
    #[error(
        "the file ends at line {line}, where {expected} was expected; it is cut short, copy or export it again"
    )]
    EndsEarly {
        /// The last line, from one.
        line: usize,
        /// The expected text.
        expected: &'static str,
    },
    /// Something else than the format requires.
    #[error(
        "line {line}: found `{found}` where {expected} was expected; fix the line or export the mesh again"
    )]
    Unexpected {
        /// The line, from one.
        line: usize,
        /// What is there.
        found: String,
        /// What should be there.
        expected: &'static str,
    },
    /// A coordinate that no organ has: NaN, infinite, or beyond 10¹² units.
    #[error(
        "vertex {vertex} has the coordinate {found} where a finite number below 1e12 was expected; remove the vertex or export the mesh again"
    )]
    BadCoordinate {
        /// Number of the vertex in the file, from zero.
        vertex: usize,
        /// The coordinate, in the unit of the file [file unit].
        found: f64,
    },
    /// A face names a vertex that is not there.
    #[error(
        "face {face} names vertex {found}, but the file has {vertices} vertices; it is damaged, export it again"
    )]
    BadIndex {
        /// Number of the face from zero; a polygon may count as its triangles.
        face: usize,
        /// The number as it stands in the file.
        found: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A list whose length is not a whole number.
    #[error(
        "row {row} announces a list of {found} values where a whole number was expected; the file is damaged, export it again"
    )]
    BadListLength {
        /// Number of the row in its table, from zero.
        row: usize,
        /// The length as it stands in the file [-].
        found: f64,
    },
    /// A face with fewer than three corners.
    #[error(
        "face {face} has {found} corners where three or more were expected; remove it or export the mesh again"
    )]
    TooFewCorners {
        /// Number of the face in the file, from zero.
        face: usize,
        /// Corners that it has.
        found: usize,
    },
    /// Nothing but points or lines.
    #[error("the file holds no triangles; export the mesh as a triangulated surface")]
    NoTriangles,
    /// A header without the parts that make a mesh.
    #[error("the header has no {expected}; export the mesh again with vertices and faces")]
    MissingPart {
        /// The requirement of a mesh.
        expected: &'static str,
    },
    /// Something that the standard allows and that is not read here.
    #[error("{what} is not read here; export the mesh without it")]
    Unsupported {
        /// What it is.
        what: &'static str,
    },
    /// A glTF document that breaks its standard.
    #[error("the glTF document is not valid ({cause}); export the mesh again")]
    Gltf {
        /// By the parser.
        cause: String,
    },
    /// A glTF buffer elsewhere than in the folder of the document.
    #[error(
        "the buffer `{uri}` is not a file in the folder of the mesh; put it there, or export as .glb"
    )]
    BufferElsewhere {
        /// As the document has it.
        uri: String,
    },
    /// No unit is known, and metres are not plausible.
    #[error(
        "no unit is known and the largest extent is {extent}: an organ has 0.005 to 0.6 m, this has {extent} m in metres and {in_millimetres} m in millimetres; set mesh_unit to \"m\", \"cm\", \"mm\" or \"um\""
    )]
    UnitNeeded {
        /// Largest extent, to four digits [file unit].
        extent: f64,
        /// The same taken as millimetres, to four digits [m].
        in_millimetres: f64,
    },
    /// The name gives no format that holds volumes.
    #[error(
        "the extension `{found}` is not one of .msh, .vtk, .vtu; save the tetrahedra as one of these"
    )]
    UnknownVolumeExtension {
        /// The extension, or nothing.
        found: String,
    },
    /// A way of writing the numbers that is not read here.
    #[error("{what} is not read here; {remedy}")]
    UnreadEncoding {
        /// How the file is written.
        what: &'static str,
        /// How to write one that can be read.
        remedy: &'static str,
    },
    /// A volume element that is no tetrahedron.
    #[error(
        "cell {cell} is {found} where a tetrahedron was expected; mesh the volume with tetrahedra only"
    )]
    NotATetrahedron {
        /// Number of the cell in the file, from zero.
        cell: usize,
        /// What it is.
        found: String,
    },
    /// A cell names a vertex that is not there.
    #[error(
        "cell {cell} names vertex {found}, which is not among the {vertices} of the file; it is damaged, export it again"
    )]
    BadCorner {
        /// Number of the cell in the file, from zero.
        cell: usize,
        /// The number as it stands in the file.
        found: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Lists that should go together and do not.
    #[error("the file has {found} {what} where {expected} were expected; export it again")]
    Mismatch {
        /// What there is a wrong number of.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// Nothing but points, lines or triangles.
    #[error("the file holds no tetrahedra; export the volume, not only its surface")]
    NoTetrahedra,
    /// The name gives no format that meshes are written in.
    #[error(
        "the extension `{found}` is not one of .stl, .obj, .ply, .vtp; give the file one of these"
    )]
    UnwrittenExtension {
        /// The extension, or nothing.
        found: String,
    },
    /// The name gives no format that holds label maps.
    #[error(
        "the extension `{found}` is not one of .nii, .nii.gz, .nrrd, and this is no DICOM file; save the label map as one of these"
    )]
    UnknownMapExtension {
        /// The extension, or nothing.
        found: String,
    },
    /// An image header with an invalid value.
    #[error(
        "the header's {what} is {found} where {expected} was expected; save the label map again"
    )]
    BadHeader {
        /// Which entry.
        what: &'static str,
        /// Its value.
        found: String,
        /// What should be there.
        expected: &'static str,
    },
    /// Compressed bytes that cannot be unpacked.
    #[error("the compressed part is damaged ({0}); copy or save the file again")]
    BadCompression(std::io::Error),
    /// A compressed frame of a DICOM file that cannot be decompressed.
    #[error(
        "frame {frame} of the compressed pixels is invalid ({cause}); copy or export the file again, or decompress it with `gdcmconv --raw IN OUT` for instance"
    )]
    BadFrame {
        /// Number of the frame in the file, from one.
        frame: usize,
        /// By the decoder.
        cause: String,
    },
    /// A DICOM file that breaks its standard.
    #[error("the DICOM data cannot be read ({cause}); copy or export the file again")]
    Dicom {
        /// By the parser.
        cause: String,
    },
    /// An image instead of a segmentation.
    #[error(
        "this is a DICOM object of modality `{modality}`, not a segmentation (SEG); segment the images, with 3D Slicer or TotalSegmentator for instance, and give what they save"
    )]
    NotASegmentation {
        /// As the file has it.
        modality: String,
    },
    /// A folder with no segmentation object, or several.
    #[error(
        "{found} DICOM segmentations (SEG) were found where one was expected; give the file of a segmentation, or one that 3D Slicer or TotalSegmentator made of the images"
    )]
    NotOneSegmentation {
        /// How many there are.
        found: usize,
    },
    /// A voxel of a picture that is no label.
    #[error(
        "voxel {voxel} has the value {found} where a label, a whole number from 0 to 65535, was expected; give the label map instead of the picture"
    )]
    NotALabel {
        /// Number of the voxel in the file, from zero.
        voxel: usize,
        /// Its value [-].
        found: f64,
    },
    /// Read, and yet not a mesh of tetrahedra.
    #[error(transparent)]
    Tetrahedra(#[from] TetrahedronError),
    /// Read, and yet not a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A word that is not a unit of length.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{found}` is not a unit of length; use \"m\", \"cm\", \"mm\" or \"um\"")]
pub struct UnknownUnit {
    /// The word.
    pub found: String,
}

impl ReadFault {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Unreadable(cause) => cause.kind() == std::io::ErrorKind::PermissionDenied,
            Self::Tetrahedra(error) => error.is_input(),
            Self::Mesh(error) => error.is_input(),
            Self::NoMemory { .. } => false,
            Self::Missing
            | Self::NotAFile
            | Self::Empty
            | Self::TooLarge { .. }
            | Self::UnknownExtension { .. }
            | Self::WrongContent { .. }
            | Self::WrongLength { .. }
            | Self::Truncated { .. }
            | Self::EndsEarly { .. }
            | Self::Unexpected { .. }
            | Self::BadCoordinate { .. }
            | Self::BadIndex { .. }
            | Self::BadListLength { .. }
            | Self::TooFewCorners { .. }
            | Self::NoTriangles
            | Self::MissingPart { .. }
            | Self::Unsupported { .. }
            | Self::Gltf { .. }
            | Self::BufferElsewhere { .. }
            | Self::UnitNeeded { .. }
            | Self::UnknownVolumeExtension { .. }
            | Self::UnreadEncoding { .. }
            | Self::NotATetrahedron { .. }
            | Self::BadCorner { .. }
            | Self::Mismatch { .. }
            | Self::NoTetrahedra
            | Self::UnwrittenExtension { .. }
            | Self::UnknownMapExtension { .. }
            | Self::BadHeader { .. }
            | Self::BadCompression(_)
            | Self::BadFrame { .. }
            | Self::Dicom { .. }
            | Self::NotASegmentation { .. }
            | Self::NotOneSegmentation { .. }
            | Self::NotALabel { .. } => true,
        }
    }

    /// The cause is shortened: a damaged document is quoted in it.
    pub(crate) fn invalid_gltf(cause: impl ToString) -> Self {
        let cause = shortened(&cause.to_string()).into_owned();
        Self::Gltf { cause }
    }

    /// No unit is known for a mesh of this largest extent [file unit].
    pub(crate) fn unit_needed(extent: f64) -> Self {
        Self::UnitNeeded {
            extent: rounded(extent),
            in_millimetres: rounded(extent * LengthUnit::Millimetre.in_metres()),
        }
    }
}
