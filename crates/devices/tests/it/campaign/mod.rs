//! The fault campaign: every fault, with every driver, at random moments in contact.
//!
//! Judge: the limits at every tick, the promised time until zero is displayed, that it stays, and the name of the fault.
//! What is displayed is read from the stand-in, which keeps a force where the vendors' documents promise nothing else. The
//! table of the worst times is printed.

mod on_the_machines_clock;
mod on_the_virtual_clock;
mod world;

use palpate_servo::Fault;

/// Who drives the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Driver {
    Virtual,
    Haply,
    OpenHaptics,
    ForceDimension,
}

pub(crate) const DRIVERS: [Driver; 4] = [
    Driver::Virtual,
    Driver::Haply,
    Driver::OpenHaptics,
    Driver::ForceDimension,
];

/// What goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Trouble {
    /// The device answers no more, or its scheduler calls no more.
    Silence,
    /// Its answer, or its scheduler's call, comes 40 ms late.
    Late,
    /// Every answer or call comes many times.
    Doubled,
    /// A call into its library never returns.
    Hung,
    /// It answers with a place that is no number.
    NotANumber,
    /// Its connection is lost.
    Lost,
    /// It takes its forces off by itself.
    TakesOff,
    /// The controller wants a force that is no number.
    ForceNotANumber,
    /// The controller panics.
    Panic,
    /// The thread of the model is killed.
    ModelKilled,
}

pub(crate) const TROUBLES: [Trouble; 10] = [
    Trouble::Silence,
    Trouble::Late,
    Trouble::Doubled,
    Trouble::Hung,
    Trouble::NotANumber,
    Trouble::Lost,
    Trouble::TakesOff,
    Trouble::ForceNotANumber,
    Trouble::Panic,
    Trouble::ModelKilled,
];

/// The largest force without a dead-man's switch [N]: half of 3 N.
pub(crate) const LIMIT: f64 = 1.5;

/// Whether `fault` is the name of `trouble` with `driver`.
pub(crate) fn is_named(driver: Driver, trouble: Trouble, fault: Option<Fault>) -> bool {
    use Trouble::{
        Doubled, ForceNotANumber, Hung, Late, Lost, ModelKilled, NotANumber, Panic, Silence,
        TakesOff,
    };
    let watchdog = Fault::Safety {
        what: "its watchdog tripped",
    };
    match (trouble, driver, fault) {
        (Silence | Hung, Driver::OpenHaptics, Some(Fault::Hung { .. })) => true,
        (Hung, Driver::ForceDimension, Some(Fault::Hung { .. })) => true,
        // A library that takes 40 ms for a call is late; a device with a watchdog says so first.
        (Silence | Late, Driver::ForceDimension, Some(fault)) => {
            matches!(fault, Fault::Late { .. }) || fault == watchdog
        }
        (Silence | Late | Hung, Driver::Haply, Some(fault)) => fault == Fault::Silent,
        (Silence, _, Some(fault)) => fault == Fault::Silent,
        (Late, _, Some(fault)) => matches!(fault, Fault::Late { .. }),
        // Frames are frames, however many: no fault.
        (Doubled, Driver::OpenHaptics, None) => true,
        (Doubled, Driver::Haply, Some(fault)) => matches!(fault, Fault::BadMessage { .. }),
        (NotANumber, Driver::Haply, Some(fault)) => matches!(fault, Fault::BadMessage { .. }),
        (NotANumber, _, Some(fault)) => fault == Fault::NonFiniteState,
        (Lost, Driver::Haply, Some(fault)) => fault == Fault::Disconnected,
        (Lost, Driver::OpenHaptics, Some(fault)) => matches!(fault, Fault::Library { .. }),
        (Lost, _, Some(fault)) => fault == Fault::Vanished,
        (TakesOff, Driver::Haply, Some(fault)) => fault == Fault::Unpowered,
        (TakesOff, Driver::OpenHaptics, Some(fault)) => matches!(fault, Fault::Library { .. }),
        (TakesOff, _, Some(fault)) => matches!(fault, Fault::Safety { .. }),
        (ForceNotANumber, _, Some(fault)) => fault == Fault::NonFiniteForce,
        (Panic, _, Some(fault)) => fault == Fault::Panicked,
        (ModelKilled, _, Some(fault)) => matches!(fault, Fault::StaleModel { .. }),
        _ => false,
    }
}

/// Whether `trouble` can befall `driver`: a virtual device makes no calls, and a call that is made gets one answer.
pub(crate) fn befalls(driver: Driver, trouble: Trouble) -> bool {
    match trouble {
        Trouble::Hung => driver != Driver::Virtual,
        Trouble::Doubled => matches!(driver, Driver::Haply | Driver::OpenHaptics),
        _ => true,
    }
}

/// Numbers below one that are the same every time.
pub(crate) struct Chance(pub(crate) u64);

impl Chance {
    pub(crate) fn next(&mut self) -> f64 {
        // Knuth's multiplier for 64 bits; the upper half is the better one.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) as f64 / f64::from(1u32 << 31)
    }
}

/// The worst that was measured of a trouble with each driver; none where it cannot befall.
pub(crate) type Row = [Option<f64>; 4];

/// Prints the table of worst times [ms], the unit of which is of the clock.
pub(crate) fn print(title: &str, rows: &[(String, Row)]) {
    println!("| {title} | virtual | haply | openhaptics | force_dimension |");
    println!("|---|---|---|---|---|");
    for (name, row) in rows {
        let cells = row.map(|worst| worst.map_or("–".to_owned(), |ms| format!("{ms:.1}")));
        println!("| {name} | {} |", cells.join(" | "));
    }
}
