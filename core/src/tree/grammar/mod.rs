// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The language in which a kind of trees is described: a parametric, stochastic, context-free L-system.
//!
//! A tree begins as a short string of modules, the axiom. At every step all modules for which there is a rule are
//! replaced at once; what stands in the string after the last step is drawn by a turtle. A step is a span of the
//! tree's life: what a late step makes is born late (see [`growth`](super::growth)).
//!
//! ```text
//! # A small tree: a stem with pairs of twigs, each pair turned by a right angle.
//! iterations = 8;
//! height_m = 4;
//! phyllotaxis = opposite;
//! let SPREAD = 50;
//!
//! axiom F(1.2) A(1);
//!
//! A(l) : l > 0.3 -> {3} F(l) [ &(SPREAD) B(l) ] [ ^(SPREAD) B(l) ] /(90) A(0.85 * l)
//!                -> {1} F(l) [ &(rand(40, 60)) B(l) ] /(137.5) A(0.9 * l);
//! A(l) -> F(l) L;
//! B(l) -> T(0.1) F(0.6 * l) L F(0.4 * l) L;
//! ```
//!
//! # Text
//! Statements end in `;`. Space and line breaks separate words and mean nothing else; `#` begins a comment that ends
//! with its line. Names are made of letters, digits and `_`, and are case-sensitive.
//!
//! - `let NAME = expression;` names a constant for the statements below it. Constants are the same for all trees of a
//!   kind, so nothing in them is random.
//! - `NAME = value;` changes a setting:
//!
//! | setting | meaning | values | otherwise |
//! |---|---|---|---|
//! | `iterations` | number of steps | 1 to 64 | 6 |
//! | `angle_deg` | angle in degrees of turns that name none | -360 to 360 | 25 |
//! | `height_m` | height of the full-grown tree in metres, unless the scene says another | 0.2 to 60 | 10 |
//! | `girth` | diameter of the full-grown trunk per height, at breast height (1.3 m; a tenth of the height of plants under 13 m) | 0.001 to 0.2 | 0.02 |
//! | `pipe_exponent` | exponent *n* of the pipe model, `rⁿ = Σ rⁿ` over the branches | 1.5 to 3 | 2.2 |
//! | `leaf_area_m2` | area of one leaf in m² | 0.00001 to 0.5 | 0.004 |
//! | `leaf_angle_deg` | angle between twig and leaf in degrees | 0 to 180 | 55 |
//! | `phyllotaxis` | how leaves follow one another | `alternate` (137.5°), `opposite` (pairs crosswise), `distichous` (two rows) | `alternate` |
//!
//! - `axiom modules;` gives the string to begin with, once.
//! - `NAME(parameters) : condition -> {weight} modules -> {weight} modules … ;` is a rule. Parameters and condition may
//!   be left out; so may weights, which are 1 then. Of the rules for a symbol the first holds whose condition is not 0;
//!   if none does, the module stays as it is. Of its alternatives one is drawn, with a probability in proportion to its
//!   weight. An alternative may be empty: the module vanishes.
//!
//! # Modules
//! A module is a symbol with arguments in brackets, if it has any. Symbols of the grammar's own need a rule; what is
//! left of them after the last step draws nothing. These are obeyed by the turtle, which starts at the origin, heading
//! up; lengths are in any unit, for the whole tree is scaled to its height:
//!
//! | symbol | meaning |
//! |---|---|
//! | `F(length, pipes)` | draws a segment; length 1 unless given; pipes of its own (see [`pipe`](super::pipe)), as many as it is long unless given |
//! | `L(leaves)` | the segment drawn last bears leaves, so many for its length, compared with others; 1 unless given |
//! | `K(number)` | the segment drawn last bears so many fruit at its end, 1 unless given |
//! | `T(strength)`, `T(strength, x, y, z)` | from here on each segment bends upwards, or towards (x, y, z), by `strength` times the sine of the angle in between, in radians; negative: away |
//! | `+(angle)` `-(angle)` | turns left, right |
//! | `&(angle)` `^(angle)` | pitches down, up |
//! | `\(angle)` `/(angle)` | rolls left, right |
//! | `\|` | turns about |
//! | `$` | rolls until left and right are level |
//! | `[` `]` | begins and ends a branch: the turtle returns to where it was |
//!
//! `F`, `L`, `K` and `T` may have rules too.
//!
//! # Expressions
//! Numbers, parameters, constants, `( )`, and, from tight to loose: `-x` `!x`; `* / %`; `+ -`; `< <= > >= == !=`; `&&`;
//! `||`. What is not 0 counts as true; true is 1. Functions, angles in degrees:
//! `abs(x)`, `ceil(x)`, `clamp(x, low, high)`, `cos(x)`, `exp(x)`, `floor(x)`, `if(condition, then, else)`, `ln(x)`,
//! `max(a, b)`, `min(a, b)`, `mix(a, b, share of b)`, `pow(base, exponent)`, `round(x)`, `sin(x)`, `sqrt(x)`, and two
//! that draw: `chance(probability)`, which is 1 or 0, and `rand(low, high)`.
//!
//! Draws are pure functions of the scene's seed, the tree's number, the step, the module's place in the string and the
//! number of the draw in its rule: the same tree every time, and another one for another number.
//!
//! # Limits
//! [`MAX_TEXT_BYTES`], [`MAX_ITERATIONS`], [`MAX_SYMBOLS`], [`MAX_PARAMETERS`], [`MAX_EXPRESSION_DEPTH`],
//! [`MAX_MODULES`], [`MAX_REWRITTEN`], [`MAX_BRANCH_DEPTH`](super::turtle::MAX_BRANCH_DEPTH) and
//! [`MAX_SEGMENTS`](super::skeleton::MAX_SEGMENTS).
//!
//! # Source
//! P. Prusinkiewicz and A. Lindenmayer, "The Algorithmic Beauty of Plants" (1990), sections 1.5 to 1.10 and 2.

mod command;
mod cursor;
mod derive;
mod draws;
mod error;
mod expression;
mod function;
mod hint;
mod parse;
mod parse_expression;
mod settings;
#[cfg(test)]
mod tests;

pub(crate) use command::Command;
pub(crate) use derive::{Derivation, Module};
pub use derive::{MAX_MODULES, MAX_REWRITTEN};
pub(crate) use draws::Draws;
pub use error::{GrammarError, Position};
use expression::Expression;
pub use parse::{MAX_PARAMETERS, MAX_SYMBOLS, MAX_TEXT_BYTES};
pub use parse_expression::MAX_EXPRESSION_DEPTH;
pub use settings::{MAX_ITERATIONS, Phyllotaxis, Settings};

/// A grammar that has been read and found to be in order.
#[derive(Clone, Debug)]
pub struct Grammar {
    settings: Settings,
    axiom: Vec<Pattern>,
    /// Those of the turtle first, in the order of [`Command::ALL`].
    symbols: Vec<Symbol>,
}

/// A symbol and what becomes of it.
#[derive(Clone, Debug)]
struct Symbol {
    name: String,
    /// Number of parameters, if there is a rule.
    parameters: Option<usize>,
    rules: Vec<Rule>,
}

impl Symbol {
    fn new(name: &str) -> Self {
        Self { name: name.to_owned(), parameters: None, rules: Vec::new() }
    }
}

#[derive(Clone, Debug)]
struct Rule {
    at: Position,
    condition: Option<Expression>,
    alternatives: Vec<Alternative>,
}

#[derive(Clone, Debug)]
struct Alternative {
    weight: Expression,
    successor: Vec<Pattern>,
}

/// A module whose arguments are yet to be computed.
#[derive(Clone, Debug)]
struct Pattern {
    at: Position,
    symbol: usize,
    arguments: Vec<Expression>,
}

impl Grammar {
    /// Reads a grammar.
    ///
    /// # Errors
    /// [`GrammarError::Text`] for the first thing that is wrong, with line and column.
    pub fn parse(text: &str) -> Result<Self, GrammarError> {
        if text.len() > MAX_TEXT_BYTES {
            let at = Position { line: 1, column: 1 };
            let found = format!("a text of {} bytes", text.len());
            return Err(GrammarError::text(at, found, format!("at most {MAX_TEXT_BYTES} bytes")));
        }
        parse::Parser::new(text).grammar()
    }

    /// Settings of the whole tree.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }
}
