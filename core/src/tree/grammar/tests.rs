// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The language: what is rewritten to what, what is wrong and where, what is too much.

mod errors;
mod random;

use std::time::{Duration, Instant};

use super::{Grammar, GrammarError, MAX_MODULES, MAX_REWRITTEN, Phyllotaxis};

/// The string after the last step, with its arguments.
fn string(text: &str, seed: u64, number: u32) -> Result<String, GrammarError> {
    let grammar = Grammar::parse(text)?;
    let derivation = grammar.derive(seed, number)?;
    let mut string = String::new();
    for module in &derivation.modules {
        string += &grammar.symbols[module.symbol].name;
        let arguments: Vec<String> =
            derivation.arguments(module).iter().map(|number| format!("{number}")).collect();
        if !arguments.is_empty() {
            string += &format!("({})", arguments.join(","));
        }
    }
    Ok(string)
}

fn derived(text: &str) -> String {
    string(text, 1, 0).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The value of an expression without parameters.
fn value(expression: &str) -> String {
    derived(&format!("axiom F({expression});"))
}

#[test]
fn all_modules_are_rewritten_at_once() {
    // Lindenmayer's algae, whose lengths are Fibonacci numbers.
    for (steps, expected) in [(1, "AB"), (2, "ABA"), (3, "ABAAB"), (4, "ABAABABA")] {
        let text = format!("iterations = {steps}; axiom A; A -> A B; B -> A;");
        assert_eq!(derived(&text), expected, "{steps} steps");
    }
    let text = "iterations = 12; axiom A; A -> A B; B -> A;";
    assert_eq!(derived(text).len(), 377, "the fourteenth Fibonacci number");
}

#[test]
fn parameters_pass_through_conditions_and_arithmetic() {
    let text = "iterations = 4; axiom B(2) A(4, 4); A(x, y) : y <= 3 -> A(x * 2, x + y); \
                A(x, y) : y > 3 -> B(x) A(x / y, 0); B(x) : x < 1 -> C; B(x) : x >= 1 -> B(x - 1); C -> C;";
    // The published derivation of this system: The Algorithmic Beauty of Plants, figure 1.38.
    for (steps, expected) in
        [(1, "B(1)B(4)A(1,0)"), (2, "B(0)B(3)A(2,1)"), (3, "CB(2)A(4,3)"), (4, "CB(1)A(8,7)")]
    {
        assert_eq!(derived(&text.replace("= 4", &format!("= {steps}"))), expected, "after {steps} steps");
    }
}

#[test]
fn the_first_rule_whose_condition_holds_is_taken() {
    let text =
        "iterations = 1; axiom A(1) A(2) A(3); A(n) : n > 2 -> F(30); A(n) : n > 1 -> F(20); A(n) -> F(10);";
    assert_eq!(derived(text), "F(10)F(20)F(30)", "in the order of the text");
    let text = "iterations = 5; axiom A(1); A(n) : n > 1 -> F;";
    assert_eq!(derived(text), "A(1)", "no rule holds");
    assert_eq!(derived("iterations = 2; axiom A F A; A -> ;"), "F", "an empty successor");
    assert_eq!(
        derived("iterations = 2; axiom F(1); F(l) -> F(l / 2) F(l / 2);"),
        "F(0.25)".repeat(4),
        "own F"
    );
}

#[test]
fn expressions_have_the_usual_values() {
    for (expression, expected) in [
        ("1 + 2 * 3 - 4 / 8", 6.5),
        ("(1 + 2) * 3", 9.0),
        ("10 - 3 - 2", 5.0),
        ("7 % 4 + 2e-1 + .5", 3.7),
        ("-2 * -3", 6.0),
        ("!0 + !5 + !-1", 1.0),
        ("1 < 2 && 2 <= 2 && 3 > 2 && 3 >= 3 && 1 == 1 && 1 != 2", 1.0),
        ("2 < 1 || 0", 0.0),
        ("0 && 1 / 4 || 1", 1.0),
        ("abs(-2) + ceil(1.2) + floor(1.8) + round(2.5)", 8.0),
        ("clamp(5, 0, 3) + max(1, 2) + min(1, 2)", 6.0),
        ("mix(10, 20, 0.25)", 12.5),
        ("pow(2, 10) + sqrt(9) + ln(1) + exp(0)", 1028.0),
        ("sin(30) * 2 + cos(60) * 2", 2.0),
        ("if(1 > 2, 1, 7)", 7.0),
    ] {
        let found: f64 = value(expression)[2..].trim_end_matches(')').parse().expect("a number");
        assert!((found - expected).abs() < 1e-12, "{expression}: {found} instead of {expected}");
    }
    // Only one side is computed.
    assert_eq!(derived("iterations = 1; axiom A(0); A(x) -> F(if(x == 0, 3, 1 / x));"), "F(3)", "if");
    assert_eq!(derived("iterations = 1; axiom A(0); A(x) : x != 0 && 1 / x > 0 -> F;"), "A(0)", "and");
    assert_eq!(derived("iterations = 1; axiom A(0); A(x) : x == 0 || 1 / x > 0 -> F;"), "F", "or");
}

#[test]
fn constants_settings_and_comments_are_read() {
    let text = "# a remark; axiom B;\nlet A_1 = 2; let b = A_1 * 3; # another\niterations = b - 1; girth = 0.05;\
                phyllotaxis = distichous; axiom F(b);";
    let grammar = Grammar::parse(text).expect("a valid grammar");
    assert_eq!(grammar.settings().iterations, 5, "computed from constants");
    assert_eq!(grammar.settings().girth, 0.05, "as given");
    assert_eq!(grammar.settings().phyllotaxis, Phyllotaxis::Distichous, "a word");
    assert_eq!(grammar.settings().leaf_angle_deg, 55.0, "otherwise the usual");
    assert_eq!(derived(text), "F(6)", "constants in modules");
}

#[test]
fn alternatives_are_drawn_by_their_weights() {
    let text = "iterations = 1; axiom A(0); A(n) -> {1} F -> {3} L -> {0} K;";
    let count =
        |symbol: &str| (0..4000).filter(|&number| string(text, 9, number).as_deref() == Ok(symbol)).count();
    assert_eq!(count("F") + count("L"), 4000, "a weight of 0 is never drawn");
    // Three standard deviations of a binomial distribution.
    assert!((count("F") as f64 - 1000.0).abs() < 3.0 * (4000.0 * 0.25 * 0.75f64).sqrt(), "{}", count("F"));
}

#[test]
fn draws_depend_on_seed_number_step_and_place_only() {
    let text = "iterations = 3; axiom A A; A -> F(rand(0, 1)) F(rand(0, 1)) A;";
    let base = string(text, 5, 2);
    assert_eq!(base, string(text, 5, 2), "the same again");
    assert_ne!(base, string(text, 6, 2), "another seed");
    assert_ne!(base, string(text, 5, 3), "another number");
    let base = base.expect("a valid grammar");
    let mut numbers: Vec<&str> = base.split(['(', ')']).filter(|part| part.starts_with("0.")).collect();
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers.len(), 12, "no draw twice: {base}");
}

#[test]
fn what_explodes_or_never_ends_is_given_up_soon() {
    let start = Instant::now();
    let explosion = "iterations = 64; axiom A; A -> A A A;";
    let Err(GrammarError::Limit { step: 12, steps: 64, what: "modules", reached, limit: MAX_MODULES }) =
        string(explosion, 1, 1)
    else {
        panic!("3^12 modules are too many: {:?}", string(explosion, 1, 1));
    };
    assert!(reached <= MAX_MODULES + 3, "given up at once: {reached}");
    let endless =
        "iterations = 64; axiom A(1); A(n) : n < 200000 -> A(2 * n) A(2 * n) ; A(n) -> B; B -> C; C -> B;";
    let error = string(endless, 1, 1).expect_err("too many over all steps");
    assert_eq!(
        error.to_string(),
        format!(
            "step 33 of 64 reaches {} modules over all steps; allowed: at most {MAX_REWRITTEN}",
            MAX_REWRITTEN + 1
        )
    );
    // Far above what a slow machine needs.
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

/// The documentation of the language, without the marks of a comment.
fn documentation() -> String {
    let text = include_str!("mod.rs").lines().filter_map(|line| line.strip_prefix("//!"));
    text.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_documented_example_grows() {
    let text = documentation();
    let example =
        text.split("```").nth(1).and_then(|block| block.strip_prefix("text\n")).expect("an example");
    let tree = crate::tree::tests::grown_by(example, &crate::scene::Tree::default());
    assert!(tree.segments.len() > 20 && tree.attachments.len() > 20, "{} segments", tree.segments.len());
    assert!((tree.height_m() - 4.0).abs() < 1e-5, "as high as it says");
}

#[test]
fn everything_in_the_language_is_documented() {
    let text = documentation();
    for function in super::function::Function::NAMES {
        assert!(text.contains(&format!("`{function}(")), "{function}");
    }
    for command in super::Command::ALL {
        let symbol = command.symbol().replace('|', "\\|");
        assert!(text.contains(&format!("`{symbol}")), "{symbol}");
    }
    for (name, low, high) in super::Settings::NUMBERS {
        let row = text.lines().find(|line| line.starts_with(&format!("| `{name}` |"))).expect(name);
        assert!(row.contains(&format!("| {low} to {high} |")), "{row}");
        let usual = Grammar::parse("axiom F;").map(|grammar| *grammar.settings()).expect("a valid grammar");
        let mut changed = usual;
        let given = row.trim_end_matches(" |").rsplit(' ').next().and_then(|number| number.parse().ok());
        changed.set(name, given.expect("a number at the end of the row"));
        assert_eq!(changed, usual, "what is otherwise: {row}");
    }
    for (name, _) in Phyllotaxis::NAMES {
        assert!(text.contains(&format!("`{name}`")), "{name}");
    }
}
