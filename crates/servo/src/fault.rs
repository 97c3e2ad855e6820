/// Why forces are off, or a loop cannot be made. A plain value, so that the loop returns it without allocation.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The controller's force is not a finite number.
    #[error("the commanded force is not finite; fix the controller and arm again")]
    NonFiniteForce,
    /// The device's state is not a finite number.
    #[error("the device answered with a number that is not finite; restart it and arm again")]
    NonFiniteState,
    /// The hand was faster than the limit.
    #[error("the hand moved at {speed:.2} m/s, beyond {limit} m/s; hold it still and arm again")]
    TooFast {
        /// Its speed [m/s].
        speed: f64,
        /// The limit [m/s].
        limit: f64,
    },
    /// The model's answer is too old.
    #[error(
        "the model's answer has been overdue for {overdue:.3} s, beyond {limit} s; free the processor or take a longer step, and arm again"
    )]
    StaleModel {
        /// How long it is overdue [s].
        overdue: f64,
        /// The limit [s].
        limit: f64,
    },
    /// The device received its next force too late.
    #[error(
        "the device had the same force for {gap:.3} s, beyond {limit} s; free the processor and arm again"
    )]
    Late {
        /// How long it had the last one [s].
        gap: f64,
        /// The limit [s].
        limit: f64,
    },
    /// The device does not answer any more.
    #[error("the device does not answer any more; plug it in and start again")]
    Silent,
    /// The device reports an error of its own.
    #[error("the device reports its error {code}; look it up in its manual and start again")]
    Device {
        /// The device's error code.
        code: i32,
    },
    /// The connection to the device's service is lost.
    #[error("the connection to the device's service is gone; start the service and begin again")]
    Disconnected,
    /// A message of the device's service is invalid.
    #[error("the device's service sent {what}; restart it and begin again")]
    BadMessage {
        /// What is wrong with it.
        what: &'static str,
    },
    /// Its service or library no longer lists the device.
    #[error("the device is gone; plug it in and begin again")]
    Vanished,
    /// The device has lost power.
    #[error("the device lost its power; switch it on and arm again")]
    Unpowered,
    /// The device is no longer calibrated.
    #[error("the device lost its calibration; calibrate it and arm again")]
    Uncalibrated,
    /// The device took its forces off by itself.
    #[error("the device took its forces off: {what}; see to that and arm again")]
    Safety {
        /// The reason.
        what: &'static str,
    },
    /// The device displays no force although the loop sends one.
    #[error(
        "the device displays nothing of the force that is sent; check that its service is of a version that `palpate devices` knows, and arm again"
    )]
    Ignored,
    /// The library of the device reports an error.
    #[error("the device's library reports {what} ({code:#06x}); see to that and begin again")]
    Library {
        /// The library's error code.
        code: u32,
        /// Its meaning.
        what: &'static str,
    },
    /// A person pressed the emergency stop.
    #[error("the emergency stop was pressed; look after what is touched and arm again")]
    EmergencyStop,
    /// Another loop of the session took its force off.
    #[error("another device of the session took its force off; see to that and arm again")]
    OtherDevice,
    /// The program that shows the touch no longer answers.
    #[error(
        "the program was silent for more than {limit} s; look after what is touched and arm again"
    )]
    ProgramSilent {
        /// The limit [s].
        limit: f64,
    },
    /// A person pressed the stop button of a device.
    #[error("the stop button of a device was pressed; look after what is touched and arm again")]
    DeviceButton,
    /// The program received a request to end.
    #[error("the program was asked to end (Ctrl-C or SIGTERM); start it again")]
    Interrupted,
    /// The recording failed.
    #[error("the recording can no longer be written; record it elsewhere and arm again")]
    Unrecorded,
    /// The thread that watches the loops no longer runs.
    #[error(
        "the thread that watches the devices was silent for more than {limit} s; free the processor and arm again"
    )]
    MonitorSilent {
        /// The limit [s].
        limit: f64,
    },
    /// The thread of the loop panicked; the device was stopped.
    #[error("the servo thread panicked, and the device was stopped; report it as a defect")]
    Panicked,
    /// A call into the device does not return, or its scheduler no longer calls.
    #[error(
        "a device has not answered for {limit} s and may still display its last force; cut its power and start again"
    )]
    Hung {
        /// The timeout [s].
        limit: f64,
    },
    /// The device was called from a thread other than its scheduler's.
    #[error(
        "the device was called outside of its own scheduler, which its library forbids; report it as a defect"
    )]
    OutsideScheduler,
    /// The operating system provides no thread.
    #[error("the operating system gives no thread for the servo loop; close other programs")]
    NoThread,
    /// A setting is out of range.
    #[error("{what} is {found}; set {expected}")]
    Setting {
        /// The setting.
        what: &'static str,
        /// Its value.
        found: f64,
        /// The valid values.
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
            | Self::MonitorSilent { .. }
            | Self::Panicked
            | Self::Hung { .. }
            | Self::OutsideScheduler
            | Self::NoThread => false,
            Self::Setting { .. } => true,
        }
    }

    /// An error unless `found` is positive; infinity is valid, for a limit that does not apply.
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

    /// An error unless `found` is finite and positive.
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
