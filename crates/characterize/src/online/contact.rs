use palpate_files::recording::IndenterShape;

use super::OnlineContact;
use super::record::{OnlineSample, Record};
use crate::clean::{Approach, rising_contact};
use crate::inverse::ZeroErrors;

/// Samples of a window, whose means are compared.
const WINDOW: usize = 8;
/// Windows before the current one that may belong to the contact already.
const GUARD: usize = 4;
/// Samples that may belong to the contact already.
const RECENT: usize = (GUARD + 3) * WINDOW;
/// Windows without load from which the zero is known well enough to see a contact.
const ENOUGH: usize = 8;
/// Standard deviations of a window's mean above the zero that are a contact, in two windows one after the other [-]: in
/// white noise once in 10¹² windows.
const SEEN: f64 = 5.0;
/// Blocks of the record of the approach, at most.
const APPROACH: usize = 4096;
/// Blocks of the zero, at most, and the fewest whose means give its error.
const ZERO: usize = 256;
const FEWEST: usize = 8;

/// A contact that was found.
#[derive(Debug, Clone, Copy)]
pub(super) struct DetectedContact {
    pub(super) time_s: f64,
    pub(super) depth_m: f64,
    pub(super) offset_n: f64,
    pub(super) zeros: ZeroErrors,
}

/// Watches for the first contact, and takes the sensor's zero before it.
#[derive(Debug, Clone)]
pub(super) struct ContactDetector {
    how: OnlineContact,
    shape: Option<IndenterShape>,
    /// What the sensor shows without load.
    zero: Record,
    /// The last samples, which may belong to the contact already: a ring.
    recent: Vec<OnlineSample>,
    oldest: usize,
    /// Of the means of windows without load: number, mean, sum of squared deviations.
    windows: (usize, f64, f64),
    /// The largest of these means, and the least standard deviation that they had so far.
    highest: f64,
    quietest: f64,
    /// The sum of the current window and its samples.
    window: (f64, usize),
    /// Means of the last windows, the newest last.
    guard: [f64; GUARD],
    guarded: usize,
    seen: usize,
    /// All of the approach, in which the contact is found afterwards.
    approach: Record,
    /// Samples of the approach that are still to come after the contact was seen.
    coming: usize,
    touched: Option<DetectedContact>,
    is_refined: bool,
}

impl ContactDetector {
    pub(super) fn new(how: OnlineContact, shape: Option<IndenterShape>) -> Self {
        Self {
            how,
            shape,
            zero: Record::new(ZERO),
            recent: Vec::with_capacity(RECENT),
            oldest: 0,
            windows: (0, 0.0, 0.0),
            highest: f64::NEG_INFINITY,
            quietest: f64::INFINITY,
            window: (0.0, 0),
            guard: [0.0; GUARD],
            guarded: 0,
            seen: 0,
            approach: Record::new(APPROACH),
            coming: (GUARD + 2) * WINDOW,
            touched: None,
            is_refined: false,
        }
    }

    pub(super) fn is_touching(&self) -> bool {
        self.touched.is_some()
    }

    /// Takes a sample before contact; those from shortly before the contact on go to `press`.
    pub(super) fn add(&mut self, sample: OnlineSample, press: &mut dyn FnMut(OnlineSample)) {
        match self.how {
            OnlineContact::Stated { error_m } if sample.depth_m > 0.0 => {
                self.touched = Some(self.at(sample.time_s, 0.0, error_m.max(0.0)));
                self.is_refined = true;
                press(sample);
            }
            OnlineContact::Stated { .. } => self.zero.add(sample),
            OnlineContact::Detected => {
                self.approach.add(sample);
                self.keep(sample);
                if self.rises(sample.force_n) {
                    self.touched = Some(self.at(sample.time_s, sample.depth_m, 0.0));
                    let count = self.recent.len();
                    for place in 0..count {
                        press(self.recent[(self.oldest + place) % count]);
                    }
                }
            }
        }
    }

    /// The samples after the contact was seen, which show where it was.
    pub(super) fn refine(&mut self, sample: OnlineSample) {
        if self.coming > 0 && !self.is_refined {
            self.coming -= 1;
            self.approach.add(sample);
        }
    }

    /// Whether the indenter is out of the tissue again.
    pub(super) fn is_withdrawn(&self, sample: &OnlineSample) -> bool {
        // Before the contact is found, its depth is where it was seen, which is deeper.
        self.touched
            .is_some_and(|touched| self.is_refined && sample.depth_m < touched.depth_m)
    }

    /// The contact, found anew until enough of the rise was seen.
    pub(super) fn contact(&mut self) -> Option<DetectedContact> {
        let touched = self.touched?;
        if self.is_refined {
            return Some(touched);
        }
        let blocks = self.approach.blocks();
        let of = |value: fn(&OnlineSample) -> f64| blocks.iter().map(value).collect();
        let approach = Approach {
            time: of(|block| block.time_s),
            depth: of(|block| block.depth_m),
            force: of(|block| block.force_n),
        };
        let (place, error) = rising_contact(&approach, self.shape);
        let found = DetectedContact {
            time_s: blocks[place].time_s,
            ..self.at(touched.time_s, blocks[place].depth_m, error)
        };
        if self.coming == 0 {
            self.touched = Some(found);
            self.is_refined = true;
        }
        Some(found)
    }

    fn at(&self, time_s: f64, depth_m: f64, error_m: f64) -> DetectedContact {
        let (offset_n, error) = self.zero_of_force();
        DetectedContact {
            time_s,
            depth_m,
            offset_n,
            zeros: ZeroErrors {
                depth: error_m,
                force: error,
                ..ZeroErrors::default()
            },
        }
    }

    /// What the sensor shows without load [N], and its standard error [N]: the largest that means of blocks of any length
    /// say, for noise may be slow.
    fn zero_of_force(&self) -> (f64, f64) {
        let blocks = self.zero.blocks();
        if blocks.is_empty() {
            return (0.0, 0.0);
        }
        let mean = blocks.iter().map(|block| block.force_n).sum::<f64>() / blocks.len() as f64;
        let lengths = std::iter::successors(Some(1), |length| Some(2 * length));
        let lengths = lengths.take_while(|length| blocks.len() / length >= FEWEST);
        let errors = lengths.map(|length| {
            let parts = blocks.chunks_exact(length);
            let count = parts.len() as f64;
            let off = |part: &[OnlineSample]| {
                let sum: f64 = part.iter().map(|block| block.force_n).sum();
                (sum / length as f64 - mean).powi(2)
            };
            (parts.map(off).sum::<f64>() / (count * (count - 1.0))).sqrt()
        });
        (mean, errors.fold(0.0, f64::max))
    }

    /// Keeps a sample in the ring; the oldest goes to the zero.
    fn keep(&mut self, sample: OnlineSample) {
        if self.recent.len() < RECENT {
            self.recent.push(sample);
            return;
        }
        self.zero.add(self.recent[self.oldest]);
        self.recent[self.oldest] = sample;
        self.oldest = (self.oldest + 1) % self.recent.len();
    }

    /// Whether the force has risen above its zero.
    fn rises(&mut self, force: f64) -> bool {
        self.window = (self.window.0 + force, self.window.1 + 1);
        if self.window.1 < WINDOW {
            return false;
        }
        let mean = self.window.0 / WINDOW as f64;
        self.window = (0.0, 0);
        let (count, zero, squares) = self.windows;
        if count >= ENOUGH {
            let deviation = (squares / (count - 1) as f64).sqrt();
            // A sensor may show the same step for long.
            let least = 1e-9 * zero.abs();
            self.quietest = self.quietest.min(deviation.max(least));
            // Tissue that a heart moves may touch the indenter before, which makes the deviation large.
            let above = mean - zero > SEEN * deviation.max(least)
                || mean - self.highest > SEEN * self.quietest;
            self.seen = if above && mean > zero {
                self.seen + 1
            } else {
                0
            };
            if self.seen >= 2 {
                return true;
            }
        }
        if self.guarded == GUARD {
            let old = self.guard[0];
            self.highest = self.highest.max(old);
            let off = old - zero;
            let count = count + 1;
            let zero = zero + off / count as f64;
            self.windows = (count, zero, squares + off * (old - zero));
            self.guard.rotate_left(1);
            self.guard[GUARD - 1] = mean;
        } else {
            self.guard[self.guarded] = mean;
            self.guarded += 1;
        }
        false
    }
}
