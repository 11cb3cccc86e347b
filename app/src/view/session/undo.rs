// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Undo and redo.

use std::collections::VecDeque;

/// Most steps that can be undone.
const MOST: usize = 200;

/// Documents to undo and redo to.
#[derive(Clone, Debug)]
pub(crate) struct Undo<T> {
    past: VecDeque<T>,
    future: Vec<T>,
    /// The gesture that made the last step, while it may go on.
    gesture: Option<u64>,
}

impl<T> Default for Undo<T> {
    fn default() -> Self {
        Self { past: VecDeque::new(), future: Vec::new(), gesture: None }
    }
}

impl<T> Undo<T> {
    /// Notes what there was `before` an edit. All edits of one gesture, a drag for example, are one step.
    pub(crate) fn record(&mut self, before: T, gesture: u64) {
        self.future.clear();
        if self.gesture == Some(gesture) {
            return;
        }
        self.gesture = Some(gesture);
        self.past.push_back(before);
        if self.past.len() > MOST {
            self.past.pop_front();
        }
    }

    /// Notes what there was `before` something that is a step of its own.
    pub(crate) fn record_apart(&mut self, before: T) {
        self.gesture = None;
        self.record(before, u64::MAX);
        self.gesture = None;
    }

    /// Goes back to what there was before the last step, if `go` gets there from `now`.
    pub(crate) fn undo<E>(&mut self, now: T, go: impl FnOnce(&T) -> Result<(), E>) -> Result<bool, E> {
        let Some(to) = self.past.back() else { return Ok(false) };
        go(to)?;
        self.past.pop_back();
        self.future.push(now);
        self.gesture = None;
        Ok(true)
    }

    /// Goes forward again to what was undone last, if `go` gets there from `now`.
    pub(crate) fn redo<E>(&mut self, now: T, go: impl FnOnce(&T) -> Result<(), E>) -> Result<bool, E> {
        let Some(to) = self.future.last() else { return Ok(false) };
        go(to)?;
        self.future.pop();
        self.past.push_back(now);
        self.gesture = None;
        Ok(true)
    }

    /// Numbers of steps that can be undone and redone.
    pub(crate) fn depths(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number that is edited.
    struct Bench {
        now: u32,
        history: Undo<u32>,
    }

    impl Bench {
        fn edit(&mut self, to: u32, gesture: u64) {
            self.history.record(self.now, gesture);
            self.now = to;
        }

        fn go(&mut self, back: bool) -> bool {
            let mut there = self.now;
            let step = |to: &u32| {
                there = *to;
                Ok::<(), ()>(())
            };
            let moved =
                if back { self.history.undo(self.now, step) } else { self.history.redo(self.now, step) };
            self.now = there;
            moved.expect("nothing refuses")
        }
    }

    #[test]
    fn a_drag_is_one_step_back_and_forth() {
        let mut bench = Bench { now: 0, history: Undo::default() };
        bench.edit(1, 1);
        for to in 2..10 {
            bench.edit(to, 2);
        }
        bench.edit(20, 3);
        assert_eq!(bench.history.depths(), (3, 0), "three gestures");
        let undone: Vec<u32> = std::iter::from_fn(|| bench.go(true).then_some(bench.now)).collect();
        assert_eq!(undone, [9, 1, 0], "before each gesture");
        let redone: Vec<u32> = std::iter::from_fn(|| bench.go(false).then_some(bench.now)).collect();
        assert_eq!(redone, [1, 9, 20], "and forward again");
    }

    #[test]
    fn an_edit_after_undoing_forgets_what_was_undone() {
        let mut bench = Bench { now: 0, history: Undo::default() };
        bench.edit(1, 1);
        bench.edit(2, 2);
        assert!(bench.go(true), "one step");
        bench.edit(3, 2);
        assert_eq!(
            bench.history.depths(),
            (2, 0),
            "a step of its own, though the gesture has the same number"
        );
        assert!(!bench.go(false), "nothing to redo");
        assert!(bench.go(true) && bench.now == 1, "what there was before");
    }

    #[test]
    fn a_step_that_is_refused_stays() {
        let mut history = Undo::default();
        history.record(7, 1);
        assert_eq!(history.undo(8, |_| Err("refused")), Err("refused"), "the error comes back");
        assert_eq!(history.depths(), (1, 0), "as before");
        for gesture in 0..500 {
            history.record(7, 10 + gesture);
        }
        assert_eq!(history.depths(), (MOST, 0), "bounded");
    }
}
