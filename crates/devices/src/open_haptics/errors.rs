//! The numbers of the library's errors.

use palpate_servo::Fault;

pub(super) const NONE: u32 = 0;

/// The meaning of an error code.
pub(super) fn meaning(code: u32) -> &'static str {
    match code {
        0x0100..=0x01FF => "a call that it does not take",
        0x0200 => "hot motors",
        0x0201 => "a force that is too large",
        0x0202 => "a force that changes too fast",
        0x0203 => "a handle that is too fast",
        0x0204 => "forces that it cannot display",
        0x0300 => "a fault of the device",
        0x0301 => "a device that is open already",
        0x0302 => "a lost connection to the device",
        0x0303 => "a wrong command to the device",
        0x0304 => "a clock that fails",
        0x0400..=0x04FF => "frames out of order",
        0x0500..=0x05FF => "a scheduler that fails",
        0x0600..=0x06FF => "a missing licence",
        _ => "an error",
    }
}

/// A device that reports one of these still answers.
fn is_lived_through(code: u32) -> bool {
    (0x0200..=0x02FF).contains(&code)
}

/// The one with further information.
pub(super) fn worse(one: u32, other: u32) -> u32 {
    match one {
        NONE => other,
        _ if is_lived_through(one) && other != NONE && !is_lived_through(other) => other,
        _ => one,
    }
}

/// The fault of an error code: it takes forces off (ok), or ends the loop (error).
pub(super) fn fault(code: u32) -> Result<Option<Fault>, Fault> {
    let what = meaning(code);
    let fault = Fault::Library { code, what };
    match code {
        NONE => Ok(None),
        _ if is_lived_through(code) => Ok(Some(fault)),
        _ => Err(fault),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_ends_a_loop_is_worse_than_what_it_lives_through() {
        assert_eq!(worse(NONE, 0x200), 0x200);
        assert_eq!(worse(0x200, NONE), 0x200);
        assert_eq!(worse(0x200, 0x302), 0x302);
        assert_eq!(worse(0x302, 0x200), 0x302);
        assert!(fault(0x203).unwrap().is_some() && fault(0x302).is_err());
        assert_eq!(fault(NONE), Ok(None));
    }
}
