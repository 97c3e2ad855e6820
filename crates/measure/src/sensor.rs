use palpate_servo::{AXIS_NAMES, ForceTorque, SensorFault};

use crate::noise::Noise;

/// A force and torque sensor on a virtual specimen.
#[derive(Debug, Clone)]
pub struct VirtualForceSensor {
    /// The steps of fx, fy, fz [N] and tx, ty, tz [N m].
    pub steps: [f64; 6],
    /// The largest that it shows on each axis [N, N m].
    pub ranges: [f64; 6],
    /// Standard deviation of its noise, in steps [-].
    pub noise: f64,
    /// Of fz, and of all others: readings of fz do not depend on whether the others are read.
    random: [Noise; 2],
}

/// Distinguishes the random stream of the five other axes.
const OTHERS: u64 = 0x5EED_0F5A_1DE5;

/// Where fz stands among the axes.
const AXIAL: usize = 2;

impl VirtualForceSensor {
    /// The source's: an ATI Nano17 with steps of 1/1280 N on each axis (section 5.2.1), ranges of its calibration
    /// SI-12-0.12 (12 N, 17 N along its axis, 0.12 N m) and noise of half a step. Steps of a torque are 1/256 N mm, in
    /// the ratio of the data sheet's 1/320 N and 1/64 N mm.
    pub fn nano17(seed: u64) -> Self {
        let ([n, nm], [side, torque]) = ([1.0 / 1280.0, 1e-3 / 256.0], [12.0, 0.12]);
        Self {
            steps: [n, n, n, nm, nm, nm],
            ranges: [side, side, 17.0, torque, torque, torque],
            noise: 0.5,
            random: [Noise::new(seed), Noise::new(seed ^ OTHERS)],
        }
    }

    /// The reading of a force and a torque.
    ///
    /// # Errors
    /// When an axis is at the end of its range.
    pub fn read(&mut self, load: &ForceTorque) -> Result<ForceTorque, SensorFault> {
        let mut shown = load.components();
        let mut saturated = None;
        for (axis, value) in shown.iter_mut().enumerate() {
            let random = &mut self.random[usize::from(axis != AXIAL)];
            let noisy = *value + self.noise * self.steps[axis] * random.normal();
            if noisy.is_nan() || noisy.abs() >= self.ranges[axis] {
                saturated.get_or_insert(AXIS_NAMES[axis]);
            }
            // Not −0.
            *value = (noisy / self.steps[axis]).round() * self.steps[axis] + 0.0;
        }
        match saturated {
            Some(axis) => Err(SensorFault::Saturated { axis }),
            None => Ok(ForceTorque::from_components(shown)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_servo::Vec3;

    /// Judge: 0.29 of a step is the standard deviation of rounding, √(0.5² + 0.29²) that of both.
    #[test]
    fn noise_is_that_of_the_data_sheet_on_every_axis() {
        let mut sensor = VirtualForceSensor::nano17(5);
        let load = ForceTorque {
            force: Vec3::new(0.1, -0.2, 0.3),
            torque: Vec3::new(1e-3, -2e-3, 5e-4),
        };
        let shown: Vec<[f64; 6]> = (0..4000)
            .map(|_| sensor.read(&load).unwrap().components())
            .collect();
        for (axis, (expected, step)) in load.components().into_iter().zip(sensor.steps).enumerate()
        {
            let mean = shown.iter().map(|row| row[axis]).sum::<f64>() / 4000.0;
            let spread = shown
                .iter()
                .map(|row| (row[axis] - mean).powi(2))
                .sum::<f64>();
            let spread = (spread / 4000.0).sqrt() / step;
            // Five standard errors of a mean of 4000.
            assert!((mean - expected).abs() < 0.05 * step, "{axis}: {mean}");
            assert!((spread - 0.577).abs() < 0.04, "{axis}: {spread}");
        }
    }

    #[test]
    fn an_axis_beyond_its_range_is_a_fault_with_its_name() {
        let mut sensor = VirtualForceSensor::nano17(1);
        let load = ForceTorque {
            force: Vec3::zeros(),
            torque: Vec3::new(0.0, 0.13, 0.0),
        };
        let fault = sensor.read(&load).unwrap_err();
        assert_eq!(fault, SensorFault::Saturated { axis: "ty" });
    }
}
