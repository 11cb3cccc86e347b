// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The event loop: opens the window, draws while time goes on, and otherwise when something changes.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use anyhow::anyhow;
use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Window, WindowId};

use windfall_core::scene::NamedFiles;
use windfall_core::{Scene, World};
use windfall_render::Quality;

use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::view::panel::Group;
use crate::view::tools::overlays::Show;
use crate::view::window::screenshot::Screenshot;
use crate::view::window::{Next, Viewer};

/// Size of the window in points of the display, unless the user says something else.
const DEFAULT_SIZE: (u32, u32) = (1280, 720);
/// Smallest size in points that leaves room for the panel and a picture.
const SMALLEST_SIZE: (u32, u32) = (480, 360);

/// Scene and options of the window.
#[derive(Clone, Debug)]
pub(crate) struct Options {
    /// The scene.
    pub scene: Scene,
    /// The preset's name or the file's path that it was loaded by.
    pub name: String,
    /// Files that scenes may name.
    pub outside: NamedFiles,
    /// The groups of the panel to begin with, all others closed; the usual ones if there are none.
    pub open: Vec<Group>,
    /// Backend that simulates.
    pub backend: BackendArguments,
    /// Effort spent on pictures; drafts on software adapters if nobody says.
    pub quality: Option<Quality>,
    /// Size of the window in pixels.
    pub size: Option<(u32, u32)>,
    /// Instruments that are shown from the beginning.
    pub show: Vec<Show>,
    /// A picture of the window to be saved after so many seconds; then the program ends.
    pub screenshot: Option<(PathBuf, f64)>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// A scene that cannot be used, no display, no adapter, a lost device, a picture that cannot be saved.
pub(crate) fn run(options: Options) -> anyhow::Result<()> {
    let screenshot =
        options.screenshot.as_ref().map(|(path, after_s)| Screenshot::prepare(path, *after_s)).transpose()?;
    // Without anything to complete an interrupt ends the program at once.
    let cancel = if screenshot.is_some() { Cancel::on_interrupt() } else { Cancel::default() };
    let event_loop = EventLoop::new().map_err(|error| no_display(&error))?;
    let world = World::build_named(&options.scene, &options.name)?;
    let display = Box::new(event_loop.owned_display_handle());
    let descriptor = windfall_wgpu::instance_descriptor().with_display_handle(display);
    let instance = wgpu::Instance::new(descriptor);
    let mut app =
        App { options, world: Some(world), screenshot, cancel, instance, viewer: None, outcome: Ok(()) };
    event_loop.run_app(&mut app).map_err(|error| no_display(&error))?;
    app.outcome
}

fn no_display(error: &dyn std::fmt::Display) -> anyhow::Error {
    let error = error.to_string();
    // The window library names first the place in its own source where the trouble was.
    let reason = match error.split_once(".rs:") {
        Some((_, place_and_reason)) => {
            place_and_reason.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':')
        }
        None => &error,
    };
    let reason = reason.trim().trim_end_matches('.');
    anyhow!("no window can be opened: {reason}; `windfall render` draws pictures and clips without one")
}

/// Title of the window while it shows a scene of this name.
pub(crate) fn title(scene: &str) -> String {
    format!("Windfall \u{2013} {scene}")
}

struct App {
    options: Options,
    /// Until the window is there.
    world: Option<World>,
    screenshot: Option<Screenshot>,
    cancel: Cancel,
    instance: wgpu::Instance,
    viewer: Option<Viewer>,
    outcome: anyhow::Result<()>,
}

impl App {
    fn open(&mut self, event_loop: &ActiveEventLoop) -> anyhow::Result<()> {
        let Some(world) = self.world.take() else { return Ok(()) };
        let name = &self.options.scene.name;
        let (width, height) = DEFAULT_SIZE;
        let (least_width, least_height) = SMALLEST_SIZE;
        let mut attributes = Window::default_attributes()
            .with_title(title(name))
            .with_inner_size(LogicalSize::new(width, height))
            .with_min_inner_size(LogicalSize::new(least_width, least_height));
        if let Some((width, height)) = self.options.size {
            attributes.inner_size = Some(PhysicalSize::new(width, height).into());
        }
        let window = event_loop.create_window(attributes).map_err(|error| no_display(&error))?;
        let screenshot = self.screenshot.take();
        let viewer = Viewer::new(self.instance.clone(), Arc::new(window), &self.options, &world, screenshot)?;
        self.viewer = Some(viewer);
        Ok(())
    }

    /// Ends the program when something failed.
    fn attempt(&mut self, event_loop: &ActiveEventLoop, result: anyhow::Result<()>) {
        if let Err(error) = result {
            self.outcome = Err(error);
            event_loop.exit();
        }
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let result = self.open(event_loop);
        self.attempt(event_loop, result);
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        let Some(viewer) = &mut self.viewer else { return };
        match event {
            WindowEvent::CloseRequested => {
                viewer.finish_recording();
                event_loop.exit();
            }
            WindowEvent::RedrawRequested => match viewer.frame() {
                Ok(Next::Quit) => event_loop.exit(),
                Ok(_) => {}
                Err(error) => {
                    let recovered = viewer.recover(error);
                    self.attempt(event_loop, recovered);
                }
            },
            event => viewer.on_event(&event),
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if self.outcome.is_err() || event_loop.exiting() {
            return;
        }
        let Some(viewer) = &mut self.viewer else { return };
        let interrupted = self.cancel.check().and(viewer.cancel().check());
        if interrupted.is_err() && viewer.finish_recording() {
            event_loop.exit();
            return;
        }
        match viewer.next() {
            Next::Frame => {
                viewer.request_frame();
                event_loop.set_control_flow(ControlFlow::Poll);
            }
            Next::At(time) if time <= Instant::now() => viewer.request_frame(),
            Next::At(time) => event_loop.set_control_flow(ControlFlow::WaitUntil(time)),
            Next::Event => event_loop.set_control_flow(ControlFlow::Wait),
            Next::Quit => event_loop.exit(),
        }
        self.attempt(event_loop, interrupted.map_err(Into::into));
    }
}
