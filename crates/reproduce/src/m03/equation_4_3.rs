use nalgebra::{DMatrix, DVector, Matrix3};
use palpate_geometry::{Organ, TriangleMesh, Vec3};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::boundary_elements::{Kelvin, Panel, PanelIntegrals, Place, integrate};

use crate::Error;
use crate::row::Rows;

const TRIANGLES: usize = 192;
const POISSONS_RATIO: f64 = 0.45;

/// Strain along the third axis [-].
const STRETCH: f64 = 0.1;

/// The kernels' integrals as they are used.
type Reading = fn(&PanelIntegrals) -> PanelIntegrals;

/// What is solved with: the name, and what becomes of the true integrals.
const READINGS: [(&str, Reading); 4] = [
    ("corrected", |true_ones| *true_ones),
    ("displacement_printed", |true_ones| PanelIntegrals {
        displacement: without_factor(true_ones),
        ..*true_ones
    }),
    ("bracket_printed", |true_ones| PanelIntegrals {
        traction: without_bracket(true_ones),
        ..*true_ones
    }),
    ("printed", |true_ones| PanelIntegrals {
        displacement: without_factor(true_ones),
        traction: -without_bracket(true_ones),
    }),
];

fn without_factor(integrals: &PanelIntegrals) -> Matrix3<f64> {
    integrals.displacement * ((1.0 - POISSONS_RATIO) / (1.0 + POISSONS_RATIO))
}

fn without_bracket(integrals: &PanelIntegrals) -> Matrix3<f64> {
    0.5 * (integrals.traction + integrals.traction.transpose())
}

/// A cube that is stretched evenly, so that the true answer is known.
struct Stretched {
    panels: Vec<Panel>,
    law: LinearElastic,
}

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let cube = Stretched::new(&Organ::Cube.surface_mesh(TRIANGLES)?)?;
    for (name, reading) in READINGS {
        let error = cube.error(reading).map(|error| 100.0 * error);
        rows.row(name)
            .with("triangles", cube.panels.len())
            .with("nu", POISSONS_RATIO)
            .is(error);
    }
    Ok(())
}

impl Stretched {
    fn new(mesh: &TriangleMesh) -> Result<Self, Error> {
        let panels = mesh.triangle_ids().map(|id| Panel::new(mesh.positions(id)));
        Ok(Self {
            panels: panels.flatten().collect(),
            law: LinearElastic::new(1.0, POISSONS_RATIO)?,
        })
    }

    /// Longer along the third axis, and narrower across [m].
    fn moved(panel: &Panel) -> Vec3 {
        let [x, y, z] = panel.centroid.into();
        STRETCH * Vec3::new(-POISSONS_RATIO * x, -POISSONS_RATIO * y, z)
    }

    /// The traction that does it, with E = 1 [Pa].
    fn pulled(panel: &Panel) -> Vec3 {
        STRETCH * panel.normal.z * Vec3::z()
    }

    fn is_fixed(panel: &Panel) -> bool {
        panel.normal.z < -0.5
    }

    /// Of the displacements that are not given [-]; none where the equations have no solution.
    fn error(&self, reading: Reading) -> Option<f64> {
        let kelvin = Kelvin::new(&self.law);
        let size = 3 * self.panels.len();
        let (mut system, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (row, at) in self.panels.iter().enumerate() {
            for (column, panel) in self.panels.iter().enumerate() {
                let place = if row == column {
                    Place::OnPanel
                } else {
                    Place::Elsewhere
                };
                let found = reading(&integrate(&kelvin, panel, &at.centroid, place));
                let mut traction = found.traction;
                if row == column {
                    traction += Matrix3::from_diagonal_element(0.5);
                }
                let (unknown, given) = match Self::is_fixed(panel) {
                    true => (-found.displacement, -traction * Self::moved(panel)),
                    false => (traction, found.displacement * Self::pulled(panel)),
                };
                system
                    .view_mut((3 * row, 3 * column), (3, 3))
                    .copy_from(&unknown);
                let mut sum = right.rows_mut(3 * row, 3);
                sum += given;
            }
        }
        let found = system.lu().solve(&right)?;
        let (mut off, mut all) = (0.0, 0.0);
        for (k, panel) in self.panels.iter().enumerate() {
            if !Self::is_fixed(panel) {
                let exact = Self::moved(panel);
                off += (found.fixed_rows::<3>(3 * k) - exact).norm_squared();
                all += exact.norm_squared();
            }
        }
        Some((off / all).sqrt())
    }
}
