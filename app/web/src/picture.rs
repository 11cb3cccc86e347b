// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The picture in a canvas: a WebGPU device, and the renderer of the scene on it.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use web_sys::HtmlCanvasElement;
use wgpu::CurrentSurfaceTexture;
use windfall_render::camera::Camera;
use windfall_render::light::Daylight;
use windfall_render::trees::SceneTrees;
use windfall_render::{FrameInput, LensMoment, RenderScene, Renderer, RendererOptions};
use windfall_texgen::Atlas;
use windfall_wgpu::{Gpu, WorldBuffers};

use crate::error::WebError;
use crate::session::Session;

/// Least height of the camera above the land, in metres.
const CLEARANCE_M: f32 = 0.1;

/// The first trouble of a device.
type Trouble = Arc<Mutex<Option<String>>>;

/// A canvas, its device, and the renderer of a scene.
#[derive(Debug)]
pub(crate) struct Picture {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Gpu,
    adapter: String,
    lost: Trouble,
    complaint: Trouble,
    /// Frames that the device still works on.
    pending: Arc<AtomicU32>,
    shown: Option<Shown>,
}

/// Renderer of a scene and the copy of its world on the device.
#[derive(Debug)]
struct Shown {
    renderer: Renderer,
    buffers: WorldBuffers,
    /// Step that the copy is of.
    copied: Option<u32>,
    moment: Option<LensMoment>,
}

/// Keeps the first message.
fn note(trouble: &Trouble, message: String) {
    trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
}

fn no_device(reason: impl ToString) -> WebError {
    WebError::NoDevice { reason: reason.to_string() }
}

impl Picture {
    /// A picture in a canvas, of nothing yet.
    ///
    /// # Errors
    /// [`WebError::NoDevice`] where there is no WebGPU.
    pub(crate) async fn open(canvas: HtmlCanvasElement) -> Result<Self, WebError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::BROWSER_WEBGPU;
        let (width, height) = (canvas.width().max(1), canvas.height().max(1));
        let instance = wgpu::Instance::new(descriptor);
        let surface = instance.create_surface(wgpu::SurfaceTarget::Canvas(canvas)).map_err(no_device)?;
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter = instance.request_adapter(&options).await.map_err(no_device)?;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("windfall"),
            required_features: wgpu::Features::TIMESTAMP_QUERY & adapter.features(),
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = adapter.request_device(&descriptor).await.map_err(no_device)?;
        let (lost, complaint) = (Trouble::default(), Trouble::default());
        let kept = Arc::clone(&lost);
        device.set_device_lost_callback(move |reason, message| note(&kept, format!("{reason:?} {message}")));
        let kept = Arc::clone(&complaint);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| note(&kept, error.to_string())));
        let mut config = surface
            .get_default_config(&adapter, width, height)
            .ok_or_else(|| no_device("the adapter cannot draw to a canvas"))?;
        // The renderer encodes gamma by itself.
        config.format = config.format.remove_srgb_suffix();
        surface.configure(&device, &config);
        let info = adapter.get_info();
        let name = if info.name.is_empty() { "WebGPU".to_owned() } else { info.name.clone() };
        let gpu = Gpu::from_parts(info, device, queue);
        let pending = Arc::default();
        Ok(Self { surface, config, gpu, adapter: name, lost, complaint, pending, shown: None })
    }

    /// Name of the adapter.
    pub(crate) fn adapter(&self) -> &str {
        &self.adapter
    }

    /// The device.
    pub(crate) fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Reason for the device's loss, if it is lost.
    pub(crate) fn lost(&self) -> Option<String> {
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The first error of the device since this was asked last, if there was one.
    pub(crate) fn take_complaint(&self) -> Option<String> {
        self.complaint.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Destroys the device, as a driver may at any time.
    pub(crate) fn lose(&self) {
        self.gpu.device().destroy();
    }

    /// Returns true while the device works on a frame.
    pub(crate) fn is_busy(&self) -> bool {
        self.pending.load(Ordering::Relaxed) > 0
    }

    /// Draws the scene of this session from now on.
    ///
    /// # Errors
    /// A scene or a size that the device cannot draw.
    pub(crate) fn show(&mut self, session: &Session, atlas: &Atlas) -> Result<(), WebError> {
        // Memory of the former scene is given back before that of the next is asked for.
        self.shown = None;
        let (scene, world) = (session.scene(), session.world());
        let scene_trees = SceneTrees::of(scene, world.compiled.forest());
        let subject = RenderScene::of(scene, &world.compiled, &scene_trees, atlas);
        let renderer = Renderer::new(
            self.gpu.device(),
            self.gpu.queue(),
            subject,
            self.config.format,
            (self.config.width, self.config.height),
            RendererOptions::for_scene(scene),
        )?;
        let buffers = WorldBuffers::new(&self.gpu, world)?;
        self.shown = Some(Shown { renderer, buffers, copied: None, moment: None });
        Ok(())
    }

    /// Draws under this sky from now on.
    pub(crate) fn set_daylight(&mut self, daylight: Daylight) {
        if let Some(shown) = &mut self.shown {
            shown.renderer.set_daylight(daylight);
        }
    }

    /// Draws pictures of another size from now on, as large as the device can.
    ///
    /// # Errors
    /// A size that the renderer refuses; it keeps its own.
    pub(crate) fn resize(&mut self, width: u32, height: u32) -> Result<(), WebError> {
        let limit = self.gpu.device().limits().max_texture_dimension_2d;
        let size = (width.clamp(1, limit), height.clamp(1, limit));
        if size != (self.config.width, self.config.height) {
            (self.config.width, self.config.height) = size;
            self.surface.configure(self.gpu.device(), &self.config);
            if let Some(shown) = &mut self.shown {
                shown.renderer.resize(size)?;
            }
        }
        Ok(())
    }

    /// Draws the world of the session as it is, `since_s` seconds after the picture before; returns true if there was a texture to draw to.
    ///
    /// # Errors
    /// A world of another scene than the one shown.
    pub(crate) fn draw(&mut self, session: &Session, camera: Camera, since_s: f64) -> Result<bool, WebError> {
        let Some(shown) = &mut self.shown else { return Ok(false) };
        let texture = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            _ => return Ok(false),
        };
        let world = session.world();
        if shown.copied != Some(world.clock.step()) {
            shown.buffers.write(&self.gpu, world)?;
            shown.copied = Some(world.clock.step());
        }
        let moment = shown.moment.map_or(LensMoment::FIRST, |moment| moment.after(since_s));
        shown.moment = Some(moment);
        let mut camera = camera;
        camera.stay_above(shown.renderer.land(), CLEARANCE_M);
        let input = FrameInput { camera, time_s: world.clock.seconds(), moment, origin: (0, 0) };
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        shown.renderer.draw(&mut encoder, &view, &shown.buffers.columns(), &input);
        self.gpu.queue().submit([encoder.finish()]);
        let pending = Arc::clone(&self.pending);
        pending.fetch_add(1, Ordering::Relaxed);
        self.gpu.queue().on_submitted_work_done(move || {
            pending.fetch_sub(1, Ordering::Relaxed);
        });
        self.gpu.queue().present(texture);
        Ok(true)
    }

    /// Milliseconds that the device last spent on each pass, where it has timestamps.
    pub(crate) fn timings(&mut self) -> Vec<(&'static str, f32)> {
        self.shown.as_mut().map_or_else(Vec::new, |shown| shown.renderer.timings())
    }
}
