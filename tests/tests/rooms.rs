// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Order of the rooms of each crate. A room is a module at the crate's root, or a module within one that is listed by itself.
//! It imports only rooms listed before it, so no import leads upward and there is no circle across rooms.
//!
//! Sources are read as text: paths from `crate::` and `super::` in code, not in comments and not in unit tests.

use std::fs;
use std::path::{Path, PathBuf};

/// A crate and its rooms.
struct Order {
    /// Folder of the sources, from the root of the repository.
    sources: &'static str,
    /// Rooms from the lowest to the highest.
    rooms: &'static [&'static str],
    /// Rooms whose modules do not import each other.
    apart: &'static [&'static str],
    /// Imports that lead upward all the same: from, to, and the reason.
    exceptions: &'static [(&'static str, &'static str, &'static str)],
}

const APP: Order = Order {
    sources: "app/src",
    rooms: &[
        "files",
        "leaves",
        "run",
        "output",
        "merge",
        "study",
        "export",
        "plot",
        "view/session",
        "view/tools",
        "view/panel",
        "view/window",
        "view",
        "commands",
        "cli",
        "lib",
        "main",
    ],
    apart: &["commands"],
    exceptions: &[],
};

const CORE: Order = Order {
    sources: "core/src",
    rooms: &[
        "convert",
        "regular_file",
        "error",
        "layout",
        "threads",
        "device/arith",
        "store",
        "hull",
        "surface",
        "scene",
        "clock",
        "flight",
        "motion",
        "tree",
        "solid",
        "blocks",
        "device/motion",
        "context",
        "device/solid",
        "device/terrain",
        "device/wind",
        "device/tree",
        "terrain",
        "wind",
        "leaf",
        "device/leaf",
        "device/flight",
        "particle",
        "device/particle",
        "device",
        "litter",
        "compile",
        "sim",
        "lib",
    ],
    apart: &[],
    exceptions: &[
        ("device/leaf", "device/flight", "a leaf that flies as a body takes its steps"),
        ("flight", "context", "drop tables are flown in the air of a scene"),
        ("flight", "device/flight", "drop tables are flown over no ground but their own"),
        ("flight", "device/leaf", "drop tables are flown by the leaf's own functions"),
        (
            "leaf",
            "device/leaf",
            "host code places and reads leaves by the records and functions of the device",
        ),
        (
            "particle",
            "device/particle",
            "the store is one of the device's records, and plain loops call its functions",
        ),
        ("leaf", "compile", "leaves of trees are placed by what the scene compiles to"),
        ("scene", "motion", "a species states its primitive motions and the changes between them"),
        ("scene", "tree", "the grammar of a tree is checked by reading it"),
        ("tree", "device/tree", "trees are built into the records that the device steps"),
    ],
};

const CRATES: [Order; 2] = [CORE, APP];

/// An import that leads upward, by rooms.
#[derive(Debug, PartialEq, Eq)]
struct Import {
    from: &'static str,
    to: String,
}

impl Order {
    /// Room of a module, by the longest listed path that it lies in.
    fn room(&self, module: &[&str]) -> Option<&'static str> {
        let path = module.join("/");
        let holds = |room: &&&str| {
            path == **room || path.strip_prefix(**room).is_some_and(|rest| rest.starts_with('/'))
        };
        self.rooms.iter().filter(holds).max_by_key(|room| room.len()).copied()
    }

    fn place(&self, room: &str) -> Option<usize> {
        self.rooms.iter().position(|listed| *listed == room)
    }

    /// Imports of a file that lead upward. `names` are those that the crate's root hands on, with their modules.
    fn upward(&self, file: &str, text: &str, names: &[(String, Vec<String>)]) -> Vec<Import> {
        let module = module_of(file);
        let module: Vec<&str> = module.iter().map(String::as_str).collect();
        let from = self.room(&module).unwrap_or_else(|| panic!("{file} is in no room of the order"));
        let mut upward = Vec::new();
        for path in paths(&code_of(text), &module) {
            let first = path.first().map(String::as_str).unwrap_or_default();
            let handed_on = names.iter().find(|(name, _)| name == first).map(|(_, module)| module);
            let target: Vec<&str> = handed_on.unwrap_or(&path).iter().map(String::as_str).collect();
            let to = self.room(&target).map_or_else(|| target.join("::"), str::to_owned);
            let is_lower = self.place(&to).is_some_and(|to| Some(to) <= self.place(from));
            let is_apart = from == to && self.apart.contains(&from) && module.get(1) != target.get(1);
            if is_apart || !is_lower {
                upward.push(Import { from, to });
            }
        }
        upward
    }
}

/// Path of a file's module from the crate's root.
fn module_of(file: &str) -> Vec<String> {
    let file = file.strip_suffix(".rs").unwrap_or(file);
    let path = file.strip_suffix("/mod").unwrap_or(file);
    path.split('/').map(str::to_owned).collect()
}

/// The code of a source: without comments, and without the unit tests at its end.
fn code_of(text: &str) -> String {
    let tests = text.find("#[cfg(test)]\nmod ").unwrap_or(text.len());
    let lines = text[..tests].lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// Paths from the crate's root that a module's code names.
fn paths(code: &str, module: &[&str]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for (start, _) in ["crate::", "super::"].into_iter().flat_map(|word| code.match_indices(word)) {
        let before = code[..start].chars().next_back();
        // The rest of a longer name, or of a chain that was followed from its beginning.
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':' || c == '$') {
            continue;
        }
        let mut rest = &code[start..];
        let mut base: Vec<String> = Vec::new();
        if let Some(inside) = rest.strip_prefix("crate::") {
            rest = inside;
        } else {
            base = module.iter().map(|&part| part.to_owned()).collect();
            while let Some(above) = rest.strip_prefix("super::") {
                base.pop();
                rest = above;
            }
        }
        for tail in tails(rest) {
            found.push(base.iter().cloned().chain(tail).collect());
        }
    }
    found
}

/// The paths that a text begins with: one, or those of a group in braces.
fn tails(text: &str) -> Vec<Vec<String>> {
    let Some(group) = text.strip_prefix('{') else {
        let name: String = text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let rest = &text[name.len()..];
        let below = rest.strip_prefix("::").map_or_else(|| vec![Vec::new()], tails);
        return below.into_iter().map(|below| [name.clone()].into_iter().chain(below).collect()).collect();
    };
    let mut depth = 0;
    let mut begin = 0;
    let mut items = Vec::new();
    for (index, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                items.push(group[begin..index].trim());
                begin = index + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    items.into_iter().filter(|item| !item.is_empty()).flat_map(tails).collect()
}

/// Names that the root of a crate hands on, with the modules that they come from.
fn handed_on(lib: &str) -> Vec<(String, Vec<String>)> {
    let code = code_of(lib);
    let uses = code.split("pub use ").skip(1);
    let paths = uses.flat_map(tails);
    paths.filter_map(|path| Some((path.last()?.clone(), path))).collect()
}

/// Macros of a module, which are named from the crate's root.
fn macros(text: &str, module: &[String]) -> Vec<(String, Vec<String>)> {
    let names = text.split("macro_rules! ").skip(1).filter_map(|rest| tails(rest).pop()?.pop());
    names.map(|name| (name, module.to_vec())).collect()
}

/// Path of a file from the sources, with slashes.
fn within(sources: &Path, path: &Path) -> String {
    path.strip_prefix(sources).expect("inside").to_string_lossy().replace('\\', "/")
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let files = paths.flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

#[test]
fn rooms_import_only_lower_ones() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut upward = Vec::new();
    for order in CRATES {
        let sources = root.join(order.sources);
        let mut names = handed_on(&fs::read_to_string(sources.join("lib.rs")).expect("a library"));
        for path in rust_files(&sources) {
            names.extend(macros(
                &fs::read_to_string(&path).expect("readable"),
                &module_of(&within(&sources, &path)),
            ));
        }
        let mut used = vec![false; order.exceptions.len()];
        for path in rust_files(&sources) {
            let file = within(&sources, &path);
            if file.split('/').any(|part| part == "tests" || part == "tests.rs") {
                continue;
            }
            let text = fs::read_to_string(&path).expect("readable");
            for Import { from, to } in order.upward(&file, &text, &names) {
                match order.exceptions.iter().position(|(a, b, _)| (*a, *b) == (from, to.as_str())) {
                    Some(index) => used[index] = true,
                    None => upward.push(format!("{}/{file}: {from} imports {to}", order.sources)),
                }
            }
        }
        for ((from, to, _), _) in order.exceptions.iter().zip(&used).filter(|(_, used)| !**used) {
            upward.push(format!("{}: the exception of {from} for {to} is needed no more", order.sources));
        }
    }
    assert!(upward.is_empty(), "upward:\n{}", upward.join("\n"));
}

#[test]
fn upward_imports_are_noticed() {
    let upward = |file: &str, text: &str| {
        let names = [("backend".to_owned(), vec!["run".to_owned(), "backend".to_owned()])];
        let found = APP.upward(file, text, &names);
        found.into_iter().map(|import| import.to).collect::<Vec<_>>()
    };
    let none: [&str; 0] = [];
    assert_eq!(upward("files/csv_file.rs", "use crate::run::terminal;"), ["run"], "a higher room");
    assert_eq!(upward("run/backend.rs", "use crate::files::OutputFile;"), none, "a lower room");
    assert_eq!(upward("run/tracks.rs", "use super::parse::whole;"), none, "its own room");
    assert_eq!(upward("run/tracks.rs", "use super::super::view::Show;"), ["view"], "by way of the root");
    assert_eq!(upward("leaves/mod.rs", "fn f(a: crate::plot::picture::Area) {}"), ["plot"], "in code");
    assert_eq!(upward("leaves/mod.rs", "use crate::backend::Device;"), ["run"], "a name handed on");
    assert_eq!(upward("commands/view.rs", "use super::render::within;"), ["commands"], "another command");
    assert_eq!(upward("commands/tree/info.rs", "use super::source::GivenTree;"), none, "the same command");
    let group = "use crate::{\n    files::{OutputFile, WriteError},\n    view::{tools::card, Group},\n};";
    assert_eq!(upward("study/folder.rs", group), ["view/tools", "view"], "in a group");
    assert_eq!(upward("view/tools/card.rs", "use crate::view::panel::keys;"), ["view/panel"], "within");
    assert_eq!(upward("view/panel/keys.rs", "use crate::view::tools::card;"), none, "a lower one within");
    assert_eq!(
        upward("view/tools/card.rs", "use super::super::window;"),
        ["view/window"],
        "within, by super"
    );
    let hidden = "//! [`crate::view`]\n// crate::view\n#[cfg(test)]\nmod tests {\n    use crate::view;\n}\n";
    assert_eq!(upward("files/csv_file.rs", hidden), none, "comments and tests");
}
