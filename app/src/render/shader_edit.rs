// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shaders that are broken on purpose, to see whether a test notices.

use std::cell::RefCell;

/// What to look for, what to put there, and how often it was found.
struct Edit {
    from: String,
    to: String,
    found: usize,
}

thread_local! {
    static EDIT: RefCell<Option<Edit>> = const { RefCell::new(None) };
}

/// Does `work` while every shader that this thread compiles has `to` in place of `from`. A renderer made then keeps its
/// shaders.
///
/// # Panics
/// If no shader had `from`: then nothing was broken.
pub fn with_shader_edit<T>(from: &str, to: &str, work: impl FnOnce() -> T) -> T {
    EDIT.set(Some(Edit { from: from.into(), to: to.into(), found: 0 }));
    let outcome = work();
    let found = EDIT.take().map_or(0, |edit| edit.found);
    assert!(found > 0, "no shader says {from:?}");
    outcome
}

/// The text that is compiled.
pub(super) fn edited(source: String) -> String {
    EDIT.with_borrow_mut(|edit| match edit {
        Some(edit) => {
            edit.found += source.matches(&edit.from).count();
            source.replace(&edit.from, &edit.to)
        }
        None => source,
    })
}
