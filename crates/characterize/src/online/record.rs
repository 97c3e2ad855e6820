use palpate_files::recording::IndenterShape;

use super::contact::DetectedContact;
use super::estimate::FEWEST;
use crate::clean::{MovingTissue, Ripple, segments};
use crate::inverse::ZeroErrors;

/// What is measured at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OnlineSample {
    /// Time [s].
    pub time_s: f64,
    /// Depth into the tissue [m].
    pub depth_m: f64,
    /// Force on the tissue [N].
    pub force_n: f64,
}

impl OnlineSample {
    pub(super) fn is_finite(&self) -> bool {
        self.time_s.is_finite() && self.depth_m.is_finite() && self.force_n.is_finite()
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            time_s: self.time_s + other.time_s,
            depth_m: self.depth_m + other.depth_m,
            force_n: self.force_n + other.force_n,
        }
    }

    pub(super) fn over(self, count: usize) -> Self {
        let count = count as f64;
        Self {
            time_s: self.time_s / count,
            depth_m: self.depth_m / count,
            force_n: self.force_n / count,
        }
    }
}

/// Means of blocks of equally many samples; neighbours are merged when it is full.
#[derive(Debug, Clone)]
pub(super) struct Record {
    blocks: Vec<OnlineSample>,
    most: usize,
    /// Samples of each block.
    each: usize,
    /// Sum of the samples of the block that is not full yet, and their number.
    open: (OnlineSample, usize),
    end: Option<f64>,
}

impl Record {
    /// Of at most so many blocks, an even number.
    pub(super) fn new(most: usize) -> Self {
        Self {
            blocks: Vec::with_capacity(most),
            most,
            each: 1,
            open: (OnlineSample::default(), 0),
            end: None,
        }
    }

    pub(super) fn clear(&mut self) {
        self.blocks.clear();
        self.each = 1;
        self.open = (OnlineSample::default(), 0);
        self.end = None;
    }

    /// Time of the last sample [s].
    pub(super) fn end(&self) -> Option<f64> {
        self.end
    }

    pub(super) fn blocks(&self) -> &[OnlineSample] {
        &self.blocks
    }

    pub(super) fn add(&mut self, sample: OnlineSample) {
        self.end = Some(sample.time_s);
        self.open = (self.open.0.plus(sample), self.open.1 + 1);
        if self.open.1 < self.each {
            return;
        }
        self.blocks.push(self.open.0.over(self.each));
        self.open = (OnlineSample::default(), 0);
        if self.blocks.len() == self.most {
            for place in 0..self.most / 2 {
                let pair = self.blocks[2 * place].plus(self.blocks[2 * place + 1]);
                self.blocks[place] = pair.over(2);
            }
            self.blocks.truncate(self.most / 2);
            self.each *= 2;
        }
    }

    /// What is fitted: from the first contact on, with the zeros taken off.
    pub(super) fn since(&self, contact: &DetectedContact) -> Samples {
        let pressed = self
            .blocks
            .iter()
            .filter(|block| block.time_s >= contact.time_s);
        let mut samples = Samples {
            zeros: contact.zeros,
            ..Samples::default()
        };
        for block in pressed {
            samples.time.push(block.time_s - contact.time_s);
            samples
                .depth
                .push((block.depth_m - contact.depth_m).max(0.0));
            samples.force.push(block.force_n - contact.offset_n);
        }
        samples
    }
}

/// What is fitted.
#[derive(Debug, Clone, Default)]
pub(super) struct Samples {
    /// Times from first contact [s].
    pub(super) time: Vec<f64>,
    /// Depths from first contact [m].
    pub(super) depth: Vec<f64>,
    /// Forces without the sensor's zero [N].
    pub(super) force: Vec<f64>,
    pub(super) zeros: ZeroErrors,
}

impl Samples {
    /// The same as if the tissue did not move by itself, where its force swings in the hold, under an indenter of this shape; its
    /// motion is a part of the error of the first contact.
    pub(super) fn at_rest(mut self, shape: Option<IndenterShape>) -> Self {
        if self.time.len() < FEWEST {
            return self;
        }
        let segments = segments::find(&self.time, &self.depth, 0);
        let Some(ripple) = Ripple::find(&self.time, &self.force, &segments) else {
            return self;
        };
        let moving = MovingTissue {
            time: &self.time,
            depth: &self.depth,
            force: &self.force,
            segments: &segments,
            ripple: &ripple,
            shape,
        };
        self.zeros.motion = ZeroErrors::of_motion(moving.amplitude().unwrap_or(0.0));
        self.force = moving.force_at_rest();
        self
    }
}
