// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions that expressions may call.

use super::draws::Draws;
use super::error::{GrammarError, Position};

/// Each row: variant, name in the text, number of arguments.
macro_rules! functions {
    ($($variant:ident = $name:literal, $arguments:literal;)*) => {
        /// A function of at most three numbers.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Function {
            $($variant,)*
        }

        impl Function {
            /// Names, in alphabetical order.
            pub(super) const NAMES: &[&str] = &[$($name,)*];

            /// The function of this name and its number of arguments.
            pub(super) fn named(name: &str) -> Option<(Self, usize)> {
                match name {
                    $($name => Some((Self::$variant, $arguments)),)*
                    _ => None,
                }
            }
        }
    };
}

functions! {
    Abs = "abs", 1;
    Ceil = "ceil", 1;
    Chance = "chance", 1;
    Clamp = "clamp", 3;
    Cos = "cos", 1;
    Exp = "exp", 1;
    Floor = "floor", 1;
    If = "if", 3;
    Ln = "ln", 1;
    Max = "max", 2;
    Min = "min", 2;
    Mix = "mix", 3;
    Pow = "pow", 2;
    Rand = "rand", 2;
    Round = "round", 1;
    Sin = "sin", 1;
    Sqrt = "sqrt", 1;
}

impl Function {
    /// Returns true if its value differs from call to call.
    pub(super) fn is_random(self) -> bool {
        matches!(self, Self::Chance | Self::Rand)
    }

    /// The value; `if` has been decided before, for only one side of it counts.
    pub(super) fn apply(
        self,
        at: Position,
        [a, b, c]: [f64; 3],
        draws: &mut Draws,
    ) -> Result<f64, GrammarError> {
        let outside = |allowed: &str| {
            let found = match self {
                Self::Pow => format!("pow({a}, {b})"),
                Self::Rand => format!("rand({a}, {b})"),
                Self::Clamp => format!("clamp({a}, {b}, {c})"),
                Self::Ln => format!("ln({a})"),
                _ => format!("sqrt({a})"),
            };
            Err(GrammarError::text(at, found, allowed))
        };
        Ok(match self {
            Self::Abs => a.abs(),
            Self::Ceil => a.ceil(),
            Self::Chance => f64::from(u8::from(draws.unit() < a)),
            Self::Clamp if b > c => return outside("a lower bound that is not above the upper one"),
            Self::Clamp => a.clamp(b, c),
            Self::Cos => libm::cos(a.to_radians()),
            Self::Exp => libm::exp(a),
            Self::Floor => a.floor(),
            Self::If => unreachable!("decided by the expression"),
            Self::Ln if a <= 0.0 => return outside("numbers above 0"),
            Self::Ln => libm::log(a),
            Self::Max => a.max(b),
            Self::Min => a.min(b),
            Self::Mix => a + (b - a) * c,
            Self::Pow if a < 0.0 && b.fract() != 0.0 => {
                return outside("a base of 0 or more, or a whole exponent");
            }
            Self::Pow if a == 0.0 && b < 0.0 => {
                return outside("a base other than 0, or an exponent of 0 or more");
            }
            Self::Pow => libm::pow(a, b),
            Self::Rand if a > b => return outside("a lower bound that is not above the upper one"),
            Self::Rand => a + (b - a) * draws.unit(),
            Self::Round => libm::round(a),
            Self::Sin => libm::sin(a.to_radians()),
            Self::Sqrt if a < 0.0 => return outside("numbers from 0"),
            Self::Sqrt => a.sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_in_alphabetical_order_and_known() {
        assert!(Function::NAMES.is_sorted(), "messages list them in this order");
        for name in Function::NAMES {
            assert!(Function::named(name).is_some(), "{name} is in the list");
        }
    }
}
