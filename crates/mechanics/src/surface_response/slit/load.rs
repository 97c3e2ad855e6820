use nalgebra::Matrix3;

use super::super::response::{SurfaceResponse, TouchId};
use super::super::tip_field::Share;
use super::curvature::Medium;
use super::traction::{DiscForce, MODES};
use super::{Cut, Slit};
use crate::Vec3;
use crate::boundary_elements::Precision;

/// The load vector on a slit of a unit force along each axis, however spread: L⁻¹ T w. It belongs to the slit
/// at the time when the load was applied.
#[derive(Debug, Clone, PartialEq)]
pub struct SlitLoad {
    rows: Vec<Vec3>,
    /// φ of each facet, of a spot.
    fades: Vec<f64>,
    /// Compliance of the rim next to a spot by itself, times E [1/m].
    rim: Matrix3<f64>,
}

/// Jumps of the displacement across the facets of a slit.
#[derive(Debug, Clone, PartialEq)]
pub struct SlitJumps {
    values: Vec<f64>,
}

impl<T: Precision> Slit<T> {
    /// Room for a load.
    pub fn load(&self) -> SlitLoad {
        SlitLoad {
            rows: Vec::with_capacity(self.most * MODES),
            fades: Vec::with_capacity(self.most),
            rim: Matrix3::zeros(),
        }
    }

    /// Room for jumps.
    pub fn jumps(&self) -> SlitJumps {
        SlitJumps {
            values: Vec::with_capacity(self.most * MODES),
        }
    }

    /// Applies a force to the slit that triangles bear in `shares`. The `spot` gives the place of a force
    /// narrower than they are: near the slit its place and side matter.
    pub fn put(
        &self,
        response: &SurfaceResponse<T>,
        shares: impl Iterator<Item = Share>,
        spot: Option<&DiscForce>,
        load: &mut SlitLoad,
    ) {
        load.rows.clear();
        load.rows.resize(self.size(), Vec3::zeros());
        load.rim = Matrix3::zeros();
        load.fades.clear();
        load.fades.resize(self.facets.len(), 0.0);
        let mut covered = 0.0;
        for (cut, fade) in self.facets.iter().zip(&mut load.fades) {
            let Some(spot) = spot else {
                break;
            };
            let medium = Medium {
                nu: self.poissons_ratio,
                tube: &self.curvature,
            };
            let Some(found) = cut.facet.point_influence(medium, cut.reach, spot) else {
                continue;
            };
            *fade = found.0;
            let rows = &mut load.rows[cut.facet.rows()];
            for (place, found) in rows.iter_mut().zip(&found.1) {
                *place += found;
            }
            if let Some((part, rim)) = cut.facet.rim_of(cut.reach, spot) {
                covered += part;
                load.rim += rim * part;
            }
        }
        for Share { triangle, weight } in shares {
            let Some(touched) = response.touchable().get(triangle.index()) else {
                continue;
            };
            let triangle = touched.triangle;
            for (facet, cut) in self.facets.iter().enumerate() {
                let rows = self.smooth(facet).chunks_exact(self.width);
                let places = &mut load.rows[cut.facet.rows()];
                for (place, row) in places.iter_mut().zip(rows) {
                    let values = &row[3 * triangle.index()..][..3];
                    *place += Vec3::from_fn(|axis, _| values[axis].into()) * weight;
                }
            }
            for (cut, fade) in self.facets.iter().zip(&load.fades) {
                if spot.is_some() && *fade == 0.0 {
                    continue;
                }
                let near = &self.near[cut.near[0]..cut.near[1]];
                let Ok(found) = near.binary_search_by_key(&triangle, |near| near.triangle) else {
                    continue;
                };
                let rows = &mut load.rows[cut.facet.rows()];
                if spot.is_some() {
                    add(rows, &near[found].resolved, -weight * fade);
                } else {
                    add(rows, &near[found].more, weight);
                }
            }
        }
        // Squared: at its end a slit opens less than half as far.
        load.rim *= covered.clamp(0.0, 1.0);
        self.h.forward(&mut load.rows);
    }

    /// Compliance that the slit adds to a load, times E [1/m]: symmetric, never negative.
    pub fn added_compliance(&self, load: &SlitLoad) -> Matrix3<f64> {
        self.between(load, load) + load.rim
    }

    /// The slit's part of [`SurfaceResponse::between`] two loads, times E [1/m]: transposed when they are
    /// exchanged.
    pub fn between(&self, moved: &SlitLoad, loaded: &SlitLoad) -> Matrix3<f64> {
        let pairs = moved.rows.iter().zip(&loaded.rows);
        pairs
            .map(|(moved, loaded)| moved * loaded.transpose())
            .sum()
    }

    /// The slit's part of [`SurfaceResponse::compliance`] of two triangles, times E [1/m]; `scratch` is two
    /// loads.
    pub fn compliance(
        &self,
        response: &SurfaceResponse<T>,
        moved: TouchId,
        loaded: TouchId,
        scratch: &mut [SlitLoad; 2],
    ) -> Matrix3<f64> {
        let whole = |triangle| {
            let weight = 1.0;
            std::iter::once(Share { triangle, weight })
        };
        let [one, other] = scratch;
        self.put(response, whole(moved), None, one);
        self.put(response, whole(loaded), None, other);
        self.between(one, other)
    }

    /// The jumps under forces [m² times the modulus: N] on loads, over E: give forces over E [m²] for jumps [m].
    pub fn jump<'a>(
        &self,
        loads: impl Iterator<Item = (&'a SlitLoad, Vec3)>,
        jumps: &mut SlitJumps,
    ) {
        jumps.values.clear();
        jumps.values.resize(self.size(), 0.0);
        for (load, force) in loads {
            for (value, row) in jumps.values.iter_mut().zip(&load.rows) {
                *value += row.dot(&force);
            }
        }
        self.h.backward(&mut jumps.values);
    }

    /// Opening of a facet at the outer surface [m]: the right one's displacement, seen along
    /// the facet with its normal up, less the left one's. None where there is no such facet.
    pub fn opening(&self, facet: usize, jumps: &SlitJumps) -> Option<Vec3> {
        let cut = self.facets.get(facet)?;
        let jumps = jumps.values.get(cut.facet.rows())?;
        let local = match *jumps {
            [n, s, z] => Vec3::new(n, s, z),
            [n, s, hinge, shear, bend] => Vec3::new(n + hinge, s, shear + bend),
            _ => return None,
        };
        Some(cut.facet.frame * local)
    }

    /// Adds to `field`, three numbers for each triangle, the displacements of the surface [m] by jumps [m].
    pub fn add_field(&self, jumps: &SlitJumps, field: &mut [T]) {
        if jumps.values.len() != self.size() || field.len() != self.width {
            return;
        }
        // Two facets at a time, so that the field is met less often.
        for (pair, cuts) in self.facets.chunks(2).enumerate() {
            let last = cuts.len() - 1;
            let rows = |k: usize| self.smooth(2 * pair + k.min(last));
            let jump = |k: usize, mode: usize| {
                let own = cuts
                    .get(k)
                    .map_or(0.0, |cut| jumps.values[cut.facet.first + mode]);
                T::of(own)
            };
            let [one, other] = [0, 1].map(|k| [0, 1, 2].map(|mode| jump(k, mode)));
            let of = |k: usize| {
                let (a, rest) = rows(k).split_at(self.width);
                let (b, c) = rest.split_at(self.width);
                a.iter().zip(b).zip(c)
            };
            for ((place, ((&a, &b), &c)), ((&d, &e), &f)) in field.iter_mut().zip(of(0)).zip(of(1))
            {
                let first = one[0] * a + one[1] * b + one[2] * c;
                *place += first + (other[0] * d + other[1] * e + other[2] * f);
            }
        }
        for cut in &self.facets {
            self.add_near(cut, &jumps.values[cut.facet.rows()], field);
        }
    }

    fn add_near(&self, cut: &Cut, jumps: &[f64], field: &mut [T]) {
        for near in &self.near[cut.near[0]..cut.near[1]] {
            for (axis, place) in field[3 * near.triangle.index()..][..3]
                .iter_mut()
                .enumerate()
            {
                let rows = near.more.iter().zip(jumps);
                let sum: f64 = rows.map(|(row, jump)| f64::from(row[axis]) * jump).sum();
                *place += T::of(sum);
            }
        }
    }
}

/// Adds rows times a factor.
fn add(rows: &mut [Vec3], more: &[[f32; 3]], factor: f64) {
    for (place, more) in rows.iter_mut().zip(more) {
        *place += Vec3::from_fn(|axis, _| f64::from(more[axis])) * factor;
    }
}
