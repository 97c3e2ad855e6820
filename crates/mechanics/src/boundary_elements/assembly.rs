use faer::{Mat, MatRef};
use nalgebra::Matrix3;
use palpate_geometry::{Surface, on_all_cores};

use super::integrals::{Place, Source};
use super::kelvin::Kelvin;
use super::panel::Panel;
use super::precision::Precision;
use super::rotations::TractionColumns;
use crate::{Error, LinearElastic};

/// All influences of panels on panels: 3 n × 3 n, row 3 i + a for component a at the centroid of panel i.
pub struct InfluenceMatrices {
    /// U [m³/N]: of the traction on each panel.
    pub displacement: Mat<f64>,
    /// ½ 1 + T [-]: of the displacement of each panel; rotations of the whole solid have no traction.
    pub traction: Mat<f64>,
}

/// The panels of a solid.
pub struct Influences<'a> {
    kelvin: Kelvin,
    pub(super) surface: &'a Surface,
    pub(super) panels: Vec<Panel>,
}

impl<'a> Influences<'a> {
    /// Those of the solid within `surface`, of the tissue `law`.
    ///
    /// # Errors
    /// When a triangle has no area.
    pub fn new(surface: &'a Surface, law: &LinearElastic) -> Result<Self, Error> {
        let mesh = surface.mesh();
        let panels = mesh.triangle_ids().map(|triangle| {
            let panel = Panel::new(mesh.positions(triangle));
            panel.ok_or(Error::SliverTriangle {
                triangle: triangle.index(),
            })
        });
        Ok(Self {
            kelvin: Kelvin::new(law),
            surface,
            panels: panels.collect::<Result<_, _>>()?,
        })
    }

    /// One for each triangle of the surface.
    pub fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// Both matrices, by all cores.
    pub fn matrices(&self) -> InfluenceMatrices {
        let size = 3 * self.panels.len();
        let mut displacement = vec![0.0; size * size];
        let mut traction = vec![0.0; size * size];
        let columns = displacement.chunks_exact_mut(3 * size);
        let columns = columns.zip(traction.chunks_exact_mut(3 * size)).enumerate();
        on_all_cores(columns, |(source, (u, t))| {
            self.displacement_columns(source, 1.0, u);
            self.traction_columns(source, t);
        });
        self.free_rotations(TractionColumns {
            columns: &mut traction,
            fixed: &vec![false; self.panels.len()],
        });
        let [displacement, traction] = [displacement, traction]
            .map(|columns| MatRef::from_column_major_slice(&columns, size, size).to_owned());
        InfluenceMatrices {
            displacement,
            traction,
        }
    }

    /// The columns of U that belong to the panel `number`, times `factor`.
    pub(super) fn displacement_columns<T: Precision>(
        &self,
        number: usize,
        factor: f64,
        columns: &mut [T],
    ) {
        let source = Source::new(&self.panels[number]);
        for (target, panel) in self.panels.iter().enumerate() {
            let place = place(number, target);
            let block = source.displacement(&self.kelvin, &panel.centroid, place);
            put(columns, target, &(block * factor));
        }
    }

    /// The columns of ½ 1 + T that belong to the panel `number`.
    pub(super) fn traction_columns<T: Precision>(&self, number: usize, columns: &mut [T]) {
        let block = self.traction_blocks(number);
        for target in 0..self.panels.len() {
            put(columns, target, &block(target));
        }
    }

    /// The same as a function of the panel where the displacement is.
    pub(super) fn traction_blocks(&self, number: usize) -> impl Fn(usize) -> Matrix3<f64> {
        let source = Source::new(&self.panels[number]);
        move |target| {
            let place = place(number, target);
            let block = source.traction(&self.kelvin, &self.panels[target].centroid, place);
            match place {
                Place::OnPanel => block + Matrix3::from_diagonal_element(0.5),
                Place::Elsewhere => block,
            }
        }
    }
}

fn place(source: usize, target: usize) -> Place {
    if source == target {
        Place::OnPanel
    } else {
        Place::Elsewhere
    }
}

/// Writes the rows of the panel `target` into the three columns of a source.
fn put<T: Precision>(columns: &mut [T], target: usize, block: &Matrix3<f64>) {
    let size = columns.len() / 3;
    for (column, values) in columns.chunks_exact_mut(size).zip(block.column_iter()) {
        for (place, &value) in column[3 * target..].iter_mut().zip(values.iter()) {
            *place = T::of(value);
        }
    }
}
