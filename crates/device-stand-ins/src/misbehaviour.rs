use std::time::Duration;

/// What goes wrong from now on.
#[derive(Debug, Clone, PartialEq)]
pub enum Misbehaviour {
    /// The connection is cut.
    Disconnects,
    /// Answers come so much later.
    Stalls(Duration),
    /// No answer comes.
    NoReply,
    /// This is sent instead of a state.
    SendsText(String),
    /// Bytes that are no text are sent instead.
    SendsBinary(Vec<u8>),
    /// These bytes are sent instead, without so much as the frame of a message.
    SendsRaw(Vec<u8>),
    /// A state is cut off after so many bytes.
    Truncates(usize),
    /// A state comes in fragments of so many bytes.
    Fragments(usize),
    /// The bytes of a state come one by one, so far apart.
    SendsBytewise(Duration),
    /// There are so many more states than were asked for.
    Repeats(usize),
    /// The devices are not in the states any more.
    DevicesMissing,
    /// The states have no position.
    NoPosition,
    /// The first coordinate is this instead of a number.
    Coordinate(&'static str),
    /// The power is gone.
    NoPower,
    /// The calibration is gone.
    NoCalibration,
    /// Forces are taken and not displayed.
    NoForce,
    /// Keys that nobody knows are in the states.
    UnknownKeys,
}
