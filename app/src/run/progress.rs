// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Progress bars on the standard error, if that is a terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Time between two drawings of a bar on which nothing happens.
const TICK: Duration = Duration::from_millis(200);

/// A bar for `count` things that are called `name`.
pub(crate) fn bar(count: u64, name: &str) -> ProgressBar {
    let bar = with_template(count, &format!("{{bar:40}} {name} {{pos}} of {{len}}, {{eta}} left"));
    bar.enable_steady_tick(TICK);
    bar
}

/// A bar that is shown while pictures of leaves are made: takes how many of how many are.
pub(crate) fn making_leaves() -> impl Fn(u32, u32) + Sync {
    let bar = with_template(0, "making leaves {bar:40} {pos} of {len}");
    move |made, count| {
        if made == 0 {
            bar.reset();
        }
        bar.set_length(count.into());
        bar.set_position(made.into());
        if made == count {
            bar.finish_and_clear();
        }
    }
}

fn with_template(count: u64, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(count), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}
