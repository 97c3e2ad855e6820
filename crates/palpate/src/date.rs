//! Dates of the Gregorian calendar, in universal time: no file states a local time zone.

/// Seconds of a day.
const DAY: i64 = 86_400;

/// Days of 400 years, after which the calendar repeats itself.
const CYCLE: i64 = 146_097;

/// From 1 March of the year 0 to the beginning of 1970 [days].
const EPOCH: i64 = 719_468;

/// A time since the beginning of 1970 [s], as `2026-11-22 17:05`.
pub(crate) fn short(when: i64) -> String {
    let (year, month, day) = day_of(when);
    let [hour, minute, _] = clock(when);
    format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}")
}

/// A time since the beginning of 1970 [s] as in ISO 8601: `2026-11-22T17:05:00Z`.
pub(crate) fn exact(when: i64) -> String {
    let (year, month, day) = day_of(when);
    let [hour, minute, second] = clock(when);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// The last second of a day that is written as `2026-11-22`, since the beginning of 1970 [s]; none where there is no
/// such day.
pub(crate) fn end_of_day(text: &str) -> Option<i64> {
    let mut parts = text.splitn(3, '-').map(str::parse::<i64>);
    let (year, month, day) = (
        parts.next()?.ok()?,
        parts.next()?.ok()?,
        parts.next()?.ok()?,
    );
    if !(1970..=9999).contains(&year) || !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // Years begin in March, as in `day_of`.
    let (in_year, year) = match month {
        1 | 2 => (month + 9, year - 1),
        _ => (month - 3, year),
    };
    let days = 365 * year + year / 4 - year / 100 + year / 400 + (153 * in_year + 2) / 5 + day - 1;
    let end = (days - EPOCH) * DAY + DAY - 1;
    // The 30th of February is another day.
    (day_of(end) == (if month <= 2 { year + 1 } else { year }, month, day)).then_some(end)
}

fn clock(when: i64) -> [i64; 3] {
    let second = when.rem_euclid(DAY);
    [second / 3600, second / 60 % 60, second % 60]
}

/// Year, month and day. Years begin in March here, so that the leap day is their last.
fn day_of(when: i64) -> (i64, i64, i64) {
    let days = when.div_euclid(DAY) + EPOCH;
    let in_cycle = days.rem_euclid(CYCLE);
    // Less the days that leap years have more: one in 4 years, none in 100, one in 400.
    let year = (in_cycle - in_cycle / 1460 + in_cycle / 36_524 - in_cycle / (CYCLE - 1)) / 365;
    let in_year = in_cycle - (365 * year + year / 4 - year / 100);
    // Five months in turn have 153 days.
    let month = (5 * in_year + 2) / 153;
    let day = in_year - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    (400 * days.div_euclid(CYCLE) + year + later, month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_end_before_the_next_one() {
        for day in ["1970-01-01", "2000-02-29", "2026-12-31", "2100-02-28"] {
            let end = end_of_day(day).unwrap();
            assert_eq!(exact(end), format!("{day}T23:59:59Z"));
        }
        for none in [
            "2100-02-29",
            "2026-13-01",
            "2026-04-31",
            "tomorrow",
            "2026-4",
            "",
        ] {
            assert_eq!(end_of_day(none), None, "{none}");
        }
    }

    #[test]
    fn known_dates() {
        assert_eq!(exact(0), "1970-01-01T00:00:00Z");
        assert_eq!(exact(951_782_399), "2000-02-28T23:59:59Z");
        assert_eq!(exact(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(exact(1_000_000_000), "2001-09-09T01:46:40Z");
        assert_eq!(exact(2_147_483_647), "2038-01-19T03:14:07Z");
        assert_eq!(exact(-1), "1969-12-31T23:59:59Z");
        assert_eq!(short(4_107_542_400), "2100-03-01 00:00");
        // The limits of a record's column.
        assert!(!exact(i64::MIN).is_empty() && !exact(i64::MAX).is_empty());
    }

    /// Judge: counting day by day, by the rule of leap years.
    #[test]
    fn every_day_of_400_years_follows_the_one_before() {
        let (mut year, mut month, mut day) = (1970, 1, 1);
        for number in 0..CYCLE {
            assert_eq!(day_of(DAY * number), (year, month, day));
            let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
            let days = match month {
                2 => 28 + i64::from(leap),
                4 | 6 | 9 | 11 => 30,
                _ => 31,
            };
            day += 1;
            if day > days {
                (day, month) = (1, month + 1);
            }
            if month > 12 {
                (month, year) = (1, year + 1);
            }
        }
    }
}
