// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rewrites a string of modules, step by step.

use super::draws::Draws;
use super::error::{GrammarError, Position};
use super::{Grammar, Pattern, Rule};

/// Most modules in the string.
pub const MAX_MODULES: usize = 1 << 18;
/// Most modules over all steps together.
pub const MAX_REWRITTEN: usize = 1 << 22;

/// A symbol with arguments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Module {
    /// Position in the text.
    pub(crate) at: Position,
    /// Index of the symbol; those of the turtle come first.
    pub(crate) symbol: usize,
    /// Step that made it; 0 for the axiom.
    pub(crate) born: u32,
    first: usize,
    count: usize,
}

/// A string of modules.
#[derive(Clone, Debug, Default)]
pub(crate) struct Derivation {
    pub(crate) modules: Vec<Module>,
    numbers: Vec<f64>,
    /// The last step that changed anything.
    pub(crate) steps: u32,
}

impl Derivation {
    /// The arguments of a module.
    pub(crate) fn arguments(&self, module: &Module) -> &[f64] {
        &self.numbers[module.first..module.first + module.count]
    }

    /// Appends a module as it is.
    fn keep(&mut self, module: Module, arguments: &[f64]) {
        let (first, count) = (self.numbers.len(), arguments.len());
        self.numbers.extend_from_slice(arguments);
        self.modules.push(Module { first, count, ..module });
    }

    /// Appends modules whose arguments are computed now.
    fn append(
        &mut self,
        patterns: &[Pattern],
        parameters: &[f64],
        born: u32,
        draws: &mut Draws,
    ) -> Result<(), GrammarError> {
        for Pattern { at, symbol, arguments } in patterns {
            let first = self.numbers.len();
            for argument in arguments {
                self.numbers.push(argument.value(parameters, draws)?);
            }
            let (at, symbol, count) = (*at, *symbol, arguments.len());
            self.modules.push(Module { at, symbol, born, first, count });
        }
        Ok(())
    }
}

impl Grammar {
    /// The string after the last step, for tree `number` of a scene with this seed.
    ///
    /// # Errors
    /// [`GrammarError::Limit`] for a string that grows too long, [`GrammarError::Text`] for arithmetic that fails.
    pub(crate) fn derive(&self, seed: u64, number: u32) -> Result<Derivation, GrammarError> {
        let steps = self.settings.iterations;
        let mut current = Derivation::default();
        current.append(&self.axiom, &[], 0, &mut Draws::new(seed, number, 0, 0))?;
        let mut rewritten = current.modules.len();
        for step in 1..=steps {
            let mut next = Derivation { steps: current.steps, ..Derivation::default() };
            next.modules.reserve(current.modules.len());
            for (index, module) in (0u32..).zip(&current.modules) {
                let arguments = current.arguments(module);
                let mut draws = Draws::new(seed, number, step, index);
                let rules = &self.symbols[module.symbol].rules;
                match choose(rules, arguments, &mut draws)? {
                    Some(successor) => {
                        next.append(successor, arguments, step, &mut draws)?;
                        next.steps = step;
                    }
                    None => next.keep(*module, arguments),
                }
                let check = |what, reached: usize, limit| {
                    if reached <= limit {
                        return Ok(());
                    }
                    Err(GrammarError::Limit { step, steps, what, reached, limit })
                };
                check("modules", next.modules.len(), MAX_MODULES)?;
                check("modules over all steps", rewritten + next.modules.len(), MAX_REWRITTEN)?;
            }
            rewritten += next.modules.len();
            if next.steps != step {
                return Ok(next);
            }
            current = next;
        }
        Ok(current)
    }
}

/// Successor of a module, if any rule holds.
fn choose<'a>(
    rules: &'a [Rule],
    parameters: &[f64],
    draws: &mut Draws,
) -> Result<Option<&'a [Pattern]>, GrammarError> {
    for Rule { at, condition, alternatives } in rules {
        if let Some(condition) = condition
            && condition.value(parameters, draws)? == 0.0
        {
            continue;
        }
        if let [only] = alternatives.as_slice() {
            return Ok(Some(&only.successor));
        }
        let mut weights = Vec::with_capacity(alternatives.len());
        for alternative in alternatives {
            let weight = alternative.weight.value(parameters, draws)?;
            if weight < 0.0 {
                let found = format!("a weight of {weight}");
                return Err(GrammarError::text(alternative.weight.at, found, "weights from 0"));
            }
            weights.push(weight);
        }
        let sum: f64 = weights.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            let found = format!("weights with a sum of {sum}");
            return Err(GrammarError::text(*at, found, "a finite sum above 0"));
        }
        let mut left = draws.unit() * sum;
        for (weight, alternative) in weights.iter().zip(alternatives) {
            if left < *weight {
                return Ok(Some(&alternative.successor));
            }
            left -= weight;
        }
        // Rounding may leave a crumb past the last one that can be drawn.
        let last = weights.iter().rposition(|&weight| weight > 0.0).expect("the sum is above 0");
        return Ok(Some(&alternatives[last].successor));
    }
    Ok(None)
}
