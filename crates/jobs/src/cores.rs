use std::panic::resume_unwind;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What `work` makes of each of `items`, in their order: whoever is idle takes the next one.
pub fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(items.len()));
    let take = || {
        let place = next.fetch_add(1, Ordering::Relaxed);
        Some((place, items.get(place)?))
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let work_on = || {
            while let Some((place, item)) = take() {
                let made = work(place, item);
                if let Ok(mut done) = done.lock() {
                    done.push((place, made));
                }
            }
        };
        let each = 0..cores.min(items.len());
        let threads: Vec<_> = each.map(|_| scope.spawn(work_on)).collect();
        for thread in threads {
            // Who broke the work off hears of it as if there was one thread.
            if let Err(broken_off) = thread.join() {
                resume_unwind(broken_off);
            }
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, made)| made).collect()
}
