// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Everything that can be wrong in the text of a grammar, with the place where it is.

use super::string;
use crate::tree::grammar::Grammar;

/// Text, and the beginning of the error.
const WRONG: &[(&str, &str)] = &[
    ("", "line 1, column 1: the text ends; allowed: a statement `axiom …;` before the end"),
    ("# nothing\n\n", "line 3, column 1: the text ends; allowed: a statement `axiom"),
    ("axiom F", "line 1, column 8: the text ends; allowed: a symbol, "),
    ("axiom F; axiom F;", "line 1, column 10: a second axiom; allowed: one axiom"),
    ("axiom F; ;", "line 1, column 10: found `;`; allowed: `let`, a setting, `axiom` or a rule"),
    ("axiom F; 7;", "line 1, column 10: found `7`; allowed: `let`, a setting"),
    ("axiom F ? G;", "line 1, column 9: found `?`; allowed: a symbol, "),
    ("axiom F\u{7};", "line 1, column 8: found `\\u{7}`; allowed: a symbol"),
    // Symbols.
    ("axiom F Leaf;", "line 1, column 9: unknown symbol `Leaf`; allowed: F, L, K, T, or a rule for it"),
    (
        "axiom Stm(1);\nStem(l) -> F(l);",
        "line 1, column 7: unknown symbol `Stm`; allowed: F, L, K, T, Stem, or a rule for it (did you mean `Stem`?)",
    ),
    ("axiom F;\nA -> F B;", "line 2, column 8: unknown symbol `B`; allowed: F, L, K, T, A, or"),
    ("axiom A(1); A -> F;", "line 1, column 7: `A` with 1 arguments; allowed: 0"),
    ("axiom A; A(l, w) -> F;", "line 1, column 7: `A` with 0 arguments; allowed: 2"),
    ("axiom F(1, 2, 3);", "line 1, column 7: `F` with 3 arguments; allowed: 0 to 2"),
    ("axiom F T;", "line 1, column 9: `T` with 0 arguments; allowed: 1 to 4"),
    ("axiom F $(3);", "line 1, column 9: `$` with 1 arguments; allowed: 0"),
    ("axiom F [(3)];", "line 1, column 9: `[` with 1 arguments; allowed: 0"),
    ("axiom F; F(l) -> F(l);", "line 1, column 7: `F` with 0 arguments; allowed: 1"),
    ("axiom F; F(a, b, c) -> F;", "line 1, column 10: a rule for `F` with 3 parameters; allowed: 0 to 2"),
    ("axiom F; A(l) -> F; A -> F;", "line 1, column 21: a rule for `A` with 0 parameters; allowed: 1, as"),
    // Brackets.
    ("axiom F [ F;", "line 1, column 9: `[` without `]`; allowed: as many `]` as `[`"),
    ("axiom [ F [ F ];", "line 1, column 7: `[` without `]`"),
    ("axiom F ] F;", "line 1, column 9: `]` without `[`"),
    ("axiom F; A -> [ F -> F ];", "line 1, column 15: `[` without `]`"),
    ("axiom F(1;", "line 1, column 10: found `;`; allowed: an operator, `,` or `)`"),
    ("axiom F(1));", "line 1, column 11: found `)`; allowed: a symbol, "),
    ("axiom F((1);", "line 1, column 12: found `;`; allowed: an operator, `,` or `)`"),
    ("axiom F();", "line 1, column 9: found `)`; allowed: a number, a parameter, a constant"),
    // Rules.
    ("axiom A; A F;", "line 1, column 12: found `F`; allowed: `(`, `:`, `->` or `=`"),
    ("axiom F; A( -> F;", "line 1, column 13: found `->`; allowed: the name of a parameter"),
    ("axiom F; A(l w) -> F;", "line 1, column 14: found `w`; allowed: `,` or `)`"),
    ("axiom F; A(l, l) -> F;", "line 1, column 15: parameter `l` again; allowed: names that"),
    ("let l = 1; axiom F; A(l) -> F;", "line 1, column 23: parameter `l` again"),
    ("axiom F; A : -> F;", "line 1, column 14: found `->`; allowed: a number, a parameter"),
    ("axiom F; A -> {1 F;", "line 1, column 18: found `F`; allowed: an operator or `}`"),
    ("axiom F; A -> {-1} F;", "line 1, column 16: a negative weight; allowed: weights from 0"),
    ("axiom F; A -> F", "line 1, column 16: the text ends; allowed: a symbol, "),
    // Settings and constants.
    (
        "iteration = 3; axiom F;",
        "line 1, column 1: unknown setting `iteration`; allowed: iterations, angle_deg",
    ),
    ("iterations = 0; axiom F;", "line 1, column 14: iterations is 0; allowed: whole numbers, 1 to 64"),
    ("iterations = 65; axiom F;", "line 1, column 14: iterations is 65; allowed: whole numbers, 1 to 64"),
    ("iterations = 2.5; axiom F;", "line 1, column 14: iterations is 2.5; allowed: whole numbers, 1 to 64"),
    ("height_m = 100; axiom F;", "line 1, column 12: height_m is 100; allowed: 0.2 to 60"),
    ("leaf_area_m2 = 0; axiom F;", "line 1, column 16: leaf_area_m2 is 0; allowed: 0.00001 to 0.5"),
    (
        "phyllotaxis = oposite; axiom F;",
        "line 1, column 15: phyllotaxis `oposite`; allowed: alternate, opposite,",
    ),
    ("let = 3; axiom F;", "line 1, column 5: found `=`; allowed: the name of a constant"),
    ("let A 3; axiom F;", "line 1, column 7: found `3`; allowed: `=`"),
    ("let A = 3 let B = 2; axiom F;", "line 1, column 11: found `let`; allowed: `;` after a statement"),
    ("let A = 3; let A = 3; axiom F;", "line 1, column 16: constant `A` again; allowed: each constant once"),
    (
        "let A = B; axiom F;",
        "line 1, column 9: unknown parameter or constant `B`; allowed: numbers and functions",
    ),
    (
        "let A = rand(0, 1); axiom F;",
        "line 1, column 9: `rand` in a constant; allowed: a value that is the same",
    ),
    // Expressions.
    ("axiom F(1 +);", "line 1, column 12: found `)`; allowed: a number, a parameter"),
    ("axiom F(2 & 3);", "line 1, column 11: found `&`; allowed: an operator, `,` or `)`"),
    ("axiom F(1e999);", "line 1, column 9: `1e999`; allowed: a number such as"),
    ("axiom F(.);", "line 1, column 9: `.`; allowed: a number such as"),
    (
        "axiom F; A(len) -> F(lem);",
        "line 1, column 22: unknown parameter or constant `lem`; allowed: len (did you mean `len`?)",
    ),
    (
        "axiom F(squrt(2));",
        "line 1, column 9: unknown function `squrt`; allowed: abs, ceil, chance, clamp, cos",
    ),
    ("axiom F(sqrt(2, 3));", "line 1, column 9: `sqrt` with 2 arguments; allowed: 1"),
    ("axiom F(rand());", "line 1, column 9: `rand` with 0 arguments; allowed: 2"),
    ("axiom F(1 / 0);", "line 1, column 11: division by zero; allowed: a divisor other than 0"),
    ("axiom F;\nA(l) -> F(l % (1 - 1));", "line 2, column 13: division by zero; allowed: a divisor"),
    ("axiom F(sqrt(-1));", "line 1, column 9: sqrt(-1); allowed: numbers from 0"),
    ("axiom F(ln(0));", "line 1, column 9: ln(0); allowed: numbers above 0"),
    ("axiom F(pow(-1, 0.5));", "line 1, column 9: pow(-1, 0.5); allowed: a base of 0 or more"),
    ("axiom F(pow(0, -1));", "line 1, column 9: pow(0, -1); allowed: a base other than 0"),
    ("axiom F(clamp(1, 3, 2));", "line 1, column 9: clamp(1, 3, 2); allowed: a lower bound"),
    ("axiom F(exp(1000));", "line 1, column 9: the result is inf; allowed: finite numbers"),
    ("axiom F(1e300 * 1e300);", "line 1, column 15: the result is inf; allowed: finite numbers"),
];

#[test]
fn errors_in_the_text_name_place_find_and_choice() {
    for (text, expected) in WRONG {
        let error = Grammar::parse(text).expect_err(text).to_string();
        assert!(error.starts_with(expected), "{text}\nfound    {error}\nexpected {expected}");
    }
}

/// Texts without an error that fail when a tree grows.
#[test]
fn errors_in_growth_name_place_find_and_choice() {
    for (text, expected) in [
        (
            "axiom A(2);\nA(n) -> F(1 / n) A(n - 1);",
            "line 2, column 13: division by zero; allowed: a divisor",
        ),
        ("axiom A(1); A(n) -> A(0 - n) F(sqrt(n));", "line 1, column 32: sqrt(-1); allowed: numbers from 0"),
        (
            "axiom A(9); A(n) -> A(n * 1e300);",
            "line 1, column 25: the result is inf; allowed: finite numbers",
        ),
        (
            "axiom A(1); A(n) -> {n} F -> {n - 2} F;",
            "line 1, column 33: a weight of -1; allowed: weights from 0",
        ),
        (
            "axiom A(0); A(n) -> {n} F -> {n} F;",
            "line 1, column 13: weights with a sum of 0; allowed: a finite",
        ),
        ("axiom A(1); A(n) -> F(rand(n, 0));", "line 1, column 23: rand(1, 0); allowed: a lower bound"),
    ] {
        let error = string(text, 1, 1).expect_err(text).to_string();
        assert!(error.starts_with(expected), "{text}\nfound    {error}\nexpected {expected}");
    }
}

#[test]
fn limits_of_the_text_give_the_count_reached() {
    let deep = format!("axiom F({}1{});", "(".repeat(1000), ")".repeat(1000));
    let minus = format!("axiom F({}1);", "-".repeat(1000));
    let chain = format!("axiom F; A(x) -> F(x{});", " + x".repeat(1000));
    for text in [deep, minus, chain] {
        let error = Grammar::parse(&text).expect_err("too deep").to_string();
        assert!(error.contains("an expression 65 levels deep; allowed: at most 64 levels"), "{error}");
    }
    let parameters: Vec<String> = (0..17).map(|index| format!("p{index}")).collect();
    let symbols: String = (0..257).map(|index| format!("S{index} -> F;\n")).collect();
    for (text, expected) in [
        (format!("axiom F; A({}) -> F;", parameters.join(", ")), "17 parameters; allowed: at most 16"),
        (format!("axiom F; {symbols}"), "line 257, column 1: 257 symbols; allowed: at most 256"),
        (format!("axiom F; #{}", "x".repeat(1 << 16)), "a text of 65546 bytes; allowed: at most 65536 bytes"),
    ] {
        let error = Grammar::parse(&text).expect_err("too much").to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn errors_stay_short_whatever_the_names() {
    let name = "x".repeat(60_000);
    for text in [
        format!("axiom {name};"),
        format!("{name} = 1;"),
        format!("axiom F({name});"),
        format!("axiom F; {name} F;"),
    ] {
        let error = Grammar::parse(&text).expect_err("unknown").to_string();
        assert!(error.chars().count() < 700 && !error.contains('\n'), "{} characters", error.len());
    }
}
