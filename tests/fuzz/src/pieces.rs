// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Changes of texts that are made of words, numbers, quoted strings and brackets, as RON, JSON, grammars and tables are:
//! whole pieces are left out, repeated or put in the place of others, so that what comes out is mostly well-formed.

use std::ops::Range;

use libfuzzer_sys::fuzzer_mutate;

use crate::random::Random;

/// Numbers at the edges of what readers take.
const NUMBERS: [&str; 22] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "0.5",
    "3",
    "7",
    "64",
    "255",
    "256",
    "65535",
    "1e-45",
    "1.1754944e-38",
    "16777217",
    "2147483648",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "3.4028235e38",
    "1e309",
    "NaN",
];

/// Class of a piece; pieces take the places of others of their class.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Number,
    Word,
    Quoted,
    Group,
    /// A word with the number, word or group behind it and a colon, or a call: `name: value`, `name(value)`.
    Field,
}

/// Changes a text in `data[..size]`, and returns its new length, at most `max_size`.
pub fn mutate(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> usize {
    let mut random = Random::new(seed);
    let most = max_size.min(data.len());
    if random.below(3) == 0 {
        return fuzzer_mutate(data, size, most);
    }
    let mut text = data[..size].to_vec();
    for _ in 0..=random.below(3) {
        text = changed(&text, &mut random).unwrap_or(text);
    }
    let size = text.len().min(most);
    data[..size].copy_from_slice(&text[..size]);
    size
}

/// The text with one change, if there are pieces.
fn changed(text: &[u8], random: &mut Random) -> Option<Vec<u8>> {
    let pieces = pieces(text);
    if pieces.is_empty() {
        return None;
    }
    let (kind, at) = random.one_of(&pieces).clone();
    let replaced = |at: Range<usize>, new: &[u8]| [&text[..at.start], new, &text[at.end..]].concat();
    if kind == Kind::Number && random.below(2) == 0 {
        let number = std::str::from_utf8(&text[at.clone()]).ok().and_then(|word| word.parse::<f64>().ok());
        return Some(match (random.below(4), number) {
            (0, Some(number)) => replaced(at, (number * 2.0).to_string().as_bytes()),
            (1, Some(number)) => replaced(at, (number / 2.0).to_string().as_bytes()),
            (2, Some(number)) => replaced(at, (-number).to_string().as_bytes()),
            _ => replaced(at, random.one_of(&NUMBERS).as_bytes()),
        });
    }
    match random.below(4) {
        // Left out, with the comma behind it.
        0 => {
            let comma = text[at.end..].iter().position(|byte| !byte.is_ascii_whitespace());
            let end = comma
                .filter(|&comma| text[at.end + comma] == b',')
                .map_or(at.end, |comma| at.end + comma + 1);
            Some(replaced(at.start..end, b""))
        }
        1 => {
            let twice = [&text[at.clone()], b", ", &text[at.clone()]].concat();
            Some(replaced(at, &twice))
        }
        _ => {
            let alike: Vec<&(Kind, Range<usize>)> = pieces.iter().filter(|piece| piece.0 == kind).collect();
            let (_, other) = random.one_of(&alike);
            Some(replaced(at, &text[other.clone()]))
        }
    }
}

/// All pieces of a text, in the order of their ends.
fn pieces(text: &[u8]) -> Vec<(Kind, Range<usize>)> {
    let mut found = Vec::new();
    // Beginnings of open brackets, each with that of the field which it is the value of.
    let mut open: Vec<(usize, Option<usize>)> = Vec::new();
    // Beginning of a name whose value comes next.
    let mut name: Option<usize> = None;
    let mut at = 0;
    while at < text.len() {
        let start = at;
        match text[at] {
            b'(' | b'[' | b'{' => {
                open.push((at, name.take()));
                at += 1;
            }
            b')' | b']' | b'}' => {
                at += 1;
                if let Some((start, field)) = open.pop() {
                    found.push((Kind::Group, start..at));
                    found.extend(field.map(|field| (Kind::Field, field..at)));
                }
                name = None;
            }
            b'"' => {
                at += 1;
                while at < text.len() && text[at] != b'"' {
                    at += if text[at] == b'\\' { 2 } else { 1 };
                }
                at = (at + 1).min(text.len());
                found.push((Kind::Quoted, start..at));
                found.extend(name.take().map(|field| (Kind::Field, field..at)));
                if followed_by_colon(text, at) {
                    name = Some(start);
                }
            }
            byte if is_word(byte) => {
                while at < text.len() && is_word(text[at]) {
                    at += 1;
                }
                let is_number = text[start].is_ascii_digit() || b"-+.".contains(&text[start]);
                found.push((if is_number { Kind::Number } else { Kind::Word }, start..at));
                let is_name = followed_by_colon(text, at);
                let is_call = text.get(at) == Some(&b'(');
                match name.take() {
                    Some(field) if !is_name && !is_call => found.push((Kind::Field, field..at)),
                    Some(field) if is_call => name = Some(field),
                    _ if is_name || is_call => name = Some(start),
                    _ => {}
                }
            }
            _ => at += 1,
        }
    }
    found
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_-+.".contains(&byte)
}

fn followed_by_colon(text: &[u8], at: usize) -> bool {
    text[at..].iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b':')
}
