use std::io;

/// Why a device cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Nobody listens where the service should be.
    #[error(
        "no Haply Inverse Service answers at {address} ({cause}); start it, or say with PALPATE_HAPLY where it is"
    )]
    NoService {
        /// Where it was looked for.
        address: String,
        /// What the system said.
        cause: io::Error,
    },
    /// Somebody listens there, but does not speak as the service does.
    #[error(
        "what answers at {address} is no Haply Inverse Service: {what}; say with PALPATE_HAPLY where that is"
    )]
    NotTheService {
        /// Where it was looked for.
        address: String,
        /// What it did.
        what: String,
    },
    /// The service knows of no such device.
    #[error(
        "the Haply Inverse Service at {address} has {there} of its devices, and number {wanted} is asked for; plug one in"
    )]
    NoDevice {
        /// Where it is.
        address: String,
        /// How many devices it has.
        there: usize,
        /// Which one is asked for, from one on.
        wanted: usize,
    },
    /// An address is no address.
    #[error(
        "{found:?} is no address; write HOST:PORT, or HOST:PORT,PORT with that of the events, as in 127.0.0.1:10001,10020"
    )]
    NoAddress {
        /// What was given.
        found: String,
    },
    /// There is no driver.
    #[error("there is no driver for `{kind}` yet; use another device")]
    NoDriver {
        /// The kind of device.
        kind: crate::Kind,
    },
}
