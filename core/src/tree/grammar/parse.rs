// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a grammar.

use std::collections::BTreeMap;

use super::command::Command;
use super::cursor::Cursor;
use super::error::{GrammarError, Position};
use super::expression::{Expression, Node};
use super::hint::did_you_mean;
use super::parse_expression::{Names, expression};
use super::settings::{Phyllotaxis, Settings};
use super::{Alternative, Grammar, Pattern, Rule, Symbol};

/// Longest text of a grammar in bytes.
pub const MAX_TEXT_BYTES: usize = 1 << 16;
/// Most parameters of a symbol.
pub const MAX_PARAMETERS: usize = 16;
/// Most symbols with rules of their own.
pub const MAX_SYMBOLS: usize = 256;

/// A symbol that stands in an axiom or successor, to be checked when all rules are known.
struct Use {
    at: Position,
    symbol: usize,
    arguments: usize,
}

pub(super) struct Parser<'a> {
    cursor: Cursor<'a>,
    constants: BTreeMap<String, f64>,
    uses: Vec<Use>,
    grammar: Grammar,
    has_axiom: bool,
}

impl<'a> Parser<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let symbols = Command::ALL.iter().map(|command| Symbol::new(command.symbol())).collect();
        let grammar = Grammar { settings: Settings::default(), axiom: Vec::new(), symbols };
        let cursor = Cursor::new(text);
        Self { cursor, constants: BTreeMap::new(), uses: Vec::new(), grammar, has_axiom: false }
    }

    /// Reads the whole text.
    pub(super) fn grammar(mut self) -> Result<Grammar, GrammarError> {
        while !self.cursor.is_at_end() {
            self.statement()?;
            self.cursor.expect(";", "`;` after a statement")?;
        }
        if !self.has_axiom {
            return Err(self.cursor.unexpected("a statement `axiom …;` before the end"));
        }
        self.check_uses()?;
        Ok(self.grammar)
    }

    fn statement(&mut self) -> Result<(), GrammarError> {
        let at = self.cursor.position();
        match self.cursor.word() {
            Some("let") => self.constant(),
            Some("axiom") => self.axiom(at),
            Some(word) if self.cursor.eats("=") => self.setting(at, word),
            Some(word) => self.rule(at, word),
            None => Err(self.cursor.unexpected("`let`, a setting, `axiom` or a rule")),
        }
    }

    fn constant(&mut self) -> Result<(), GrammarError> {
        let at = self.cursor.position();
        let name = self.cursor.word().ok_or_else(|| self.cursor.unexpected("the name of a constant"))?;
        self.cursor.expect("=", "`=`")?;
        let value = self.fixed_number()?;
        if self.constants.insert(name.to_owned(), value).is_some() {
            return Err(GrammarError::text(at, format!("constant `{name}` again"), "each constant once"));
        }
        Ok(())
    }

    /// A value that is the same for all trees.
    fn fixed_number(&mut self) -> Result<f64, GrammarError> {
        let names = Names { constants: &self.constants, parameters: &[], may_draw: false };
        match expression(&mut self.cursor, &names)?.node {
            Node::Number(number) => Ok(number),
            _ => unreachable!("an expression without parameters and draws folds to a number"),
        }
    }

    fn setting(&mut self, at: Position, name: &str) -> Result<(), GrammarError> {
        if name == "phyllotaxis" {
            let at = self.cursor.position();
            let word = self.cursor.word().unwrap_or_default();
            let found = Phyllotaxis::NAMES.into_iter().find(|row| row.0 == word);
            let (_, phyllotaxis) = found.ok_or_else(|| {
                let names = Phyllotaxis::NAMES.map(|row| row.0);
                let allowed = format!("{}{}", names.join(", "), did_you_mean(word, names));
                GrammarError::text(at, format!("phyllotaxis `{word}`"), allowed)
            })?;
            self.grammar.settings.phyllotaxis = phyllotaxis;
            return Ok(());
        }
        let Some(&(_, low, high)) = Settings::NUMBERS.iter().find(|row| row.0 == name) else {
            let names = || Settings::NUMBERS.iter().map(|row| row.0).chain(["phyllotaxis"]);
            let all = names().collect::<Vec<_>>().join(", ");
            let allowed = format!("{all}{}; constants begin with `let`", did_you_mean(name, names()));
            return Err(GrammarError::text(at, format!("unknown setting `{name}`"), allowed));
        };
        let at = self.cursor.position();
        let value = self.fixed_number()?;
        let is_whole = name != "iterations" || value.fract() == 0.0;
        if !(low..=high).contains(&value) || !is_whole {
            let whole = if name == "iterations" { "whole numbers, " } else { "" };
            let allowed = format!("{whole}{low} to {high}");
            return Err(GrammarError::text(at, format!("{name} is {value}"), allowed));
        }
        self.grammar.settings.set(name, value);
        Ok(())
    }

    fn axiom(&mut self, at: Position) -> Result<(), GrammarError> {
        if self.has_axiom {
            return Err(GrammarError::text(at, "a second axiom", "one axiom"));
        }
        self.has_axiom = true;
        self.grammar.axiom = self.modules(&[])?;
        Ok(())
    }

    fn rule(&mut self, at: Position, name: &str) -> Result<(), GrammarError> {
        let mut parameters: Vec<String> = Vec::new();
        if self.cursor.eats("(") {
            loop {
                let at = self.cursor.position();
                let Some(parameter) = self.cursor.word() else {
                    return Err(self.cursor.unexpected("the name of a parameter"));
                };
                if self.constants.contains_key(parameter) || parameters.iter().any(|one| one == parameter) {
                    let found = format!("parameter `{parameter}` again");
                    let allowed = "names that no other parameter of the rule and no constant has";
                    return Err(GrammarError::text(at, found, allowed));
                }
                parameters.push(parameter.to_owned());
                if parameters.len() > MAX_PARAMETERS {
                    let found = format!("{} parameters", parameters.len());
                    return Err(GrammarError::text(at, found, format!("at most {MAX_PARAMETERS}")));
                }
                if !self.cursor.eats(",") {
                    break;
                }
            }
            self.cursor.expect(")", "`,` or `)`")?;
        }
        let symbol = self.symbol(at, name)?;
        self.check_head(at, symbol, parameters.len())?;
        let condition = if self.cursor.eats(":") { Some(self.expression(&parameters)?) } else { None };
        let mut alternatives = Vec::new();
        while self.cursor.eats("->") {
            let at = self.cursor.position();
            let weight = if self.cursor.eats("{") {
                let weight = self.expression(&parameters)?;
                self.cursor.expect("}", "an operator or `}`")?;
                weight
            } else {
                Expression { at, node: Node::Number(1.0) }
            };
            if matches!(weight.node, Node::Number(weight) if weight < 0.0) {
                return Err(GrammarError::text(weight.at, "a negative weight", "weights from 0"));
            }
            alternatives.push(Alternative { weight, successor: self.modules(&parameters)? });
        }
        if alternatives.is_empty() {
            return Err(self
                .cursor
                .unexpected("`(`, `:`, `->` or `=` after the name of a symbol or setting"));
        }
        let rule = Rule { at, condition, alternatives };
        self.grammar.symbols[symbol].rules.push(rule);
        Ok(())
    }

    /// All rules of a symbol have the same number of parameters, which the turtle can take if it obeys the symbol.
    fn check_head(&mut self, at: Position, symbol: usize, parameters: usize) -> Result<(), GrammarError> {
        let name = &self.grammar.symbols[symbol].name;
        let found = || format!("a rule for `{name}` with {parameters} parameters");
        if let Some(&command) = Command::ALL.get(symbol) {
            let (fewest, most) = command.arguments();
            if !(fewest..=most).contains(&parameters) {
                return Err(GrammarError::text(at, found(), count_range(fewest, most)));
            }
        }
        match self.grammar.symbols[symbol].parameters {
            Some(first) if first != parameters => {
                Err(GrammarError::text(at, found(), format!("{first}, as in the first rule for it")))
            }
            _ => {
                self.grammar.symbols[symbol].parameters = Some(parameters);
                Ok(())
            }
        }
    }

    fn expression(&mut self, parameters: &[String]) -> Result<Expression, GrammarError> {
        expression(&mut self.cursor, &Names { constants: &self.constants, parameters, may_draw: true })
    }

    /// A string of modules with balanced brackets.
    fn modules(&mut self, parameters: &[String]) -> Result<Vec<Pattern>, GrammarError> {
        let (mut modules, mut open) = (Vec::new(), Vec::new());
        loop {
            let at = self.cursor.position();
            if self.cursor.sees("->") {
                break;
            }
            let symbol = if let Some(word) = self.cursor.word() {
                self.symbol(at, word)?
            } else {
                let is_next = |command: &Command, cursor: &mut Cursor<'_>| {
                    !command.is_word() && cursor.eats(command.symbol())
                };
                match Command::ALL.iter().position(|command| is_next(command, &mut self.cursor)) {
                    Some(symbol) => symbol,
                    None => break,
                }
            };
            match Command::ALL.get(symbol) {
                Some(Command::Push) => open.push(at),
                Some(Command::Pop) if open.pop().is_none() => {
                    return Err(GrammarError::text(at, "`]` without `[`", "as many `]` as `[`"));
                }
                _ => {}
            }
            let mut arguments = Vec::new();
            if self.cursor.eats("(") {
                loop {
                    arguments.push(self.expression(parameters)?);
                    if !self.cursor.eats(",") {
                        break;
                    }
                }
                self.cursor.expect(")", "an operator, `,` or `)`")?;
            }
            self.uses.push(Use { at, symbol, arguments: arguments.len() });
            modules.push(Pattern { at, symbol, arguments });
        }
        if let Some(at) = open.pop() {
            return Err(GrammarError::text(at, "`[` without `]`", "as many `]` as `[`"));
        }
        if !(self.cursor.sees(";") || self.cursor.sees("->")) {
            return Err(self.cursor.unexpected("a symbol, `+ - & ^ \\ / | $ [ ]`, `->` or `;`"));
        }
        Ok(modules)
    }

    /// Index of a symbol, which is new at its first use.
    fn symbol(&mut self, at: Position, name: &str) -> Result<usize, GrammarError> {
        if let Some(index) = self.grammar.symbols.iter().position(|symbol| symbol.name == name) {
            return Ok(index);
        }
        let count = self.grammar.symbols.len() + 1 - Command::ALL.len();
        if count > MAX_SYMBOLS {
            let allowed = format!("at most {MAX_SYMBOLS}");
            return Err(GrammarError::text(at, format!("{count} symbols"), allowed));
        }
        self.grammar.symbols.push(Symbol::new(name));
        Ok(self.grammar.symbols.len() - 1)
    }

    /// Every symbol is known to the turtle or has a rule, and has the right number of arguments.
    fn check_uses(&self) -> Result<(), GrammarError> {
        let symbols = &self.grammar.symbols;
        for &Use { at, symbol, arguments } in &self.uses {
            let Symbol { name, parameters, .. } = &symbols[symbol];
            let (fewest, most) = match (parameters, Command::ALL.get(symbol)) {
                (Some(count), _) => (*count, *count),
                (None, Some(command)) => command.arguments(),
                (None, None) => {
                    let known = || {
                        let is_known = |(index, symbol): &(usize, &Symbol)| {
                            symbol.parameters.is_some()
                                || Command::ALL.get(*index).is_some_and(|command| command.is_word())
                        };
                        symbols.iter().enumerate().filter(is_known).map(|(_, symbol)| symbol.name.as_str())
                    };
                    let all = known().collect::<Vec<_>>().join(", ");
                    let allowed = format!("{all}, or a rule for it{}", did_you_mean(name, known()));
                    return Err(GrammarError::text(at, format!("unknown symbol `{name}`"), allowed));
                }
            };
            if !(fewest..=most).contains(&arguments) {
                let found = format!("`{name}` with {arguments} arguments");
                return Err(GrammarError::text(at, found, count_range(fewest, most)));
            }
        }
        Ok(())
    }
}

fn count_range(fewest: usize, most: usize) -> String {
    if fewest == most { fewest.to_string() } else { format!("{fewest} to {most}") }
}
