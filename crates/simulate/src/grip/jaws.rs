use nalgebra::UnitQuaternion;
use palpate_files::scene::Jaws;
use palpate_geometry::{Vec3, closest_on_triangle};

/// Distance ahead of their ends within which jaws still grasp tissue [m].
const AHEAD: f64 = 1e-3;

/// The box that open jaws sweep when they shut, in the frame of their tool.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Swept {
    pub(crate) tip: Vec3,
    pub(crate) turned: UnitQuaternion<f64>,
    low: Vec3,
    high: Vec3,
}

/// Sample points along the jaws, and across, for a large triangle.
const ALONG: usize = 9;
const ACROSS: [f64; 3] = [0.0, -0.5, 0.5];

impl Swept {
    /// Of `jaws` at `tip` [m], whose touching end lies `overhang` [m] ahead of it.
    pub(crate) fn new(jaws: &Jaws, tip: Vec3, turned: UnitQuaternion<f64>, overhang: f64) -> Self {
        let (across, aside) = (0.5 * jaws.opening_m, 0.5 * jaws.width_m);
        Self {
            tip,
            turned,
            low: Vec3::new(-across, -aside, -(overhang + AHEAD)),
            high: Vec3::new(across, aside, jaws.length_m),
        }
    }

    /// A place of the scene [m] in the tool's frame.
    pub(crate) fn inside_of_tool(&self, place: &Vec3) -> Vec3 {
        self.turned.inverse() * (place - self.tip)
    }

    /// The far end of the drawn-in tissue, in the scene [m].
    pub(crate) fn far_end(&self) -> Vec3 {
        self.tip - self.turned * Vec3::z() * AHEAD
    }

    /// Whether a place in the tool's frame lies between the jaws.
    pub(crate) fn contains(&self, place: &Vec3) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&place[axis]))
    }

    /// Whether a part of a triangle with these corners in the tool's frame lies between the jaws.
    pub(crate) fn intersects(&self, corners: &[Vec3; 3]) -> bool {
        // Almost all triangles of an organ fail this test.
        let misses = |axis: usize| {
            let along = corners.map(|corner| corner[axis]);
            along.iter().all(|&x| x < self.low[axis]) || along.iter().all(|&x| x > self.high[axis])
        };
        if (0..3).any(misses) {
            return false;
        }
        let step = (self.high.z - self.low.z) / (ALONG - 1) as f64;
        let mut along = (0..ALONG).map(|k| self.low.z + step * k as f64);
        along.any(|z| {
            ACROSS.iter().any(|part| {
                let point = Vec3::new(part * self.high.x, 0.0, z);
                self.contains(&closest_on_triangle(corners, &point).position)
            })
        })
    }

    /// Thickness of tissue from `first` to `last` along x between the jaws [m]: never less than a tenth of their
    /// opening, since there is tissue behind a surface.
    pub(crate) fn thickness(&self, first: f64, last: f64) -> f64 {
        let opening = self.high.x - self.low.x;
        let filled = last.min(self.high.x) - first.max(self.low.x);
        filled.clamp(0.1 * opening, opening)
    }

    /// Area of a jaw's face [m²].
    pub(crate) fn face(jaws: &Jaws) -> f64 {
        jaws.length_m * jaws.width_m
    }
}

/// Force of each of the `jaws` [N] on tissue of `area` [m²], `thickness` [m] and Young's modulus `modulus` [Pa] at
/// `grip` [-]: a column of neo-Hookean rubber, limited by the jaws' force.
pub(super) fn press(jaws: &Jaws, area: f64, thickness: f64, grip: f64, modulus: f64) -> f64 {
    let gap = jaws.opening_m * (1.0 - grip);
    let stretch = (gap / thickness).min(1.0);
    // Completely shut, they press with their full force.
    let column = modulus * area / 3.0 * (stretch.powi(-2) - stretch);
    column.min(jaws.force_n)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: Hooke's law at small strain; the jaws' own force at the end.
    #[test]
    fn jaws_press_as_on_a_column() {
        let jaws = Jaws::GRASPER;
        let (area, thickness, modulus) = (4e-5, 8e-3, 1e4);
        let at = |grip| press(&jaws, area, thickness, grip, modulus);
        assert_eq!(at(0.2), 0.0);
        // 1 % of strain, to which the law's next term adds a hundredth.
        let hooke = modulus * area * 0.01;
        let found = at(1.0 - 0.99 * thickness / jaws.opening_m);
        assert!((found / hooke - 1.0).abs() < 0.02, "{found} {hooke}");
        assert_eq!(at(1.0), jaws.force_n);
        let rising: Vec<_> = (0..=100).map(|k| at(0.01 * f64::from(k))).collect();
        assert!(rising.windows(2).all(|pair| pair[0] <= pair[1]));
    }

    #[test]
    fn a_box_holds_what_is_between_the_jaws() {
        let turned = UnitQuaternion::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI);
        let swept = Swept::new(&Jaws::GRASPER, Vec3::x(), turned, 0.0);
        // The shaft runs down.
        let inside = |place: Vec3| swept.contains(&swept.inside_of_tool(&place));
        assert!(inside(Vec3::new(1.004, 0.0, -0.011)));
        assert!(!inside(Vec3::new(1.004, 0.0, 0.011)));
        assert!(!inside(Vec3::new(1.0, 0.003, -0.001)));
        // A triangle wider than the jaws has no corner between them.
        let wide = [[-0.1, -0.1], [0.1, -0.1], [0.0, 0.2]].map(|[x, y]| Vec3::new(x, y, 0.004));
        assert!(swept.intersects(&wide));
        let below = wide.map(|corner| corner + Vec3::z() * 0.01);
        assert!(!swept.intersects(&below));
    }
}
