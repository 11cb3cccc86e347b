// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Photos on the command line, each with a mask of its own: `--photo a.png --mask a.mask.png --photo b.png`.

use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, value_parser};

/// Photos and their masks.
#[derive(Clone, Debug, Default)]
pub(super) struct PhotoArguments {
    /// Photo files, each with its mask file if one was given.
    pub(super) photos: Vec<(PathBuf, Option<PathBuf>)>,
}

impl Args for PhotoArguments {
    fn augment_args(command: Command) -> Command {
        let path = |name: &'static str, value: &'static str| {
            Arg::new(name)
                .long(name)
                .value_name(value)
                .action(ArgAction::Append)
                .value_parser(value_parser!(PathBuf))
        };
        command
            .arg(path("photo", "FILE").help("Photo of a leaf to take after; give several for more variety"))
            .arg(
                path("mask", "FILE")
                    .help("Mask of the photo before it, light where the leaf is [default: NAME.mask.png beside it, or the plain background]"),
            )
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for PhotoArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |name: &str| -> Vec<(usize, PathBuf)> {
            let places = matches.indices_of(name).into_iter().flatten();
            places.zip(matches.get_many::<PathBuf>(name).into_iter().flatten().cloned()).collect()
        };
        let photos = given("photo");
        let mut masks: Vec<Option<PathBuf>> = vec![None; photos.len()];
        for (place, mask) in given("mask") {
            let before = photos.iter().rposition(|(photo, _)| *photo < place);
            match before.map(|index| &mut masks[index]) {
                Some(slot @ None) => *slot = Some(mask),
                _ => {
                    let message = format!("--mask {} needs a --photo of its own before it\n", mask.display());
                    return Err(clap::Error::raw(ErrorKind::ArgumentConflict, message));
                }
            }
        }
        let photos = photos.into_iter().map(|(_, photo)| photo).zip(masks);
        Ok(Self {
            photos: photos.map(|(photo, mask)| (photo.clone(), mask.or_else(|| beside(&photo)))).collect(),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The mask that lies beside a photo, if one does.
fn beside(photo: &Path) -> Option<PathBuf> {
    Some(photo.with_extension("mask.png")).filter(|mask| mask.is_file())
}
