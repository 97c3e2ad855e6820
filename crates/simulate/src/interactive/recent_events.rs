use palpate_files::session::Event;

/// Something that happened to a tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedEvent {
    /// Its number since the beginning: who remembers the last number sees what is new.
    pub number: u64,
    /// When [s].
    pub time: f64,
    /// To which tool, in the scene's order.
    pub tool: usize,
    /// What.
    pub event: Event,
}

/// How many are kept.
const KEPT: u64 = 32;

/// The last 32 things that happened; it never grows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RecentEvents {
    ring: [Option<TimedEvent>; KEPT as usize],
    count: u64,
}

impl RecentEvents {
    /// Adds one; the oldest goes.
    pub(super) fn add(&mut self, time: f64, tool: usize, event: Event) {
        self.ring[(self.count % KEPT) as usize] = Some(TimedEvent {
            number: self.count,
            time,
            tool,
            event,
        });
        self.count += 1;
    }

    /// How many there were since the beginning.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Those from number `from` on that are still kept, the oldest first.
    pub fn since(&self, from: u64) -> impl Iterator<Item = &TimedEvent> {
        let first = from.max(self.count.saturating_sub(KEPT));
        (first..self.count).filter_map(|number| self.ring[(number % KEPT) as usize].as_ref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_go() {
        let mut recent_events = RecentEvents::default();
        (0..40).for_each(|tool| recent_events.add(0.0, tool, Event::Contact));
        let tools: Vec<_> = recent_events
            .since(0)
            .map(|happening| happening.tool)
            .collect();
        assert_eq!(tools, (8..40).collect::<Vec<_>>());
        assert_eq!(recent_events.since(39).count(), 1);
        assert_eq!(recent_events.since(recent_events.count()).count(), 0);
    }
}
