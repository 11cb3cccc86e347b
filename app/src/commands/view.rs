// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall view`: a window with the scene in it.

use std::path::PathBuf;

use clap::Args;

use super::render::{picture_size, within};
use super::scene::SceneArguments;
use super::sky::SkyArguments;
use crate::backend::BackendArguments;
use crate::viewer;

/// Options of `windfall view`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    sky: SkyArguments,
    #[command(flatten)]
    backend: BackendArguments,
    /// Width and height of the window in pixels.
    #[arg(long, value_name = "WxH", value_parser = picture_size)]
    size: Option<(u32, u32)>,
    /// What to show beside the scene from the beginning.
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    show: Vec<viewer::Show>,
    /// Group of the panel to begin with, in place of the usual ones; may be given more than once.
    #[arg(long, value_name = "GROUP", value_enum)]
    open: Vec<viewer::Group>,
    /// Save a picture of the window as PNG, panel and all, and quit.
    #[arg(long, value_name = "FILE.png")]
    screenshot: Option<PathBuf>,
    /// Seconds from opening the window to saving the picture.
    #[arg(long, value_name = "SECONDS", default_value = "2", requires = "screenshot", value_parser = delay)]
    after: f64,
}

/// Runs the command.
///
/// # Errors
/// Bad input, no display, no adapter, a lost device, a picture that cannot be saved.
pub fn run(arguments: Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.sky.apply(&mut scene, arguments.scene.name())?;
    viewer::run(viewer::Options {
        scene,
        name: arguments.scene.name().to_owned(),
        open: arguments.open,
        backend: arguments.backend,
        size: arguments.size,
        show: arguments.show,
        screenshot: arguments.screenshot.map(|path| (path, arguments.after)),
    })
}

fn delay(text: &str) -> Result<f64, String> {
    within(text, 0.0, 86_400.0)
}
