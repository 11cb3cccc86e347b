// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Errors of grammars.

use thiserror::Error;

/// Most characters of what an error says was found, and of what is allowed.
const LONGEST: usize = 300;

/// A place in the text of a grammar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

/// A grammar that cannot be used as it is.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum GrammarError {
    /// Something in the text is wrong, or turns out to be wrong when a tree grows.
    #[error("line {}, column {}: {found}; allowed: {allowed}", at.line, at.column)]
    Text {
        /// Position in the text.
        at: Position,
        /// Text found.
        found: String,
        /// Values allowed.
        allowed: String,
    },
    /// The tree grows past a limit.
    #[error("step {step} of {steps} reaches {reached} {what}; allowed: at most {limit}")]
    Limit {
        /// The step at which it does; after the last for what is counted in the finished tree.
        step: u32,
        /// Number of steps asked for.
        steps: u32,
        /// Name of what is counted.
        what: &'static str,
        /// Count reached.
        reached: usize,
        /// The limit.
        limit: usize,
    },
    /// A tree of which nothing is above the ground.
    #[error(
        "the tree has no height: nothing of it is above the ground; allowed: `F` upwards in the finished tree"
    )]
    NoHeight,
}

impl GrammarError {
    /// An error in the text.
    pub(crate) fn text(at: Position, found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self::Text { at, found: shortened(found.into()), allowed: shortened(allowed.into()) }
    }

    /// Value found, and values allowed.
    pub fn parts(&self) -> (String, String) {
        let line = self.to_string();
        let (found, allowed) = line.rsplit_once("; allowed: ").expect("every variant says what is allowed");
        (found.to_owned(), allowed.to_owned())
    }
}

/// At most [`LONGEST`] characters, for names may be as long as the text.
fn shortened(text: String) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}
