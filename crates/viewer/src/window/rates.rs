use palpate_servo::LoopReport;
use palpate_simulate::interactive::{ModelReport, Quality};

/// How often things happened within the last second or so.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Rates {
    /// Pictures [Hz].
    pub(super) display: f64,
    /// Steps of the model [Hz].
    pub(super) model: f64,
    /// Ticks of the servo loop [Hz].
    pub(super) servo: f64,
    /// Measurements of the servo loop since the start; zeros without one.
    pub(super) touch: LoopReport,
    /// Measurements of the model.
    pub(super) answers: ModelReport,
    counted: Counted,
}

#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Counted {
    time: f64,
    pictures: u64,
    steps: u64,
    ticks: u64,
}

/// Time over which events are counted [s].
const STRETCH: f64 = 1.0;

impl Rates {
    /// Counts a picture at `time` [s] and looks at what the touch says of itself.
    pub(super) fn count(&mut self, time: f64, tool: usize, quality: &Quality) {
        let servo = quality.loops.get(tool).copied().flatten();
        let ticks = servo.map_or(0, |servo| servo.ticks);
        let now = Counted {
            time,
            pictures: self.counted.pictures,
            steps: quality.model.steps,
            ticks,
        };
        self.counted.pictures += 1;
        self.touch = servo.unwrap_or_default();
        self.answers = quality.model;
        let elapsed = time - self.counted.time;
        let begun_anew = now.steps < self.counted.steps || now.ticks < self.counted.ticks;
        if (0.0..STRETCH).contains(&elapsed) && !begun_anew {
            return;
        }
        if !begun_anew && elapsed > 0.0 {
            let rate = |now: u64, before: u64| (now - before) as f64 / elapsed;
            self.display = self.counted.pictures as f64 / elapsed;
            self.model = rate(now.steps, self.counted.steps);
            self.servo = rate(now.ticks, self.counted.ticks);
        }
        self.counted = Counted { pictures: 0, ..now };
    }
}
