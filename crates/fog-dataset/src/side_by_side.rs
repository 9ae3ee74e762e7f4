//! Reading many files at once.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crate::store::Store;

/// Threads where every one of them mostly waits for a network.
const WAITING: usize = 16;

/// Results of `work` for 0, 1, … `count` − 1, by as many threads as have cores, or more where the store waits.
pub(crate) fn side_by_side<T: Send>(
    store: &Store,
    count: usize,
    work: &(dyn Fn(usize) -> T + Sync),
) -> Vec<T> {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let threads = if store.waits() { WAITING } else { cores }.min(count.max(1));
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= count {
                return done;
            }
            done.push((i, work(i)));
        }
    };
    let mut all: Vec<(usize, T)> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(take)).collect();
        let results = threads.into_iter().map(|thread| thread.join());
        results.flat_map(|done| done.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    all.sort_unstable_by_key(|(i, _)| *i);
    all.into_iter().map(|(_, result)| result).collect()
}
