// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Everything between resolved light and the picture, pass by pass.

use windfall_core::scene::Lens;

use super::exposure_pass::ExposurePass;
use super::focus_pass::{FocusChain, FocusPass};
use super::glare_pass::{GlareChain, GlarePass};
use super::group::{LensGroup, LensUniform, Shot};
use super::sample_pass::SamplePass;
use super::shutter_pass::{ShutterChain, ShutterPass};
use super::tonemap_pass::TonemapPass;
use crate::gpu::targets::Targets;
use crate::gpu::tile::Tile;
use crate::gpu::timing::GpuTimer;

/// Numbers of the timed passes here, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimedPosts {
    pub(crate) shutter: u32,
    pub(crate) focus: u32,
    pub(crate) exposure: u32,
    pub(crate) glare: u32,
    pub(crate) tone_map: u32,
}

/// The lens, the passes, and what they read in pictures of one size.
#[derive(Debug)]
pub(crate) struct Post {
    lens: Lens,
    group: LensGroup,
    passes: Passes,
    bound: Bound,
}

/// The passes, in their order.
#[derive(Debug)]
struct Passes {
    /// None where samples are averaged to pixels.
    samples: Option<SamplePass>,
    shutter: ShutterPass,
    focus: FocusPass,
    exposure: ExposurePass,
    glare: GlarePass,
    tonemap: TonemapPass,
}

/// Resources that depend on the textures.
#[derive(Debug)]
struct Bound {
    /// Samples that become pixels.
    samples: Option<wgpu::BindGroup>,
    shutter: Option<ShutterChain>,
    focus: Option<FocusChain>,
    exposure: wgpu::BindGroup,
    glare: GlareChain,
    tonemap: wgpu::BindGroup,
}

impl Post {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        targets: &Targets,
        format: wgpu::TextureFormat,
        lens: Lens,
    ) -> Self {
        let group = LensGroup::new(device);
        let passes = Passes {
            samples: (targets.shading_px > 1).then(|| SamplePass::new(device, &group)),
            shutter: ShutterPass::new(device, &group),
            focus: FocusPass::new(device, &group),
            exposure: ExposurePass::new(device, &group),
            glare: GlarePass::new(device, &group),
            tonemap: TonemapPass::new(device, &group, format),
        };
        let bound = Bound::new(device, queue, targets, &group, &passes, &lens);
        Self { lens, group, passes, bound }
    }

    /// Takes over another lens.
    pub(crate) fn set_lens(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        targets: &Targets,
        lens: Lens,
    ) {
        let needs_other_textures = self.lens.focus.is_some() != lens.focus.is_some()
            || self.bound.shutter.is_some() != targets.ways.is_some();
        self.lens = lens;
        if needs_other_textures {
            self.rebind(device, queue, targets);
        }
    }

    /// Time that the shutter is open, in seconds.
    pub(crate) fn shutter_s(&self) -> f32 {
        self.lens.shutter_s
    }

    /// Reads from new targets.
    pub(crate) fn rebind(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, targets: &Targets) {
        self.bound = Bound::new(device, queue, targets, &self.group, &self.passes, &self.lens);
    }

    /// The glare of the last picture, and pixels of the picture along one of it.
    #[cfg(test)]
    pub(crate) fn glare(&self) -> (&wgpu::TextureView, u32) {
        (&self.bound.glare.result, self.bound.glare.pixels)
    }

    /// Makes everything ready for a picture, before its tiles are drawn.
    pub(crate) fn begin(&self, queue: &wgpu::Queue, shot: &Shot) {
        self.group.write(queue, &LensUniform::new(&self.lens, shot));
    }

    /// Takes what it needs of a tile before the next is drawn.
    pub(crate) fn take_tile(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        (tile, targets): (&Tile, &Targets),
        shot: &Shot,
    ) {
        if let Some((pass, samples)) = self.passes.samples.as_ref().zip(self.bound.samples.as_ref()) {
            pass.draw(queue, encoder, &self.group, (samples, &targets.resolved), tile);
        }
        if let Some(chain) = &self.bound.shutter {
            self.passes.shutter.take(queue, encoder, &self.group, chain, (tile, shot));
        }
        if let Some(chain) = &self.bound.focus {
            self.passes.focus.take_depth(queue, encoder, &self.group, chain, tile);
        }
    }

    /// Makes the picture in its place in `output`.
    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: Option<(&GpuTimer, TimedPosts)>,
        output: &wgpu::TextureView,
        shot: &Shot,
    ) {
        let split = |pass: fn(TimedPosts) -> u32| {
            let writes = timer.map(|(timer, passes)| timer.split_writes(pass(passes)));
            writes.map_or([None, None], |writes| writes.map(Some))
        };
        if let Some(chain) = &self.bound.shutter {
            self.passes.shutter.draw(encoder, split(|passes| passes.shutter), &self.group, chain);
        }
        if let Some(chain) = &self.bound.focus {
            self.passes.focus.draw(encoder, split(|passes| passes.focus), &self.group, chain);
        }
        let writes = timer.map(|(timer, passes)| timer.compute_writes(passes.exposure));
        self.passes.exposure.run(encoder, writes, &self.group, &self.bound.exposure);
        if self.lens.glare.strength > 0.0 {
            self.passes.glare.draw(encoder, split(|passes| passes.glare), &self.group, &self.bound.glare);
        }
        let writes = timer.map(|(timer, passes)| timer.render_writes(passes.tone_map));
        let curve = (&self.lens.tone_map, [&self.group.group, &self.bound.tonemap]);
        self.passes.tonemap.draw(encoder, writes, curve, output, (shot.origin, shot.size));
    }
}

impl Bound {
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        targets: &Targets,
        group: &LensGroup,
        passes: &Passes,
        lens: &Lens,
    ) -> Self {
        let shutter = passes.shutter.chain(device, targets);
        let light = shutter.as_ref().map_or(&targets.resolved, |chain| &chain.result);
        let focus = lens.focus.map(|_| passes.focus.chain(device, targets, light));
        let light = focus.as_ref().map_or(light, |chain| &chain.result);
        let glare = passes.glare.chain(device, queue, light, targets.size);
        Self {
            samples: passes.samples.as_ref().map(|pass| pass.bind(device, targets)),
            exposure: passes.exposure.bind(device, group, light),
            tonemap: passes.tonemap.bind(device, queue, light, &glare),
            glare,
            focus,
            shutter,
        }
    }
}
