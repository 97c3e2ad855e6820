//! Writers of small label maps, for the round trips and for the damaged files.

use std::io::Write;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

/// A label map as a NIfTI-1 file of 16-bit voxels.
pub(crate) struct Nifti {
    pub(crate) size: [usize; 3],
    pub(crate) voxels: Vec<u16>,
    /// The sform: rows of right, front and head [mm].
    pub(crate) rows: [[f64; 4]; 3],
    qform: Option<([f64; 3], [f64; 3])>,
}

impl Nifti {
    /// Voxels of 1 mm.
    pub(crate) fn new(size: [usize; 3], voxels: Vec<u16>) -> Self {
        assert_eq!(voxels.len(), size.iter().product::<usize>());
        let rows = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
        Self {
            size,
            voxels,
            rows,
            qform: None,
        }
    }

    /// With a quaternion in the place of the rows.
    pub(crate) fn with_qform(mut self, turn: &Matrix3<f64>, spacing: [f64; 3]) -> Self {
        let turn = Rotation3::from_matrix_unchecked(*turn);
        let turn = UnitQuaternion::from_rotation_matrix(&turn);
        let sign = turn.w.signum();
        self.qform = Some(([turn.i * sign, turn.j * sign, turn.k * sign], spacing));
        self
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut bytes = vec![0; 352];
        let mut put = |at: usize, part: &[u8]| bytes[at..at + part.len()].copy_from_slice(part);
        put(0, &348i32.to_le_bytes());
        put(40, &3i16.to_le_bytes());
        for k in 0..3 {
            put(42 + 2 * k, &(self.size[k] as i16).to_le_bytes());
        }
        put(70, &512i16.to_le_bytes());
        put(108, &352f32.to_le_bytes());
        put(123, &[2]);
        match self.qform {
            Some((quaternion, spacing)) => {
                put(252, &1i16.to_le_bytes());
                put(76, &1f32.to_le_bytes());
                for k in 0..3 {
                    put(80 + 4 * k, &(spacing[k] as f32).to_le_bytes());
                    put(256 + 4 * k, &(quaternion[k] as f32).to_le_bytes());
                    put(268 + 4 * k, &(self.rows[k][3] as f32).to_le_bytes());
                }
            }
            None => {
                put(254, &1i16.to_le_bytes());
                for (k, c) in self.rows.iter().flatten().enumerate() {
                    put(280 + 4 * k, &(*c as f32).to_le_bytes());
                }
            }
        }
        put(344, b"n+1\0");
        bytes.extend(self.voxels.iter().flat_map(|v| v.to_le_bytes()));
        bytes
    }
}

pub(crate) fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packer.write_all(bytes).unwrap();
    packer.finish().unwrap()
}

/// The same map as NRRD, to the left, the back and the head, whose label 1 is called `ball`.
pub(crate) fn nrrd(map: &Nifti, pack: bool, big_endian: bool) -> Vec<u8> {
    let [x, y, z] = map.rows;
    let column = |k: usize| format!("({},{},{})", -x[k], -y[k], z[k]);
    let [i, j, k] = map.size;
    let encoding = if pack { "gzip" } else { "raw" };
    let endian = if big_endian { "big" } else { "little" };
    let mut bytes = format!(
        "NRRD0004\n# made by a test\ntype: unsigned short\ndimension: 3\nspace: left-posterior-superior\n\
         sizes: {i} {j} {k}\nspace directions: {} {} {}\nkinds: domain domain domain\n\
         endian: {endian}\nencoding: {encoding}\nspace origin: {}\n\
         Segment0_LabelValue:=1\nSegment0_Name:=ball\n\n",
        column(0),
        column(1),
        column(2),
        column(3)
    )
    .into_bytes();
    let voxels = map.voxels.iter();
    let voxels: Vec<u8> = match big_endian {
        true => voxels.flat_map(|v| v.to_be_bytes()).collect(),
        false => voxels.flat_map(|v| v.to_le_bytes()).collect(),
    };
    bytes.extend(if pack { packed(&voxels) } else { voxels });
    bytes
}

/// All formats: a file name and the bytes of a small map.
pub(crate) fn all() -> Vec<(&'static str, Vec<u8>)> {
    let map = Nifti::new([3, 2, 2], (0..12).collect());
    vec![
        ("a.nii", map.bytes()),
        ("a.nii.gz", packed(&map.bytes())),
        ("raw.nrrd", nrrd(&map, false, false)),
        ("packed.nrrd", nrrd(&map, true, true)),
    ]
}
