// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Verdict on generated leaves: could they be photographed ones, by twelve numbers?

use std::fmt::{self, Display, Formatter};

use super::folder::ComparedLeaf;
use super::levels::Levels;
use super::metric::{Distances, Metric};
use crate::TexgenError;

/// Metrics in which generated leaves must differ from each other.
const VARIETY: [Metric; 3] = [Metric::MeanColour, Metric::Patterns, Metric::Overlap];
/// Share of the photos' mean distance that they must differ by.
const LEAST_VARIETY: f32 = 0.5;
/// A leaf nearer to a photo than this share of the photos' mean distance, in colour and texture, is a copy.
const COPY: f32 = 0.25;
/// 1 - IoU below which an outline is a photo's.
const SAME_OUTLINE: f32 = 0.02;
/// Leaves that a verdict should rest on.
const ENOUGH: usize = 8;

/// Generated leaves against photos.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Levels that the medians are held against.
    pub levels: Levels,
    /// Name of each generated leaf and its mean distances to the photos.
    pub leaves: Vec<(String, Distances)>,
    /// Median of the mean distances over the leaves.
    pub median: Distances,
    /// True if the outlines were generated; otherwise the shape columns do not count.
    pub has_own_outlines: bool,
    /// Mean distance between generated leaves, with the least that is allowed.
    pub variety: Vec<Variety>,
    /// Names of leaves and of the photos that they copy.
    pub copies: Vec<(String, String)>,
}

/// Differences of generated leaves from each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variety {
    /// In what.
    pub metric: Metric,
    /// Mean over all pairs.
    pub mean: f32,
    /// Least mean allowed; `None` where there is no level.
    pub least: Option<f32>,
}

impl Comparison {
    /// Compares leaves; a leaf is not compared with a photo of the same file.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] without any pair to compare.
    pub fn of(
        generated: &[ComparedLeaf],
        photos: &[ComparedLeaf],
        levels: Levels,
    ) -> Result<Self, TexgenError> {
        let index = |metric: Metric| Metric::ALL.iter().position(|m| *m == metric).unwrap_or(0);
        let mut leaves = Vec::with_capacity(generated.len());
        let mut copies = Vec::new();
        let mut same_outlines = 0;
        for leaf in generated {
            let others = photos.iter().filter(|photo| photo.path != leaf.path);
            let to: Vec<(&ComparedLeaf, Distances)> =
                others.map(|photo| (photo, leaf.measured.distances(&photo.measured))).collect();
            if to.is_empty() {
                continue;
            }
            let mean = |k: usize| to.iter().map(|(_, d)| d[k]).sum::<f32>() / to.len() as f32;
            leaves.push((name(leaf), std::array::from_fn(mean)));
            let near = |d: &Distances, metric: Metric| {
                levels.mean[index(metric)].is_some_and(|mean| d[index(metric)] < COPY * mean)
            };
            let copied = to.iter().find(|(_, d)| near(d, Metric::MeanColour) && near(d, Metric::Patterns));
            copies.extend(copied.map(|(photo, _)| (name(leaf), name(photo))));
            let same = to.iter().any(|(_, d)| d[index(Metric::Overlap)] < SAME_OUTLINE);
            same_outlines += usize::from(same);
        }
        if leaves.is_empty() {
            let allowed = "at least one leaf and one photo of another file";
            return Err(TexgenError::out_of_range("leaves to compare", generated.len(), allowed));
        }
        let median = |k: usize| {
            let mut column: Vec<f32> = leaves.iter().map(|(_, d)| d[k]).collect();
            column.sort_by(f32::total_cmp);
            (column[(column.len() - 1) / 2] + column[column.len() / 2]) / 2.0
        };
        let pairs: Vec<Distances> = (0..generated.len())
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| generated[i].measured.distances(&generated[j].measured))
            .collect();
        let variety = VARIETY.map(|metric| {
            let k = index(metric);
            let mean = pairs.iter().map(|d| d[k]).sum::<f32>() / (pairs.len() as f32).max(1.0);
            Variety { metric, mean, least: levels.mean[k].map(|mean| LEAST_VARIETY * mean) }
        });
        Ok(Self {
            median: std::array::from_fn(median),
            has_own_outlines: 2 * same_outlines <= leaves.len(),
            variety: if pairs.is_empty() { Vec::new() } else { variety.into() },
            levels,
            leaves,
            copies,
        })
    }

    /// Verdict on a metric: the median is within the 90th percentile; `None` where it does not count.
    pub fn passes_in(&self, metric: Metric) -> Option<bool> {
        let k = Metric::ALL.iter().position(|m| *m == metric)?;
        let counts = self.has_own_outlines || !metric.is_shape();
        self.levels.p90[k].filter(|_| counts).map(|p90| self.median[k] <= p90)
    }

    /// Returns true if generated leaves differ enough from each other.
    pub fn is_varied(&self) -> bool {
        let counts = |variety: &&Variety| self.has_own_outlines || !variety.metric.is_shape();
        self.variety.iter().filter(counts).all(|v| v.least.is_none_or(|least| v.mean >= least))
    }

    /// Returns true if all columns that count, the variety and the rule against copies pass.
    pub fn passes(&self) -> bool {
        Metric::ALL.iter().all(|metric| self.passes_in(*metric) != Some(false))
            && self.is_varied()
            && self.copies.is_empty()
    }
}

/// Name of a leaf's file.
fn name(leaf: &ComparedLeaf) -> String {
    leaf.path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

impl Display for Comparison {
    /// A table with a line for each leaf, and the verdict in words.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let widest = self.leaves.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).max(12);
        let number = |value: Option<f32>| value.map_or_else(|| "-".into(), |value| format!("{value:.3}"));
        write!(f, "{:widest$}", "")?;
        for metric in Metric::ALL {
            write!(f, " {:>10}", metric.label())?;
        }
        let mut line = |name: &str, cells: &dyn Fn(usize) -> String| -> fmt::Result {
            write!(f, "\n{name:widest$}")?;
            (0..Metric::ALL.len()).try_for_each(|k| write!(f, " {:>10}", cells(k)))
        };
        for (name, distances) in &self.leaves {
            line(name, &|k| number(Some(distances[k])))?;
        }
        line("median", &|k| number(Some(self.median[k])))?;
        line("photos, mean", &|k| number(self.levels.mean[k]))?;
        line("photos, p90", &|k| number(self.levels.p90[k]))?;
        line("", &|k| match self.passes_in(Metric::ALL[k]) {
            Some(true) => "pass".into(),
            Some(false) => "FAIL".into(),
            None => "-".into(),
        })?;
        writeln!(f, "\n\n{}", self.levels.source)?;
        for variety in &self.variety {
            let Variety { metric, mean, least } = variety;
            let least = least.map_or_else(String::new, |least| format!(", at least {least:.3}"));
            writeln!(f, "variety in {}: {mean:.3}{least}", metric.label())?;
        }
        for (leaf, photo) in &self.copies {
            writeln!(f, "{leaf} copies {photo}")?;
        }
        if !self.has_own_outlines {
            writeln!(f, "the outlines are those of the photos: shape columns do not count")?;
        }
        if self.leaves.len() < ENOUGH {
            writeln!(f, "{} leaves; a verdict should rest on at least {ENOUGH}", self.leaves.len())?;
        }
        write!(f, "{}", if self.passes() { "PASS" } else { "FAIL" })
    }
}
