// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Grammars of trees: read, and grown into a tree with bark.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use windfall_core::scene::{Tree, TreeForm, TreeKind};
use windfall_core::tree::grammar::Grammar;
use windfall_core::tree::{BarkDetail, bark_mesh, full_leaf_count, grow};
use windfall_fuzz::pieces;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Err(error) = Grammar::parse(text) {
        assert!(!error.to_string().is_empty(), "an error says something");
        return;
    }
    let kind = TreeKind { form: TreeForm::Grammar(text.to_owned()), ..TreeKind::default() };
    let tree = Tree { leaves: 100, ..Tree::default() };
    match grow(&kind, &tree, 1) {
        Ok(skeleton) => {
            skeleton.validate().expect("what has grown is valid");
            bark_mesh(&skeleton, BarkDetail::Far);
            let full = full_leaf_count(&kind, &tree, 1).expect("the same tree");
            assert!(full >= 0.0 && full.is_finite(), "a number of leaves: {full}");
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    pieces::mutate(data, size, max_size, seed)
});
