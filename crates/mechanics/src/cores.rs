use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// How many threads can run at once.
pub(crate) fn cores() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// Does `work` on every item, on all cores: whoever is idle takes the next one. What is done on an item
/// does not depend on the number of cores.
pub(crate) fn on_all_cores<Items>(items: Items, work: impl Fn(Items::Item) + Sync)
where
    Items: Iterator + Send,
{
    let items = Mutex::new(items);
    let next = || items.lock().unwrap_or_else(PoisonError::into_inner).next();
    thread::scope(|scope| {
        for _ in 0..cores() {
            scope.spawn(|| {
                while let Some(item) = next() {
                    work(item);
                }
            });
        }
    });
}
