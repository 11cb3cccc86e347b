// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Agreement of Rust and WGSL, checked without a GPU: layouts, twins, and the rules that make bits equal. One file, because all of
//! these read the same two trees of sources in the same way.

use std::fs;
use std::path::{Path, PathBuf};

use naga::{AddressSpace, TypeInner};
use windfall_core::blocks::{
    BirthBlock, ConesBlock, JetBlock, LitterBlock, MomentBlock, MoverBlock, NestBlock, PlumeBend, PlumeBlock,
    PopulationBlock, ResponseBlock, SceneBlock, ShelterBlock, SolidsBlock, SourceBlock, SpeciesBlock,
    SpreadBlock, StepBlock, SwayBlock, VortexBlock, VortexNode, WindBlock,
};
use windfall_core::flight::block::BodyBlock;
use windfall_core::layout::WgslStruct;
use windfall_core::leaf::{Attitude, Drift, Identity, Petiole, Place, Schedule};
use windfall_core::particle::{
    CarrierRun, HistoryRun, HistorySample, ParticleMotion, ParticlePlace, ParticleRun, ParticleStart,
    ParticleTraits,
};
use windfall_core::tree::record::{CarryBlock, LevelBlock, SegmentConstants};
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

/// No shader text is generated from scenes, and layouts are stated once (bevy_hanabi#440, #478, #479: faults of generated code).
#[test]
fn every_module_is_valid_and_every_struct_has_one_layout() {
    let shaders = Shaders::default();
    for name in shaders.names() {
        parse(name);
    }
    let (module, _) = parse("bindings");
    same_layout::<SpeciesBlock>(&module);
    same_layout::<SourceBlock>(&module);
    same_layout::<ShelterBlock>(&module);
    same_layout::<WindBlock>(&module);
    same_layout::<SwayBlock>(&module);
    same_layout::<ResponseBlock>(&module);
    same_layout::<ConesBlock>(&module);
    same_layout::<BodyBlock>(&module);
    same_layout::<SceneBlock>(&module);
    same_layout::<VortexBlock>(&module);
    same_layout::<VortexNode>(&module);
    same_layout::<JetBlock>(&module);
    same_layout::<PlumeBend>(&module);
    same_layout::<PlumeBlock>(&module);
    same_layout::<MomentBlock>(&module);
    same_layout::<StepBlock>(&module);
    same_layout::<LitterBlock>(&module);
    same_layout::<SolidsBlock>(&module);
    same_layout::<MoverBlock>(&module);
    same_layout::<SegmentConstants>(&module);
    same_layout::<LevelBlock>(&module);
    same_layout::<CarryBlock>(&module);
    same_layout::<Petiole>(&module);
    same_layout::<SpreadBlock>(&module);
    same_layout::<NestBlock>(&module);
    same_layout::<PopulationBlock>(&module);
    same_layout::<BirthBlock>(&module);
    same_layout::<ParticlePlace>(&module);
    same_layout::<ParticleMotion>(&module);
    same_layout::<ParticleTraits>(&module);
    same_layout::<ParticleRun>(&module);
    same_layout::<CarrierRun>(&module);
    same_layout::<HistorySample>(&module);
    same_layout::<HistoryRun>(&module);
    same_layout::<ParticleStart>(&module);
    same_layout::<Place>(&module);
    same_layout::<Drift>(&module);
    same_layout::<Attitude>(&module);
    same_layout::<Schedule>(&module);
    same_layout::<Identity>(&module);
}

/// Functions that read a list of words which stands in a uniform block four to a vector.
const LIST_READERS: [&str; 5] =
    ["source_share", "species_rate", "transition_count", "response_of", "cone_of"];

/// Members that are vectors of four with axes.
const QUATERNIONS: [&str; 3] = ["quaternion", "rest_quaternion", "turn"];

/// Returns true if an expression reads a lane of a vector without axes: of a vector of two or four that is a member of a
/// struct in a buffer, but for quaternions. Vectors of three have axes, and rows of a table have no members.
fn reads_a_lane(
    module: &naga::Module,
    function: &naga::Function,
    at: naga::Handle<naga::Expression>,
) -> bool {
    use naga::Expression::{Access, AccessIndex, GlobalVariable, Load, Swizzle};
    let (Access { base: vector, .. } | AccessIndex { base: vector, .. } | Swizzle { vector, .. }) =
        function.expressions[at]
    else {
        return false;
    };
    // From the global variable down to the vector: an index of a member or an element for each level.
    let mut path = Vec::new();
    let mut from = vector;
    let global = loop {
        match function.expressions[from] {
            Load { pointer } => from = pointer,
            AccessIndex { base, index } => {
                path.push(index as usize);
                from = base;
            }
            Access { base, .. } => {
                path.push(0);
                from = base;
            }
            GlobalVariable(global) => break &module.global_variables[global],
            _ => return false,
        }
    };
    let is_buffer = matches!(global.space, AddressSpace::Uniform | AddressSpace::Storage { .. });
    let (mut ty, mut member) = (global.ty, None);
    for index in path.into_iter().rev() {
        ty = match &module.types[ty].inner {
            TypeInner::Struct { members, .. } => {
                member = members[index].name.as_deref();
                members[index].ty
            }
            TypeInner::Array { base, .. } => *base,
            _ => return false,
        };
    }
    let is_flat = matches!(
        module.types[ty].inner,
        TypeInner::Vector { size: naga::VectorSize::Bi | naga::VectorSize::Quad, .. }
    );
    is_buffer && is_flat && member.is_some_and(|member| !QUATERNIONS.contains(&member))
}

/// Names of the functions of a module that read such a lane.
fn lane_readers(module: &naga::Module) -> Vec<String> {
    let functions = module.functions.iter().map(|(_, function)| function);
    let all = functions.chain(module.entry_points.iter().map(|entry| &entry.function));
    all.filter(|function| function.expressions.iter().any(|(at, _)| reads_a_lane(module, function, at)))
        .map(|function| function.name.clone().unwrap_or_default())
        .filter(|name| !LIST_READERS.contains(&name.as_str()))
        .collect()
}

/// Numbers in uniform blocks and records have names.
#[test]
fn shaders_read_no_lanes_of_blocks_and_records() {
    for name in Shaders::default().names() {
        let (module, _) = parse(name);
        assert_eq!(lane_readers(&module), [""; 0], "{name}");
    }
    // A lane read that is put in is found, also behind a name of its own.
    let planted = [
        ("leaf/release", "scene.species[species].rates[0]", "rates.x"),
        ("leaf/release", "scene.seed", "rates.y"),
        ("leaf/advance", "attitudes[leaf].quaternion", "u32(rates.x)"),
    ];
    for (module, read, lane) in planted {
        let text = Shaders::default().compose(module).expect("it composes");
        let text = format!(
            "{text}\nfn planted(species: u32, leaf: u32) -> u32 {{\n    let rates = {read};\n    return {lane};\n}}\n"
        );
        let module =
            naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        let expected: &[&str] = if read.ends_with("quaternion") { &[] } else { &["planted"] };
        assert_eq!(lane_readers(&module), expected, "{read}");
    }
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).expect("the folder exists").map(|entry| entry.expect("readable").path());
    let files = entries.flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

/// Fields that are tables by number, in newtypes or as vectors of four of a list in a uniform block.
const NUMBERED: [&str; 6] = ["self", "lanes", "rates", "shares", "transitions", "tables"];

/// Returns true if a line of Rust indexes the inner array of a value that is none of [`NUMBERED`].
fn indexes_a_vector(line: &str) -> bool {
    line.match_indices(".0[").any(|(at, _)| {
        let mut receiver = &line[..at];
        while let Some((before, _)) = receiver.strip_suffix(']').and_then(|inside| inside.rsplit_once('[')) {
            receiver = before;
        }
        let name = receiver.rsplit(|character: char| !character.is_alphanumeric() && character != '_').next();
        !NUMBERED.contains(&name.unwrap_or_default())
    })
}

/// Constants of places within the words of records.
fn packing_constants() -> Vec<&'static str> {
    use windfall_core::device::leaf::{petiole, record};
    let constants = record::wgsl_constants().into_iter().chain(petiole::wgsl_constants());
    constants
        .map(|(name, _)| name)
        .filter(|name| name.ends_with("_SHIFT") || name.ends_with("_MASK") && *name != "HALF_MASK")
        .collect()
}

/// Words of records that hold integers of one state and floats of another.
const REUSED: [&str; 3] = [".phase", ".rate", ".heading"];

/// Fault of a line that packs or unpacks a word of a leaf's records by hand, if it does.
fn unpacks_by_hand(line: &str) -> Option<String> {
    let is_word = |found: &str| {
        line.match_indices(found).any(|(at, _)| {
            let is_part = |character: char| character.is_alphanumeric() || character == '_';
            !line[..at].ends_with(is_part) && !line[at + found.len()..].starts_with(is_part)
        })
    };
    let constant = packing_constants().into_iter().find(|constant| is_word(constant));
    let casts = line.contains("bitcast<") || line.contains("to_bits") || line.contains("from_bits");
    let word = REUSED.into_iter().find(|word| casts && line.contains(word));
    constant.or(word).map(|found| format!("{found} in '{}'", line.trim()))
}

/// Words of blocks and records are read by name, in both languages: no lanes of vectors, and no shifts, masks and casts
/// outside the accessors.
#[test]
fn words_are_read_by_name() {
    let folders = ["core/src", "backend-cpu/src", "backend-wgpu/src"].map(|folder| root().join(folder));
    let shaders = wgsl_files(&root().join("backend-wgpu/src/shaders"));
    let rust: Vec<PathBuf> = folders.iter().flat_map(|folder| rust_files(folder)).collect();
    let mut faults = Vec::new();
    let is_test = |path: &Path| {
        let inside = path.strip_prefix(root()).expect("a file of the workspace");
        inside.iter().any(|part| part == "tests" || part == "tests.rs")
    };
    for path in rust.iter().chain(&shaders).filter(|path| !is_test(path)) {
        let text = fs::read_to_string(path).expect("readable");
        let is_accessor = path.file_stem().is_some_and(|stem| stem == "record" || stem == "petiole");
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            if indexes_a_vector(line) {
                faults.push(format!("{}: '{}'", path.display(), line.trim()));
            }
            faults.extend(unpacks_by_hand(line).filter(|_| !is_accessor));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    let count = |files: &[PathBuf]| files.iter().filter(|path| !is_test(path)).count();
    assert!(count(&rust) > 100 && count(&shaders) > 40, "both languages were read");
    // Lines that must be found, and lines that may stand.
    for line in ["cx.scene.seed.0[2]", "x = block.sources[0].timing.0[3];", "(a.0)[0] + b.0[1]"] {
        assert!(indexes_a_vector(line), "{line}");
    }
    for line in ["species.rates[(p >> 2) as usize].0[1]", "self.0[from as usize]", "place.position[1]"] {
        assert!(!indexes_a_vector(line), "{line}");
    }
    let by_hand = [
        "let state = place.bits & STATE_MASK;",
        "leaf.drift.phase = spin.x.to_bits();",
        "let spin = bitcast<f32>(drifts[leaf].phase);",
        "(bits >> SPECIES_SHIFT) & 31u",
        "petiole.bits >> PETIOLE_KIND_SHIFT",
    ];
    assert!(by_hand.iter().all(|line| unpacks_by_hand(line).is_some()), "found in every line");
    for line in ["let up = place.position.y;", "PETIOLE_SPECIES_MASKS", "x.to_bits()", "drift.phase + 1"] {
        assert_eq!(unpacks_by_hand(line), None, "{line}");
    }
}

/// Common devices, and browsers, allow eight storage buffers. Tables and all six columns of leaves are seven of them, and
/// `resolve_events` has a list on top; `advance` has two lists, but no identities. Particles have three columns, and as many buffers of what
/// others do to them, besides tables and counts.
#[test]
fn kernels_make_do_with_eight_storage_buffers() {
    for kernel in KernelId::ALL {
        let share = match kernel {
            KernelId::ResolveEvents | KernelId::Advance | KernelId::Carry | KernelId::StepParticles => 8,
            KernelId::Fly | KernelId::BurnLeaves => 7,
            _ => 6,
        };
        let kernel = &format!("kernels/{}", kernel.name());
        let (module, info) = parse(kernel);
        let storage = |space: &AddressSpace| matches!(space, AddressSpace::Storage { .. });
        let entry = info.get_entry_point(0);
        let count = module
            .global_variables
            .iter()
            .filter(|(handle, variable)| storage(&variable.space) && !entry[*handle].is_empty())
            .count();
        assert!((1..=share).contains(&count), "{kernel} uses {count} storage buffers; its share is {share}");
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
const BINDINGS_ONLY: [&str; 10] = [
    "bindings.wgsl",
    "leaf/burn_bindings.wgsl",
    "leaf/carrier_bindings.wgsl",
    "particle/bindings.wgsl",
    "particle/flake_bindings.wgsl",
    "particle/force_carrier_bindings.wgsl",
    "particle/history_bindings.wgsl",
    "particle/mutual_bindings.wgsl",
    "particle/on_leaf_bindings.wgsl",
    "tree/bindings.wgsl",
];
/// Files of lists, which only a GPU has: the CPU notes which units of slots are idle as it steps them.
const GPU_ONLY: [&str; 7] = [
    "kernels/list_active.wgsl",
    "lists/active.wgsl",
    "lists/append_active.wgsl",
    "lists/events.wgsl",
    "lists/fill_active.wgsl",
    "lists/fill_events.wgsl",
    "lists/turns.wgsl",
];

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
        if GPU_ONLY.contains(&relative.as_str()) {
            continue;
        }
        let wgsl = fs::read_to_string(&path).expect("readable");
        let line = wgsl.lines().find_map(|line| line.strip_prefix("// twin: "));
        let twin = line.unwrap_or_else(|| panic!("{relative} names no twin"));
        let beside = relative.replace(".wgsl", ".rs");
        let expected = match relative.starts_with("kernels/") {
            true => format!("backend-cpu/src/{beside}"),
            false => format!("core/src/device/{beside}"),
        };
        assert_eq!(twin, expected, "both trees are laid out alike");
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
    assert_eq!(
        twins + BINDINGS_ONLY.len() + GPU_ONLY.len(),
        modules,
        "every module is a file, and every file a module"
    );
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
            // Drivers take it for a negation, which has another sign of zero.
            assert!(
                !line.contains("(0.0 - ") && !line.contains(" 0.0 - "),
                "{}:{}: '{line}'",
                path.display(),
                index + 1
            );
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
