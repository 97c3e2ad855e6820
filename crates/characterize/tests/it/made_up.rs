//! Recordings whose truth is known.

use palpate_files::Recording;
use palpate_files::recording::{ForeignColumns, RecordingHeader, Samples};

/// A stream of numbers that look random, the same ones each time: splitmix64.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    /// Uniform in 0..1.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Normal with mean 0 and deviation 1.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// Times [s] from zero to `end` [s] at `rate` [Hz].
pub(crate) fn times(rate: f64, end: f64) -> Vec<f64> {
    (0..=(rate * end).round() as usize)
        .map(|sample| sample as f64 / rate)
        .collect()
}

/// A recording of this project.
pub(crate) fn own(
    time: &[f64],
    depth: impl Fn(f64) -> f64,
    force: impl FnMut(f64) -> f64,
) -> Recording {
    let samples = Samples {
        time_s: time.to_vec(),
        depth_m: time.iter().map(|t| depth(*t)).collect(),
        force_n: time.iter().copied().map(force).collect(),
    };
    Recording::new(RecordingHeader::default(), samples).unwrap()
}

/// The same numbers as another program would have written them.
pub(crate) fn foreign(recording: &Recording) -> Recording {
    let mut text = "time_s,depth_m,force_N\n".to_owned();
    for (sample, time) in recording.time_s().iter().enumerate() {
        let (depth, force) = (recording.depth_m()[sample], recording.force_n()[sample]);
        text += &format!("{time:?},{depth:?},{force:?}\n");
    }
    Recording::parse_foreign(&text, "made-up.csv", &ForeignColumns::default()).unwrap()
}

/// A ramp from `start` [s] to `depth` [m] with `speed` [m/s], then a hold.
pub(crate) fn ramp_and_hold(start: f64, speed: f64, depth: f64) -> impl Fn(f64) -> f64 + Copy {
    move |time| (speed * (time - start)).clamp(0.0, depth)
}
