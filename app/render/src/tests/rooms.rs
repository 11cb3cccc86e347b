// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Order of the rooms of this crate: a room imports only those listed before it, so there is no circle across rooms. Within a
//! room there is none either.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms from the lowest to the highest: modules at the root of the crate.
const ROOMS: [&str; 19] = [
    "random",
    "quality",
    "light",
    "error",
    "gpu",
    "land",
    "camera",
    "frame",
    "lens",
    "trees",
    "objects",
    "leaves",
    "shadows",
    "scenery",
    "park",
    "particles",
    "marks",
    "renderer",
    "lib",
];

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).expect("a readable folder").map(|entry| entry.expect("an entry").path());
    let files = entries.flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

/// Room of a file by its path within the sources; `None` for tests.
fn room(path: &Path) -> Option<String> {
    let first = path.components().next()?.as_os_str().to_string_lossy();
    let is_test = path.to_string_lossy().contains("tests");
    (!is_test).then(|| first.trim_end_matches(".rs").to_owned())
}

/// Rooms that a source text names, without its unit tests.
fn imports(text: &str) -> Vec<String> {
    let text = text.split("#[cfg(test)]").next().unwrap_or(text);
    let code: String = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let named = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    code.split("crate::").skip(1).map(named).collect()
}

/// Imports of a file in `room` that the order forbids.
fn forbidden(room: &str, text: &str) -> Vec<String> {
    let place = |name: &str| ROOMS.iter().position(|room| *room == name);
    let own = place(room).unwrap_or_else(|| panic!("room '{room}' has no place in the order"));
    let is_lower = |name: &str| place(name).is_some_and(|at| at < own);
    imports(text).into_iter().filter(|import| import != room && !is_lower(import)).collect()
}

#[test]
fn rooms_import_only_lower_ones() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = 0;
    for path in rust_files(&sources) {
        let relative = path.strip_prefix(&sources).expect("inside");
        let Some(room) = room(relative) else { continue };
        let upward = forbidden(&room, &fs::read_to_string(&path).expect("readable"));
        assert!(upward.is_empty(), "{} imports upward: {upward:?}", relative.display());
        seen += 1;
    }
    assert!(seen > 60, "{seen} files");
}

#[test]
fn an_upward_import_is_noticed() {
    assert_eq!(forbidden("gpu", "use crate::frame::group::FrameGroup;"), ["frame"], "a higher room");
    assert_eq!(forbidden("gpu", "fn f(renderer: crate::Renderer) {}"), ["Renderer"], "past the rooms");
    assert_eq!(forbidden("frame", "use crate::gpu::upload;"), Vec::<String>::new(), "a lower room");
}

/// Names in the path, or the tree of paths, that a text begins with.
fn names(text: &str) -> Vec<&str> {
    let is_path = |c: char| c.is_alphanumeric() || "_:{}, \n".contains(c);
    let path = &text[..text.find(|c| !is_path(c)).unwrap_or(text.len())];
    path.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|name| !name.is_empty()).collect()
}

/// Modules of a room, by name and text, that import each other in a circle. `root` is the text of the room itself, which hands on
/// names of theirs.
fn circle(room: &str, root: &str, modules: &BTreeMap<String, String>) -> BTreeSet<String> {
    let mut owners: BTreeMap<&str, &str> =
        modules.keys().map(|name| (name.as_str(), name.as_str())).collect();
    for handed_on in root.split("use ").skip(1).map(names) {
        if let [module, names @ ..] = handed_on.as_slice()
            && modules.contains_key(*module)
        {
            owners.extend(names.iter().map(|name| (*name, *module)));
        }
    }
    let from_root = format!("crate::{room}::");
    let imports = |name: &str, text: &str| -> BTreeSet<String> {
        let text = text.split("#[cfg(test)]").next().unwrap_or(text);
        let lines: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
        let code = lines.join("\n");
        let paths = code.split("super::").skip(1).chain(code.split(&from_root).skip(1)).flat_map(names);
        let owned = paths.filter_map(|name| owners.get(name)).filter(|owner| **owner != name);
        owned.map(|owner| (*owner).to_owned()).collect()
    };
    let mut left: BTreeMap<String, BTreeSet<String>> =
        modules.iter().map(|(name, text)| (name.clone(), imports(name, text))).collect();
    // Those that import none of the others, and those that none of the others import, are in no circle.
    loop {
        let is_free = |name: &str, imports: &BTreeSet<String>| {
            !imports.iter().any(|import| left.contains_key(import))
                || !left.values().any(|other| other.contains(name))
        };
        let free: Vec<String> = left
            .iter()
            .filter(|(name, imports)| is_free(name, imports))
            .map(|(name, _)| name.clone())
            .collect();
        if free.is_empty() {
            return left.into_keys().collect();
        }
        left.retain(|name, _| !free.contains(name));
    }
}

#[test]
fn modules_of_a_room_import_one_way() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut rooms: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for path in rust_files(&sources) {
        let relative = path.strip_prefix(&sources).expect("inside");
        let Some(room) = room(relative).filter(|_| relative.components().count() == 2) else { continue };
        let module = path.file_stem().expect("a file").to_string_lossy().into_owned();
        rooms.entry(room).or_default().insert(module, fs::read_to_string(&path).expect("readable"));
    }
    assert!(rooms.len() > 10, "{} rooms", rooms.len());
    for (room, mut modules) in rooms {
        let root = modules.remove("mod").expect("a root");
        assert_eq!(circle(&room, &root, &modules), BTreeSet::new(), "a circle in {room}");
    }
}

#[test]
fn a_circle_is_noticed() {
    let modules = |texts: [&str; 3]| {
        ["sky", "sun", "haze"].map(str::to_owned).into_iter().zip(texts.map(str::to_owned)).collect()
    };
    let root = "mod sky;\nmod sun;\nmod haze;\npub use sun::{Sun, SunDisc};\n";
    let of = |texts| circle("light", root, &modules(texts)).into_iter().collect::<Vec<_>>();
    let user = "use crate::light::sky::Sky;";
    assert_eq!(of(["use super::sun::Sun;", "use super::sky::Sky;", user]), ["sky", "sun"], "by modules");
    assert_eq!(
        of(["use super::{Sun, shaders};", "use crate::light::sky;", user]),
        ["sky", "sun"],
        "by handed-on names"
    );
    assert_eq!(of(["use super::SunDisc;", "// super::sky", user]), [""; 0], "one way");
}
