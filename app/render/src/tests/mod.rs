// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws small pictures on whatever Vulkan adapter there is. A machine without one fails these tests: Mesa's
//! software driver is enough. The bench that all of them draw with stands here, beside the pictures of a single leaf.

mod blades;
mod blobs;
mod burning;
mod closure;
mod cull;
mod flames;
mod halo;
mod layout;
mod lens;
mod look;
mod motion;
mod objects;
mod particles;
mod quality;
mod ribbons;
mod rooms;
mod snow;
mod sort;
mod trees;

use bytemuck::Pod;
use image::RgbaImage;
use windfall_core::device::leaf::record::STATE_FALLING;
use windfall_core::leaf::Burn;
use windfall_core::scene::{Exposure, Focus, Terrain};
use windfall_core::solid::solids_of;
use windfall_core::{CompiledScene, Scene};
use windfall_texgen::{Atlas, Layer};
use windfall_wgpu::{BedColumn, BranchColumns, Gpu, LeafColumns, ParticleColumns, WorldColumns};

use super::*;
use crate::camera::Camera;
use crate::gpu::upload;
use crate::trees::SceneTrees;

/// A width whose rows need padding on their way back.
pub(crate) const SIZE: (u32, u32) = (150, 90);

pub(crate) struct Bench {
    pub(crate) gpu: Gpu,
    pub(crate) scene: Scene,
    pub(crate) scene_trees: SceneTrees,
    pub(crate) renderer: Renderer,
}

pub(crate) fn bench(change: impl FnOnce(&mut Scene)) -> Bench {
    bench_with(|scene| {
        change(scene);
        SceneTrees::default()
    })
}

/// The best Vulkan adapter, with default limits.
pub(crate) fn gpu() -> Gpu {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends = wgpu::Backends::VULKAN;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
        .expect("a Vulkan adapter; apt install mesa-vulkan-drivers");
    let features = adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
    let descriptor = wgpu::DeviceDescriptor { required_features: features, ..Default::default() };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("a device");
    Gpu::from_parts(adapter.get_info(), device, queue)
}

/// An encoder of commands.
pub(crate) fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
}

/// Rows of a buffer after everything submitted.
pub(crate) fn read<T: Pod>(gpu: &Gpu, buffer: &wgpu::Buffer) -> Vec<T> {
    let bytes = usize::try_from(buffer.size()).expect("it fits");
    let mut rows = vec![T::zeroed(); bytes / size_of::<T>()];
    gpu.read(buffer, bytemuck::cast_slice_mut(&mut rows)).expect("a device that answers");
    rows
}

/// A bench for a changed scene and its trees.
pub(crate) fn bench_with(change: impl FnOnce(&mut Scene) -> SceneTrees) -> Bench {
    let mut scene = Scene::default();
    let scene_trees = change(&mut scene);
    let atlas = disc_atlas(&scene, 32);
    bench_of(scene, scene_trees, &atlas)
}

/// Two round leaves, chequered in autumn colours, for each species of a scene.
pub(super) fn disc_atlas(scene: &Scene, size_px: u32) -> Atlas {
    let disc = |variant: u32| {
        let middle = size_px as f32 / 2.0;
        let picture = RgbaImage::from_fn(size_px, size_px, |x, y| {
            let [right, down] = [x, y].map(|at| at as f32 + 0.5 - middle);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
            let alpha = (255.0 * (0.8 * middle - right.hypot(down) + 0.5).clamp(0.0, 1.0)) as u8;
            let [r, g, b] = [[190, 60, 25], [200, 130, 30]][((x / 4 + y / 4 + variant) % 2) as usize];
            image::Rgba([r, g, b, alpha])
        });
        Layer::from_picture(picture)
    };
    let layers = scene.species.iter().flat_map(|_| [disc(0), disc(1)]).collect();
    Atlas { size_px, variants: 2, layers }
}

/// A bench for a scene with pictures of its own.
pub(crate) fn bench_of(scene: Scene, scene_trees: SceneTrees, atlas: &Atlas) -> Bench {
    bench_in(scene, scene_trees, atlas, Quality::Full)
}

/// The same for pictures of a quality.
pub(crate) fn bench_in(scene: Scene, scene_trees: SceneTrees, atlas: &Atlas, quality: Quality) -> Bench {
    let gpu = gpu();
    let options = RendererOptions { litter_count: 0, tile_px: u32::MAX, quality };
    let solids = solids_of(&scene).expect("shapes without files");
    let is_compiled = scene.leaves_burn() || scene.weather.is_some();
    let compiled = is_compiled.then(|| CompiledScene::compile(&scene).expect("a scene"));
    let burns = compiled.as_ref().map_or(&[][..], |compiled| &compiled.block().burns);
    let snow = compiled.as_ref().filter(|compiled| compiled.block().has_snow());
    let subject = RenderScene { scene: &scene, solids: &solids, burns, snow, trees: &scene_trees, atlas };
    let renderer = Renderer::new(gpu.device(), gpu.queue(), subject, PictureTarget::FORMAT, SIZE, options)
        .expect("a renderer within default limits");
    Bench { gpu, scene, scene_trees, renderer }
}

/// Parts of a world besides one leaf.
#[derive(Default)]
struct Drawn<'a> {
    branches: Option<&'a BranchColumns<'a>>,
    particles: Option<ParticleColumns<'a>>,
    burn: Option<Burn>,
    bed: Option<BedColumn<'a>>,
    /// The leaf lies level, and else faces the camera.
    is_level: bool,
}

impl Bench {
    /// Draws the trees alone.
    pub(crate) fn draw_trees(&mut self, branches: Option<&BranchColumns<'_>>) -> RgbaImage {
        self.draw_all(branches, 0, 60_000, 0.0, 0.0)
    }

    /// Draws the trees, and their first leaf big before the middle of the picture as one that stands for others.
    pub(crate) fn draw_cluster(&mut self) -> RgbaImage {
        self.draw_all(None, 1, 3 << 14 | 1 << 30, 0.0, 0.0)
    }

    /// Draws one big leaf that faces the camera, in the given state, at an offset from the middle of the picture.
    pub(crate) fn draw(&mut self, state: u32, offset_m: f32, time_s: f64) -> RgbaImage {
        self.draw_all(None, state, 60_000, offset_m, time_s)
    }

    /// Draws these particles: places, motions and traits, word by word.
    pub(crate) fn draw_particles(&mut self, rows: &[[[u32; 4]; 3]], time_s: f64) -> RgbaImage {
        self.draw_ribbons(rows, &[[0; 4]], time_s)
    }

    /// The same with samples of their ways.
    pub(crate) fn draw_ribbons(
        &mut self,
        rows: &[[[u32; 4]; 3]],
        samples: &[[u32; 4]],
        time_s: f64,
    ) -> RgbaImage {
        let (device, queue) = (self.gpu.device(), self.gpu.queue());
        let usage = wgpu::BufferUsages::STORAGE;
        let [place, motion, traits] = [0, 1, 2].map(|column| {
            let words: Vec<[u32; 4]> = rows.iter().map(|row| row[column]).collect();
            upload::buffer(device, queue, "column", usage, bytemuck::cast_slice(&words))
        });
        let count = u32::try_from(rows.len()).expect("few");
        let history = upload::buffer(device, queue, "samples", usage, bytemuck::cast_slice(samples));
        let particles =
            ParticleColumns { place: &place, motion: &motion, traits: &traits, count, history: &history };
        self.draw_world(Drawn { particles: Some(particles), ..Drawn::default() }, 0, 60_000, 0.0, time_s)
    }

    /// Draws the snow that these words of a bed hold.
    pub(crate) fn draw_snow(&mut self, words: &[u32]) -> RgbaImage {
        self.draw_bed(words, 0, Drawn::default())
    }

    /// The same over a level leaf in a state, the first of the scene's.
    pub(crate) fn draw_snowy_leaf(&mut self, words: &[u32], state: u32) -> RgbaImage {
        self.draw_bed(words, state, Drawn { is_level: true, ..Drawn::default() })
    }

    fn draw_bed(&mut self, words: &[u32], state: u32, drawn: Drawn<'_>) -> RgbaImage {
        let (device, queue) = (self.gpu.device(), self.gpu.queue());
        let usage = wgpu::BufferUsages::STORAGE;
        let buffer = upload::buffer(device, queue, "bed", usage, bytemuck::cast_slice(words));
        let bed = BedColumn { buffer: &buffer, first_word: 0 };
        self.draw_world(Drawn { bed: Some(bed), ..drawn }, state, 60_000, 0.0, 0.0)
    }

    /// Draws one big falling leaf that burns as `burn` says.
    pub(crate) fn draw_burning(&mut self, burn: Burn, time_s: f64) -> RgbaImage {
        self.draw_world(Drawn { burn: Some(burn), ..Drawn::default() }, STATE_FALLING, 60_000, 0.0, time_s)
    }

    fn draw_all(
        &mut self,
        branches: Option<&BranchColumns<'_>>,
        state: u32,
        size: u32,
        offset_m: f32,
        time_s: f64,
    ) -> RgbaImage {
        self.draw_world(Drawn { branches, ..Drawn::default() }, state, size, offset_m, time_s)
    }

    fn draw_world(
        &mut self,
        Drawn { branches, particles, burn, bed, is_level }: Drawn<'_>,
        state: u32,
        size: u32,
        offset_m: f32,
        time_s: f64,
    ) -> RgbaImage {
        let (device, queue) = (self.gpu.device(), self.gpu.queue());
        let at = self.scene.view.camera.target_m;
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let column =
            |words: [u32; 4]| upload::buffer(device, queue, "column", usage, bytemuck::bytes_of(&words));
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let place = column([(at.x + offset_m).to_bits(), at.y.to_bits(), (at.z + 6.0).to_bits(), state]);
        let turned = if is_level { [0.0, 0.0, 0.0, 1.0f32] } else { [half, 0.0, 0.0, half] };
        let attitude = column(turned.map(f32::to_bits));
        let (schedule, identity) = (column([0, 0, size, 0]), column([0, 0, 0, 0x1_2345]));
        let leaves = LeafColumns {
            place: &place,
            drift: &place,
            attitude: &attitude,
            schedule: &schedule,
            identity: &identity,
            leaf_count: 1,
        };
        let burns = burn.map(|burn| column(bytemuck::cast(burn)));
        let target = PictureTarget::new(device, SIZE).expect("a target");
        let mut encoder = encoder(&self.gpu);
        let camera = Camera::from(&self.scene.view.camera);
        self.renderer.draw(
            &mut encoder,
            &target.view(),
            &WorldColumns { leaves, branches: branches.cloned(), particles, burns: burns.as_ref(), bed },
            &FrameInput { camera, time_s, moment: LensMoment::FIRST, origin: (0, 0) },
        );
        target.submit_and_read(device, queue, encoder).expect("a picture")
    }
}

pub(crate) fn differing(a: &RgbaImage, b: &RgbaImage) -> usize {
    a.pixels().zip(b.pixels()).filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12)).count()
}

#[test]
fn a_leaf_is_seen_unless_dormant() {
    let mut bench = bench(|_| {});
    let empty = bench.draw(0, 0.0, 0.0);
    assert_eq!(empty, bench.draw(0, 1.0, 0.0), "a dormant leaf is nowhere");
    for state in 1..=3 {
        let seen = differing(&empty, &bench.draw(state, 0.0, 0.0));
        assert!((30..6000).contains(&seen), "state {state}: {seen} pixels changed");
    }
}

#[test]
fn painted_leaves_look_otherwise_and_leave_nothing_behind() {
    let mut bench = bench(|_| {});
    let own = bench.draw(2, 0.0, 0.0);
    bench.renderer.set_paint(Some(Paint { measure: Measure::Height, most: 50.0 }));
    let low = bench.draw(2, 0.0, 0.0);
    bench.renderer.set_paint(Some(Paint { measure: Measure::Height, most: 0.1 }));
    let high = bench.draw(2, 0.0, 0.0);
    for (name, other) in [("in its own colours", &own), ("at the other end of the scale", &low)] {
        let seen = differing(&high, other);
        assert!((30..6000).contains(&seen), "{name}: {seen} pixels differ");
    }
    bench.renderer.set_paint(None);
    assert_eq!(bench.draw(2, 0.0, 0.0), own, "as if nothing had been painted");
    bench.renderer.set_landings(true);
    assert_eq!(bench.draw(2, 0.0, 0.0), own, "nothing lies there");
    bench.renderer.set_landings(false);
}

#[test]
fn same_frame_gives_same_picture() {
    let mut bench = bench(|_| {});
    let picture = bench.draw(2, 0.3, 1.5);
    assert_eq!(bench.draw(2, 0.3, 1.5), picture, "nothing random in a frame");
    bench.renderer.set_split_scene(true);
    assert_eq!(bench.draw(2, 0.3, 1.5), picture, "nor does a pass for each part change it");
}

#[test]
fn picture_is_opaque_day_over_a_meadow() {
    let mut bench = bench(|_| {});
    let picture = bench.draw(0, 0.0, 0.0);
    assert!(picture.pixels().all(|pixel| pixel.0[3] == 255), "opaque");
    let mean = |rows: std::ops::Range<u32>| {
        let count = f64::from(SIZE.0) * f64::from(rows.end - rows.start);
        let rows = picture.enumerate_pixels().filter(|(_, y, _)| rows.contains(y));
        let sum = rows.fold([0.0; 3], |sum: [f64; 3], (_, _, pixel)| {
            std::array::from_fn(|channel| sum[channel] + f64::from(pixel.0[channel]))
        });
        sum.map(|channel| channel / count)
    };
    let (sky, meadow) = (mean(0..20), mean(75..90));
    assert!(sky.iter().all(|&channel| channel > 110.0), "a bright sky: {sky:?}");
    assert!(meadow[1] > meadow[2] * 1.3, "a green meadow: {meadow:?}");
}

#[test]
fn trail_follows_a_leaf_and_breaks_where_it_is_put_elsewhere() {
    let mut bench = bench(|scene| scene.view.trail_s = 2.0);
    let mut last = bench.draw(2, -1.0, 0.0);
    let start = last.clone();
    for frame in 1..=30 {
        let along = frame as f32 / 30.0;
        last = bench.draw(2, -1.0 + along, f64::from(frame) / 60.0);
    }
    let middle = |picture: &RgbaImage| {
        let column = image::imageops::crop_imm(picture, SIZE.0 / 2 - 16, 0, 2, SIZE.1);
        column.to_image()
    };
    assert!(differing(&middle(&start), &middle(&last)) > 0, "a ribbon where the leaf has been");
    let before = bench.draw(0, 0.0, 31.0 / 60.0);
    let jumped = bench.draw(2, -1.2, 32.0 / 60.0);
    let ribbon_kept = differing(&middle(&before), &middle(&jumped));
    assert!(ribbon_kept < 20, "no new ribbon across the jump: {ribbon_kept} pixels");
}

#[test]
fn sizes_beyond_the_device_are_refused() {
    let mut bench = bench(|_| {});
    for size in [(0, 10), (10, 0), (100_000, 10)] {
        let error = bench.renderer.resize(size).expect_err("an impossible size");
        assert!(matches!(error, RenderError::Size { .. }), "{size:?}: {error}");
        assert!(PictureTarget::new(bench.gpu.device(), size).is_err(), "{size:?} as a target");
    }
    assert_eq!(bench.renderer.size(), SIZE, "the renderer keeps its size");
}

#[test]
fn tiles_join_without_a_seam() {
    let draw = |tile_px: u32, focus: Option<Focus>| {
        let mut bench = bench(|scene| scene.view.lens.focus = focus);
        bench.renderer.set_tile_px(tile_px).expect("the same size");
        bench.draw(2, 0.3, 1.5)
    };
    let focus = Focus { distance_m: 0.5, f_number: 1.0 };
    for focus in [None, Some(focus)] {
        let whole = draw(u32::MAX, focus);
        // Tiles of 40 by 24, of which the last ones reach beyond the edge.
        let tiled = draw(1500, focus);
        let largest = whole.as_raw().iter().zip(tiled.as_raw()).map(|(a, b)| a.abs_diff(*b)).max();
        let sum: u64 =
            whole.as_raw().iter().zip(tiled.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        let mean = sum as f64 / whole.as_raw().len() as f64;
        println!("{focus:?}: {largest:?} at most, {mean} on average");
        assert!(mean < 0.05, "{focus:?}: {mean} of 255 apart on average");
        let seen = differing(&whole, &tiled);
        assert!(seen < 20, "{focus:?}: {seen} pixels differ by more than 12 of 255");
    }
}

#[test]
fn focus_blurs_what_is_far_from_it() {
    let sharpness = |focus: Option<Focus>| {
        let mut bench = bench(|scene| scene.view.lens.focus = focus);
        let picture = bench.draw(0, 0.0, 0.0);
        let row = |y: u32| (1..SIZE.0).map(move |x| (x, y));
        let steps = (50..SIZE.1)
            .flat_map(row)
            .map(|(x, y)| u64::from(picture.get_pixel(x, y).0[1].abs_diff(picture.get_pixel(x - 1, y).0[1])));
        steps.sum::<u64>()
    };
    let sharp = sharpness(None);
    let near = sharpness(Some(Focus { distance_m: 0.2, f_number: 1.0 }));
    let stopped_down = sharpness(Some(Focus { distance_m: 8.0, f_number: 64.0 }));
    assert!(2 * near < sharp, "the meadow is blurred: {near} and {sharp}");
    assert!(10 * stopped_down > 9 * sharp, "a small aperture keeps it sharp: {stopped_down} and {sharp}");
}

#[test]
fn hills_stand_before_the_sun() {
    let light = |elevation_deg: f32| {
        let mut bench = bench(|scene| {
            scene.ground.terrain =
                Some(Terrain { edge_m: 64.0, relief_m: 16.0, levels: 6, ..Terrain::default() });
            scene.view.sun.elevation_deg = elevation_deg;
            scene.view.lens.exposure = Exposure::Manual { ev100: 13.0 };
        });
        let picture = bench.draw(0, 0.0, 0.0);
        picture.pixels().map(|pixel| f64::from(pixel.0[1])).sum::<f64>()
    };
    let open = |elevation_deg| {
        with_shader_edit("* hill_light(position), shade.g);", ", shade.g);", || light(elevation_deg))
    };
    let (low, high) = (light(8.0) / open(8.0), light(80.0) / open(80.0));
    assert!(low < 0.97, "a low sun throws their shadows over the meadow: {low}");
    assert!((high - 1.0).abs() < 0.003, "a high one lights all of it: {high}");
}
