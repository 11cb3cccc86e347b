// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Puts values into scenes at places that a path names: the scene as a tree of values, whatever fields it has.

use anyhow::anyhow;
use serde_json::Value;
use windfall_core::Scene;

use super::variation::Setting;

/// A scene as a tree: structures are objects, lists arrays, a variant `Name(…)` an object with that one key.
#[derive(Clone, Debug)]
pub struct SceneTree {
    root: Value,
}

impl SceneTree {
    /// The tree of a scene.
    ///
    /// # Errors
    /// None for scenes that are valid; numbers that are not finite have no place in a tree.
    pub fn new(scene: &Scene) -> anyhow::Result<Self> {
        Ok(Self { root: serde_json::to_value(scene)? })
    }

    /// Puts a value where `path` leads. A path leads through variants by their names or without, as in
    /// `wind.speed.MetresPerSecond` and `wind.speed`; a name other than the scene's puts that variant in its place.
    ///
    /// # Errors
    /// A path that leads nowhere, with what there is; a value that does not fit there.
    pub fn put(&mut self, path: &str, setting: &Setting) -> anyhow::Result<()> {
        let segments: Vec<&str> = path.split('.').collect();
        let before = self.root.clone();
        let place = find(&mut self.root, &segments).map_err(|found| {
            let Found { parent, segment, has } = found;
            anyhow!("{path}: no '{segment}' in {parent}; there: {has}")
        })?;
        let old = std::mem::replace(inside(place), setting.value.clone());
        if old.is_object() || old.is_array() {
            let has = names(&old);
            self.root = before;
            return Err(anyhow!("{path}: not one value but several; there: {has}"));
        }
        if let Err(error) = self.scene() {
            self.root = before;
            return Err(anyhow!("{path}: {} does not fit where {old} is: {error}", setting.text));
        }
        Ok(())
    }

    /// Label of an axis along which `path` varies: the path, and the variant that the number belongs to.
    pub(crate) fn label(&self, path: &str) -> String {
        let segments: Vec<&str> = path.split('.').collect();
        let mut root = self.root.clone();
        let place = find(&mut root, &segments).ok();
        match place.and_then(|place| tag(place)) {
            Some(variant) => format!("{path} ({variant})"),
            None => path.into(),
        }
    }

    /// The scene that the tree says; nothing of it has been validated.
    ///
    /// # Errors
    /// A tree that says none.
    pub fn scene(&self) -> Result<Scene, serde_json::Error> {
        serde_json::from_value(self.root.clone())
    }
}

/// Error at the end of a path that leads nowhere.
struct Found {
    parent: String,
    segment: String,
    has: String,
}

/// The place that a path leads to.
fn find<'a>(root: &'a mut Value, segments: &[&str]) -> Result<&'a mut Value, Found> {
    let mut place = root;
    for (depth, segment) in segments.iter().enumerate() {
        let is_variant = segment.starts_with(|c: char| c.is_ascii_uppercase());
        if is_variant && (tag(place).is_some() || place.is_string()) {
            if tag(place) != Some(segment) {
                *place = serde_json::json!({ *segment: 0 });
            }
        } else {
            place = inside(place);
        }
        let has = names(place);
        let next = match place {
            Value::Object(fields) => fields.get_mut(*segment),
            Value::Array(entries) => segment.parse().ok().and_then(|index: usize| entries.get_mut(index)),
            _ => None,
        };
        let parent = if depth == 0 { "the scene".into() } else { segments[..depth].join(".") };
        place = next.ok_or_else(|| Found { parent, segment: (*segment).into(), has })?;
    }
    Ok(place)
}

/// The name of a variant with something in it.
fn tag(place: &Value) -> Option<&str> {
    let fields = place.as_object().filter(|fields| fields.len() == 1)?;
    let name = fields.keys().next()?;
    name.starts_with(|c: char| c.is_ascii_uppercase()).then_some(name)
}

/// Value of a variant; the place itself if there is none.
fn inside(place: &mut Value) -> &mut Value {
    match tag(place).map(str::to_owned) {
        Some(name) => &mut place[name],
        None => place,
    }
}

/// Names that can stand next in a path.
fn names(place: &Value) -> String {
    match place {
        Value::Object(fields) => {
            let mut names: Vec<&str> = fields.keys().map(String::as_str).collect();
            names.sort_unstable();
            names.join(", ")
        }
        Value::Array(entries) if entries.is_empty() => "an empty list".into(),
        Value::Array(entries) => format!("entries 0 to {}", entries.len() - 1),
        Value::Null => "nothing, for the scene says None".into(),
        value => format!("{value} and no more"),
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::{MeanSpeed, PRESETS, Profile};

    use super::*;

    fn setting(value: impl Into<Value>) -> Setting {
        let value = value.into();
        Setting { text: value.to_string(), value }
    }

    fn put(scene: &Scene, path: &str, value: impl Into<Value>) -> anyhow::Result<Scene> {
        let mut tree = SceneTree::new(scene)?;
        tree.put(path, &setting(value))?;
        Ok(tree.scene()?)
    }

    #[test]
    fn every_preset_comes_back_from_its_tree_bit_for_bit() {
        for (name, _) in PRESETS {
            let scene = Scene::preset(name).expect("a preset");
            let tree = SceneTree::new(&scene).expect("finite");
            assert_eq!(tree.scene().expect("a scene"), scene, "{name}");
        }
    }

    #[test]
    fn paths_lead_through_structures_lists_and_variants() {
        let scene = Scene::preset("autumn-park").expect("a preset");
        let edited = put(&scene, "wind.gusts.strength", 0.25).expect("a field");
        assert_eq!(edited.wind.gusts.strength, 0.25, "in a structure");
        let edited = put(&scene, "sources.1.count", 77).expect("a field");
        assert_eq!(
            (edited.sources[1].count, edited.sources[0].count),
            (77, scene.sources[0].count),
            "in a list"
        );
        for path in ["wind.speed", "wind.speed.MetresPerSecond"] {
            let edited = put(&scene, path, 9).expect("a variant");
            assert_eq!(edited.wind.speed, MeanSpeed::MetresPerSecond(9.0), "{path}");
        }
        let edited = put(&scene, "wind.speed.Beaufort", 9).expect("another variant");
        assert_eq!(edited.wind.speed, MeanSpeed::Beaufort(9), "another variant takes its place");
        let mut rest = edited;
        rest.wind.speed = scene.wind.speed;
        assert_eq!(rest, scene, "nothing else has changed");
        let mut uniform = scene.clone();
        uniform.wind.profile = Profile::Uniform;
        let error = put(&uniform, "wind.profile.exponent", 0.3).expect_err("it has none").to_string();
        assert!(error.contains("no 'exponent' in wind.profile"), "{error}");
    }

    #[test]
    fn paths_that_lead_nowhere_and_values_that_do_not_fit_are_refused() {
        let scene = Scene::preset("autumn-park").expect("a preset");
        for (path, value, essentials) in [
            ("wind.sped", Value::from(1), &["wind.sped: ", "no 'sped' in wind", "speed", "gusts"][..]),
            ("wnd", 1.into(), &["no 'wnd' in the scene", "wind", "sources"]),
            ("sources.99.count", 1.into(), &["no '99' in sources", "entries 0 to"]),
            ("sources.x", 1.into(), &["no 'x' in sources"]),
            ("seed.x", 1.into(), &["no 'x' in seed", "and no more"]),
            ("ground.water.height_m", 1.into(), &["ground.water", "None"]),
            ("wind.gusts", 1.into(), &["several", "interval_s, strength"]),
            ("wind.speed.Knots", 1.into(), &["does not fit", "Knots", "Beaufort"]),
            ("wind.speed.Beaufort", 2.5.into(), &["2.5 does not fit", "u8"]),
            ("sources.0.count", 2.5.into(), &["2.5 does not fit", "u32"]),
            ("seed", "x".into(), &["does not fit", "u64"]),
            ("", 1.into(), &["no '' in the scene"]),
        ] {
            let error = put(&scene, path, value).expect_err(path).to_string();
            for essential in essentials {
                assert!(error.contains(essential), "{path}: {essential:?} is missing in {error:?}");
            }
        }
    }
}
