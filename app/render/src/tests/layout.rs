// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shaders of the renderer without a GPU: every module composes and is valid, and every shared struct has one layout.

use naga::TypeInner;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use windfall_core::layout::WgslStruct;

use crate::gpu::shaders::Shaders;
use crate::land::texture::LandUniform;
use crate::{frame, leaves, lens, marks, park, scenery, shadows, trees};

/// Modules of every room.
fn rooms() -> [Shaders; 8] {
    [
        frame::shaders(),
        lens::shaders(),
        trees::shaders(),
        leaves::shaders(),
        shadows::shaders(),
        scenery::shaders(),
        park::shaders(),
        marks::shaders(),
    ]
}

fn parse(shaders: &Shaders, name: &str) -> naga::Module {
    let source = shaders.compose(name).unwrap_or_else(|error| panic!("{name}: {error}"));
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
    Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
    module
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
    assert_same::<trees::records::TreeRecord>(&parse(&trees::shaders(), "trees/structs"));
    let module = parse(&leaves::shaders(), "leaves/structs");
    assert_same::<leaves::species_table::SpeciesRow>(&module);
    assert_same::<leaves::species_table::LayerRow>(&module);
    assert_same::<leaves::species_table::SpeciesUniform>(&module);
    assert_same::<leaves::record::LeafRecord>(&module);
    assert_same::<leaves::record::LeafDraw>(&module);
    assert_same::<leaves::record::PageUniform>(&module);
    assert_same::<leaves::record::ViewUniform>(&module);
    assert_same::<leaves::motion_pass::MotionUniform>(&module);
    let module = parse(&lens::shaders(), "lens/structs");
    assert_same::<lens::group::LensUniform>(&module);
    assert_same::<lens::group::Exposure>(&module);
    assert_same::<lens::focus_pass::FocusUniform>(&module);
    assert_same::<lens::shutter_pass::ShutterUniform>(&module);
    assert_same::<lens::glare_pass::GlareScale>(&module);
    let module = parse(&marks::shaders(), "marks/structs");
    assert_same::<marks::landing_count::LandingUniform>(&module);
    assert_same::<marks::paint_pass::PaintUniform>(&module);
    assert_same::<marks::trail_pass::TrailUniform>(&module);
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
