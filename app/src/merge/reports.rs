// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Adds up reports of shards to that of the whole.

use std::fs;
use std::path::Path;

use anyhow::{Context, anyhow, bail};
use serde_json::{Value, json};

use super::shard_files::ShardFiles;
use crate::files::{Identity, OutputFile, WriteError};

/// Key of the run that a report is of: all that its outcome depends on, but for the shard.
pub(crate) const RUN: &str = "run";

/// Writes the report of the whole, and returns it.
///
/// # Errors
/// Reports of other scenes, seeds, steps or versions; a file that is no report; errors of the system.
pub(crate) fn join(files: &ShardFiles) -> anyhow::Result<Value> {
    let reports = files.parts.iter().map(|path| read(path)).collect::<anyhow::Result<Vec<_>>>()?;
    let run = Identity::new(reports[0][RUN].clone());
    for (path, report) in files.parts.iter().zip(&reports) {
        let other = Identity::new(report[RUN].clone()).text();
        if other != run.text() {
            bail!(
                "{}: is of another run than {}: {}",
                path.display(),
                files.parts[0].display(),
                run.difference(&other)
            );
        }
    }
    let whole = sum(&reports).ok_or_else(|| anyhow!("{}: a report lacks numbers", files.whole.display()))?;
    OutputFile::write_whole(&files.whole, format!("{whole}\n").as_bytes())?;
    Ok(whole)
}

fn read(path: &Path) -> anyhow::Result<Value> {
    let text = fs::read_to_string(path).map_err(WriteError::at(path))?;
    let report: Value =
        serde_json::from_str(&text).with_context(|| format!("{}: is no report", path.display()))?;
    if !report[RUN].is_object() {
        bail!("{}: is no report of `windfall simulate --report`", path.display());
    }
    Ok(report)
}

/// The report of the whole: that of the first shard, which has what is not divided, with sums, extremes and means over all.
fn sum(reports: &[Value]) -> Option<Value> {
    let mut whole = reports[0].clone();
    let of = |path: &str| reports.iter().map(move |report| report.pointer(path)).collect::<Option<Vec<_>>>();
    let numbers = |path: &str| of(path)?.into_iter().map(Value::as_f64).collect::<Option<Vec<_>>>();
    let totals = numbers("/leaves/total")?;
    for path in ["total", "attached", "falling", "resting", "dormant"].map(|key| format!("/leaves/{key}")) {
        let counts = of(&path)?.into_iter().map(Value::as_u64).collect::<Option<Vec<_>>>()?;
        *whole.pointer_mut(&path)? = counts.iter().sum::<u64>().into();
    }
    for path in ["count", "segments", "leaves_shed"].map(|key| format!("/trees/{key}")) {
        let counts = of(&path)?.into_iter().map(Value::as_u64).collect::<Option<Vec<_>>>()?;
        *whole.pointer_mut(&path)? = counts.iter().sum::<u64>().into();
    }
    for path in ["/trees/max_joint_angle_rad", "/trees/tip_speed_max_m_s"] {
        *whole.pointer_mut(path)? = numbers(path)?.into_iter().fold(0.0, f64::max).into();
    }
    for key in ["mean_position_m", "mean_velocity_m_s"] {
        let mut means = [0.0; 3];
        for (axis, mean) in means.iter_mut().enumerate() {
            let weighted = numbers(&format!("/{key}/{axis}"))?;
            let sum: f64 = weighted.iter().zip(&totals).map(|(value, total)| value * total).sum();
            *mean = sum / totals.iter().sum::<f64>().max(1.0);
        }
        whole[key] = json!(means);
    }
    for key in ["leaf_steps_per_s", "cpu_s"] {
        whole[key] = numbers(&format!("/{key}"))?.iter().sum::<f64>().into();
    }
    for key in ["backend", "adapter"] {
        let mut names: Vec<_> =
            of(&format!("/{key}"))?.into_iter().map(Value::as_str).collect::<Option<_>>()?;
        names.sort_unstable();
        names.dedup();
        whole[key] = names.join(", ").into();
    }
    let hashes = of("/state_hash")?.into_iter().map(|hash| u64::from_str_radix(hash.as_str()?, 16).ok());
    let hash = hashes.collect::<Option<Vec<_>>>()?.into_iter().fold(0_u64, u64::wrapping_add);
    whole["state_hash"] = format!("{hash:016x}").into();
    whole["shard"] = Value::Null;
    Some(whole)
}
