// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns values that are not allowed into errors that name file, field, value and range.

use std::fmt::{Debug, Display};

use glam::Vec3;

use crate::SceneError;
use crate::scene::limits::Limit;

/// A place in a scene: the file and the path of a structure in it.
pub(super) struct Check<'a> {
    file: &'a str,
    /// Ends in a dot unless empty.
    prefix: String,
}

impl<'a> Check<'a> {
    /// The top of a scene.
    pub(super) fn new(file: &'a str) -> Self {
        Self { file, prefix: String::new() }
    }

    /// A structure inside this one.
    pub(super) fn inside(&self, name: impl Display) -> Self {
        Self { file: self.file, prefix: format!("{}{name}.", self.prefix) }
    }

    /// A table of numbers: name, value if there is one, range.
    pub(super) fn numbers<T, const N: usize>(
        &self,
        rows: [(&str, Option<T>, Limit<T>); N],
    ) -> Result<(), SceneError>
    where
        T: Copy + PartialOrd + Debug + Display,
    {
        for (name, value, limit) in rows {
            let Some(value) = value else { continue };
            self.holds(limit.contains(value), name, || (format!("{value:?}"), limit.to_string()))?;
        }
        Ok(())
    }

    /// The three components of a vector.
    pub(super) fn vector(&self, name: &str, value: Vec3, limit: Limit<f32>) -> Result<(), SceneError> {
        self.inside(name).numbers([
            ("x", value.x.into(), limit),
            ("y", value.y.into(), limit),
            ("z", value.z.into(), limit),
        ])
    }

    /// The number of entries of a list.
    pub(super) fn length(
        &self,
        name: &str,
        length: usize,
        low: usize,
        high: usize,
    ) -> Result<(), SceneError> {
        self.holds((low..=high).contains(&length), name, || {
            (format!("a list of {length}"), format!("{low} to {high} entries"))
        })
    }

    /// Any other condition; `explain` gives the value found and what is allowed.
    pub(super) fn holds(
        &self,
        condition: bool,
        name: &str,
        explain: impl FnOnce() -> (String, String),
    ) -> Result<(), SceneError> {
        if condition {
            return Ok(());
        }
        let (value, allowed) = explain();
        Err(self.error(name, value, allowed))
    }

    /// The time of a key, which is after that of the key before and then takes its place.
    pub(super) fn later(&self, time_s: f32, earlier_s: &mut Option<f32>) -> Result<(), SceneError> {
        let is_later = earlier_s.is_none_or(|earlier_s| time_s > earlier_s);
        self.holds(is_later, "time_s", || {
            let allowed = format!("more than the {:?} s of the key before", earlier_s.unwrap_or(0.0));
            (format!("{time_s:?}"), allowed)
        })?;
        *earlier_s = Some(time_s);
        Ok(())
    }

    /// The error for a value that is not allowed.
    pub(super) fn error(&self, name: &str, value: String, allowed: String) -> SceneError {
        let field = format!("{}{name}", self.prefix);
        SceneError::Field { file: self.file.to_owned(), field, value, allowed }
    }
}
