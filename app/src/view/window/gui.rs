// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Between egui and the window on one side, the device on the other.

use std::time::Duration;

use egui_wgpu::ScreenDescriptor;
use windfall_wgpu::Gpu;
use winit::event::WindowEvent;
use winit::window::Window;

use crate::view::panel::style;

/// The panel's library and its pipeline.
pub(crate) struct Gui {
    context: egui::Context,
    state: egui_winit::State,
    renderer: egui_wgpu::Renderer,
}

/// Outcome of a pass of the panel's code.
pub(crate) struct Painting {
    primitives: Vec<egui::ClippedPrimitive>,
    pixels_per_point: f32,
    freed: Vec<egui::TextureId>,
    /// Time until the panel wants to be drawn again.
    pub(crate) again_after: Duration,
}

impl Gui {
    pub(crate) fn new(window: &Window, gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let context = egui::Context::default();
        style::apply(&context);
        let largest = usize::try_from(gpu.device().limits().max_texture_dimension_2d).ok();
        // A display density is far from where single precision ends.
        #[expect(clippy::cast_possible_truncation, reason = "a small number")]
        let density = window.scale_factor() as f32;
        let state = egui_winit::State::new(
            context.clone(),
            egui::ViewportId::ROOT,
            window,
            Some(density),
            Some(winit::window::Theme::Dark),
            largest,
        );
        let options = egui_wgpu::RendererOptions::default();
        let renderer = egui_wgpu::Renderer::new(gpu.device(), format, options);
        Self { context, state, renderer }
    }

    /// Begins anew on another device; what is open, and where, stays.
    pub(crate) fn reopen(&mut self, window: &Window, gpu: &Gpu, format: wgpu::TextureFormat) {
        let memory = self.context.memory(Clone::clone);
        *self = Self::new(window, gpu, format);
        self.context.memory_mut(|fresh| *fresh = memory);
    }

    /// Hands an event on; true if something has to be drawn anew.
    pub(crate) fn on_event(&mut self, window: &Window, event: &WindowEvent) -> bool {
        self.state.on_window_event(window, event).repaint
    }

    /// Runs the panel's code, which may happen more than once.
    pub(crate) fn run(&mut self, window: &Window, gpu: &Gpu, show: impl FnMut(&mut egui::Ui)) -> Painting {
        let input = self.state.take_egui_input(window);
        let mut output = self.context.run_ui(input, show);
        self.state.handle_platform_output(window, output.platform_output);
        // The panel wants every change applied, also when the frame is not shown in the end.
        for (id, changes) in output.textures_delta.set.drain() {
            for change in changes {
                self.renderer.update_texture(gpu.device(), gpu.queue(), id, &change);
            }
        }
        let again_after = output.viewport_output.values().map(|viewport| viewport.repaint_delay).min();
        Painting {
            primitives: self.context.tessellate(output.shapes, output.pixels_per_point),
            pixels_per_point: output.pixels_per_point,
            freed: output.textures_delta.free.drain().collect(),
            again_after: again_after.unwrap_or(Duration::MAX),
        }
    }

    /// Encodes the panel over what `view`, of `size` pixels, already shows.
    pub(crate) fn paint(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        view: &wgpu::TextureView,
        (width, height): (u32, u32),
        painting: &Painting,
    ) {
        let descriptor =
            ScreenDescriptor { size_in_pixels: [width, height], pixels_per_point: painting.pixels_per_point };
        let (device, queue) = (gpu.device(), gpu.queue());
        // No callbacks are registered, so there are no command buffers of theirs.
        let _ = self.renderer.update_buffers(device, queue, encoder, &painting.primitives, &descriptor);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("panel"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        self.renderer.render(&mut pass.forget_lifetime(), &painting.primitives, &descriptor);
    }

    /// Frees the textures that the painting was the last to use; call it after submitting.
    pub(crate) fn clean_up(&mut self, painting: &Painting) {
        for id in &painting.freed {
            self.renderer.free_texture(id);
        }
    }
}
