// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motion tables. A line `...` stands for the line before it, as often as it takes to fill its table, so that small inputs are whole
//! files.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use windfall_core::motion::MotionTables;
use windfall_core::motion::table::TABLE_ROWS;
use windfall_fuzz::pieces;

/// Most lines that stand for others: one for each table.
const MOST_REPEATED: usize = 6;

/// The text with its `...` written out.
fn written_out(text: &str) -> String {
    let mut out = String::new();
    let (mut rows, mut last, mut repeated) = (0usize, "", 0);
    for line in text.lines() {
        if line == "..." && repeated < MOST_REPEATED {
            repeated += 1;
            for _ in rows..TABLE_ROWS as usize {
                out += last;
                out.push('\n');
            }
            rows = 0;
            continue;
        }
        rows = if line.starts_with("primitive") { 0 } else { rows + 1 };
        last = line;
        out += line;
        out.push('\n');
    }
    out
}

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match MotionTables::from_text(&written_out(text), "tables") {
        Ok(tables) => {
            let written = tables.to_text();
            let again =
                MotionTables::from_text(&written, "the tables again").expect("what is written can be read");
            assert_eq!(again, tables, "the same tables");
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    pieces::mutate(data, size, max_size, seed)
});
