// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random texts and random grammars: never a panic, and in the second case always a tree or an error in numbers.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use crate::scene::{Tree, TreeForm, TreeKind, TreePreset};
use crate::tree::grammar::{Grammar, GrammarError};
use crate::tree::{TreeError, grow};

/// Pieces of grammars, to be put together at random.
const PIECES: &[&str] = &[
    "axiom",
    "let",
    "iterations",
    "girth",
    "phyllotaxis",
    "opposite",
    "A",
    "B",
    "F",
    "L",
    "K",
    "T",
    "l",
    "rand",
    "if",
    "sqrt",
    "0",
    "1",
    "2.5",
    "1e3",
    "(",
    ")",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    ";",
    ":",
    "->",
    "=",
    "==",
    "<=",
    "&&",
    "||",
    "+",
    "-",
    "*",
    "/",
    "\\",
    "|",
    "&",
    "^",
    "$",
    "!",
    "%",
    " ",
    "\n",
    "# x\n",
    "é",
    "\u{0}",
];

fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        (0.0f64..3.0).prop_map(|number| format!("{number:.3}")),
        Just("p0".to_owned()),
        Just("p1".to_owned()),
        Just("C".to_owned()),
        Just("rand(0.2, 1)".to_owned()),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let operator = select(vec!["+", "-", "*", "/", "%", "<", "&&", "||", "==", "!="]);
        prop_oneof![
            (inner.clone(), operator, inner.clone())
                .prop_map(|(a, operator, b)| format!("({a} {operator} {b})")),
            (select(vec!["max", "min", "pow"]), inner.clone(), inner.clone())
                .prop_map(|(function, a, b)| format!("{function}({a}, {b})")),
            (select(vec!["abs", "sqrt", "sin", "-", "!"]), inner)
                .prop_map(|(function, a)| format!("{function}({a})")),
        ]
    })
}

fn modules() -> impl Strategy<Value = String> {
    let two = |(symbol, a, b): (&str, String, String)| format!("{symbol}({a}, {b})");
    let one = |(symbol, a): (&str, String)| format!("{symbol}({a})");
    let leaf = prop_oneof![
        3 => (select(vec!["A", "B"]), expression(), expression()).prop_map(two),
        3 => (Just("F"), expression()).prop_map(one),
        1 => (select(vec!["L", "K", "T"]), expression()).prop_map(one),
        2 => (select(vec!["+", "-", "&", "^", "/", "\\"]), expression()).prop_map(one),
        1 => select(vec!["$", "|", "F L", "F K", "T(1, 0, 1, 2)"]).prop_map(str::to_owned),
    ];
    let string = vec(leaf, 0..5).prop_map(|modules| modules.join(" "));
    string.prop_recursive(2, 8, 3, |inner| {
        vec(prop_oneof![inner.clone(), inner.prop_map(|inner| format!("[ {inner} ]"))], 1..3)
            .prop_map(|parts| parts.join(" "))
    })
}

prop_compose! {
    fn grammar()(
        iterations in 1u32..12,
        constant in -2.0f64..2.0,
        axiom in modules(),
        rules in vec((select(vec!["A", "B"]), proptest::option::of(expression()), vec(modules(), 1..3)), 1..4),
    ) -> String {
        let axiom = axiom.replace("p0", "1").replace("p1", "2");
        let mut text = format!("iterations = {iterations}; let C = {constant:.2}; axiom F {axiom};\n");
        for (symbol, condition, alternatives) in rules {
            let condition = condition.map(|condition| format!(": {condition}")).unwrap_or_default();
            text += &format!("{symbol}(p0, p1) {condition} -> {};\n", alternatives.join(" -> "));
        }
        // Both have a rule.
        text + "A(l, w) -> F(l); B(l, w) -> F(w) L;"
    }
}

fn kind(text: String) -> TreeKind {
    TreeKind { form: TreeForm::Grammar(text), ..TreeKind::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_text_never_panics(text in ".{0,200}") {
        let _ = grow(&kind(text), &Tree::default(), 1);
    }

    #[test]
    fn random_pieces_never_panic(pieces in vec(select(PIECES.to_vec()), 0..60)) {
        let _ = grow(&kind(pieces.join(" ")), &Tree::default(), 1);
        let _ = grow(&kind(format!("axiom F; {}", pieces.concat())), &Tree::default(), 1);
    }

    #[test]
    fn a_damaged_preset_never_panics(
        preset in select(TreePreset::ALL.to_vec()),
        (at, length) in (any::<proptest::sample::Index>(), 0usize..40),
        piece in select(PIECES.to_vec()),
    ) {
        let text = preset.text();
        let mut from = at.index(text.len());
        let mut to = (from + length).min(text.len());
        while !text.is_char_boundary(from) { from -= 1; }
        while !text.is_char_boundary(to) { to += 1; }
        let _ = grow(&kind(format!("{}{piece}{}", &text[..from], &text[to..])), &Tree::default(), 1);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_grammars_give_trees_or_errors_in_numbers(
        text in grammar(),
        seed in any::<u64>(),
        (age, number, leaves) in (0.05f32..=1.0, any::<u32>(), 0u32..500),
    ) {
        let parsed = Grammar::parse(&text);
        if let Err(GrammarError::Text { found, .. }) = &parsed {
            // Constants in expressions are computed while the text is read.
            let is_arithmetic = ["division", "pow(", "sqrt(", "the result"].iter().any(|start| found.starts_with(start));
            prop_assert!(is_arithmetic, "{text}: {found}");
        }
        let tree = Tree { age, number, leaves, ..Tree::default() };
        match grow(&kind(text.clone()), &tree, seed) {
            Ok(skeleton) => {
                prop_assert_eq!(skeleton.validate(), Ok(()), "{}", text);
                let again = grow(&kind(text.clone()), &tree, seed).ok();
                prop_assert_eq!(again.as_ref(), Some(&skeleton), "{}", text);
            }
            Err(TreeError::Grammar { .. } | TreeError::Skeleton { .. }) => {}
            Err(other) => prop_assert!(false, "{text}: {other}"),
        }
    }
}
