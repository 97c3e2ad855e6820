use std::fmt;
use std::str::FromStr;

use crate::OpenError;

/// Where a Haply Inverse Service is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HaplyAddress {
    /// The machine.
    pub host: String,
    /// The port of states and forces.
    pub port: u16,
    /// The port of events.
    pub events_port: u16,
}

impl Default for HaplyAddress {
    /// The service's own defaults, on this machine.
    fn default() -> Self {
        Self {
            host: "127.0.0.1".to_owned(),
            port: 10_001,
            events_port: 10_020,
        }
    }
}

impl FromStr for HaplyAddress {
    type Err = OpenError;

    fn from_str(text: &str) -> Result<Self, OpenError> {
        let no_address = || OpenError::NoAddress {
            found: text.to_owned(),
        };
        let (place, events) = match text.split_once(',') {
            Some((place, events)) => (place, Some(events)),
            None => (text, None),
        };
        let (host, port) = place.rsplit_once(':').ok_or_else(no_address)?;
        let number = |digits: &str| digits.trim().parse().map_err(|_| no_address());
        let is_name = |letter: char| letter.is_ascii_alphanumeric() || "-.:[]".contains(letter);
        if host.is_empty() || !host.chars().all(is_name) {
            return Err(no_address());
        }
        Ok(Self {
            host: host.to_owned(),
            port: number(port)?,
            events_port: events.map_or(Ok(Self::default().events_port), number)?,
        })
    }
}

impl fmt::Display for HaplyAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.host, self.port)
    }
}
