// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Response of the lens to known light, on any Vulkan adapter.

use half::f16;
use image::RgbaImage;
use windfall_core::scene::{Exposure, Glare, Lens, ToneMap};

use super::*;
use crate::gpu::targets::Targets;
use crate::lens::group::Shot;
use crate::lens::post::Post;

/// Bytes of a texel of light, four halves.
const TEXEL_BYTES: u32 = 8;

/// A lens that does nothing to grey light but expose it one to one and tone map it.
fn plain(tone_map: ToneMap) -> Lens {
    // 1000 / (1.2 · 2^EV) is 1.
    let exposure = Exposure::Manual { ev100: (1000.0f32 / 1.2).log2() };
    let glare = Glare { strength: 0.0, ..Glare::default() };
    Lens { exposure, tone_map, glare, focus: None, shutter_s: 0.0, saturation: 1.0, vignette: 0.0 }
}

struct Bench {
    gpu: Gpu,
    targets: Targets,
    post: Post,
    target: PictureTarget,
    moment: Option<LensMoment>,
}

impl Bench {
    fn new(size: (u32, u32), lens: Lens) -> Self {
        let gpu = gpu();
        let (device, queue) = (gpu.device(), gpu.queue());
        let targets = Targets::new(device, size, (u32::MAX, 1), false).expect("targets");
        let post = Post::new(device, queue, &targets, PictureTarget::FORMAT, lens);
        let target = PictureTarget::new(device, size).expect("a target");
        Self { gpu, targets, post, target, moment: None }
    }

    /// The picture of grey light, so long after the one before.
    fn draw(&mut self, since_s: f64, light: impl Fn(u32, u32) -> f32) -> RgbaImage {
        self.draw_colored(since_s, |x, y| [light(x, y); 3])
    }

    fn draw_colored(&mut self, since_s: f64, light: impl Fn(u32, u32) -> [f32; 3]) -> RgbaImage {
        let (width, height) = self.targets.size;
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let texel = |[red, green, blue]: [f32; 3]| {
            [red, green, blue, 1.0].map(|light| f16::from_f32(light).to_bits())
        };
        let texels: Vec<[u16; 4]> = places.map(|(x, y)| texel(light(x, y))).collect();
        self.gpu.queue().write_texture(
            self.targets.resolved.texture().as_image_copy(),
            bytemuck::cast_slice(&texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(TEXEL_BYTES * width),
                rows_per_image: None,
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        let moment = self.moment.map_or(LensMoment::FIRST, |moment| moment.after(since_s));
        self.moment = Some(moment);
        let mut encoder = encoder(&self.gpu);
        let shot = Shot {
            size: self.targets.size,
            shading_px: 1,
            origin: (0, 0),
            moment,
            vertical_fov_rad: 0.8,
            near_m: camera::NEAR_M,
        };
        self.post.begin(self.gpu.queue(), &shot);
        self.post.draw(&mut encoder, None, &self.target.view(), &shot);
        self.target.submit_and_read(self.gpu.device(), self.gpu.queue(), encoder).expect("a picture")
    }

    /// Sum of the glare over the pixels of the picture.
    fn glare_energy(&self) -> f32 {
        let (view, pixels) = self.post.glare();
        let size = view.texture().size();
        let row = (size.width * TEXEL_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * size.height),
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = encoder(&self.gpu);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            view.texture().as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            size,
        );
        self.gpu.queue().submit([encoder.finish()]);
        let texels: Vec<[u16; 4]> = read(&self.gpu, &buffer);
        let rows = texels.chunks((row / TEXEL_BYTES) as usize);
        let seen = rows.flat_map(|row| &row[..size.width as usize]);
        let sum: f32 = seen.map(|[_, green, ..]| f16::from_bits(*green).to_f32()).sum();
        sum * (pixels * pixels) as f32
    }
}

fn srgb(linear: f32) -> f32 {
    255.0 * if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Asserts that the pixel has this displayed light, within dither and rounding.
fn assert_displays(picture: &RgbaImage, (x, y): (u32, u32), linear: f32) {
    let pixel = picture.get_pixel(x, y).0;
    for channel in &pixel[..3] {
        let apart = (f32::from(*channel) - srgb(linear)).abs();
        assert!(apart <= 1.2, "at {x}, {y}: {pixel:?} for {}", srgb(linear));
    }
}

#[test]
fn reinhard_follows_the_published_curve() {
    let mut bench = Bench::new((8, 4), plain(ToneMap::Reinhard { white: 2.0 }));
    // L (1 + L / 4) / (1 + L) by hand.
    let rows =
        [(0.0, 0.0), (0.1, 0.093_18), (0.5, 0.375), (1.0, 0.625), (1.5, 0.825), (2.0, 1.0), (4.0, 1.0)];
    let picture = bench.draw(0.0, |x, _| rows.get(x as usize).map_or(0.0, |row| row.0));
    for (x, (light, displayed)) in (0..).zip(rows) {
        assert_displays(&picture, (x, 2), displayed);
        assert!(light >= 0.0, "light {light}");
    }
    // Equation 2 with the key 0.18: the log-average of 0.2 and 0.8 is 0.4, which makes 0.09 and 0.36 of them.
    let lens = Lens { exposure: Exposure::default(), ..plain(ToneMap::Reinhard { white: 1000.0 }) };
    bench.post.set_lens(bench.gpu.device(), bench.gpu.queue(), &bench.targets, lens);
    let picture = bench.draw(f64::INFINITY, |x, _| if x % 2 == 0 { 0.2 } else { 0.8 });
    assert_displays(&picture, (2, 1), 0.09 / 1.09);
    assert_displays(&picture, (3, 1), 0.36 / 1.36);
}

#[test]
fn linear_tone_map_is_a_power_and_a_cut() {
    let mut bench = Bench::new((4, 1), plain(ToneMap::Linear { gamma: 2.0 }));
    let picture = bench.draw(0.0, |x, _| [0.0, 0.25, 0.64, 3.0][x as usize]);
    for (x, wanted) in [(0, 0.0), (1, 127.5), (2, 204.0), (3, 255.0)] {
        let found = f32::from(picture.get_pixel(x, 0).0[0]);
        assert!((found - wanted).abs() <= 1.0, "pixel {x}: {found} for {wanted}");
    }
}

#[test]
fn the_filmic_curve_rises_from_black_through_middle_grey_to_white() {
    let mut bench = Bench::new((100, 1), plain(ToneMap::AgX));
    // A fifth of a stop from pixel to pixel.
    let light = |x: u32| 0.18 * ((x as f32 - 60.0) * 0.2).exp2();
    let picture = bench.draw(0.0, |x, _| light(x));
    assert_displays(&picture, (60, 0), 0.18);
    assert_displays(&picture, (0, 0), 0.0);
    assert_eq!(picture.get_pixel(99, 0).0, [255; 4], "7.8 stops above middle grey is white");
    for x in 0..99 {
        let (dark, bright) = (picture.get_pixel(x, 0).0[1], picture.get_pixel(x + 1, 0).0[1]);
        // Dither is up to one step.
        assert!(
            bright.saturating_add(1) >= dark,
            "at {} times middle grey: {dark} then {bright}",
            light(x) / 0.18
        );
    }
    let slope = (srgb(0.18) - f32::from(picture.get_pixel(55, 0).0[1])) / (srgb(0.18) - srgb(0.09));
    assert!((1.05..1.4).contains(&slope), "more contrast than the scene has: {slope}");
    let picture = bench.draw_colored(0.0, |x, _| [[0.3, 0.1, 0.01], [30.0, 10.0, 1.0]][x as usize % 2]);
    let spread = |x| picture.get_pixel(x, 0).0[0] - picture.get_pixel(x, 0).0[2];
    assert!(spread(0) > 60 && spread(1) < 60, "bright orange pales: {} then {}", spread(0), spread(1));
}

#[test]
fn automatic_exposure_makes_any_grey_wall_middle_grey() {
    let lens = Lens { exposure: Exposure::default(), ..plain(ToneMap::AgX) };
    for light in [0.002, 0.18, 7.0, 900.0] {
        let mut bench = Bench::new((50, 30), lens);
        assert_displays(&bench.draw(0.0, |_, _| light), (20, 20), 0.18);
    }
    let brighter = Exposure::Auto { compensation_ev: 1.0, adaptation_s: 0.8 };
    let mut bench =
        Bench::new((50, 30), Lens { exposure: brighter, ..plain(ToneMap::Linear { gamma: 1.0 }) });
    let pixel = bench.draw(0.0, |_, _| 3.0).get_pixel(20, 20).0[0];
    assert!((f32::from(pixel) - 0.36 * 255.0).abs() <= 1.0, "one stop brighter: {pixel}");
    let picture = bench.draw(f64::INFINITY, |x, _| if x == 7 { f32::NAN } else { 3.0 });
    assert!(picture.get_pixel(20, 20).0[0] > 80, "a pixel that is no number does not blind the lens");
}

#[test]
fn the_lens_adapts_with_its_time_constant() {
    let exposure = Exposure::Auto { compensation_ev: 0.0, adaptation_s: 2.0 };
    let mut bench = Bench::new((16, 16), Lens { exposure, ..plain(ToneMap::Linear { gamma: 1.0 }) });
    bench.draw(0.1, |_, _| 1.0);
    // A stop brighter; after 2 s of frames the lens has gone half of the way, after four times that all of it.
    let mut after = |frames: u32| {
        let last = (0..frames).map(|_| bench.draw(0.02, |_, _| 2.0)).last().expect("frames");
        let [grey, ..] = last.get_pixel(8, 8).0;
        grey
    };
    let wanted = 255.0 * 0.18 * 0.5f32.exp2();
    let pixel = after(100);
    assert!((f32::from(pixel) - wanted).abs() <= 2.0, "{pixel} for {wanted}");
    let pixel = after(325);
    assert!((f32::from(pixel) - 255.0 * 0.18).abs() <= 1.0, "{pixel}");
}

#[test]
fn glare_keeps_the_energy_of_what_is_beyond_the_threshold() {
    for size in [(192, 144), (321, 203)] {
        for (light, threshold) in [(50.0, 0.8), (2.0, 0.5), (0.79, 0.8), (1000.0, 0.0)] {
            let glare = Glare { threshold, strength: 0.5 };
            let mut bench = Bench::new(size, Lens { glare, ..plain(ToneMap::AgX) });
            // In the middle: nothing leaves the picture.
            let middle = (size.0 / 2, size.1 / 2);
            bench.draw(0.0, |x, y| if (x, y) == middle { light } else { 0.0 });
            let wanted = ((light - threshold) / (1.0 - threshold)).max(0.0);
            let found = bench.glare_energy();
            assert!((found - wanted).abs() <= 0.01 * wanted, "{size:?}, {light}: {found} for {wanted}");
        }
    }
}

#[test]
fn glare_shines_around_the_sun_and_nowhere_without_it() {
    let glare = Glare { threshold: 0.8, strength: 0.1 };
    let lens = plain(ToneMap::Linear { gamma: 1.0 });
    let light = |x: u32, y: u32| if (x / 3, y / 3) == (10, 10) { 300.0 } else { 0.1 };
    let without = Bench::new((90, 60), lens).draw(0.0, light);
    let with = Bench::new((90, 60), Lens { glare, ..lens }).draw(0.0, light);
    let at = |picture: &RgbaImage, x: u32| picture.get_pixel(x, 31).0[0];
    assert!(at(&with, 36) > at(&without, 36) + 20, "near: {} and {}", at(&with, 36), at(&without, 36));
    assert!(at(&with, 36) > at(&with, 50) && at(&with, 50) > at(&without, 50), "farther: {}", at(&with, 50));
    let dull = |_, _| 0.7;
    let without = Bench::new((90, 60), lens).draw(0.0, dull);
    assert_eq!(
        without,
        Bench::new((90, 60), Lens { glare, ..lens }).draw(0.0, dull),
        "nothing is too bright"
    );
}
