//! A protocol on a real device: the rig runs on its own thread and another thread writes, as in the window, so that
//! neither the disk nor the formatting of numbers delays a tick.

use std::path::Path;
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;

use palpate_files::recording::RecordingHeader;
use palpate_measure::live::{ConsoleEvent, LiveRig, RecordingRequest, RigCommand};
use palpate_measure::{DepthTrajectory, Ended, Phase, Recorded, Rig};

use super::estimating::Estimating;
use crate::{Error, ProgressCallback};

/// Polling interval for a request to stop.
const LOOK: Duration = Duration::from_millis(1);

/// A rig on a real device.
pub(super) struct LiveMeasuring {
    live: LiveRig,
    header: RecordingHeader,
    number: u64,
}

/// How a command ended, with its recording.
struct Done {
    ended: Ended,
    recorded: Option<Recorded>,
}

impl LiveMeasuring {
    pub(super) fn start(rig: Rig) -> Result<Self, Error> {
        let header = rig.header().clone();
        let live = LiveRig::start(rig)?;
        Ok(Self {
            live,
            header,
            number: 0,
        })
    }

    /// Facts on specimen, indenter and sensor for the header of a recording.
    pub(super) fn header(&self) -> &RecordingHeader {
        &self.header
    }

    /// Runs one command. A stop takes all forces off at once, because a hand may be on the device.
    pub(super) fn carry_out(
        &mut self,
        order: RigCommand,
        watch: &dyn ProgressCallback,
    ) -> Result<Ended, Error> {
        self.live.console.send(order);
        self.wait_for(order, &mut None, watch)
            .map(|done| done.ended)
    }

    /// Runs one stimulus; none when it was stopped before any sample.
    pub(super) fn record(
        &mut self,
        trajectory: &DepthTrajectory,
        header: RecordingHeader,
        file: &Path,
        online: &mut Option<Estimating>,
        watch: &dyn ProgressCallback,
    ) -> Result<Option<Recorded>, Error> {
        self.number += 1;
        // The tissue recovers from the previous stimulus, then from the search for contact.
        for order in [RigCommand::Rest, RigCommand::Approach, RigCommand::Rest] {
            if self.carry_out(order, watch)? == Ended::Stopped {
                return Ok(None);
            }
        }
        let commission = RecordingRequest {
            number: self.number,
            file: file.to_owned(),
            header,
        };
        self.live.press(*trajectory, commission);
        let press = RigCommand::Press(*trajectory, self.number);
        let pressed = self.wait_for(press, online, watch);
        pressed.map(|done| done.recorded)
    }

    fn wait_for(
        &mut self,
        order: RigCommand,
        online: &mut Option<Estimating>,
        watch: &dyn ProgressCallback,
    ) -> Result<Done, Error> {
        let (mut recorded, mut is_stopped) = (None, false);
        loop {
            self.live.report_alive();
            if !is_stopped && watch.should_stop() {
                self.live.console.emergency_stop();
                is_stopped = true;
            }
            for sample in self.live.samples.drain() {
                let pressing = online.as_mut().filter(|_| sample.phase == Phase::Pressing);
                if pressing.is_some_and(|online| online.take(&sample, watch)) {
                    self.live.console.end_press(self.number);
                }
            }
            let news = match self.live.console_events.recv_timeout(LOOK) {
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
            let ended = match news {
                ConsoleEvent::Recorded(_, done, _) => {
                    recorded = Some(done);
                    continue;
                }
                ConsoleEvent::WriteFailed(unwritten) => return Err(unwritten.error.into()),
                ConsoleEvent::Ended(_, Err(error)) | ConsoleEvent::Failed(error) if !is_stopped => {
                    return Err(error.into());
                }
                ConsoleEvent::Ended(done, how) if done == order => how.unwrap_or(Ended::Stopped),
                ConsoleEvent::Dropped(dropped) if dropped == order => Ended::Stopped,
                _ => continue,
            };
            // A stop that is requested during the last tick of a command applies to that command.
            let ended = if is_stopped { Ended::Stopped } else { ended };
            return Ok(Done { ended, recorded });
        }
    }

    /// A device that hangs gives an error at once: its rig sends nothing more.
    fn check_device(&self) -> Result<(), Error> {
        self.live
            .hung_device()
            .map_or(Ok(()), |hung| Err(Error::failed(hung)))
    }
}
