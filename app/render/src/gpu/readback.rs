// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Brings a drawn picture back to the CPU. It waits for the device: for stills and clips, not for a window.

use std::sync::mpsc;

use image::RgbaImage;

use crate::error::RenderError;

/// A texture to draw pictures into and the buffer they come back through.
#[derive(Debug)]
pub struct PictureTarget {
    texture: wgpu::Texture,
    buffer: wgpu::Buffer,
    bytes_per_row: u32,
    /// True if blue comes first.
    is_bgra: bool,
}

impl PictureTarget {
    /// Format of the texture: the renderer encodes gamma by itself.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    /// A target of `size` pixels.
    ///
    /// # Errors
    /// A size the device cannot draw.
    pub fn new(device: &wgpu::Device, size: (u32, u32)) -> Result<Self, RenderError> {
        Self::with_format(device, size, Self::FORMAT)
    }

    /// A target in the format of a window, for pictures of the window.
    ///
    /// # Errors
    /// A size the device cannot draw; a format other than four bytes of red, green, blue and alpha in some order.
    pub fn with_format(
        device: &wgpu::Device,
        size: (u32, u32),
        format: wgpu::TextureFormat,
    ) -> Result<Self, RenderError> {
        let is_bgra = match format.remove_srgb_suffix() {
            wgpu::TextureFormat::Rgba8Unorm => false,
            wgpu::TextureFormat::Bgra8Unorm => true,
            _ => return Err(RenderError::Readback(format!("the format is {format:?}"))),
        };
        let limits = device.limits();
        let (width, height) = size;
        let limit = limits.max_texture_dimension_2d;
        // Rows in the buffer begin at multiples of 256 bytes.
        let bytes_per_row = width.saturating_mul(4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer_size = u64::from(bytes_per_row) * u64::from(height);
        if width == 0
            || height == 0
            || width > limit
            || height > limit
            || buffer_size > limits.max_buffer_size
        {
            return Err(RenderError::Size { width, height, limit });
        }
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: buffer_size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Ok(Self { texture, buffer, bytes_per_row, is_bgra })
    }

    /// Target to draw into.
    pub fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// Submits `encoder`, which drew into this target, waits for it, and returns the picture, opaque.
    ///
    /// # Errors
    /// The device was lost or refused the work.
    pub fn submit_and_read(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        mut encoder: wgpu::CommandEncoder,
    ) -> Result<RgbaImage, RenderError> {
        let size = self.texture.size();
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.bytes_per_row),
                    rows_per_image: None,
                },
            },
            size,
        );
        let submission = queue.submit([encoder.finish()]);
        let (sender, receiver) = mpsc::channel();
        self.buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // Nobody listens any more only if this call has already failed.
            let _ = sender.send(result);
        });
        let failed = |reason: &dyn std::fmt::Display| RenderError::Readback(reason.to_string());
        device
            .poll(wgpu::PollType::Wait { submission_index: Some(submission), timeout: None })
            .map_err(|error| failed(&error))?;
        receiver.recv().map_err(|error| failed(&error))?.map_err(|error| failed(&error))?;
        let mut pixels = Vec::with_capacity(size.width as usize * size.height as usize * 4);
        {
            let rows = self.buffer.get_mapped_range(..).map_err(|error| failed(&error))?;
            for row in rows.chunks_exact(self.bytes_per_row as usize) {
                pixels.extend_from_slice(&row[..size.width as usize * 4]);
            }
        }
        self.buffer.unmap();
        for pixel in pixels.as_chunks_mut::<4>().0 {
            if self.is_bgra {
                pixel.swap(0, 2);
            }
            pixel[3] = u8::MAX;
        }
        RgbaImage::from_raw(size.width, size.height, pixels)
            .ok_or_else(|| RenderError::Readback("fewer bytes than pixels".into()))
    }
}
