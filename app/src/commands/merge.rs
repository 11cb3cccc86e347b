// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall merge`: what shards have written, put together.

use std::path::PathBuf;

use clap::Args;
use serde_json::Value;

use crate::merge::shard_files::{ShardFiles, find};
use crate::merge::{reports, stages, tables};
use crate::run::terminal;

/// Options of `windfall merge`.
///
/// Reports (.json) of `windfall simulate --shard` are checked to be of one run and added up, tables (.csv) of tracks and exports are joined row
/// by row, and USD stages (.usda) get a root layer over them. The hash is that of a run of the whole scene, and so are the tables, byte
/// for byte. Other files of shards, such as checkpoints, stay as they are.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Folder with the files of all shards: NAME.shard-1-of-8.json and so on. The whole is written to NAME.json beside them.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print the report of the whole as one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

/// Runs the command. Everything that is missing is found before anything is written.
///
/// # Errors
/// Shards that are missing, of different divisions or of different runs; files that cannot be read or written.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let found = find(&arguments.folder)?;
    let (of_runs, rest): (Vec<_>, Vec<_>) = found.into_iter().partition(|files| has_ending(files, "json"));
    // Reports first: they tell whether the shards belong together.
    let mut text = String::new();
    for files in &of_runs {
        let report = reports::join(files)?;
        if arguments.json {
            text += &format!("{report}\n");
        } else {
            text += &format!("{}: {}\n", files.whole.display(), in_words(&report, files.parts.len()));
        }
    }
    for files in &rest {
        if has_ending(files, "csv") {
            tables::join(files)?;
        } else if has_ending(files, "usda") {
            stages::join(files)?;
        } else {
            continue;
        }
        if !arguments.json {
            text += &format!("{}: of {} shards\n", files.whole.display(), files.parts.len());
        }
    }
    terminal::print(&text)
}

fn has_ending(files: &ShardFiles, ending: &str) -> bool {
    files.whole.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// The report of a whole on one line.
fn in_words(report: &Value, shards: usize) -> String {
    let leaves = &report["leaves"];
    let of = |state: &str| leaves[state].as_u64().unwrap_or(0);
    format!(
        "state hash {} after {} steps; {} leaves: {} attached, {} falling, {} resting; of {shards} shards",
        report["state_hash"].as_str().unwrap_or_default(),
        report["steps"],
        of("total"),
        of("attached"),
        of("falling"),
        of("resting"),
    )
}
