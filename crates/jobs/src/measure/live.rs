//! A protocol on a device that is there: the rig runs on its own thread and another one writes, as in the window, so that
//! neither the disk nor a number that is formatted delays a tick.

use std::path::Path;
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;

use palpate_files::recording::RecordingHeader;
use palpate_measure::live::{Commission, LiveRig, News, Order};
use palpate_measure::{Course, Recorded, Rig};

use crate::{Error, Watch};

/// How often it is looked whether somebody asks to stop.
const LOOK: Duration = Duration::from_millis(1);

/// A rig on a device that is there.
pub(super) struct LiveMeasuring {
    live: LiveRig,
    number: u64,
}

impl LiveMeasuring {
    pub(super) fn start(rig: Rig) -> Result<Self, Error> {
        let live = LiveRig::start(rig).map_err(Error::failed)?;
        Ok(Self { live, number: 0 })
    }

    /// One stimulus; none when it was stopped before anything was recorded. To stop takes all forces off at once, for a
    /// hand may be on the device.
    pub(super) fn record(
        &mut self,
        (course, header): (&Course, RecordingHeader),
        file: &Path,
        watch: &dyn Watch,
    ) -> Result<Option<Recorded>, Error> {
        self.number += 1;
        for order in [Order::Rest, Order::Approach, Order::Rest] {
            self.live.console.order(order);
        }
        let commission = Commission {
            number: self.number,
            file: file.to_owned(),
            header,
        };
        self.live.press(*course, commission);
        let (mut recorded, mut is_stopped) = (None, false);
        loop {
            if !is_stopped && watch.is_asked_to_stop() {
                self.live.console.emergency_stop();
                is_stopped = true;
            }
            let news = match self.live.news.recv_timeout(LOOK) {
                Ok(news) => news,
                Err(RecvTimeoutError::Timeout) => {
                    self.check_device()?;
                    continue;
                }
                Err(RecvTimeoutError::Disconnected) => {
                    let gone =
                        "a thread of the rig has ended, and its device was stopped; start again";
                    return Err(Error::failed(gone));
                }
            };
            match news {
                News::Recorded(_, done, _) => recorded = Some(done),
                News::Unwritten(unwritten) => return Err(unwritten.error.into()),
                News::Ended(_, Err(error)) | News::Disturbed(error) if !is_stopped => {
                    return Err(Error::failed(error));
                }
                News::Ended(Order::Press(..), _) | News::Dropped(Order::Press(..)) => {
                    return Ok(recorded);
                }
                _ => {}
            }
        }
    }

    /// A device that hangs is an error at once: its rig says nothing any more.
    fn check_device(&self) -> Result<(), Error> {
        self.live
            .hung_device()
            .map_or(Ok(()), |hung| Err(Error::failed(hung)))
    }
}
