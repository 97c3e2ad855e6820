use std::time::Duration;

/// What goes wrong from now on.
#[derive(Debug, Clone, PartialEq)]
pub enum Misbehaviour {
    /// The connection is cut.
    Drops,
    /// Answers come so much later.
    Stalls(Duration),
    /// No answer comes.
    Swallows,
    /// This is sent instead of a state.
    Says(String),
    /// Bytes that are no text are sent instead.
    SaysBytes(Vec<u8>),
    /// These bytes are sent instead, without so much as the frame of a message.
    SaysRaw(Vec<u8>),
    /// A state is cut off after so many bytes.
    CutsOff(usize),
    /// A state comes in fragments of so many bytes.
    Fragments(usize),
    /// The bytes of a state come one by one, so far apart.
    Dribbles(Duration),
    /// There are so many more states than were asked for.
    Repeats(usize),
    /// The devices are not in the states any more.
    Vanishes,
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
