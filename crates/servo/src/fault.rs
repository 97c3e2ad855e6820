/// Why forces are off, or a loop cannot be made. A plain value, so that it leaves the loop without
/// allocation.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The controller gave a force that is no number.
    #[error("the commanded force is not finite; fix the controller and arm again")]
    NonFiniteForce,
    /// The device gave a state that is no number.
    #[error("the device answered with a number that is not finite; restart it and arm again")]
    NonFiniteState,
    /// The hand moved faster than it may.
    #[error("the hand moved at {speed:.2} m/s, beyond {limit} m/s; hold it still and arm again")]
    TooFast {
        /// How fast it moved [m/s].
        speed: f64,
        /// How fast it may move [m/s].
        limit: f64,
    },
    /// What the force is made of is too old.
    #[error(
        "the model's answer has been overdue for {overdue:.3} s, beyond {limit} s; free the processor or take a longer step, and arm again"
    )]
    StaleModel {
        /// How long it has been overdue [s].
        overdue: f64,
        /// How long it may be [s].
        limit: f64,
    },
    /// The device waited too long for its next force.
    #[error(
        "the device had the same force for {gap:.3} s, beyond {limit} s; free the processor and arm again"
    )]
    Late {
        /// How long it had it [s].
        gap: f64,
        /// How long it may have it [s].
        limit: f64,
    },
    /// The device does not answer any more.
    #[error("the device does not answer any more; plug it in and start again")]
    Silent,
    /// The device reports an error of its own.
    #[error("the device reports its error {code}; look it up in its manual and start again")]
    Device {
        /// Its own number for it.
        code: i32,
    },
    /// The connection to the device's service is gone.
    #[error("the connection to the device's service is gone; start the service and begin again")]
    Disconnected,
    /// A message of the device's service cannot be used.
    #[error("the device's service sent {what}; restart it and begin again")]
    BadMessage {
        /// What was wrong with it.
        what: &'static str,
    },
    /// The device is no longer among those that its service or library knows.
    #[error("the device is gone; plug it in and begin again")]
    Vanished,
    /// The device has no power any more.
    #[error("the device lost its power; switch it on and arm again")]
    Unpowered,
    /// The device does not know any more where its handle is.
    #[error("the device lost its calibration; calibrate it and arm again")]
    Uncalibrated,
    /// The device took its forces off by itself.
    #[error("the device took its forces off: {what}; see to that and arm again")]
    Safety {
        /// Why.
        what: &'static str,
    },
    /// The device displays no force although one is sent.
    #[error(
        "the device displays nothing of the force that is sent; check that its service is of a version that `palpate devices` knows, and arm again"
    )]
    Ignored,
    /// The library of the device reports an error.
    #[error("the device's library reports {what} ({code:#06x}); see to that and begin again")]
    Library {
        /// The library's own number for it.
        code: u32,
        /// What it means.
        what: &'static str,
    },
    /// Somebody wants no force at all.
    #[error("the emergency stop was pressed; look after what is touched and arm again")]
    EmergencyStop,
    /// Another loop of the session took its force off.
    #[error("another device of the session took its force off; see to that and arm again")]
    OtherDevice,
    /// The program that shows what is touched does not answer any more.
    #[error(
        "the program was silent for more than {limit} s; look after what is touched and arm again"
    )]
    ProgramSilent {
        /// How long it may be [s].
        limit: f64,
    },
    /// Somebody pressed the stop button of a device.
    #[error("the stop button of a device was pressed; look after what is touched and arm again")]
    DeviceButton,
    /// The program was asked to end.
    #[error("the program was asked to end (Ctrl-C or SIGTERM); start it again")]
    Interrupted,
    /// What happens can no longer be recorded.
    #[error("the recording can no longer be written; record it elsewhere and arm again")]
    Unrecorded,
    /// The thread that watches the loops does not run any more.
    #[error(
        "the thread that watches the devices was silent for more than {limit} s; free the processor and arm again"
    )]
    Unwatched {
        /// How long it may be [s].
        limit: f64,
    },
    /// The thread of the loop ended in a panic; the device was stopped.
    #[error("the servo thread panicked, and the device was stopped; report it as a defect")]
    Panicked,
    /// A call into the device does not return, or its scheduler does not call any more.
    #[error(
        "a device has not answered for {limit} s and may still display its last force; cut its power and start again"
    )]
    Hung {
        /// How long it was waited for [s].
        limit: f64,
    },
    /// The device was called from a thread that is not its scheduler's.
    #[error(
        "the device was called outside of its own scheduler, which its library forbids; report it as a defect"
    )]
    OutsideScheduler,
    /// The operating system gives no thread.
    #[error("the operating system gives no thread for the servo loop; close other programs")]
    NoThread,
    /// A setting is out of range.
    #[error("{what} is {found}; set {expected}")]
    Setting {
        /// Which one.
        what: &'static str,
        /// What it is.
        found: f64,
        /// What it should be.
        expected: &'static str,
    },
}

impl Fault {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::NonFiniteForce
            | Self::NonFiniteState
            | Self::TooFast { .. }
            | Self::StaleModel { .. }
            | Self::Late { .. }
            | Self::Silent
            | Self::Device { .. }
            | Self::Disconnected
            | Self::BadMessage { .. }
            | Self::Vanished
            | Self::Unpowered
            | Self::Uncalibrated
            | Self::Safety { .. }
            | Self::Ignored
            | Self::Library { .. }
            | Self::EmergencyStop
            | Self::OtherDevice
            | Self::ProgramSilent { .. }
            | Self::DeviceButton
            | Self::Interrupted
            | Self::Unrecorded
            | Self::Unwatched { .. }
            | Self::Panicked
            | Self::Hung { .. }
            | Self::OutsideScheduler
            | Self::NoThread => false,
            Self::Setting { .. } => true,
        }
    }

    /// An error unless `found` is a number above zero; it may be infinite where a limit can be none.
    pub(crate) fn unless_positive(what: &'static str, found: f64) -> Result<(), Self> {
        if found > 0.0 {
            return Ok(());
        }
        Err(Self::Setting {
            what,
            found,
            expected: "a number above zero",
        })
    }

    /// An error unless `found` is a finite number above zero.
    pub(crate) fn unless_finite_and_positive(what: &'static str, found: f64) -> Result<(), Self> {
        if found.is_finite() {
            return Self::unless_positive(what, found);
        }
        Err(Self::Setting {
            what,
            found,
            expected: "a finite number above zero",
        })
    }
}

/// As its message.
impl serde::Serialize for Fault {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
