// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The glow around bright places.
//!
//! The picture is halved until its height is about a dozen pixels. The five smallest sizes are blurred with the same
//! kernel, which is twice as wide in each as in the one before, and added up from the smallest on. What is wide in the
//! picture is so at any resolution.

use windfall_core::layout::Float4;
use windfall_core::{shared_constants, shared_struct};

use super::fullscreen::{Fullscreen, light_texture, smooth_sampler};
use super::group::LensGroup;
use crate::gpu::pipeline::{FILTERABLE, sampler_entry, texture_entry, uniform_entry};
use crate::gpu::targets::HDR_FORMAT;

/// Standard deviation of the widest Gaussian as a part of the picture's height.
const WIDEST: f32 = 0.16;
/// Shares of the scales, the widest first. They add up to one.
const SHARES: [f32; 5] = [0.10, 0.15, 0.20, 0.25, 0.30];
/// Lowest the smallest size may be, in pixels: the widest Gaussian is narrow enough for the kernel.
const LEAST_HEIGHT: f32 = 9.0;
shared_constants! {
    /// Weights of one half of the kernel, without its middle.
    const GLARE_RADIUS: u32 = 9;
}
/// The same with its middle.
const WEIGHTS: usize = GLARE_RADIUS as usize + 1;

shared_struct! {
    /// A scale of the glare.
    pub(crate) struct GlareScale, padding 12 {
        /// Weights of the Gaussian from its middle outwards, four by four; with those of its other half they add up to one.
        kernel: [Float4; 3],
        /// Share of this scale in the glare.
        share: f32,
    }
}

/// Half of a Gaussian kernel: with its mirror image it adds up to one, so that a blur keeps energy.
fn kernel(deviation: f32) -> [f32; WEIGHTS] {
    let weights: [f32; WEIGHTS] = std::array::from_fn(|offset| {
        let t = offset as f32 / deviation;
        (-0.5 * t * t).exp()
    });
    let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f32>();
    weights.map(|weight| weight / sum)
}

/// Pipelines and kernels.
#[derive(Debug)]
pub(crate) struct GlarePass {
    bright: Fullscreen,
    halve: Fullscreen,
    across: Fullscreen,
    along: Fullscreen,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    scales: Vec<wgpu::Buffer>,
    black: wgpu::TextureView,
}

/// One size of the picture.
#[derive(Debug)]
struct Level {
    view: wgpu::TextureView,
    /// Reads the size before.
    halving: wgpu::BindGroup,
    /// The blur of the five smallest.
    blur: Option<Blur>,
}

/// Pictures and bind groups of a blur.
#[derive(Debug)]
struct Blur {
    half_done: wgpu::TextureView,
    across: wgpu::BindGroup,
    along: wgpu::BindGroup,
}

/// Glare of pictures of one size.
#[derive(Debug)]
pub(crate) struct GlareChain {
    levels: Vec<Level>,
    /// The glare, and pixels of the picture along one of it.
    pub(crate) result: wgpu::TextureView,
    pub(crate) pixels: u32,
}

impl GlarePass {
    pub(crate) fn new(device: &wgpu::Device, lens: &LensGroup) -> Self {
        let dimension = wgpu::TextureViewDimension::D2;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("glare"),
            entries: &[
                texture_entry(0, FILTERABLE, dimension),
                texture_entry(1, FILTERABLE, dimension),
                sampler_entry(2, wgpu::SamplerBindingType::Filtering),
                uniform_entry(3),
            ],
        });
        let pipeline = |entry| {
            let source = ("lens/glare_pass", entry);
            Fullscreen::new(device, lens, &layout, source, HDR_FORMAT, &[])
        };
        let scales = SHARES.iter().map(|_| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("glare"),
                size: size_of::<GlareScale>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        Self {
            bright: pipeline("bright"),
            halve: pipeline("halve"),
            across: pipeline("blur_across"),
            along: pipeline("blur_along"),
            sampler: smooth_sampler(device),
            scales: scales.collect(),
            // Textures begin black.
            black: light_texture(device, "no glare", (1, 1)),
            layout,
        }
    }

    /// The chain for pictures of `size` in `light`.
    pub(crate) fn chain(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        light: &wgpu::TextureView,
        size: (u32, u32),
    ) -> GlareChain {
        let halvings = halvings(size.1);
        let deviation = WIDEST * size.1 as f32 / (1u32 << halvings) as f32;
        let kernel = kernel(deviation);
        // A small picture has fewer sizes.
        let all: f32 = SHARES.iter().take(halvings as usize).sum();
        for (buffer, share) in self.scales.iter().zip(SHARES) {
            let weight = |index: usize| kernel.get(index).copied().unwrap_or(0.0);
            let scale = GlareScale {
                kernel: [0, 4, 8].map(|first| Float4([0, 1, 2, 3].map(|next| weight(first + next)))),
                share: share / all,
                padding: [0; 12],
            };
            queue.write_buffer(buffer, 0, bytemuck::bytes_of(&scale));
        }
        let halved = |edge: u32, count: u32| edge.div_ceil(1 << count).max(1);
        let views: Vec<_> = (1..=halvings)
            .map(|count| light_texture(device, "glare", (halved(size.0, count), halved(size.1, count))))
            .collect();
        let levels = (1..=halvings).zip(&views).map(|(count, view)| {
            let index = count as usize - 1;
            let before = index.checked_sub(1).map_or(light, |index| &views[index]);
            let wider = views.get(index + 1).unwrap_or(&self.black);
            let blur = self.scales.get((halvings - count) as usize).map(|scale| {
                let half_done =
                    light_texture(device, "half glare", (halved(size.0, count), halved(size.1, count)));
                Blur {
                    across: self.bind(device, view, &self.black, scale),
                    along: self.bind(device, &half_done, wider, scale),
                    half_done,
                }
            });
            let halving = self.bind(device, before, &self.black, &self.scales[0]);
            Level { view: view.clone(), halving, blur }
        });
        let levels: Vec<Level> = levels.collect();
        let unblurred = levels.iter().take_while(|level| level.blur.is_none()).count();
        let result = levels.get(unblurred).map_or(&self.black, |level| &level.view).clone();
        #[expect(clippy::cast_possible_truncation, reason = "at most a few levels")]
        let pixels = 1 << (unblurred as u32 + 1);
        GlareChain { levels, result, pixels }
    }

    fn bind(
        &self,
        device: &wgpu::Device,
        source: &wgpu::TextureView,
        wider: &wgpu::TextureView,
        scale: &wgpu::Buffer,
    ) -> wgpu::BindGroup {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("glare"),
            layout: &self.layout,
            entries: &[
                entry(0, wgpu::BindingResource::TextureView(source)),
                entry(1, wgpu::BindingResource::TextureView(wider)),
                entry(2, wgpu::BindingResource::Sampler(&self.sampler)),
                entry(3, scale.as_entire_binding()),
            ],
        })
    }

    /// Fills the chain's result. `timestamps` gives those of the first and of the last pass.
    pub(crate) fn draw<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: [Option<wgpu::RenderPassTimestampWrites<'a>>; 2],
        lens: &LensGroup,
        chain: &GlareChain,
    ) {
        let [mut begin, mut end] = timestamps;
        for (index, level) in chain.levels.iter().enumerate() {
            let pipeline = if index == 0 { &self.bright } else { &self.halve };
            pipeline.draw(encoder, begin.take(), [&lens.group, &level.halving], &level.view, None);
        }
        let blurred = chain.levels.iter().filter_map(|level| Some((level, level.blur.as_ref()?)));
        let count = blurred.clone().count();
        for (index, (level, blur)) in blurred.rev().enumerate() {
            self.across.draw(encoder, None, [&lens.group, &blur.across], &blur.half_done, None);
            let writes = if index + 1 == count { end.take() } else { None };
            self.along.draw(encoder, writes, [&lens.group, &blur.along], &level.view, None);
        }
    }
}

/// Number of halvings of a picture.
fn halvings(height: u32) -> u32 {
    let mut count = 1;
    while height as f32 / (1u32 << (count + 1)) as f32 >= LEAST_HEIGHT {
        count += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_and_shares_add_up_to_one() {
        for height in [1, 9, 90, 143, 144, 360, 1080, 2160, 4320, 16_384] {
            let deviation = WIDEST * height as f32 / (1u32 << halvings(height)) as f32;
            let kernel = kernel(deviation.max(0.01));
            let sum = kernel[0] + 2.0 * kernel[1..].iter().sum::<f32>();
            assert!((sum - 1.0).abs() < 1.0e-6, "{height} pixels high: {sum}");
            assert!(kernel.is_sorted_by(|a, b| a >= b), "falls from the middle: {kernel:?}");
            let cut = kernel[WEIGHTS - 1] / kernel[0];
            assert!(cut < 0.02, "{height} pixels high: the kernel ends at {cut} of its middle");
        }
        assert!((SHARES.iter().sum::<f32>() - 1.0).abs() < 1.0e-6, "shares of the scales");
    }
}
