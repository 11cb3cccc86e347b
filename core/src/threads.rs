// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Work on several threads where the platform has any, and on the caller's where it has none, as in a browser.

use std::panic::resume_unwind;
use std::thread::{available_parallelism, scope};

/// Number of threads that can run at once: 1 where it is not known.
fn parallelism() -> usize {
    available_parallelism().map_or(1, usize::from)
}

/// Results of two jobs, done side by side.
pub(crate) fn both<A: Send, B>(first: impl FnOnce() -> A + Send, second: impl FnOnce() -> B) -> (A, B) {
    if parallelism() == 1 {
        return (first(), second());
    }
    scope(|scope| {
        let first = scope.spawn(first);
        let second = second();
        (first.join().unwrap_or_else(|panic| resume_unwind(panic)), second)
    })
}

/// Results of a job for every item, each on a thread of its own.
pub(crate) fn each<I: Send, T: Send>(items: impl Iterator<Item = I>, job: impl Fn(I) -> T + Sync) -> Vec<T> {
    if parallelism() == 1 {
        return items.map(job).collect();
    }
    scope(|scope| {
        let job = &job;
        let jobs: Vec<_> = items.map(|item| scope.spawn(move || job(item))).collect();
        jobs.into_iter().map(|job| job.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
}

/// Does the same work on as many threads as can run at once.
pub(crate) fn on_all(work: impl Fn() + Sync) {
    scope(|scope| {
        for _ in 1..parallelism() {
            scope.spawn(&work);
        }
        work();
    });
}
