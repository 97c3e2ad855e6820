use palpate_characterize::online::{
    OnlineContact, OnlineEstimate, OnlineEstimator, OnlineSample, OnlineSettings,
};
use palpate_files::protocol::Stimulus;
use palpate_files::recording::RecordingHeader;
use palpate_measure::{DepthTrajectory, RigSample};

use crate::ProgressCallback;

/// Time between two estimates [s], and part of the time since first contact [-]: later ones change less.
const FIRST: f64 = 0.25;
const LATER: f64 = 0.2;

/// Online estimation of the tissue during a stimulus.
#[derive(Debug)]
pub(super) struct Estimating {
    online: OnlineEstimator,
    last: Option<OnlineEstimate>,
    /// Time of the next estimate on the rig's clock [s].
    next: Option<f64>,
    /// The relative half interval at which the press ends [-].
    target: Option<f64>,
}

impl Estimating {
    /// Of a ramp and hold, where no finite elements have to be run.
    pub(super) fn of(
        header: &RecordingHeader,
        trajectory: &DepthTrajectory,
        target: Option<f64>,
    ) -> Option<Self> {
        if !matches!(trajectory.stimulus(), Stimulus::RampAndHold { .. }) {
            return None;
        }
        let settings = OnlineSettings {
            header: header.clone(),
            contact: OnlineContact::Detected,
            deepest_m: Some(trajectory.deepest_expected()),
        };
        if !settings.is_tabulated() {
            return None;
        }
        let online = OnlineEstimator::new(settings).ok()?;
        Some(Self {
            online,
            last: None,
            next: None,
            target,
        })
    }

    /// Adds a sample and returns whether the estimate meets the target.
    pub(super) fn take(&mut self, sample: &RigSample, watch: &dyn ProgressCallback) -> bool {
        let Some(depth_m) = sample.depth else {
            return false;
        };
        self.online.add(OnlineSample {
            time_s: sample.time,
            depth_m,
            force_n: sample.force,
        });
        if !self.online.is_touching() || self.next.is_some_and(|next| sample.time < next) {
            return false;
        }
        let estimate = self.online.estimate();
        self.next = Some(sample.time + FIRST.max(LATER * estimate.time_s));
        watch.report_step(&estimate.to_string());
        self.last = Some(estimate);
        self.is_enough()
    }

    /// Whether the estimate is as accurate as the protocol asks.
    pub(super) fn is_enough(&self) -> bool {
        let known = self.last.as_ref().zip(self.target);
        known.is_some_and(|(estimate, target)| estimate.is_enough(target))
    }

    /// The last estimate, from all samples.
    pub(super) fn last(mut self) -> Option<OnlineEstimate> {
        self.last.take().map(|_| self.online.estimate())
    }
}
