// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall motions`: the motion tables of a scene as text files, to be changed and named in a scene again.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use windfall_core::motion::MotionTables;
use windfall_core::scene::Species;
use windfall_core::{Scene, SceneError};

use crate::files::{OutputFolder, WriteError};
use crate::run::scene_arguments::{DEFAULT_SCENE, OutsideArguments};
use crate::run::terminal;

/// Options of `windfall motions`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Preset or path of a RON file [default: autumn-park].
    #[arg(value_name = "SCENE")]
    scene: Option<String>,
    #[command(flatten)]
    outside: OutsideArguments,
    /// Folder for the files, one SPECIES.motions for each species; made if it is not there.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// A scene that cannot be used, or a folder that cannot be written to; then no file has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let name = arguments.scene.as_deref().unwrap_or(DEFAULT_SCENE);
    let scene = Scene::load_naming(name, arguments.outside.named_files())?;
    check_names(&scene, name)?;
    let texts: Vec<String> = scene
        .species
        .iter()
        .map(|species| tables(&scene, species).map(|tables| tables.to_text()))
        .collect::<Result<_, _>>()?;

    let folder = OutputFolder::create(&arguments.out)?;
    let mut lines = String::new();
    for (species, text) in scene.species.iter().zip(texts) {
        let name = format!("{}.motions", species.name);
        let path = folder.partial().join(&name);
        fs::write(path, text).map_err(WriteError::at(folder.destination()))?;
        lines += &format!("{}\n", folder.destination().join(name).display());
    }
    folder.finish("")?;
    terminal::print(&lines)
}

/// Species become names of files, also on systems that ignore the case of letters.
fn check_names(scene: &Scene, file: &str) -> Result<(), SceneError> {
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | ' ');
    for (index, Species { name, .. }) in scene.species.iter().enumerate() {
        let lower = name.to_lowercase();
        let is_taken = scene.species[..index].iter().any(|other| other.name.to_lowercase() == lower);
        if is_taken || name.len() > 200 || !name.chars().all(plain) {
            return Err(SceneError::Field {
                file: file.into(),
                field: format!("species[{index}].name"),
                value: format!("{name:?}"),
                allowed: "for motion files: letters, digits, '-', '_' and spaces, unique in any case".into(),
            });
        }
    }
    Ok(())
}

/// The tables that a simulation of the species would use.
fn tables(scene: &Scene, species: &Species) -> anyhow::Result<MotionTables> {
    #[expect(clippy::cast_possible_truncation, reason = "low and high word")]
    let words = [scene.seed as u32, (scene.seed >> 32) as u32];
    let Some(path) = &species.tables else {
        return Ok(MotionTables::generate(species, words, scene.gravity_m_s2));
    };
    Ok(MotionTables::read(path)?)
}
