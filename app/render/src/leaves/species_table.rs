// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the shaders know of the species: sizes, the texture arrays of leaf pictures and surfaces, and meshes.

use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::scene::{FlightModel, LeafShape, MAX_SPECIES, Species};
use windfall_texgen::{Atlas, Layer};

use super::meshes::{LEVELS, LeafForms, STAGES, two_shares};
use crate::error::RenderError;
use crate::gpu::pipeline::{FILTERABLE, buffer_entry, sampler_entry, texture_entry, uniform_entry};
use crate::gpu::upload;

/// Most leaf pictures: what the uniform block of the species holds.
pub const MAX_LAYERS: usize = 512;
/// Stages that the greenest leaf has dried, and the brownest has besides.
const DRY_STAGES: [f32; 2] = [0.5, 2.7];

/// `Kinds` of `leaf_kinds.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Kinds {
    size: [[f32; 4]; MAX_SPECIES],
    layer: [[f32; 4]; MAX_LAYERS],
    heights: [[u32; 8]; MAX_LAYERS],
    counts: [u32; 4],
    strips: [u32; LEVELS],
}

/// Bind group of the species, shared by the leaf and the shadow passes; the culling takes only the uniform block.
#[derive(Debug)]
pub(crate) struct LeafKinds {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
    pub(crate) uniform: wgpu::Buffer,
}

impl LeafKinds {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        atlas: &Atlas,
    ) -> Result<Self, RenderError> {
        check(scene, atlas, device.limits().max_texture_array_layers)?;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("leaf kinds"),
            entries: &[
                uniform_entry(0),
                texture_entry(1, FILTERABLE, wgpu::TextureViewDimension::D2Array),
                sampler_entry(2, wgpu::SamplerBindingType::Filtering),
                texture_entry(3, FILTERABLE, wgpu::TextureViewDimension::D2Array),
                buffer_entry(4, read, wgpu::ShaderStages::VERTEX),
                buffer_entry(5, read, wgpu::ShaderStages::VERTEX),
                buffer_entry(6, read, wgpu::ShaderStages::VERTEX),
            ],
        });
        let array = |label, format, mips: fn(&Layer) -> &Vec<RgbaImage>| {
            let bytes = |layer| mips(layer).iter().map(|mip| mip.as_raw().as_slice()).collect();
            let layers: Vec<Vec<&[u8]>> = atlas.layers.iter().map(bytes).collect();
            upload::texture_array(device, queue, label, format, atlas.size_px, &layers)
        };
        let view = array("leaf images", wgpu::TextureFormat::Rgba8UnormSrgb, |layer| &layer.mips);
        let surfaces = array("leaf surfaces", wgpu::TextureFormat::Rgba8Unorm, |layer| &layer.surface);
        let forms = LeafForms::new(atlas);
        let storage =
            |label, bytes: &[u8]| upload::buffer(device, queue, label, wgpu::BufferUsages::STORAGE, bytes);
        let corners = storage("leaf corners", bytemuck::cast_slice(&forms.corners));
        let strips = storage("leaf strips", bytemuck::cast_slice(&forms.strips));
        let meshes = storage("leaf meshes", bytemuck::cast_slice(&forms.meshes));
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let uniform = upload::buffer(
            device,
            queue,
            "leaf kinds",
            wgpu::BufferUsages::UNIFORM,
            bytemuck::bytes_of(&kinds(scene, atlas, &forms)),
        );
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf kinds"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&sampler) },
                wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::TextureView(&surfaces) },
                wgpu::BindGroupEntry { binding: 4, resource: corners.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 5, resource: strips.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 6, resource: meshes.as_entire_binding() },
            ],
        });
        Ok(Self { layout, group, uniform })
    }
}

fn kinds(scene: &Scene, atlas: &Atlas, forms: &LeafForms) -> Kinds {
    let mut kinds = Kinds {
        size: [[0.0; 4]; MAX_SPECIES],
        layer: [[0.0; 4]; MAX_LAYERS],
        heights: [[0; 8]; MAX_LAYERS],
        strips: forms.longest,
        counts: [atlas.variants, u32::try_from(atlas.layers.len()).unwrap_or(u32::MAX), 0, 0],
    };
    for (slot, species) in kinds.size.iter_mut().zip(&scene.species) {
        *slot = build(species);
    }
    for (slot, layer) in kinds.layer.iter_mut().zip(&atlas.layers) {
        // pi / 4 d^2 = area fraction * edge^2
        let edge = (std::f32::consts::FRAC_PI_4 / layer.area_fraction).sqrt();
        *slot = [edge, dryness(layer), 0.0, 0.0];
    }
    for (slot, heights) in kinds.heights.iter_mut().zip(&forms.heights) {
        for (word, [low, high]) in slot.iter_mut().zip(heights) {
            *word = two_shares(*low, *high);
        }
    }
    let variants = (atlas.variants as usize).max(1);
    for (slots, layers) in kinds.layer.chunks_mut(variants).zip(atlas.layers.chunks(variants)) {
        let mut order: Vec<(f32, f32)> =
            layers.iter().zip(0u8..).map(|(layer, variant)| (turned(layer), f32::from(variant))).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (slot, (_, variant)) in slots.iter_mut().zip(order) {
            slot[3] = variant;
        }
    }
    kinds
}

/// Size of a species; of a body, where the middle of its area lies from its centre of mass, in diameters; and how much
/// of a dry leaf's folds it has.
pub fn build(species: &Species) -> [f32; 4] {
    let (ahead, right) = match species.flight {
        FlightModel::Synthesis => (0.0, 0.0),
        FlightModel::Aerodynamic(body) => body.mass_offset,
    };
    let folds = match species.shape {
        LeafShape::Plate => 0.0,
        LeafShape::Samara => 0.2,
        LeafShape::Paper => 0.5,
        _ => 1.0,
    };
    [species.size_m, -0.5 * right, -0.5 * ahead, folds]
}

/// Mean stage of drying of a leaf; -1 for what has no shapes of it.
pub fn dryness(layer: &Layer) -> f32 {
    let [fresh, more] = DRY_STAGES;
    let is_drying = layer.form.levels.iter().any(|level| !level.shapes.is_empty());
    let season = layer.season.unwrap_or(0.5);
    if is_drying { (fresh + more * season).min(STAGES as f32) } else { -1.0 }
}

/// How far a leaf has turned, from its colour: green is below 0, yellow about 0.1, red and brown above.
pub fn turned(layer: &Layer) -> f32 {
    let Some(mip) = layer.mips.first() else { return 0.0 };
    let leaf = mip.pixels().filter(|pixel| pixel.0[3] > 127);
    let sum = leaf.fold([0.0f32; 3], |sum, pixel| std::array::from_fn(|c| sum[c] + f32::from(pixel.0[c])));
    (sum[0] - sum[1]) / (sum[0] + sum[1] + sum[2]).max(1.0)
}

/// Checks that the pictures cover the scene's species and fit the device.
fn check(scene: &Scene, atlas: &Atlas, layer_limit: u32) -> Result<(), RenderError> {
    let wanted = scene.species.len() * atlas.variants as usize;
    let layers = atlas.layers.len();
    if wanted == 0 || layers != wanted {
        let species = scene.species.len();
        let variants = atlas.variants;
        return Err(RenderError::Images(format!("{layers} for {species} species of {variants} variants")));
    }
    let limit = layer_limit.min(u32::try_from(MAX_LAYERS).unwrap_or(u32::MAX));
    if layers > limit as usize {
        return Err(RenderError::Layers { layers, limit });
    }
    let covered = |fraction: f32| fraction > 0.0 && fraction <= 1.0;
    if let Some(empty) = atlas.layers.iter().position(|layer| !covered(layer.area_fraction)) {
        return Err(RenderError::Images(format!("picture {empty} shows no leaf")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::Aerodynamics;

    use super::*;
    use crate::tests::disc_atlas;

    #[test]
    fn blade_has_the_area_the_species_says() {
        let scene = Scene::default();
        let atlas = disc_atlas(&scene, 16);
        let kinds = kinds(&scene, &atlas, &LeafForms::new(&atlas));
        let edge_m = kinds.size[0][0] * kinds.layer[1][0];
        let area = atlas.layers[1].area_fraction * edge_m * edge_m;
        let disc = std::f32::consts::FRAC_PI_4 * scene.species[0].size_m.powi(2);
        assert!((area / disc - 1.0).abs() < 1.0e-5, "blade {area} m2, disc {disc} m2");
    }

    #[test]
    fn a_body_is_drawn_about_its_centre_of_mass() {
        let body = Aerodynamics { mass_offset: (0.6, -0.2), ..Aerodynamics::default() };
        let species = Species { flight: FlightModel::Aerodynamic(body), ..Species::default() };
        assert_eq!(
            build(&species),
            [species.size_m, 0.1, -0.3, 1.0],
            "its middle lies behind, half of it a diameter"
        );
        assert_eq!(
            build(&Species::default()),
            [0.08, 0.0, 0.0, 1.0],
            "other leaves are drawn about their middle"
        );
        let plate = Species { shape: LeafShape::Plate, ..Species::default() };
        assert_eq!(build(&plate)[3].to_bits(), 0, "a plate is flat");
    }

    #[test]
    fn atlas_must_fit_scene_and_device() {
        let mut scene = Scene::default();
        let atlas = disc_atlas(&scene, 16);
        assert!(check(&scene, &atlas, 256).is_ok(), "its own atlas fits");
        assert!(
            matches!(check(&scene, &atlas, 1), Err(RenderError::Layers { limit: 1, .. })),
            "one layer only"
        );
        scene.species.push(Species::default());
        assert!(
            matches!(check(&scene, &atlas, 256), Err(RenderError::Images(_))),
            "a species without leaves"
        );
    }
}
