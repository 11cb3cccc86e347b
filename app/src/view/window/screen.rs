// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The surface of the window, and what becomes of it when the window changes.

use std::sync::Arc;

use anyhow::{Context, anyhow};
use wgpu::CurrentSurfaceTexture;
use windfall_wgpu::{Gpu, select_adapter};
use winit::window::Window;

use crate::run::drawing::no_adapter;

/// The surface and how it is configured.
#[derive(Debug)]
pub(crate) struct Screen {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    /// The surface works, but no longer fits.
    is_stale: bool,
}

impl Screen {
    /// A surface of `window`, not yet configured for any device.
    ///
    /// # Errors
    /// A window system that the graphics API does not support.
    pub(crate) fn surface(
        instance: &wgpu::Instance,
        window: &Arc<Window>,
    ) -> anyhow::Result<wgpu::Surface<'static>> {
        instance.create_surface(Arc::clone(window)).map_err(|error| {
            match select_adapter(instance, None, None) {
                // Without any driver there is no surface either, but the driver is what is missing.
                Err(missing) => no_adapter(&missing),
                Ok(_) => anyhow!("cannot draw to a window: {error}"),
            }
        })
    }

    /// Configures the surface.
    ///
    /// # Errors
    /// A surface that the adapter cannot draw to.
    pub(crate) fn new(
        window: Arc<Window>,
        surface: wgpu::Surface<'static>,
        adapter: &wgpu::Adapter,
        gpu: &Gpu,
    ) -> anyhow::Result<Self> {
        let config = configuration(&window, &surface, adapter)?;
        surface.configure(gpu.device(), &config);
        gpu.check()?;
        Ok(Self { window, surface, config, is_stale: false })
    }

    /// Goes on with another surface of the same window, for another device.
    ///
    /// # Errors
    /// A surface that the adapter cannot draw to.
    pub(crate) fn reopen(
        &mut self,
        surface: wgpu::Surface<'static>,
        adapter: &wgpu::Adapter,
        gpu: &Gpu,
    ) -> anyhow::Result<()> {
        // The former one lets go of the window before this one takes it.
        self.surface = surface;
        self.config = configuration(&self.window, &self.surface, adapter)?;
        self.surface.configure(gpu.device(), &self.config);
        self.is_stale = false;
        Ok(gpu.check()?)
    }

    /// Format of its textures.
    pub(crate) fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Size in pixels; at least one by one.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.config.width, self.config.height)
    }

    /// Follows the size of the window; false while that is nothing, as it is when minimised.
    pub(crate) fn follow_window(&mut self, gpu: &Gpu) -> bool {
        let size = self.window.inner_size();
        if size.width == 0 || size.height == 0 {
            return false;
        }
        if self.is_stale || (size.width, size.height) != self.size() {
            // A window may be larger than the device's largest texture.
            let limit = gpu.device().limits().max_texture_dimension_2d;
            (self.config.width, self.config.height) = (size.width.min(limit), size.height.min(limit));
            self.surface.configure(gpu.device(), &self.config);
            self.is_stale = false;
        }
        true
    }

    /// The next texture to draw to; `None` if there is none just now.
    ///
    /// # Errors
    /// A surface that is lost for good.
    pub(crate) fn acquire(
        &mut self,
        instance: &wgpu::Instance,
        gpu: &Gpu,
    ) -> anyhow::Result<Option<wgpu::SurfaceTexture>> {
        match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) => return Ok(Some(texture)),
            CurrentSurfaceTexture::Suboptimal(texture) => {
                self.is_stale = true;
                return Ok(Some(texture));
            }
            CurrentSurfaceTexture::Outdated => self.is_stale = true,
            CurrentSurfaceTexture::Lost => {
                // With its device everything is lost; without, a new surface will do.
                gpu.check()?;
                self.surface = Self::surface(instance, &self.window)?;
                self.is_stale = true;
            }
            CurrentSurfaceTexture::Timeout
            | CurrentSurfaceTexture::Occluded
            | CurrentSurfaceTexture::Validation => {}
        }
        gpu.check()?;
        Ok(None)
    }
}

/// Configuration of a surface that fills its window.
fn configuration(
    window: &Window,
    surface: &wgpu::Surface<'_>,
    adapter: &wgpu::Adapter,
) -> anyhow::Result<wgpu::SurfaceConfiguration> {
    let size = window.inner_size();
    let mut config = surface
        .get_default_config(adapter, size.width.max(1), size.height.max(1))
        .context("the graphics adapter cannot draw to this window")?;
    // The panel blends in gamma space.
    let formats = surface.get_capabilities(adapter).formats;
    let plain = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    if let Some(format) = plain.into_iter().find(|format| formats.contains(format)) {
        config.format = format;
    }
    config.present_mode = wgpu::PresentMode::AutoVsync;
    Ok(config)
}
