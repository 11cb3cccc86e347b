// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading of a grammar's text from left to right, with line and column.

use super::error::{GrammarError, Position};

/// A place in a text, before which everything has been read.
pub(super) struct Cursor<'a> {
    rest: &'a str,
    position: Position,
}

impl<'a> Cursor<'a> {
    /// The start of a text.
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, position: Position { line: 1, column: 1 } }
    }

    /// Position of the next token, past space and comments.
    pub(super) fn position(&mut self) -> Position {
        self.skip_space();
        self.position
    }

    /// Returns true at the end of the text.
    pub(super) fn is_at_end(&mut self) -> bool {
        self.skip_space();
        self.rest.is_empty()
    }

    /// Returns true if `text` comes next.
    pub(super) fn sees(&mut self, text: &str) -> bool {
        self.skip_space();
        self.rest.starts_with(text)
    }

    /// The next character.
    pub(super) fn peek(&mut self) -> Option<char> {
        self.skip_space();
        self.rest.chars().next()
    }

    /// Passes `text` if it comes next.
    pub(super) fn eats(&mut self, text: &str) -> bool {
        let sees = self.sees(text);
        if sees {
            self.advance(text.len());
        }
        sees
    }

    /// Passes `text`, which must come next; `allowed` describes it.
    pub(super) fn expect(&mut self, text: &str, allowed: &str) -> Result<(), GrammarError> {
        if self.eats(text) { Ok(()) } else { Err(self.unexpected(allowed)) }
    }

    /// The next word: a letter or an underscore, then letters, digits and underscores.
    pub(super) fn word(&mut self) -> Option<&'a str> {
        self.skip_space();
        let rest = self.rest;
        if !rest.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            return None;
        }
        let end = rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
        self.advance(end);
        Some(&rest[..end])
    }

    /// The next number, without a sign.
    pub(super) fn number(&mut self) -> Result<Option<f64>, GrammarError> {
        let at = self.position();
        let rest = self.rest;
        if !rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return Ok(None);
        }
        let digits = |from: usize| {
            let tail = &rest[from..];
            from + tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len())
        };
        let mut end = digits(0);
        if rest[end..].starts_with('.') {
            end = digits(end + 1);
        }
        if rest[end..].starts_with(['e', 'E']) {
            let sign = usize::from(rest[end + 1..].starts_with(['+', '-']));
            let exponent = digits(end + 1 + sign);
            end = if exponent > end + 1 + sign { exponent } else { end };
        }
        self.advance(end);
        match rest[..end].parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Some(number)),
            _ => {
                Err(GrammarError::text(at, format!("`{}`", &rest[..end]), "a number such as 2, 0.5 or 1e-3"))
            }
        }
    }

    /// The error that something else should stand here.
    pub(super) fn unexpected(&mut self, allowed: &str) -> GrammarError {
        let at = self.position();
        GrammarError::text(at, self.describe(), allowed)
    }

    /// Next token, for an error.
    fn describe(&self) -> String {
        let rest = self.rest;
        match rest.chars().next() {
            None => "the text ends".into(),
            Some(first) if is_word(first) => {
                let end = rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
                let shown: String = rest[..end].chars().take(40).collect();
                format!("found `{shown}`")
            }
            Some(_) if rest.starts_with("->") => "found `->`".into(),
            Some(first) => format!("found `{}`", first.escape_debug()),
        }
    }

    fn skip_space(&mut self) {
        loop {
            let space = self.rest.find(|c: char| !c.is_whitespace()).unwrap_or(self.rest.len());
            self.advance(space);
            if !self.rest.starts_with('#') {
                return;
            }
            self.advance(self.rest.find('\n').unwrap_or(self.rest.len()));
        }
    }

    fn advance(&mut self, bytes: usize) {
        for passed in self.rest[..bytes].chars() {
            if passed == '\n' {
                self.position = Position { line: self.position.line + 1, column: 1 };
            } else {
                self.position.column += 1;
            }
        }
        self.rest = &self.rest[bytes..];
    }
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}
