// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shaders of the renderer without a GPU: every module composes and is valid, every shared struct has one layout, and its
//! numbers are read by name.

use std::collections::BTreeSet;

use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Expression, Function, Handle, StructMember, Type, TypeInner, VectorSize};
use windfall_core::layout::WgslStruct;
use windfall_core::leaf::{Attitude, Burn, Drift, Identity, Place, Schedule};
use windfall_core::particle::{HistoryRun, HistorySample, ParticleMotion, ParticlePlace, ParticleTraits};

use crate::gpu::shaders::Shaders;
use crate::land::texture::LandUniform;
use crate::{frame, leaves, lens, marks, objects, park, particles, scenery, shadows, trees};

/// Modules of every room.
fn rooms() -> [Shaders; 10] {
    [
        frame::shaders(),
        lens::shaders(),
        trees::shaders(),
        objects::shaders(),
        leaves::shaders(),
        shadows::shaders(),
        scenery::shaders(),
        park::shaders(),
        particles::shaders(),
        marks::shaders(),
    ]
}

fn parse_text(name: &str, source: &str) -> (naga::Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    (module, info)
}

fn composed(shaders: &Shaders, name: &str) -> String {
    shaders.compose(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn parse(shaders: &Shaders, name: &str) -> naga::Module {
    parse_text(name, &composed(shaders, name)).0
}

/// The way in which the layout of `T` differs in a module; `None` if it is the same.
fn difference<T: WgslStruct>(module: &naga::Module) -> Option<String> {
    let name = T::name();
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(&name));
    let Some(TypeInner::Struct { members, span }) = found.map(|(_, ty)| &ty.inner) else {
        return Some(format!("no struct {name}"));
    };
    let wgsl: Vec<_> =
        members.iter().map(|member| (member.name.as_deref().unwrap_or(""), member.offset as usize)).collect();
    let fields = T::fields();
    let rust: Vec<_> = fields.iter().map(|(field, _, offset)| (*field, *offset)).collect();
    let is_same = rust == wgsl && *span as usize == size_of::<T>();
    (!is_same).then(|| format!("{name}: {rust:?}, {} bytes; in WGSL {wgsl:?}, {span}", size_of::<T>()))
}

fn assert_same<T: WgslStruct>(module: &naga::Module) {
    assert_eq!(difference::<T>(module), None, "one layout");
}

#[test]
fn every_module_is_valid() {
    let mut seen = 0;
    for shaders in rooms() {
        for name in shaders.names() {
            parse(&shaders, name);
            seen += 1;
        }
    }
    assert!(seen > 80, "{seen} modules");
}

#[test]
fn every_struct_has_one_layout() {
    let module = parse(&frame::shaders(), "frame/structs");
    assert_same::<frame::surroundings::FrameUniform>(&module);
    assert_same::<LandUniform>(&module);
    let module = parse(&objects::shaders(), "objects/structs");
    assert_same::<objects::records::ObjectRecord>(&module);
    assert_same::<objects::records::PastPose>(&module);
    assert_same::<lens::motion::MotionUniform>(&parse(&objects::shaders(), "lens/motion_structs"));
    assert_same::<trees::records::TreeRecord>(&parse(&trees::shaders(), "trees/structs"));
    let module = parse(&leaves::shaders(), "leaves/structs");
    assert_same::<leaves::species_table::SpeciesRow>(&module);
    assert_same::<leaves::species_table::LayerRow>(&module);
    assert_same::<leaves::species_table::SpeciesUniform>(&module);
    assert_same::<leaves::meshes::LeafMesh>(&module);
    assert_same::<leaves::record::LeafRecord>(&module);
    assert_same::<leaves::record::LeafDraw>(&module);
    assert_same::<leaves::record::PageUniform>(&module);
    assert_same::<leaves::record::ViewUniform>(&module);
    assert_same::<leaves::burning::BurningUniform>(&module);
    assert_same::<Burn>(&parse(&leaves::shaders(), "leaf_records"));
    let module = parse(&lens::shaders(), "lens/structs");
    assert_same::<lens::group::LensUniform>(&module);
    assert_same::<lens::group::Exposure>(&module);
    assert_same::<lens::focus_pass::FocusUniform>(&module);
    assert_same::<lens::shutter_pass::ShutterUniform>(&module);
    assert_same::<lens::glare_pass::GlareScale>(&module);
    let module = parse(&marks::shaders(), "marks/structs");
    assert_same::<marks::landing_count::LandingUniform>(&module);
    assert_same::<marks::paint_pass::PaintUniform>(&module);
    assert_same::<marks::paint_pass::PastMark>(&module);
    assert_same::<marks::trail_pass::TrailUniform>(&module);
    assert_same::<marks::trail_pass::TrailSample>(&module);
    let module = parse(&particles::shaders(), "particles/structs");
    assert_same::<particles::looks::PopulationLook>(&module);
    assert_same::<particles::looks::LookRow>(&module);
    assert_same::<particles::draw_list::ParticleUniform>(&module);
    assert_same::<particles::blobs::BlobLook>(&module);
    assert_same::<particles::blobs::Blob>(&module);
    assert_same::<particles::blobs::BlobCell>(&module);
    let module = parse(&particles::shaders(), "particle_records");
    assert_same::<ParticlePlace>(&module);
    assert_same::<ParticleMotion>(&module);
    assert_same::<ParticleTraits>(&module);
    assert_same::<HistorySample>(&module);
    assert_same::<HistoryRun>(&module);
    let module = parse(&leaves::shaders(), "leaf_records");
    assert_same::<Place>(&module);
    assert_same::<Drift>(&module);
    assert_same::<Attitude>(&module);
    assert_same::<Schedule>(&module);
    assert_same::<Identity>(&module);
}

/// Structs of shaders are declared in Rust, but for what passes from vertices to fragments and within a shader.
#[test]
fn uniforms_and_storage_have_generated_structs() {
    for shaders in rooms() {
        for name in shaders.names() {
            let text = shaders.text(name).expect("a module has a text");
            let is_generated = name.ends_with("/structs");
            let bound =
                text.lines().filter(|line| line.contains("var<uniform>") || line.contains("var<storage"));
            for line in bound {
                let declared = text.lines().filter_map(|line| line.strip_prefix("struct "));
                let own = declared.filter_map(|rest| rest.split([' ', '{']).next());
                let hand_written = own.into_iter().find(|own| line.contains(own));
                assert!(is_generated || hand_written.is_none(), "{name}: {line} binds {hand_written:?}");
            }
        }
    }
}

#[test]
fn another_layout_is_noticed() {
    let shaders = frame::shaders();
    let edit = |old, new| shaders.clone().edited("frame/structs", old, new).expect("the text is there");
    let swapped =
        edit("    cells_per_m: f32,\n    cells: u32,\n", "    cells: u32,\n    cells_per_m: f32,\n");
    let found = difference::<LandUniform>(&parse(&swapped, "frame/structs"));
    assert!(found.is_some(), "two members swapped");
    let longer = edit("    water_m: f32,\n", "    water_m: f32,\n    more: f32,\n");
    assert!(difference::<LandUniform>(&parse(&longer, "frame/structs")).is_some(), "one more member");
}

/// Members of structs in buffers that are vectors with axes: colours, planes, directions and sizes.
const WITH_AXES: [&str; 11] = [
    "ambient",
    "corner_m",
    "palette",
    "sides",
    "bend_way",
    "path_lead",
    "paved_half_m",
    "inv_size_px",
    "inv_viewport_px",
    "snow_cells",
    "snow_squares",
];

/// Members that are lists by number, four to a vector.
const LISTS: [&str; 5] = ["heights", "kernel", "moment_weights", "strips", "texels_m"];

/// Buffers that are rows of vectors: columns of the branches, whose rows are positions and quaternions.
const ROWS: [&str; 4] = ["branch_base", "branch_pose", "rest_base", "rest_pose"];

/// Returns true for vectors of two or four. Vectors of three have axes.
fn is_flat(inner: &TypeInner) -> bool {
    matches!(inner, TypeInner::Vector { size: VectorSize::Bi | VectorSize::Quad, .. })
}

fn buffers(module: &naga::Module) -> impl Iterator<Item = &naga::GlobalVariable> {
    let is_buffer = |space| matches!(space, AddressSpace::Uniform | AddressSpace::Storage { .. });
    module.global_variables.iter().map(|(_, variable)| variable).filter(move |buffer| is_buffer(buffer.space))
}

/// Structs that a module's buffers hold.
fn buffer_structs(module: &naga::Module) -> Vec<Handle<Type>> {
    let mut waiting: Vec<Handle<Type>> = buffers(module).map(|buffer| buffer.ty).collect();
    let mut structs = Vec::new();
    while let Some(ty) = waiting.pop() {
        match &module.types[ty].inner {
            TypeInner::Array { base, .. } => waiting.push(*base),
            TypeInner::Struct { members, .. } => {
                structs.push(ty);
                waiting.extend(members.iter().map(|member| member.ty));
            }
            _ => {}
        }
    }
    structs
}

/// Member of a struct in a buffer of whose lanes an expression reads one: of a vector of two or four, or of an array of
/// them.
fn lane_of<'a>(
    module: &'a naga::Module,
    (function, info): (&Function, &FunctionInfo),
    structs: &[Handle<Type>],
    at: Handle<Expression>,
) -> Option<&'a StructMember> {
    use Expression::{Access, AccessIndex, Load, Swizzle};
    let struct_at = |at: Handle<Expression>| {
        let ty = match info[at].ty.inner_with(&module.types) {
            TypeInner::Pointer { base, .. } => Some(*base),
            _ => info[at].ty.handle(),
        };
        ty.filter(|ty| structs.contains(ty))
    };
    // Down to the member, past the lane and the elements of an array.
    let (mut from, mut depth) = (at, 0);
    let member = loop {
        from = match function.expressions[from] {
            Load { pointer } => {
                from = pointer;
                continue;
            }
            AccessIndex { base, index } => match struct_at(base).map(|ty| &module.types[ty].inner) {
                Some(TypeInner::Struct { members, .. }) => break &members[index as usize],
                _ => base,
            },
            Access { base, .. } => base,
            Swizzle { vector, .. } => vector,
            _ => return None,
        };
        depth += 1;
    };
    let mut ty = &module.types[member.ty].inner;
    while let TypeInner::Array { base, .. } = ty {
        depth -= 1;
        ty = &module.types[*base].inner;
    }
    (is_flat(ty) && depth == 1).then_some(member)
}

/// Members of structs in buffers of which functions of a module read lanes, and buffers of vectors in place of structs.
fn nameless((module, info): &(naga::Module, ModuleInfo)) -> BTreeSet<String> {
    let structs = buffer_structs(module);
    let functions = module.functions.iter().map(|(handle, function)| (function, &info[handle]));
    let entries = (0..).zip(&module.entry_points);
    let entries = entries.map(|(index, entry)| (&entry.function, info.get_entry_point(index)));
    let lanes = functions.chain(entries).flat_map(|(function, info)| {
        let lanes = function.expressions.iter();
        lanes.filter_map(|(at, _)| lane_of(module, (function, info), &structs, at)).collect::<Vec<_>>()
    });
    let is_table = |buffer: &&naga::GlobalVariable| match module.types[buffer.ty].inner {
        TypeInner::Array { base, .. } => is_flat(&module.types[base].inner),
        _ => false,
    };
    let tables = buffers(module).filter(is_table).filter_map(|buffer| buffer.name.clone());
    lanes.filter_map(|member| member.name.clone()).chain(tables).collect()
}

/// Numbers in uniform blocks and records have names.
#[test]
fn shaders_read_no_lanes_of_blocks_and_records() {
    let mut found = BTreeSet::new();
    for shaders in rooms() {
        for name in shaders.names() {
            found.append(&mut nameless(&parse_text(name, &composed(&shaders, name))));
        }
    }
    let allowed = WITH_AXES.into_iter().chain(LISTS).chain(ROWS).map(str::to_owned).collect();
    assert_eq!(found, allowed, "lanes of these alone");
}

#[test]
fn a_number_without_a_name_is_noticed() {
    let planted = [
        ("fn planted() -> f32 { let size = motion.size_px; return size.y; }", "size_px"),
        ("fn planted(motion: MotionUniform) -> f32 { return motion.size_px[1]; }", "size_px"),
        ("fn planted() -> vec2<f32> { return frame.tile_scale.yx; }", "tile_scale"),
        ("fn planted(leaf: u32) -> f32 { return attitudes[leaf].quaternion.w; }", "quaternion"),
        ("@group(3) @binding(5) var<storage, read> drifts: array<vec4<u32>>;", "drifts"),
    ];
    let text = composed(&leaves::shaders(), "leaves/motion_pass");
    let before = nameless(&parse_text("as it is", &text));
    for (line, name) in planted {
        let found = nameless(&parse_text(line, &format!("{text}\n{line}\n")));
        assert_eq!(found.difference(&before).collect::<Vec<_>>(), [name], "{line}");
    }
}
