// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shaders that are broken on purpose, to see whether a test notices.

use std::cell::RefCell;

/// Text to replace, its replacement, and the number of places found.
struct Edit {
    from: String,
    to: String,
    found: usize,
}

thread_local! {
    static EDITS: RefCell<Vec<Edit>> = const { RefCell::new(Vec::new()) };
}

/// Does `work` while every shader that this thread compiles has `to` in place of `from`. A renderer made then keeps its
/// shaders. Edits may lie within one another.
///
/// # Panics
/// If no shader had `from`: then nothing was broken.
pub fn with_shader_edit<T>(from: &str, to: &str, work: impl FnOnce() -> T) -> T {
    EDITS.with_borrow_mut(|edits| edits.push(Edit { from: from.into(), to: to.into(), found: 0 }));
    let outcome = work();
    let found = EDITS.with_borrow_mut(Vec::pop).map_or(0, |edit| edit.found);
    assert!(found > 0, "no shader says {from:?}");
    outcome
}

/// The text that is compiled.
pub(crate) fn edited(source: String) -> String {
    EDITS.with_borrow_mut(|edits| {
        edits.iter_mut().fold(source, |source, edit| {
            edit.found += source.matches(&edit.from).count();
            source.replace(&edit.from, &edit.to)
        })
    })
}
