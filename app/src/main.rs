// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The command line of Windfall.

use std::process::ExitCode;

fn main() -> ExitCode {
    windfall::cli::main()
}
