// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The window with all that is in it, frame by frame.

mod actions;
mod dropped;
mod editing;
pub(crate) mod event_loop;
mod gui;
mod instruments;
mod leaf_making;
mod recording;
mod recovery;
mod scene_folder;
mod screen;
mod screenshot;
mod stepping;

use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::Context;
use windfall_core::scene::{NamedFiles, camera_at};
use windfall_core::{Scene, World};
use windfall_render::camera::Camera;
use windfall_render::{FrameInput, LensMoment, PictureTarget, Quality, Renderer};
use windfall_wgpu::Gpu;
use winit::event::WindowEvent;
use winit::window::Window;

use self::editing::{Document, renderer_of};
use self::instruments::Instruments;
use self::leaf_making::{ASK_AGAIN, LeafMaking, pictures_at_once};
use crate::leaves;
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::drawing::Drawing;
use crate::run::planned_loss::lose_if_planned;
use crate::run::progress::making_leaves;
use crate::run::terminal;
use crate::view::panel::Panel;
use crate::view::panel::action::Action;
use crate::view::panel::panel_input::Message;
use crate::view::session::Session;
use crate::view::session::undo::Undo;
use crate::view::tools::clip::Recording;
use crate::view::tools::meter::{Meter, Stage};
use crate::view::window::event_loop::Options;
use crate::view::window::gui::{Gui, Painting};
use crate::view::window::screen::Screen;
use crate::view::window::screenshot::Screenshot;

/// Time between two attempts to draw to a window that shows nothing.
const HIDDEN_PAUSE: Duration = Duration::from_millis(100);
/// Time that a message stays.
const MESSAGE_TIME: Duration = Duration::from_secs(8);

/// Time of the next frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Next {
    /// A frame, at once.
    Frame,
    /// A frame, then.
    At(Instant),
    /// Nothing until something happens.
    Event,
    /// The end.
    Quit,
}

/// The window.
pub(crate) struct Viewer {
    instance: wgpu::Instance,
    window: Arc<Window>,
    gpu: Gpu,
    screen: Screen,
    gui: Gui,
    panel: Panel,
    session: Session,
    /// The scene as it was loaded.
    loaded: Arc<Scene>,
    /// Files that scenes to be opened may name.
    outside: NamedFiles,
    history: Undo<Document>,
    /// Action that takes building anew, and the number of frames until then: a message announces it.
    building: Option<(Action, u8)>,
    renderer: Renderer,
    quality: Quality,
    /// Leaves that are being made, while small ones are shown.
    leaf_making: Option<LeafMaking>,
    camera: Camera,
    /// True if the camera follows the scene's keys, if it has any: until the user moves it.
    follows_path: bool,
    instruments: Instruments,
    meter: Meter,
    message: Option<(Message, Instant)>,
    screenshot: Option<Screenshot>,
    recording: Option<Recording>,
    /// Request to end, once there is a clip to complete before.
    cancel: Cancel,
    /// Path of the next clip, once it is known.
    record_to: Option<String>,
    /// Backend that was asked for.
    backend: BackendArguments,
    /// Times that the device was lost.
    losses: u32,
    next: Next,
    /// Something was changed after the panel was laid out: it does not show it yet.
    has_news: bool,
    /// There was nothing to draw before this frame.
    was_idle: bool,
    /// Moment of the frame for the lens, which adapts at once if nothing was drawn for a while.
    moment: LensMoment,
}

impl Viewer {
    pub(crate) fn new(
        instance: wgpu::Instance,
        window: Arc<Window>,
        options: &Options,
        world: &World,
        mut screenshot: Option<Screenshot>,
    ) -> anyhow::Result<Self> {
        let scene = &options.scene;
        let surface = Screen::surface(&instance, &window)?;
        let Drawing { device, gpu, adapter, reason, .. } =
            Drawing::choose(&options.backend, &instance, Some(&surface))?;
        let screen = Screen::new(Arc::clone(&window), surface, &adapter, &gpu)?;
        let session = Session::new(scene.clone(), world, &device, gpu.clone())?;
        let mut leaf_making = None;
        // A picture that is to be saved shows the leaves that it would show next time too.
        let atlas = if screenshot.is_some() {
            leaves::atlas_of(scene, &making_leaves())?
        } else {
            pictures_at_once(&mut leaf_making, session.scene())?
        };
        let is_software = gpu.info().device_type == wgpu::DeviceType::Cpu;
        let usual = if is_software { Quality::Draft } else { Quality::Full };
        let quality = options.quality.unwrap_or(usual);
        let (format, size) = (screen.format(), screen.size());
        let renderer = renderer_of(&gpu, &world.compiled, scene, &atlas, format, size, quality)?;
        let gui = Gui::new(&window, &gpu, screen.format());
        gpu.check()?;
        if let Some(reason) = reason {
            terminal::note(&reason);
        }
        let told = is_software && options.quality.is_none();
        let message = told.then(|| {
            let text =
                format!("Pictures are drafts: {} is no hardware. Simulation has full ones.", gpu.info().name);
            (Message { text, is_error: false }, Instant::now())
        });
        if let Some(screenshot) = &mut screenshot {
            screenshot.begin();
        }
        Ok(Self {
            instruments: Instruments::new(gpu.device(), &options.show),
            camera: Camera::from(&scene.view.camera),
            follows_path: true,
            instance,
            window,
            gpu,
            screen,
            gui,
            panel: Panel::new(&options.name, options.open.clone()),
            loaded: Arc::clone(session.scene()),
            outside: options.outside,
            history: Undo::default(),
            building: None,
            session,
            renderer,
            quality,
            leaf_making,
            meter: Meter::new(),
            message,
            screenshot,
            recording: None,
            cancel: Cancel::default(),
            record_to: None,
            backend: options.backend.clone(),
            losses: 0,
            next: Next::Frame,
            has_news: false,
            was_idle: true,
            moment: LensMoment::FIRST,
        })
    }

    /// Hands an event of the window on.
    pub(crate) fn on_event(&mut self, event: &WindowEvent) {
        let repaint = self.gui.on_event(&self.window, event);
        if repaint || matches!(event, WindowEvent::Resized(_) | WindowEvent::Occluded(false)) {
            self.next = Next::Frame;
        }
    }

    /// Request to end the program.
    pub(crate) fn cancel(&self) -> &Cancel {
        &self.cancel
    }

    /// Time of the next frame.
    pub(crate) fn next(&self) -> Next {
        self.next
    }

    /// Asks the window system for a frame.
    pub(crate) fn request_frame(&self) {
        self.window.request_redraw();
    }

    /// Does everything that makes a frame.
    ///
    /// # Errors
    /// A lost device or window, a picture that cannot be saved.
    pub(crate) fn frame(&mut self) -> anyhow::Result<Next> {
        lose_if_planned(&self.gpu, self.session.simulator().clock().step().into());
        self.gpu.check()?;
        let frame_s = if self.was_idle { 0.0 } else { self.meter.begin_frame() };
        if self.was_idle {
            self.meter.resume();
        }
        if !self.screen.follow_window(&self.gpu) {
            self.next = Next::At(Instant::now() + HIDDEN_PAUSE);
            self.was_idle = true;
            return Ok(self.next);
        }
        // A clip that is recorded goes on by its own frames.
        let passed_s = if self.recording.is_some() { 0.0 } else { frame_s };
        self.moment = if self.was_idle { LensMoment::FIRST } else { self.moment.after(passed_s) };
        self.has_news = false;
        self.build_what_was_announced()?;
        self.take_made_leaves()?;
        let since = Instant::now();
        self.simulate(frame_s)?;
        self.meter.add(Stage::Simulate, since);
        let painting = self.panel()?;
        if self.next == Next::Quit {
            self.finish_recording();
            return Ok(Next::Quit);
        }
        if !self.session.is_seeking() {
            self.record_frame()?;
        }

        let since = Instant::now();
        let texture = self.screen.acquire(&self.instance, &self.gpu)?;
        self.meter.add(Stage::Wait, since);
        let is_shown = texture.is_some();
        if let Some(texture) = texture {
            let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
            let encoder = self.encode(&view, &painting)?;
            let since = Instant::now();
            self.gpu.queue().submit([encoder.finish()]);
            self.meter.add(Stage::Draw, since);
            self.window.pre_present_notify();
            let queue = self.gpu.queue();
            self.meter.measure(Stage::Wait, || queue.present(texture));
            // Not before there is something to see.
            self.leaf_making.as_mut().map_or(Ok(()), LeafMaking::begin)?;
        }
        if self.screenshot.as_mut().is_some_and(Screenshot::is_due) {
            self.take_screenshot(&painting)?;
            return Ok(Next::Quit);
        }
        self.gui.clean_up(&painting);
        self.next = self.after(&painting, is_shown);
        self.was_idle = self.next != Next::Frame;
        Ok(self.next)
    }

    fn after(&self, painting: &Painting, is_shown: bool) -> Next {
        let now = Instant::now();
        if !is_shown {
            return Next::At(now + HIDDEN_PAUSE);
        }
        if !self.session.pace.is_paused
            || self.session.is_seeking()
            || self.recording.is_some()
            || self.has_news
            || self.screenshot.is_some()
        {
            return Next::Frame;
        }
        // A message has to go away again.
        let message_ends = self.message.as_ref().map(|(_, since)| *since + MESSAGE_TIME);
        let panel_wants = now.checked_add(painting.again_after);
        let leaves_may_be_made = self.leaf_making.as_ref().map(|_| now + ASK_AGAIN);
        match [message_ends, panel_wants, leaves_may_be_made].into_iter().flatten().min() {
            None => Next::Event,
            Some(time) if time <= now => Next::Frame,
            Some(time) => Next::At(time),
        }
    }

    /// Shows the panel, steers the camera and handles the actions.
    fn panel(&mut self) -> anyhow::Result<Painting> {
        self.message.take_if(|(_, since)| since.elapsed() >= MESSAGE_TIME);
        self.observe()?;
        let input = self.panel_input()?;
        let since = Instant::now();
        let time_s = self.session.simulator().clock().seconds();
        if self.follows_path
            && let Some(camera) = camera_at(&self.session.scene().view.path, time_s)
        {
            self.camera = Camera::from(&camera);
        }
        let before = self.camera;
        let Self { gui, panel, camera, window, gpu, renderer, .. } = self;
        let mut actions = Vec::new();
        let painting = gui.run(window, gpu, |ui| actions = panel.show(ui, &input, camera, renderer.land()));
        self.follows_path &= self.camera == before;
        self.meter.add(Stage::Panel, since);
        for action in actions {
            self.has_news = true;
            self.announce_or_handle(action)?;
        }
        Ok(painting)
    }

    /// Encodes the scene beside the panel, and the panel.
    fn encode(
        &mut self,
        view: &wgpu::TextureView,
        painting: &Painting,
    ) -> anyhow::Result<wgpu::CommandEncoder> {
        let (origin, size) = self.panel.picture_area(self.screen.size());
        let size = self.recording.as_ref().map_or(size, |recording| recording.size);
        self.renderer.resize(size).context("the window is too large")?;
        let clock = self.session.simulator().clock();
        let (time_s, step) = (clock.seconds(), clock.step());
        let since = Instant::now();
        let is_far = self.session.host_leaves().is_none();
        let columns = self.session.columns()?;
        self.meter.add(Stage::Upload, since);
        let since = Instant::now();
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let input = FrameInput { camera: self.camera, time_s, moment: self.moment, origin };
        self.renderer.draw(&mut encoder, view, &columns, &input);
        self.instruments.ask(&mut encoder, &columns, step, is_far);
        self.meter.add(Stage::Draw, since);
        let since = Instant::now();
        self.gui.paint(&self.gpu, &mut encoder, view, self.screen.size(), painting);
        self.meter.add(Stage::Panel, since);
        Ok(encoder)
    }

    /// Draws what the window shows once more, and saves it.
    fn take_screenshot(&mut self, painting: &Painting) -> anyhow::Result<()> {
        let Some(screenshot) = self.screenshot.take() else { return Ok(()) };
        let device = self.gpu.device().clone();
        let target = PictureTarget::with_format(&device, self.screen.size(), self.screen.format())?;
        let encoder = self.encode(&target.view(), painting)?;
        let picture = target.submit_and_read(&device, self.gpu.queue(), encoder);
        self.gpu.check()?;
        screenshot.save(&picture?)
    }
}
