use std::collections::BTreeMap;

use nalgebra::Matrix3;

use crate::Vec3;

/// A segmented picture: a label at each voxel of a block, zero where there is nothing.
///
/// Positions are those of the built-in organs: metres, x to the patient's left, y to the back, z to
/// the head (LPS), whatever the file counted in.
#[derive(Debug, Clone, PartialEq)]
pub struct LabelMap {
    pub(crate) size: [usize; 3],
    /// The first index runs fastest.
    pub(crate) labels: Vec<u16>,
    /// Steps from voxel to voxel, as columns [m].
    pub(crate) steps: Matrix3<f64>,
    /// Middle of the first voxel [m].
    pub(crate) origin: Vec3,
    pub(crate) names: BTreeMap<u16, String>,
    pub(crate) warnings: Vec<String>,
}

/// One label of a [`LabelMap`].
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Label {
    /// Its value in the voxels, never zero.
    pub number: u16,
    /// Its name in the file.
    pub name: Option<String>,
    /// How many voxels have it.
    pub voxels: usize,
    /// Volume of these [m³].
    #[serde(rename = "volume_m3")]
    pub volume: f64,
}

impl LabelMap {
    /// Voxels along each index.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Distances between voxels along each index [m].
    pub fn spacing(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.steps.column(k).norm())
    }

    /// Warnings.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The labels that occur, in ascending order.
    pub fn labels(&self) -> Vec<Label> {
        let mut counts = vec![0usize; 1 + usize::from(u16::MAX)];
        for &label in &self.labels {
            counts[usize::from(label)] += 1;
        }
        let present = (1..=u16::MAX).filter(|&n| counts[usize::from(n)] > 0);
        present
            .map(|number| Label {
                number,
                name: self.names.get(&number).cloned(),
                voxels: counts[usize::from(number)],
                volume: counts[usize::from(number)] as f64 * self.voxel_volume(),
            })
            .collect()
    }

    /// Gives names to labels that the file does not name.
    pub fn add_names(&mut self, names: impl IntoIterator<Item = (u16, String)>) {
        for (number, name) in names {
            self.names.entry(number).or_insert(name);
        }
    }

    /// The same with the voxels of `others` as voxels of `organ`: an organ with the labels inside
    /// of it.
    #[must_use]
    pub fn with_inside(&self, organ: u16, others: &[u16]) -> Self {
        let joined = |label: &u16| match others.contains(label) {
            true => organ,
            false => *label,
        };
        self.with_labels(self.labels.iter().map(joined).collect())
    }

    fn with_labels(&self, labels: Vec<u16>) -> Self {
        Self {
            labels,
            size: self.size,
            steps: self.steps,
            origin: self.origin,
            names: self.names.clone(),
            warnings: self.warnings.clone(),
        }
    }

    /// The same where every voxel of the labels `inside` has only `organ` and its own label around it: voxels that touch another
    /// label or an earlier one of them, over a corner too, become `organ`. Also returns the number of these voxels of each.
    #[must_use]
    pub fn separated(&self, organ: u16, inside: &[u16]) -> (Self, Vec<usize>) {
        let [nx, ny, nz] = self.size;
        let mut labels = self.labels.clone();
        let mut moved = vec![0; inside.len()];
        for (at, own) in self.labels.iter().enumerate() {
            let Some(place) = inside.iter().position(|label| label == own) else {
                continue;
            };
            let is_near = |label: u16| {
                let later = inside.iter().skip(place);
                label == organ || later.clone().any(|other| *other == label)
            };
            let index = [at % nx, at / nx % ny, at / nx / ny];
            let is_apart = (0..27).all(|step| {
                let step: [usize; 3] = [step % 3, step / 3 % 3, step / 9];
                let [i, j, k] = [0, 1, 2].map(|axis| (index[axis] + step[axis]).wrapping_sub(1));
                i < nx && j < ny && k < nz && is_near(self.labels[i + nx * (j + ny * k)])
            });
            if !is_apart {
                labels[at] = organ;
                moved[place] += 1;
            }
        }
        (self.with_labels(labels), moved)
    }

    /// Volume of one voxel [m³].
    pub(crate) fn voxel_volume(&self) -> f64 {
        self.steps.determinant().abs()
    }

    /// Position of an index, whole or not, in space [m].
    pub(crate) fn position(&self, index: &Vec3) -> Vec3 {
        self.origin + self.steps * index
    }
}
