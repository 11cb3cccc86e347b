// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pages of the project, held to the tree: links lead somewhere, and the map names what is there.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every Markdown page at the root, in `docs` and in `benches/record`.
fn pages() -> Vec<PathBuf> {
    let folders = ["", "docs", "docs/guide", "benches/record"].map(|folder| root().join(folder));
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("a folder of the project"));
    entries
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "md"))
        .collect()
}

/// Anchor of a heading, as forges write it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

/// Relative links of a page that lead nowhere.
fn broken_links(page: &Path, text: &str) -> Vec<String> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets
        .filter(|target| !target.contains("://"))
        .filter(|target| {
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let path = match file {
                "" => page.to_owned(),
                file => page.parent().expect("a page lies in a folder").join(file),
            };
            let has_heading = || {
                let text = fs::read_to_string(&path).unwrap_or_default();
                text.lines()
                    .filter_map(|line| line.strip_prefix('#'))
                    .any(|line| anchor(line.trim_start_matches('#')) == heading)
            };
            !path.exists() || !(heading.is_empty() || has_heading())
        })
        .map(str::to_owned)
        .collect()
}

#[test]
fn links_lead_somewhere() {
    let pages = pages();
    assert!(pages.len() >= 12, "{} pages", pages.len());
    for page in pages {
        let text = fs::read_to_string(&page).expect("readable");
        assert_eq!(broken_links(&page, &text), [""; 0], "links of {}", page.display());
    }
    let broken =
        broken_links(&root().join("README.md"), "[a](docs/none.md) [b](README.md#no-such) [c](docs)");
    assert_eq!(broken, ["docs/none.md", "README.md#no-such"], "broken links are noticed");
}

/// Folders of sources below `folder`, with their paths from the root: those that hold a source file or another folder.
fn source_folders(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).expect("a folder of the project") {
        let path = entry.expect("readable").path();
        let name = path.file_name().expect("an entry has a name").to_string_lossy().into_owned();
        if path.is_dir() && name != "tests" {
            found.insert(path.strip_prefix(root()).expect("inside").to_string_lossy().replace('\\', "/"));
            source_folders(&path, found);
        }
    }
}

/// Paths that the map of ARCHITECTURE.md has a line for: the first word of each line of its tree, indented by parents.
fn mapped(text: &str) -> BTreeSet<String> {
    let tree = text.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap_or("");
    let mut parents: Vec<String> = Vec::new();
    let mut found = BTreeSet::new();
    for line in tree.lines().filter(|line| !line.trim().is_empty()) {
        let depth = (line.len() - line.trim_start().len()) / 2;
        let name = line.split_whitespace().next().unwrap_or("").trim_end_matches('/');
        parents.truncate(depth);
        parents.push(name.to_owned());
        found.insert(parents.join("/"));
    }
    found
}

/// Every folder that the map names exists, and every folder of sources, down to the rooms of each crate, is on it.
#[test]
fn the_map_is_that_of_the_tree() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("readable");
    let mapped = mapped(&text);
    for path in &mapped {
        assert!(root().join(path).exists(), "the map names {path}, which is not there");
    }
    let crates = ["core", "backend-cpu", "backend-wgpu", "texgen", "app", "app/render", "tests"];
    let mut folders = BTreeSet::new();
    for name in crates {
        source_folders(&root().join(name).join("src"), &mut folders);
    }
    let rooms = folders.iter().filter(|path| {
        let below = path.split("src/").nth(1).unwrap_or("");
        !below.is_empty() && !below.contains('/')
    });
    let missing: Vec<_> = rooms.filter(|room| !mapped.contains(*room)).collect();
    assert!(missing.is_empty(), "rooms that the map leaves out: {missing:?}");
    assert!(mapped.len() > 40, "the map has {} lines", mapped.len());
}

#[test]
fn scenes_of_the_gallery_can_be_built() {
    let entries = fs::read_dir(root().join("docs/gallery")).expect("a folder of the project");
    let files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "ron"))
        .collect();
    assert!(files.len() > 1, "{files:?}");
    for file in files {
        let name = file.display().to_string();
        let text = fs::read_to_string(&file).expect("readable");
        let scene =
            windfall_core::Scene::from_ron(&text, &name).unwrap_or_else(|error| panic!("{name}: {error}"));
        windfall_core::World::build(&scene).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
