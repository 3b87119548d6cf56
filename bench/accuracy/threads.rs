//! Work on as many threads as there are cores, results in the order they were asked for.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use crate::Failure;

/// Calls `work` on every item and `done` with each result in the order of the items, as soon as all
/// before it are there: a long run shows its rows while it goes on.
pub fn in_order<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
    mut done: impl FnMut(&T, R),
) {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..cores.min(items.len()) {
            let (next, work, sender) = (&next, &work, sender.clone());
            scope.spawn(move || {
                while let Some((i, item)) = take(next, items) {
                    if sender.send((i, work(item))).is_err() {
                        break;
                    }
                }
            });
        }
        // Else receiving would never end should a thread panic.
        drop(sender);
        let mut waiting: Vec<Option<R>> = items.iter().map(|_| None).collect();
        let mut shown = 0;
        for (i, result) in receiver {
            waiting[i] = Some(result);
            while let Some(result) = waiting.get_mut(shown).and_then(Option::take) {
                done(&items[shown], result);
                shown += 1;
            }
        }
    });
}

/// The same for work that can fail: `done` sees what did not, and the first failure is returned.
pub fn try_in_order<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<R, Failure> + Sync,
    mut done: impl FnMut(&T, R),
) -> Result<(), Failure> {
    let mut outcome = Ok(());
    in_order(items, work, |item, result| match result {
        Ok(result) => done(item, result),
        Err(failure) if outcome.is_ok() => outcome = Err(failure),
        Err(_) => {}
    });
    outcome
}

/// The same for items in groups: `done` sees all results of a group at once. Threads do not wait for a
/// group's end.
pub fn in_groups<G: Sync, T: Sync, R: Send>(
    groups: &[(G, Vec<T>)],
    work: impl Fn(&G, &T) -> Result<R, Failure> + Sync,
    mut done: impl FnMut(&G, &[R]),
) -> Result<(), Failure> {
    let flat: Vec<(&(G, Vec<T>), &T)> = groups
        .iter()
        .flat_map(|group| group.1.iter().map(move |item| (group, item)))
        .collect();
    let mut results = Vec::new();
    try_in_order(
        &flat,
        |((of, _), item)| work(of, item),
        |((of, items), _), result| {
            results.push(result);
            if results.len() == items.len() {
                done(of, &results);
                results.clear();
            }
        },
    )
}

/// All results.
pub fn all<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<R, Failure> + Sync,
) -> Result<Vec<R>, Failure> {
    let mut results = Vec::new();
    try_in_order(items, work, |_, result| results.push(result))?;
    Ok(results)
}

fn take<'a, T>(next: &AtomicUsize, items: &'a [T]) -> Option<(usize, &'a T)> {
    let i = next.fetch_add(1, Ordering::Relaxed);
    items.get(i).map(|item| (i, item))
}
