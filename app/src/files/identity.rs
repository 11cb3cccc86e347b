// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Everything that a result depends on, as a text that is kept beside unfinished work.

use serde_json::Value;

/// Identity of a piece of work: named values.
#[derive(Clone, Debug)]
pub(crate) struct Identity(Value);

impl Identity {
    /// Identity of an object of named values.
    pub(crate) fn new(values: Value) -> Self {
        Self(values)
    }

    /// Its values.
    pub(crate) fn values(&self) -> &Value {
        &self.0
    }

    /// Its text: equal for equal work.
    pub(crate) fn text(&self) -> String {
        format!("{:#}\n", self.0)
    }

    /// Names of the values that the text of another identity differs in.
    pub(crate) fn difference(&self, other: &str) -> String {
        // Both from their texts, as numbers lose bits on their way through one.
        let [own, found] =
            [&*self.text(), other].map(|text| serde_json::from_str::<Value>(text).unwrap_or_default());
        let Some(values) = own.as_object() else { return "unreadable".into() };
        let names = values.iter().filter(|(name, value)| found.get(name) != Some(value));
        let names: Vec<_> = names.map(|(name, _)| name.as_str()).collect();
        if names.is_empty() { "written otherwise".into() } else { format!("other {}", names.join(", ")) }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn differences_are_named() {
        let identity = Identity::new(json!({ "fps": 60.0, "scene": { "seed": 1 }, "size": [2, 3] }));
        let other = Identity::new(json!({ "fps": 30.0, "scene": { "seed": 2 }, "size": [2, 3] }));
        assert_eq!(identity.difference(&other.text()), "other fps, scene", "both");
        assert_eq!(identity.difference("{"), "other fps, scene, size", "no text of an identity");
        assert_eq!(identity.text(), identity.clone().text(), "the same");
        assert_ne!(identity.text(), other.text(), "another");
    }
}
