// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Suggestions for misspelt names.

/// Candidate that `name` is a likely misspelling of.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Beyond this no allowance for typing errors would reach a candidate, and the distance costs its square.
    if name.len() > 64 {
        return None;
    }
    let name = name.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (strsim::levenshtein(&name, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, candidate)| distance <= 1 + candidate.chars().count() / 4)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_likely_misspellings_are_offered() {
        let names = ["autumn-park", "storm", "million"];
        assert_eq!(nearest("autum-parc", names), Some("autumn-park"), "two errors in a long name");
        assert_eq!(nearest("Strom", names), Some("storm"), "case does not count");
        assert_eq!(nearest("winter", names), None, "nothing like it");
        assert_eq!(nearest(&"storm".repeat(1000), names), None, "absurdly long");
    }
}
