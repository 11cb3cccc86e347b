// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Everything between resolved light and the picture, pass by pass.

use windfall_core::scene::Lens;

use super::exposure_pass::ExposurePass;
use super::glare_pass::{GlareChain, GlarePass};
use super::lens_group::{LensGroup, LensUniform, Shot};
use super::targets::Targets;
use super::timing::GpuTimer;
use super::tonemap_pass::TonemapPass;

/// Numbers of the timed passes here, in order.
#[derive(Clone, Copy, Debug)]
pub(super) struct TimedPosts {
    pub(super) exposure: u32,
    pub(super) glare: u32,
    pub(super) tone_map: u32,
}

/// The passes, and what they read in pictures of one size.
#[derive(Debug)]
pub(super) struct Post {
    lens: Lens,
    group: LensGroup,
    exposure_pass: ExposurePass,
    glare_pass: GlarePass,
    tonemap_pass: TonemapPass,
    bound: Bound,
}

/// What depends on the textures.
#[derive(Debug)]
struct Bound {
    exposure: wgpu::BindGroup,
    glare: GlareChain,
    tonemap: wgpu::BindGroup,
}

impl Post {
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        targets: &Targets,
        format: wgpu::TextureFormat,
        lens: Lens,
    ) -> Self {
        let group = LensGroup::new(device);
        let exposure_pass = ExposurePass::new(device, &group);
        let glare_pass = GlarePass::new(device, &group);
        let tonemap_pass = TonemapPass::new(device, &group, format);
        let bound = Bound::new(device, queue, targets, &group, (&exposure_pass, &glare_pass, &tonemap_pass));
        Self { lens, group, exposure_pass, glare_pass, tonemap_pass, bound }
    }

    /// Takes over another lens.
    pub(super) fn set_lens(&mut self, lens: Lens) {
        self.lens = lens;
    }

    /// Reads from new targets.
    pub(super) fn rebind(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, targets: &Targets) {
        let passes = (&self.exposure_pass, &self.glare_pass, &self.tonemap_pass);
        self.bound = Bound::new(device, queue, targets, &self.group, passes);
    }

    /// The glare of the last picture, and pixels of the picture along one of it.
    #[cfg(test)]
    pub(super) fn glare(&self) -> (&wgpu::TextureView, u32) {
        (&self.bound.glare.result, self.bound.glare.pixels)
    }

    /// Makes the picture in its place in `output`.
    pub(super) fn draw(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        timer: Option<(&GpuTimer, TimedPosts)>,
        output: &wgpu::TextureView,
        shot: &Shot,
    ) {
        self.group.write(queue, &LensUniform::new(&self.lens, shot));
        let writes = timer.map(|(timer, passes)| timer.compute_writes(passes.exposure));
        self.exposure_pass.run(encoder, writes, &self.group, &self.bound.exposure);
        if self.lens.glare.strength > 0.0 {
            let writes = timer.map(|(timer, passes)| timer.split_writes(passes.glare));
            let [begin, end] = writes.map_or([None, None], |writes| writes.map(Some));
            self.glare_pass.draw(encoder, [begin, end], &self.group, &self.bound.glare);
        }
        let writes = timer.map(|(timer, passes)| timer.render_writes(passes.tone_map));
        let groups = [&self.group.group, &self.bound.tonemap];
        self.tonemap_pass.draw(encoder, writes, groups, output, (shot.origin, shot.size));
    }
}

impl Bound {
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        targets: &Targets,
        group: &LensGroup,
        (exposure, glare, tonemap): (&ExposurePass, &GlarePass, &TonemapPass),
    ) -> Self {
        let light = &targets.resolved;
        let chain = glare.chain(device, queue, light, targets.size);
        Self {
            exposure: exposure.bind(device, group, light),
            tonemap: tonemap.bind(device, queue, light, &chain),
            glare: chain,
        }
    }
}
