// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Words of doc comments, and of comments in shaders: the first is the noun or the verb of the item, and banned words stand
//! nowhere.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders of sources.
const SOURCES: [&str; 7] = ["app", "backend-cpu", "backend-wgpu", "benches", "core", "tests", "texgen"];
/// Words that no doc comment begins with.
const QUESTIONS: [&str; 8] = ["What", "Who", "Whether", "How", "Where", "When", "Why", "Whose"];
/// Words that stand in no doc comment.
const BANNED: [&str; 5] = ["tell", "tells", "told", "telling", "canary"];

/// Root of the repository.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the package is a folder of the workspace")
}

/// Rust and WGSL files below a folder, in order.
fn source_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of the workspace") {
        let path = entry.expect("a readable entry").path();
        if path.is_dir() {
            found.extend(source_files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs" || ending == "wgsl") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Language of a source.
#[derive(Clone, Copy, PartialEq)]
enum Language {
    Rust,
    Wgsl,
}

/// Text of a line of a doc comment, or of any comment in a shader.
fn doc(line: &str, language: Language) -> Option<&str> {
    let line = line.trim_start();
    let found = match language {
        Language::Rust => line.strip_prefix("///").or_else(|| line.strip_prefix("//!")),
        Language::Wgsl => line.strip_prefix("//"),
    };
    found.map(str::trim)
}

/// Words of a text without the marks around them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '\'' && c != '_').filter(|word| !word.is_empty())
}

/// Lines of a file, by number from one, that break a rule.
fn faults(text: &str, language: Language) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut is_first = true;
    for (number, line) in (1..).zip(text.lines()) {
        let Some(doc) = doc(line, language) else {
            is_first = true;
            continue;
        };
        let first = words(doc).next();
        if is_first && first.is_some_and(|word| QUESTIONS.contains(&word)) {
            found.push((number, format!("begins with \"{}\": {doc}", first.unwrap_or_default())));
        }
        for word in words(doc).filter(|word| BANNED.contains(&word.to_lowercase().as_str())) {
            found.push((number, format!("says \"{word}\": {doc}")));
        }
        // A head such as `# Source` begins anew behind it, as do the lines at the beginning of a shader.
        is_first = ["#", "SPDX", "twin:"].iter().any(|head| doc.starts_with(head));
    }
    found
}

#[test]
fn doc_comments_begin_with_a_noun_or_a_verb() {
    let mut found = Vec::new();
    for folder in SOURCES {
        for path in source_files(&root().join(folder)) {
            let text = fs::read_to_string(&path).expect("a source file");
            let name = path.strip_prefix(root()).expect("below the root").display();
            let is_shader = path.extension().is_some_and(|ending| ending == "wgsl");
            let language = if is_shader { Language::Wgsl } else { Language::Rust };
            found.extend(
                faults(&text, language).into_iter().map(|(line, fault)| format!("{name}:{line} {fault}")),
            );
        }
    }
    assert!(found.is_empty(), "{} doc comments:\n{}", found.len(), found.join("\n"));
}

#[test]
fn planted_lines_are_found() {
    let plant = |line: &str| format!("/// Next event step.\npub event: u32,\n{line}\npub size: u32,\n");
    for (line, count) in [
        ("    /// What a leaf is up to.", 1),
        ("//! How leaves fall.", 1),
        ("/// Whether it is told.", 2),
        ("/// The regime that its own motion tells.", 1),
        ("/// Time at which a leaf lands, and where.", 0),
        ("/// Number of steps.\n/// How many they are is free.", 0),
        ("let what = \"What, told in code\"; // How, in a plain comment", 0),
        ("/// Storytelling is no word of ours, nor is `tell_tale`.", 0),
    ] {
        let found = faults(&plant(line), Language::Rust);
        assert_eq!(found.len(), count, "{line}: {found:?}");
        assert!(found.iter().all(|(number, _)| *number == 3), "{line}: {found:?}");
    }
    let shader = "// SPDX-License-Identifier: MIT\n// twin: a.rs\n// How leaves fall.\nfn fall() {}\n";
    assert_eq!(faults(shader, Language::Wgsl).len(), 1, "the first words of a shader");
}
