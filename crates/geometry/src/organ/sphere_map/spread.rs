use std::f64::consts::TAU;

use super::SphereMap;
use crate::Vec3;

const ROWS: usize = 64;
const COLUMNS: usize = 128;

/// `count` unit vectors whose images under `map` are spread evenly by area: a Fibonacci lattice,
/// stretched by the inverse of the cumulative area, first along z, then around it.
pub(super) fn spread_points(map: SphereMap, count: usize) -> Vec<Vec3> {
    let area = AreaTable::new(map);
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    (0..count)
        .map(|i| {
            let row = invert(&area.rows, (i as f64 + 0.5) / count as f64);
            let column = invert(&area.around(row), (golden * i as f64).fract());
            unit_vector(row, column)
        })
        .collect()
}

/// Unit vector at a place of the table; rows are evenly spaced in z, so they cut equal areas.
fn unit_vector(row: f64, column: f64) -> Vec3 {
    let z = 2.0 * row / ROWS as f64 - 1.0;
    let ring = (1.0 - z * z).max(0.0).sqrt();
    let (sine, cosine) = (TAU * column / COLUMNS as f64).sin_cos();
    Vec3::new(ring * cosine, ring * sine, z)
}

/// Cumulative share of the area, by rows and, within each row, by columns; from 0 to 1.
struct AreaTable {
    rows: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl AreaTable {
    fn new(map: SphereMap) -> Self {
        let corner = |row: usize, column: usize| map(&unit_vector(row as f64, column as f64));
        let mut row_areas = Vec::with_capacity(ROWS);
        let mut columns = Vec::with_capacity(ROWS);
        for row in 0..ROWS {
            let cells: Vec<f64> = (0..COLUMNS)
                .map(|column| {
                    let rising = corner(row + 1, column + 1) - corner(row, column);
                    let falling = corner(row, column + 1) - corner(row + 1, column);
                    0.5 * rising.cross(&falling).norm()
                })
                .collect();
            row_areas.push(cells.iter().sum());
            columns.push(shares(&cells));
        }
        Self {
            rows: shares(&row_areas),
            columns,
        }
    }

    /// Cumulative shares around the sphere at a row, blended between the rows next to it.
    fn around(&self, row: f64) -> Vec<f64> {
        let from_centres = (row - 0.5).clamp(0.0, (ROWS - 1) as f64);
        let below = (from_centres as usize).min(ROWS - 2);
        let weight = from_centres - below as f64;
        self.columns[below]
            .iter()
            .zip(&self.columns[below + 1])
            .map(|(low, high)| low + weight * (high - low))
            .collect()
    }
}

/// Running sums of `parts`, scaled to end at one.
fn shares(parts: &[f64]) -> Vec<f64> {
    let total: f64 = parts.iter().sum();
    let mut sums = vec![0.0];
    let mut sum = 0.0;
    for part in parts {
        sum += part / total;
        sums.push(sum);
    }
    sums
}

/// Where the rising table reaches `share`: a place between its entries.
fn invert(table: &[f64], share: f64) -> f64 {
    let after = table
        .partition_point(|&entry| entry <= share)
        .clamp(1, table.len() - 1);
    let (low, high) = (table[after - 1], table[after]);
    (after - 1) as f64 + ((share - low) / (high - low)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_follow_the_area() {
        // Half of the area of this cylinder-like sheet lies above the middle of its height.
        let stretched: SphereMap = |u| Vec3::new(u.x, u.y, 3.0 * u.z);
        let points = spread_points(stretched, 2_000);
        let above = points.iter().filter(|p| p.z > 0.0).count();
        let left = points.iter().filter(|p| p.x > 0.0).count();
        assert!(above.abs_diff(1_000) <= 5, "{above}");
        assert!(left.abs_diff(1_000) <= 20, "{left}");
    }
}
