//! One computation on all cores.

use std::num::NonZero;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, Builder};

/// Number of threads that can run at the same time.
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// Whether the system refused a thread.
static REFUSED: AtomicBool = AtomicBool::new(false);

/// Whether the system refused a thread of [`on_all_cores`] since the program began. The results are the same, but
/// took longer.
pub fn threads_were_refused() -> bool {
    REFUSED.load(Ordering::Relaxed)
}

/// Does `work` on every item, on all cores: an idle thread takes the next one. The result for an item does not
/// depend on the number of cores. Where the system gives fewer threads than there are cores, or none, the calling
/// thread works too.
///
/// # Panics
/// When `work` does, as if there was one thread.
pub fn on_all_cores<Items>(items: Items, work: impl Fn(Items::Item) + Sync)
where
    Items: Iterator + Send,
{
    with_threads(cores(), items, work);
}

/// The results of `work` for `items`, in their order, on all cores.
///
/// # Panics
/// When `work` does.
pub fn collect_on_all_cores<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(usize, &T) -> R + Sync,
) -> Vec<R> {
    let done = Mutex::new(Vec::with_capacity(items.len()));
    on_all_cores(items.iter().enumerate(), |(place, item)| {
        let made = work(place, item);
        let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
        done.push((place, made));
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, made)| made).collect()
}

fn with_threads<Items>(threads: usize, items: Items, work: impl Fn(Items::Item) + Sync)
where
    Items: Iterator + Send,
{
    let items = Mutex::new(items);
    let next = || items.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work_on = || {
        while let Some(item) = next() {
            work(item);
        }
    };
    thread::scope(|scope| {
        let mut others = Vec::new();
        // The calling thread is one of them.
        for _ in 1..threads {
            match Builder::new().spawn_scoped(scope, work_on) {
                Ok(thread) => others.push(thread),
                Err(_) => {
                    REFUSED.store(true, Ordering::Relaxed);
                    break;
                }
            }
        }
        work_on();
        for thread in others {
            if let Err(panic) = thread.join() {
                resume_unwind(panic);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;

    use super::*;

    #[test]
    fn every_item_is_done_once_by_any_number_of_threads() {
        for threads in [0, 1, 7] {
            let sum = AtomicUsize::new(0);
            with_threads(threads, 0..1000, |item| {
                sum.fetch_add(item, Ordering::Relaxed);
            });
            assert_eq!(sum.into_inner(), 499_500);
        }
    }
}
