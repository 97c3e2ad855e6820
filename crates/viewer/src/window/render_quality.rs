use std::time::Duration;

/// Render quality: a slow machine draws fewer samples, then fewer pixels, and never delays the touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RenderQuality {
    rung: usize,
    slow: u32,
    quick: u32,
}

/// Samples per pixel, and drawn pixels per pixel of the window along an edge.
const LADDER: [(u32, f32); 4] = [(4, 1.0), (1, 1.0), (1, 0.7), (1, 0.5)];

/// A picture that takes longer than this is slow, one that takes less than that is quick: each rung up is at most
/// twice the work, so it is not slow.
const SLOW: Duration = Duration::from_millis(90);
const QUICK: Duration = Duration::from_millis(45);

/// Slow pictures in a row that lower the effort, and quick ones that raise it.
const SLOW_IN_A_ROW: u32 = 8;
const QUICK_IN_A_ROW: u32 = 180;

impl RenderQuality {
    /// Everything, or less where the processor draws.
    pub(super) fn new(is_software: bool) -> Self {
        Self {
            rung: usize::from(is_software),
            slow: 0,
            quick: 0,
        }
    }

    /// Samples per pixel.
    pub(super) fn samples(&self) -> u32 {
        LADDER[self.rung].0
    }

    /// Drawn pixels per pixel of the window, along an edge [-].
    pub(super) fn scale(&self) -> f32 {
        LADDER[self.rung].1
    }

    /// Counts a picture that took `time` since the last, with the touch late or in time.
    pub(super) fn count(&mut self, time: Duration, touch_is_late: bool) {
        let slow = time > SLOW || touch_is_late;
        self.slow = if slow { self.slow + 1 } else { 0 };
        self.quick = if time < QUICK && !touch_is_late {
            self.quick + 1
        } else {
            0
        };
        if self.slow >= SLOW_IN_A_ROW && self.rung + 1 < LADDER.len() {
            self.rung += 1;
            self.slow = 0;
        }
        if self.quick >= QUICK_IN_A_ROW && self.rung > 0 {
            self.rung -= 1;
            self.quick = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_go_before_pixels_and_come_back_after_them() {
        let mut render_quality = RenderQuality::new(false);
        let mut seen = vec![(render_quality.samples(), render_quality.scale())];
        for _ in 0..60 {
            render_quality.count(Duration::from_millis(150), false);
            seen.push((render_quality.samples(), render_quality.scale()));
        }
        seen.dedup();
        assert_eq!(seen, LADDER);
        for _ in 0..1000 {
            render_quality.count(Duration::from_millis(10), false);
        }
        assert_eq!(
            render_quality,
            RenderQuality {
                quick: render_quality.quick,
                ..RenderQuality::new(false)
            }
        );
    }

    #[test]
    fn a_late_touch_lowers_a_quick_picture() {
        let mut render_quality = RenderQuality::new(false);
        (0..SLOW_IN_A_ROW).for_each(|_| render_quality.count(Duration::from_millis(10), true));
        assert_eq!(render_quality.samples(), 1);
    }
}
