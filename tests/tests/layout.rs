// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What Rust and WGSL share, checked without a GPU: layouts, twins, and the rules that make bits equal.

use std::fs;
use std::path::{Path, PathBuf};

use naga::{AddressSpace, TypeInner};
use windfall_core::blocks::{
    EnvironmentBlock, ResponseBlock, SourceBlock, SpeciesBlock, StepBlock, VortexBlock, WindBlock,
};
use windfall_core::flight::block::BodyBlock;
use windfall_core::layout::WgslStruct;
use windfall_core::tree::record::{LevelBlock, SegmentConstants};
use windfall_wgpu::{KernelId, Shaders};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn parse(name: &str) -> (naga::Module, naga::valid::ModuleInfo) {
    let source = Shaders::default().compose(name).expect("it composes");
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(&source)));
    let flags = naga::valid::ValidationFlags::all();
    let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
    (module, info)
}

fn same_layout<T: WgslStruct>(module: &naga::Module) {
    let name = T::name();
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(&name));
    let TypeInner::Struct { members, span } = &found.unwrap_or_else(|| panic!("no struct {name}")).1.inner
    else {
        panic!("{name} is a struct");
    };
    assert_eq!(*span as usize, size_of::<T>(), "size of {name}");
    let wgsl: Vec<_> =
        members.iter().map(|member| (member.name.as_deref().unwrap_or(""), member.offset as usize)).collect();
    let fields = T::fields();
    let rust: Vec<_> = fields.iter().map(|(name, _, offset)| (*name, *offset)).collect();
    assert_eq!(rust, wgsl, "fields and offsets of {name}");
}

#[test]
fn every_module_is_valid_and_every_struct_has_one_layout() {
    let shaders = Shaders::default();
    for name in shaders.names() {
        parse(name);
    }
    let (module, _) = parse("bindings");
    same_layout::<SpeciesBlock>(&module);
    same_layout::<SourceBlock>(&module);
    same_layout::<WindBlock>(&module);
    same_layout::<ResponseBlock>(&module);
    same_layout::<BodyBlock>(&module);
    same_layout::<EnvironmentBlock>(&module);
    same_layout::<VortexBlock>(&module);
    same_layout::<StepBlock>(&module);
    same_layout::<SegmentConstants>(&module);
    same_layout::<LevelBlock>(&module);
}

#[test]
fn kernels_stay_within_eight_storage_buffers() {
    for kernel in KernelId::ALL {
        let kernel = &format!("kernels/{}", kernel.name());
        let (module, info) = parse(kernel);
        let storage = |space: &AddressSpace| matches!(space, AddressSpace::Storage { .. });
        let entry = info.get_entry_point(0);
        let count = module
            .global_variables
            .iter()
            .filter(|(handle, variable)| storage(&variable.space) && !entry[*handle].is_empty())
            .count();
        assert!((1..=8).contains(&count), "{kernel} uses {count} storage buffers; common devices allow 8");
    }
}

/// Function names of a source text, in order.
fn functions(text: &str) -> Vec<String> {
    text.lines()
        .take_while(|line| !line.starts_with("#[cfg(test)]"))
        .filter_map(|line| {
            line.trim_start().strip_prefix("pub fn ").or(line.trim_start().strip_prefix("fn "))
        })
        .filter_map(|rest| rest.split(['(', '<']).next())
        .map(str::to_owned)
        .collect()
}

fn wgsl_files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).expect("the shader folder exists").map(|entry| entry.expect("readable").path());
    entries.flat_map(|path| if path.is_dir() { wgsl_files(&path) } else { vec![path] }).collect()
}

/// Files without a twin: on the CPU what they declare are arguments.
const BINDINGS_ONLY: [&str; 4] = ["bindings.wgsl", "due.wgsl", "leaf/petioles.wgsl", "tree/bindings.wgsl"];

/// Every WGSL file names its Rust twin, the twin names it back, and their functions have the same names in the same
/// order (Rust may have more, for the host).
#[test]
fn twins_name_each_other_and_keep_their_order() {
    let shaders = root().join("backend-wgpu/src/shaders");
    let mut twins = 0;
    for path in wgsl_files(&shaders) {
        let relative = path.strip_prefix(&shaders).expect("inside").to_string_lossy().replace('\\', "/");
        if BINDINGS_ONLY.contains(&relative.as_str()) {
            let text = fs::read_to_string(&path).expect("readable");
            assert!(
                !text.contains("\nfn ") && text.contains("@binding"),
                "{relative} declares bindings only"
            );
            continue;
        }
        let wgsl = fs::read_to_string(&path).expect("readable");
        let line = wgsl.lines().find_map(|line| line.strip_prefix("// twin: "));
        let twin = line.unwrap_or_else(|| panic!("{relative} names no twin"));
        assert_eq!(Path::new(twin).file_stem(), path.file_stem(), "{relative} and its twin share their stem");
        let rust = fs::read_to_string(root().join(twin)).unwrap_or_else(|error| panic!("{twin}: {error}"));
        let back = format!("//! twin: backend-wgpu/src/shaders/{relative}");
        assert!(rust.lines().any(|line| line == back), "{twin} does not say '{back}'");
        if !relative.starts_with("kernels/") {
            let rust_functions = functions(&rust);
            let mut rest = rust_functions.iter();
            for name in &functions(&wgsl) {
                let found = rest.any(|other| name == other || name.ends_with(other.as_str()));
                assert!(
                    found,
                    "{relative}: '{name}' is not in {twin}, or not in this order: {rust_functions:?}"
                );
            }
        }
        twins += 1;
    }
    let modules = Shaders::default().names().filter(|name| *name != "prelude").count();
    assert_eq!(twins + BINDINGS_ONLY.len(), modules, "every module is a file, and every file a module");
}

/// Functions and operators that drivers round as they like must not appear on the state path.
#[test]
fn the_state_path_uses_only_exact_operations() {
    let banned = [
        "fma(",
        "mix(",
        "dot(",
        "normalize(",
        "length(",
        "distance(",
        "sqrt(",
        "inverseSqrt(",
        "pow(",
        "exp(",
        "exp2(",
        "log(",
        "log2(",
        "sin(",
        "cos(",
        "tan(",
        "atan2(",
        "smoothstep(",
        "fract(",
        "round(",
        "mat3x3",
        "mat4x4",
    ];
    for path in wgsl_files(&root().join("backend-wgpu/src/shaders")) {
        let text = fs::read_to_string(&path).expect("readable");
        for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"))
        {
            for word in banned {
                let at = line.find(word).filter(|&at| {
                    !line[..at]
                        .chars()
                        .next_back()
                        .is_some_and(|before| before.is_alphanumeric() || before == '_')
                });
                assert!(at.is_none(), "{}:{}: '{word}' in '{line}'", path.display(), index + 1);
            }
        }
    }
}
