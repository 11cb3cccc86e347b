// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall view`: a window with the scene in it.

use std::path::PathBuf;

use clap::Args;

use crate::run::backend::BackendArguments;
use crate::run::parse::picture_size;
use crate::run::parse::within;
use crate::run::quality_arguments::QualityName;
use crate::run::scene_arguments::SceneArguments;
use crate::run::sky_arguments::SkyArguments;
use crate::view;

/// Options of `windfall view`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    sky: SkyArguments,
    #[command(flatten)]
    backend: BackendArguments,
    /// Effort spent on each picture [default: draft if there is no hardware graphics adapter, else full].
    #[arg(long, value_enum)]
    quality: Option<QualityName>,
    /// Width and height of the window in pixels.
    #[arg(long, value_name = "WxH", value_parser = picture_size)]
    size: Option<(u32, u32)>,
    /// Instruments that are shown from the beginning.
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    show: Vec<view::Show>,
    /// Group of the panel to begin with, in place of the usual ones; may be given more than once.
    #[arg(long, value_name = "GROUP", value_enum)]
    open: Vec<view::Group>,
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
pub(crate) fn run(arguments: Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.sky.apply(&mut scene, arguments.scene.name())?;
    view::run(view::Options {
        scene,
        name: arguments.scene.name().to_owned(),
        outside: arguments.scene.outside.named_files(),
        open: arguments.open,
        backend: arguments.backend,
        quality: arguments.quality.map(Into::into),
        size: arguments.size,
        show: arguments.show,
        screenshot: arguments.screenshot.map(|path| (path, arguments.after)),
    })
}

fn delay(text: &str) -> Result<f64, String> {
    within(text, 0.0, 86_400.0)
}
