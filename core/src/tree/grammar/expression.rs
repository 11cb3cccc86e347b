// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Arithmetic of a grammar: numbers, parameters, operators, functions.

use super::draws::Draws;
use super::error::{GrammarError, Position};
use super::function::Function;

/// An expression with the place where its operator, function or value stands.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    pub(super) at: Position,
    pub(super) node: Node,
}

#[derive(Clone, Debug)]
pub(super) enum Node {
    Number(f64),
    /// Parameter of the rule, counted from 0.
    Parameter(usize),
    Not(Box<Expression>),
    Negative(Box<Expression>),
    Binary(Operator, Box<[Expression; 2]>),
    Call(Function, Vec<Expression>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Or,
    And,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
}

impl Operator {
    /// Operators by how closely they bind, loosest first; longer ones before their beginnings.
    pub(super) const LEVELS: [&[(&str, Self)]; 5] = [
        &[("||", Self::Or)],
        &[("&&", Self::And)],
        &[
            ("<=", Self::LessEqual),
            (">=", Self::GreaterEqual),
            ("==", Self::Equal),
            ("!=", Self::NotEqual),
            ("<", Self::Less),
            (">", Self::Greater),
        ],
        &[("+", Self::Add), ("-", Self::Subtract)],
        &[("*", Self::Multiply), ("/", Self::Divide), ("%", Self::Remainder)],
    ];

    fn apply(self, at: Position, a: f64, b: f64) -> Result<f64, GrammarError> {
        let truth = |value: bool| if value { 1.0 } else { 0.0 };
        Ok(match self {
            Self::Or => truth(a != 0.0 || b != 0.0),
            Self::And => truth(a != 0.0 && b != 0.0),
            Self::Less => truth(a < b),
            Self::LessEqual => truth(a <= b),
            Self::Greater => truth(a > b),
            Self::GreaterEqual => truth(a >= b),
            Self::Equal => truth(a == b),
            Self::NotEqual => truth(a != b),
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide | Self::Remainder if b == 0.0 => {
                return Err(GrammarError::text(at, "division by zero", "a divisor other than 0"));
            }
            Self::Divide => a / b,
            Self::Remainder => libm::fmod(a, b),
        })
    }
}

impl Expression {
    /// The value for these parameters.
    ///
    /// # Errors
    /// Division by zero, a function outside its domain, a result that is not a finite number.
    pub(super) fn value(&self, parameters: &[f64], draws: &mut Draws) -> Result<f64, GrammarError> {
        let value = match &self.node {
            Node::Number(number) => return Ok(*number),
            Node::Parameter(index) => return Ok(parameters[*index]),
            Node::Not(inner) => f64::from(u8::from(inner.value(parameters, draws)? == 0.0)),
            Node::Negative(inner) => -inner.value(parameters, draws)?,
            Node::Binary(operator, sides) => {
                let left = sides[0].value(parameters, draws)?;
                let decided = match operator {
                    Operator::And => left == 0.0,
                    Operator::Or => left != 0.0,
                    _ => false,
                };
                let right = if decided { left } else { sides[1].value(parameters, draws)? };
                operator.apply(self.at, left, right)?
            }
            Node::Call(Function::If, arguments) => {
                let chosen = if arguments[0].value(parameters, draws)? != 0.0 { 1 } else { 2 };
                arguments[chosen].value(parameters, draws)?
            }
            Node::Call(function, arguments) => {
                let mut values = [0.0; 3];
                for (value, argument) in values.iter_mut().zip(arguments) {
                    *value = argument.value(parameters, draws)?;
                }
                function.apply(self.at, values, draws)?
            }
        };
        if value.is_finite() {
            Ok(value)
        } else {
            Err(GrammarError::text(self.at, format!("the result is {value}"), "finite numbers"))
        }
    }

    /// Expression folded to its value if that is constant.
    ///
    /// # Errors
    /// As [`Self::value`].
    pub(super) fn folded(self) -> Result<Self, GrammarError> {
        let is_constant = match &self.node {
            Node::Number(_) | Node::Parameter(_) => return Ok(self),
            Node::Not(inner) | Node::Negative(inner) => inner.is_number(),
            Node::Binary(_, sides) => sides.iter().all(Self::is_number),
            Node::Call(function, arguments) => !function.is_random() && arguments.iter().all(Self::is_number),
        };
        if let Node::Binary(Operator::Divide | Operator::Remainder, sides) = &self.node
            && matches!(sides[1].node, Node::Number(divisor) if divisor == 0.0)
        {
            return Err(GrammarError::text(self.at, "division by zero", "a divisor other than 0"));
        }
        if !is_constant {
            return Ok(self);
        }
        let value = self.value(&[], &mut Draws::none())?;
        Ok(Self { at: self.at, node: Node::Number(value) })
    }

    pub(super) fn is_number(&self) -> bool {
        matches!(self.node, Node::Number(_))
    }
}
