// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads expressions.

use std::collections::BTreeMap;

use super::cursor::Cursor;
use super::error::{GrammarError, Position};
use super::expression::{Expression, Node, Operator};
use super::function::Function;
use super::hint::did_you_mean;

/// Most operators and functions inside one another.
pub const MAX_EXPRESSION_DEPTH: usize = 64;

/// The names that an expression may use.
pub(super) struct Names<'a> {
    /// Constants of the grammar.
    pub(super) constants: &'a BTreeMap<String, f64>,
    /// Parameters of the rule.
    pub(super) parameters: &'a [String],
    /// True if the value may be random; constants are fixed for all trees of a kind.
    pub(super) may_draw: bool,
}

/// An expression and how deep it is.
type Deep = (Expression, usize);

/// Reads the expression that comes next.
pub(super) fn expression(cursor: &mut Cursor<'_>, names: &Names<'_>) -> Result<Expression, GrammarError> {
    Ok(level(cursor, names, 0, 0)?.0)
}

/// An expression of operators that bind at least as closely as `level`, inside `outer` others.
fn level(
    cursor: &mut Cursor<'_>,
    names: &Names<'_>,
    level: usize,
    outer: usize,
) -> Result<Deep, GrammarError> {
    if level == Operator::LEVELS.len() {
        return unary(cursor, names, outer);
    }
    let (mut left, mut depth) = self::level(cursor, names, level + 1, outer)?;
    loop {
        let at = cursor.position();
        // `->` ends the condition of a rule.
        let found = if cursor.sees("->") {
            None
        } else {
            Operator::LEVELS[level].iter().find(|row| cursor.eats(row.0))
        };
        let Some(&(_, operator)) = found else {
            return Ok((left, depth));
        };
        let (right, right_depth) = self::level(cursor, names, level + 1, outer)?;
        depth = check_depth(at, depth.max(right_depth) + 1)?;
        left = Expression { at, node: Node::Binary(operator, Box::new([left, right])) }.folded()?;
    }
}

fn unary(cursor: &mut Cursor<'_>, names: &Names<'_>, outer: usize) -> Result<Deep, GrammarError> {
    let at = cursor.position();
    check_depth(at, outer)?;
    let wrap: fn(Box<Expression>) -> Node = match cursor.peek() {
        Some('-') if !cursor.sees("->") => Node::Negative,
        Some('!') => Node::Not,
        _ => return primary(cursor, names, outer),
    };
    cursor.eats("-");
    cursor.eats("!");
    let (inner, depth) = unary(cursor, names, outer + 1)?;
    let depth = check_depth(at, depth + 1)?;
    Ok((Expression { at, node: wrap(Box::new(inner)) }.folded()?, depth))
}

fn primary(cursor: &mut Cursor<'_>, names: &Names<'_>, outer: usize) -> Result<Deep, GrammarError> {
    let at = cursor.position();
    if let Some(number) = cursor.number()? {
        return Ok((Expression { at, node: Node::Number(number) }, 0));
    }
    if cursor.eats("(") {
        let inner = level(cursor, names, 0, outer + 1)?;
        cursor.expect(")", "an operator or `)`")?;
        return Ok(inner);
    }
    let Some(word) = cursor.word() else {
        return Err(cursor.unexpected("a number, a parameter, a constant, a function, `-`, `!` or `(`"));
    };
    if cursor.sees("(") {
        return call(cursor, names, at, word, outer);
    }
    let node = if let Some(index) = names.parameters.iter().position(|parameter| parameter == word) {
        Node::Parameter(index)
    } else if let Some(&constant) = names.constants.get(word) {
        Node::Number(constant)
    } else {
        let known: Vec<&str> =
            names.parameters.iter().chain(names.constants.keys()).map(String::as_str).collect();
        let allowed = match known.as_slice() {
            [] => "numbers and functions; there are no parameters and no constants here".into(),
            known => format!("{}{}", known.join(", "), did_you_mean(word, known.iter().copied())),
        };
        return Err(GrammarError::text(at, format!("unknown parameter or constant `{word}`"), allowed));
    };
    Ok((Expression { at, node }, 0))
}

fn call(
    cursor: &mut Cursor<'_>,
    names: &Names<'_>,
    at: Position,
    word: &str,
    outer: usize,
) -> Result<Deep, GrammarError> {
    let Some((function, count)) = Function::named(word) else {
        let hint = did_you_mean(word, Function::NAMES.iter().copied());
        let allowed = format!("{}{hint}", Function::NAMES.join(", "));
        return Err(GrammarError::text(at, format!("unknown function `{word}`"), allowed));
    };
    if function.is_random() && !names.may_draw {
        return Err(GrammarError::text(
            at,
            format!("`{word}` in a constant"),
            "a value that is the same for all trees; rules and the axiom may draw",
        ));
    }
    let (mut arguments, mut depth) = (Vec::new(), 0);
    cursor.expect("(", "`(`")?;
    if !cursor.sees(")") {
        loop {
            let (argument, inner) = level(cursor, names, 0, outer + 1)?;
            depth = depth.max(inner);
            arguments.push(argument);
            if !cursor.eats(",") {
                break;
            }
        }
    }
    cursor.expect(")", "an operator, `,` or `)`")?;
    if arguments.len() != count {
        let found = format!("`{word}` with {} arguments", arguments.len());
        return Err(GrammarError::text(at, found, format!("{count}")));
    }
    let depth = check_depth(at, depth + 1)?;
    Ok((Expression { at, node: Node::Call(function, arguments) }.folded()?, depth))
}

fn check_depth(at: Position, depth: usize) -> Result<usize, GrammarError> {
    if depth <= MAX_EXPRESSION_DEPTH {
        return Ok(depth);
    }
    let found = format!("an expression {depth} levels deep");
    Err(GrammarError::text(at, found, format!("at most {MAX_EXPRESSION_DEPTH} levels")))
}
