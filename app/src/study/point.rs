// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The points of a study: every combination of the values of its variations.

use std::collections::HashMap;

use anyhow::{anyhow, bail};
use windfall_core::Scene;

use super::drops::{DropOptions, drop_scene};
use super::place::SceneTree;
use super::variation::{MAX_POINTS, Setting, Variation};

/// One combination of values.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// The value of each variation, in their order.
    pub settings: Vec<Setting>,
    /// The scene in which every leaf falls once.
    pub scene: Scene,
}

impl Point {
    /// Settings of the point, for people.
    pub(crate) fn title(&self, variations: &[Variation]) -> String {
        let named = variations.iter().zip(&self.settings);
        let texts: Vec<_> = named.map(|(to, setting)| format!("{} = {}", to.path, setting.text)).collect();
        texts.join(", ")
    }
}

/// All points, those of the last variation following one another. `file` names the scene in errors.
///
/// # Errors
/// Too many points; a path that leads nowhere; a value that the scene may not have; a variation that drops do not
/// depend on.
pub(crate) fn points_of(
    scene: &Scene,
    file: &str,
    variations: &[Variation],
    options: &DropOptions,
) -> anyhow::Result<Vec<Point>> {
    let count = variations.iter().try_fold(1usize, |all, to| all.checked_mul(to.settings.len()));
    let Some(count) = count.filter(|count| (1..=MAX_POINTS).contains(count)) else {
        let counts: Vec<_> = variations.iter().map(|to| to.settings.len().to_string()).collect();
        bail!("--vary asks for {} points; allowed: 1 to {MAX_POINTS}", counts.join(" x "));
    };
    for (index, to) in variations.iter().enumerate() {
        if variations[..index].iter().any(|earlier| earlier.path == to.path) {
            bail!("--vary {}: varied twice; allowed: once", to.path);
        }
    }
    let tree = SceneTree::new(scene)?;
    let mut points: Vec<Point> = Vec::with_capacity(count);
    let mut known: HashMap<String, usize> = HashMap::new();
    for number in 0..count {
        let settings = settings_at(variations, number);
        let mut tree = tree.clone();
        for (to, setting) in variations.iter().zip(&settings) {
            tree.put(&to.path, setting).map_err(|error| anyhow!("--vary {error}"))?;
        }
        let varied = tree.scene()?;
        varied.validate(file)?;
        let point = Point { settings, scene: drop_scene(&varied, file, options)? };
        if let Some(earlier) = known.insert(point.scene.to_ron(), number) {
            let (one, other) = (points[earlier].title(variations), point.title(variations));
            bail!(
                "--vary: {one} and {other} let the same leaves fall the same way; allowed: what drops depend on \
                 (trees, their season, the view and, with --drops, a source's share alone are not)"
            );
        }
        points.push(point);
    }
    Ok(points)
}

/// The values of point `number`.
fn settings_at(variations: &[Variation], number: usize) -> Vec<Setting> {
    let mut left = number;
    let mut settings: Vec<_> = variations
        .iter()
        .rev()
        .map(|to| {
            let setting = to.settings[left % to.settings.len()].clone();
            left /= to.settings.len();
            setting
        })
        .collect();
    settings.reverse();
    settings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(variations: &[&str]) -> anyhow::Result<Vec<Point>> {
        let scene = Scene::preset("autumn-park").expect("a preset");
        let variations: Vec<_> = variations.iter().map(|text| text.parse().expect("a variation")).collect();
        let options = DropOptions { drops: Some(10), over_s: 1.0, seconds: 10.0, tracks: 0 };
        points_of(&scene, "autumn-park", &variations, &options)
    }

    #[test]
    fn points_are_all_combinations_in_order() {
        let points = points(&["wind.speed=1,2", "fall_speed=0.5,1,2"]).expect("allowed");
        let texts: Vec<_> = points
            .iter()
            .map(|point| point.settings.iter().map(|setting| setting.text.as_str()).collect::<Vec<_>>())
            .collect();
        assert_eq!(texts, [["1", "0.5"], ["1", "1"], ["1", "2"], ["2", "0.5"], ["2", "1"], ["2", "2"]]);
        assert_eq!(points[5].scene.fall_speed, 2.0, "the scene has the value");
        assert!(points.iter().all(|point| point.scene.leaf_count() == 10), "ten drops each");
    }

    #[test]
    fn studies_of_nothing_are_refused() {
        for (variations, essentials) in [
            (&["autumn=0,0.5"][..], &["autumn = 0", "autumn = 0.5", "same leaves"][..]),
            (&["wind.speed=1,2", "wind.speed=3"], &["wind.speed", "twice"]),
            (&["fall_speed=0..1/101", "wind.speed=0..1/100"], &["101 x 100", "1 to 10000"]),
            (&["wind.speed=90"], &["autumn-park: wind.speed is 90", "0 to 80"]),
        ] {
            let error = points(variations).expect_err("refused").to_string();
            for essential in essentials {
                assert!(error.contains(essential), "{variations:?}: {essential:?} is missing in {error:?}");
            }
        }
    }
}
