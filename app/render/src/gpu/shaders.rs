// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shader modules of the rooms, composed by the simulator's `#import`: every room has its own and those of the rooms below.

pub(crate) use windfall_wgpu::Shaders;
use windfall_wgpu::{leaf_wgsl, particle_wgsl};

use super::shader_edit;

/// Name and text of shader modules: the WGSL files of a room, beside the file that says this.
macro_rules! wgsl_files {
    ($room:literal: $($name:literal),* $(,)?) => {
        [$((concat!($room, "/", $name), include_str!(concat!($name, ".wgsl")).to_owned())),*]
    };
}
pub(crate) use wgsl_files;

/// Declarations of lists of shared constants.
pub(crate) fn declarations<const N: usize>(lists: [Vec<(&'static str, String)>; N]) -> String {
    lists.into_iter().flatten().map(|(_, declaration)| declaration).collect()
}

/// Modules that bind nothing: numbers, and the records of leaves and particles with their accessors.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = Shaders::from_iter(wgsl_files!("gpu": "numbers"));
    shaders.extend([("leaf_records", leaf_wgsl()), ("particle_records", particle_wgsl())]);
    shaders
}

/// Compiles a module with everything that it imports.
///
/// # Panics
/// If a module imports one that is not there: the layout test composes all of them.
pub(crate) fn compile(device: &wgpu::Device, shaders: &Shaders, name: &str) -> wgpu::ShaderModule {
    let source = shaders.compose(name).unwrap_or_else(|error| panic!("{name}: {error}"));
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(shader_edit::edited(source).into()),
    })
}
