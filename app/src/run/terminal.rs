// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Output to the standard streams. A reader that has gone away is no error: it has seen what it wanted.

use std::io::{self, ErrorKind, Write};

/// Writes text to the standard output.
///
/// # Errors
/// Errors of the system, for example a full disk.
pub(crate) fn print(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(anyhow::anyhow!("standard output: cannot write: {error}"))
        }
        _ => Ok(()),
    }
}

/// Writes a note for the user on one line of the standard error.
pub(crate) fn note(message: &str) {
    // Nothing is left to report a failure to.
    let _ = writeln!(io::stderr(), "{}", one_line(message));
}

/// The text with line breaks, and whatever else could move the cursor, replaced by spaces.
pub(crate) fn one_line(text: &str) -> String {
    let words = text.split(|c: char| c.is_whitespace() || c.is_control());
    words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_joined_and_control_characters_dropped() {
        assert_eq!(one_line("a\n  b\r\n\u{1b}[1m c\t d\n"), "a b [1m c d", "one line without escapes");
    }
}
