use std::sync::Mutex;

/// What `work` makes of each of `items`, in their order: whoever is idle takes the next one.
pub fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let done = Mutex::new(Vec::with_capacity(items.len()));
    palpate_mechanics::on_all_cores(items.iter().enumerate(), |(place, item)| {
        let made = work(place, item);
        if let Ok(mut done) = done.lock() {
            done.push((place, made));
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, made)| made).collect()
}
