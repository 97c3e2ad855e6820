use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::message;
use crate::refused::Refused;

/// How a call ended: the exit statuses of the command `palpate`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(
    clippy::enum_variant_names,
    reason = "in C a variant is a name of its own"
)]
pub enum Status {
    /// It was done.
    PalpateOk = 0,
    /// It was not, and what was given is not at fault: a file that may not be read, a defect, a preparation that was
    /// cancelled.
    PalpateFailed = 1,
    /// It was not: what was given is invalid.
    PalpateBadInput = 2,
}

/// Makes a call of what is done; nothing unwinds out of it.
pub(crate) fn answer(call: impl FnOnce() -> Result<(), Refused>) -> Status {
    or_else((), call).1
}

/// What a call answers, or `otherwise` where it cannot be done.
pub(crate) fn or_else<T>(otherwise: T, call: impl FnOnce() -> Result<T, Refused>) -> (T, Status) {
    let refused = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(answer)) => return (answer, Status::PalpateOk),
        Ok(Err(refused)) => refused,
        Err(payload) => Refused::Panicked {
            said: panic_message(payload.as_ref()).to_owned(),
        },
    };
    message::keep(&refused);
    (otherwise, refused.status())
}

fn panic_message(payload: &(dyn Any + Send)) -> &str {
    let owned = payload.downcast_ref::<String>().map(String::as_str);
    owned
        .or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no reason was given")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_sentence() {
        let status = answer(|| panic!("the {} is gone", "ground"));
        assert_eq!(status, Status::PalpateFailed);
        let message = message::last();
        assert!(message.contains("the ground is gone"), "{message}");
    }
}
