// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Species for the shaders: sizes, the texture arrays of leaf pictures and surfaces, and meshes.

use bytemuck::Zeroable;
use half::f16;
use image::RgbaImage;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use windfall_core::blocks::BurnBlock;
use windfall_core::device::leaf::burn::burnt_share;
use windfall_core::flight::mass::MassDistribution;
use windfall_core::layout::Uint4;
use windfall_core::scene::{LeafShape, MAX_SPECIES, Species};
use windfall_core::{Scene, shared_struct};
use windfall_texgen::{Atlas, BurnMap, Layer};

use super::meshes::{LEVELS, LeafMeshes, STAGES, two_shares};
use crate::error::RenderError;
use crate::gpu::pipeline::{FILTERABLE, buffer_entry, sampler_entry, texture_entry, uniform_entry};
use crate::gpu::upload;

/// Most leaf pictures: what the uniform block of the species holds.
pub const MAX_LAYERS: usize = 512;
/// Stages that the greenest leaf has dried, and the brownest has besides.
const DRY_STAGES: [f32; 2] = [0.5, 2.7];

shared_struct! {
    /// A species, as it is drawn.
    pub struct SpeciesRow {
        /// Diameter of the disc with the blade's area, in metres.
        pub diameter_m: f32,
        /// Middle of the area from the centre of mass along x, in diameters.
        pub offset_x: f32,
        /// The same along z.
        pub offset_z: f32,
        /// Share of a dry leaf's folds that it has.
        pub(crate) folds: f32,
    }
}

shared_struct! {
    /// A leaf picture.
    pub(crate) struct LayerRow {
        /// Edge of its square relative to the disc's diameter.
        edge: f32,
        /// Stage of drying, 0 fresh to 5; negative for what does not dry.
        dryness: f32,
        /// Seconds that a front takes for each metre of the picture's edge, and the length of its way in edges, as halves; zeros where leaves
        /// do not burn.
        burning: u32,
        /// The variant that has this layer's place in the order from green to brown.
        variant: u32,
    }
}

shared_struct! {
    /// Species and their leaf pictures, for shaders.
    pub(crate) struct SpeciesUniform, padding 4 {
        species: [SpeciesRow; MAX_SPECIES],
        layers: [LayerRow; MAX_LAYERS],
        /// Of each layer, lowest and highest corner at each of six stages, as signed halves of two sides; two words are unused.
        heights: [Uint4; 2 * MAX_LAYERS],
        /// Longest strips of the levels of detail.
        strips: [u32; LEVELS],
        /// Variants of a species.
        variants: u32,
        /// Number of layers.
        layer_count: u32,
        /// Number of species: behind them come the stages of those that burn.
        species_count: u32,
    }
}

/// Bind group of the species, shared by the leaf and the shadow passes; the culling takes only the uniform block.
#[derive(Debug)]
pub(crate) struct SpeciesTable {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
    pub(crate) uniform: wgpu::Buffer,
    /// True if leaves of some species burn.
    pub(crate) leaves_burn: bool,
}

impl SpeciesTable {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        atlas: &Atlas,
        burns: &[BurnBlock],
    ) -> Result<Self, RenderError> {
        check(scene, atlas, device.limits().max_texture_array_layers)?;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("leaf species_table"),
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
        let maps = burn_maps(atlas, burns);
        let array = |label, format, pictures: Vec<&[RgbaImage]>| {
            let layers: Vec<Vec<&[u8]>> = pictures.into_iter().map(bytes_of).collect();
            upload::texture_array(device, queue, label, format, atlas.size_px, &layers)
        };
        let images = atlas.layers.iter().map(|layer| layer.mips.as_slice()).collect();
        let view = array("leaf images", wgpu::TextureFormat::Rgba8UnormSrgb, images);
        let pairs = atlas.layers.iter().zip(&maps);
        let surfaces = pairs
            .map(|(layer, map)| map.as_ref().map_or(layer.surface.as_slice(), |map| &map.surface))
            .collect();
        let surfaces = array("leaf surfaces", wgpu::TextureFormat::Rgba8Unorm, surfaces);
        let forms = LeafMeshes::new(atlas);
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
            "leaf species_table",
            wgpu::BufferUsages::UNIFORM,
            bytemuck::bytes_of(&table(scene, atlas, &forms, (burns, &maps))),
        );
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf species_table"),
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
        let leaves_burn = maps.iter().any(Option::is_some);
        Ok(Self { layout, group, uniform, leaves_burn })
    }
}

/// Bytes of every level of a picture.
fn bytes_of(mips: &[RgbaImage]) -> Vec<&[u8]> {
    mips.iter().map(|mip| mip.as_raw().as_slice()).collect()
}

/// Arrivals of fronts on the pictures of species that burn.
fn burn_maps(atlas: &Atlas, burns: &[BurnBlock]) -> Vec<Option<BurnMap>> {
    let variants = (atlas.variants as usize).max(1);
    let map = |(number, layer): (usize, &Layer)| {
        let burns = burns.get(number / variants).is_some_and(|burn| burn.steps > 0.0);
        burns.then(|| BurnMap::new(layer, number as u64, burnt_share))
    };
    atlas.layers.par_iter().enumerate().map(map).collect()
}

fn table(
    scene: &Scene,
    atlas: &Atlas,
    forms: &LeafMeshes,
    (burns, maps): (&[BurnBlock], &[Option<BurnMap>]),
) -> SpeciesUniform {
    let mut table = SpeciesUniform {
        strips: forms.longest,
        variants: atlas.variants,
        layer_count: u32::try_from(atlas.layers.len()).unwrap_or(u32::MAX),
        species_count: u32::try_from(scene.species.len()).unwrap_or(u32::MAX),
        ..SpeciesUniform::zeroed()
    };
    for (row, species) in table.species.iter_mut().zip(&scene.species) {
        *row = SpeciesRow::of(species);
    }
    for (row, layer) in table.layers.iter_mut().zip(&atlas.layers) {
        // pi / 4 d^2 = area fraction * edge^2
        row.edge = (std::f32::consts::FRAC_PI_4 / layer.area_fraction).sqrt();
        row.dryness = dryness(layer);
    }
    for (rows, heights) in table.heights.chunks_mut(2).zip(&forms.heights) {
        let words = rows.iter_mut().flat_map(|row| &mut row.0);
        for (word, [low, high]) in words.zip(heights) {
            *word = two_shares(*low, *high);
        }
    }
    let variants = (atlas.variants as usize).max(1);
    for (number, (row, map)) in table.layers.iter_mut().zip(maps).enumerate() {
        let species = number / variants;
        let Some((map, burn)) = map.as_ref().zip(burns.get(species)) else { continue };
        let edge_m = table.species[species].diameter_m * row.edge;
        row.burning = halves(burn.steps * scene.dt_s / edge_m, map.way);
    }
    for (rows, layers) in table.layers.chunks_mut(variants).zip(atlas.layers.chunks(variants)) {
        let mut order: Vec<(f32, u32)> =
            layers.iter().zip(0..).map(|(layer, variant)| (turned(layer), variant)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (row, (_, variant)) in rows.iter_mut().zip(order) {
            row.variant = variant;
        }
    }
    table
}

/// Two numbers as halves, the first in the low one.
fn halves(low: f32, high: f32) -> u32 {
    let [low, high] = [low, high].map(|number| u32::from(f16::from_f32(number).to_bits()));
    low | high << 16
}

impl SpeciesRow {
    /// Size of a species, where the middle of its area lies, and its folds.
    pub fn of(species: &Species) -> Self {
        let mass = MassDistribution::of(species).centre;
        #[expect(clippy::cast_possible_truncation, reason = "shares of a radius")]
        let offset = |share: f64| (-0.5 * share) as f32;
        let folds = match species.shape {
            LeafShape::Plate => 0.0,
            LeafShape::Samara => 0.2,
            LeafShape::Paper => 0.5,
            _ => 1.0,
        };
        Self { diameter_m: species.size_m, offset_x: offset(mass.x), offset_z: offset(mass.z), folds }
    }
}

/// Mean stage of drying of a leaf; -1 for what has no shapes of it.
pub fn dryness(layer: &Layer) -> f32 {
    let [fresh, more] = DRY_STAGES;
    let is_drying = layer.form.levels.iter().any(|level| !level.shapes.is_empty());
    let season = layer.season.unwrap_or(0.5);
    if is_drying { (fresh + more * season).min(STAGES as f32) } else { -1.0 }
}

/// Autumn colouring of a leaf: green is below 0, yellow about 0.1, red and brown above.
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
    use windfall_core::scene::{Aerodynamics, FlightModel};

    use super::*;
    use crate::tests::disc_atlas;

    #[test]
    fn blade_has_the_area_the_species_says() {
        let scene = Scene::default();
        let atlas = disc_atlas(&scene, 16);
        let table = table(&scene, &atlas, &LeafMeshes::new(&atlas), (&[], &[]));
        let edge_m = table.species[0].diameter_m * table.layers[1].edge;
        let area = atlas.layers[1].area_fraction * edge_m * edge_m;
        let disc = std::f32::consts::FRAC_PI_4 * scene.species[0].size_m.powi(2);
        assert!((area / disc - 1.0).abs() < 1.0e-5, "blade {area} m2, disc {disc} m2");
    }

    #[test]
    fn a_body_is_drawn_about_its_centre_of_mass() {
        let row = |[diameter_m, offset_x, offset_z, folds]: [f32; 4]| SpeciesRow {
            diameter_m,
            offset_x,
            offset_z,
            folds,
        };
        let planform = Some(LeafShape::Maple.planform());
        let body = Aerodynamics { planform, mass_offset: (0.6, -0.2), ..Aerodynamics::default() };
        let species = Species { flight: FlightModel::Aerodynamic(body), ..Species::default() };
        assert_eq!(
            SpeciesRow::of(&species),
            row([species.size_m, 0.1, -0.3, 1.0]),
            "its middle lies behind, half of it a diameter"
        );
        assert_eq!(
            SpeciesRow::of(&Species::default()),
            row([0.08, 0.0, 0.0, 1.0]),
            "other leaves are drawn about their middle"
        );
        let maple = Species::preset("maple").expect("a preset");
        let ahead = SpeciesRow::of(&maple).offset_z;
        assert!((0.09..0.12).contains(&ahead), "its petiole leaves the blade ahead: {ahead}");
        let plate = Species { shape: LeafShape::Plate, ..Species::default() };
        assert_eq!(SpeciesRow::of(&plate).folds.to_bits(), 0, "a plate is flat");
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
