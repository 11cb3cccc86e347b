// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The command line of Windfall.

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    keep_wayland_quiet();
    windfall::cli::main()
}

/// Mesa's Vulkan layer that sorts devices looks for a Wayland display, and the Wayland library complains on the
/// standard error if the session has no folder for one. There is no display to find then, so the program starts itself
/// again without that layer.
#[cfg(target_os = "linux")]
fn keep_wayland_quiet() {
    use std::os::unix::process::CommandExt;
    use std::{env, process};

    const WITHOUT_LAYER: &str = "NODEVICE_SELECT";
    let has_folder =
        env::var_os("XDG_RUNTIME_DIR").is_some_and(|folder| folder.as_encoded_bytes().starts_with(b"/"));
    if has_folder || env::var_os(WITHOUT_LAYER).is_some() {
        return;
    }
    let Ok(program) = env::current_exe() else { return };
    let mut arguments = env::args_os();
    let name = arguments.next().unwrap_or_default();
    // Returns only if the program could not be started; then a complaint does no harm.
    let _ = process::Command::new(program).arg0(name).args(arguments).env(WITHOUT_LAYER, "1").exec();
}
