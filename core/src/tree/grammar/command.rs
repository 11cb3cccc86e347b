// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The symbols that the turtle obeys.

/// Each row: variant, symbol in the text, fewest and most arguments.
macro_rules! commands {
    ($($(#[$doc:meta])* $variant:ident = $symbol:literal, $fewest:literal, $most:literal;)*) => {
        /// A symbol that the turtle obeys.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Command {
            $($(#[$doc])* $variant,)*
        }

        impl Command {
            /// All of them, in the order of their numbers.
            pub(crate) const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The symbol in the text.
            pub(super) fn symbol(self) -> &'static str {
                match self {
                    $(Self::$variant => $symbol,)*
                }
            }

            /// Fewest and most arguments.
            pub(super) fn arguments(self) -> (usize, usize) {
                match self {
                    $(Self::$variant => ($fewest, $most),)*
                }
            }
        }
    };
}

commands! {
    /// A segment: length, pipes of its own.
    Forward = "F", 0, 2;
    /// Leaves of the last segment: number per length.
    Leaves = "L", 0, 1;
    /// Fruit at the end of the last segment: number.
    Fruit = "K", 0, 1;
    /// Segments bend: strength, and a direction other than up.
    Tropism = "T", 1, 4;
    /// Turns left about the turtle's up.
    Left = "+", 0, 1;
    /// Turns right.
    Right = "-", 0, 1;
    /// Pitches down about the turtle's left.
    Down = "&", 0, 1;
    /// Pitches up.
    Up = "^", 0, 1;
    /// Rolls left about the heading.
    RollLeft = "\\", 0, 1;
    /// Rolls right.
    RollRight = "/", 0, 1;
    /// Turns about.
    Around = "|", 0, 0;
    /// Rolls until the turtle's left is horizontal.
    Level = "$", 0, 0;
    /// Begins a branch.
    Push = "[", 0, 0;
    /// Ends a branch.
    Pop = "]", 0, 0;
}

impl Command {
    /// Returns true if it is written as a word, and so may be rewritten by a rule.
    pub(super) fn is_word(self) -> bool {
        matches!(self, Self::Forward | Self::Leaves | Self::Fruit | Self::Tropism)
    }
}
