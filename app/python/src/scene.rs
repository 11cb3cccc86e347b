// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes: presets, files, text, dictionaries, and changes by the paths of `windfall study --vary`.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use windfall::scenes::{SceneTree, Setting, fit_bodies, load_scene};
use windfall_core::Scene;
use windfall_core::scene::{NamedFiles, ObjectShape, Sky};

use crate::errors::{of_text, raise};

/// Name of scenes that are no file's, in errors.
const OF_DICT: &str = "<dict>";

/// A scene: what there is before a world is built of it. It does not change; `with_` makes another.
#[pyclass(name = "Scene", module = "windfall", frozen, eq)]
pub(crate) struct PyScene {
    pub(crate) scene: Scene,
    /// Preset, path or `<…>`: what errors name.
    pub(crate) file: String,
}

impl PartialEq for PyScene {
    /// Equal scenes may come from different places.
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene
    }
}

impl PyScene {
    /// A scene, or one that a preset's name or a path stands for.
    pub(crate) fn of(given: &Bound<'_, PyAny>) -> PyResult<(Scene, String)> {
        if let Ok(scene) = given.cast::<Self>() {
            let scene = scene.get();
            return Ok((scene.scene.clone(), scene.file.clone()));
        }
        let path = given.py().import("os")?.call_method1("fspath", (given,))?;
        let Self { scene, file } = Self::load(given.py(), path.extract()?, false)?;
        Ok((scene, file))
    }

    /// A scene as the command would read it from a file: bodies fitted to folders of leaves, values checked.
    fn valid(py: Python<'_>, mut scene: Scene, file: String) -> PyResult<Self> {
        let fitted = scene.validate(&file).map_err(Into::into).and_then(|()| fit_bodies(&mut scene));
        let checked = fitted.and_then(|_| Ok(scene.validate(&file)?));
        checked.map_err(|error| raise(py, &error))?;
        Ok(Self { scene, file })
    }
}

#[pymethods]
impl PyScene {
    /// A scene of fields as they stand in files: structures are dictionaries, a variant `Name(…)` is {"Name": …}. Those left out have
    /// the values they have in files.
    #[new]
    #[pyo3(signature = (fields=None))]
    fn new(py: Python<'_>, fields: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let text = fields.map_or_else(|| Ok("{}".into()), |fields| to_json(fields.as_any()))?;
        let scene: Scene =
            serde_json::from_str(&text).map_err(|error| of_text(py, OF_DICT, &plain(&error)))?;
        Self::valid(py, scene, OF_DICT.into())
    }

    /// The scene that a preset's name or a file's path stands for. Files that the scene names must lie in its folder or below, unless
    /// `allow_outside`.
    #[staticmethod]
    #[pyo3(signature = (name, *, allow_outside=false))]
    fn load(py: Python<'_>, name: String, allow_outside: bool) -> PyResult<Self> {
        let allowed = if allow_outside { NamedFiles::Anywhere } else { NamedFiles::Below };
        let scene = py.detach(|| load_scene(&name, allowed)).map_err(|error| raise(py, &error))?;
        Ok(Self { scene, file: name })
    }

    /// A scene from the text of a scene file; errors name `file`.
    #[staticmethod]
    #[pyo3(signature = (text, file="<string>".into()), text_signature = "(text, file='<string>')")]
    fn from_ron(py: Python<'_>, text: &str, file: String) -> PyResult<Self> {
        let scene = Scene::from_ron(text, &file).map_err(|error| raise(py, &error.into()))?;
        Self::valid(py, scene, file)
    }

    /// The same scene with other values: with_(seed=7, **{"wind.speed": 9.0}). Paths are those of `windfall study --vary`: fields and
    /// numbers of list entries with dots between them. `leaves` is the number of all leaves, which trees, sources and litter share.
    #[pyo3(signature = (**changes))]
    fn with_(&self, py: Python<'_>, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let fail = |error: anyhow::Error| raise(py, &error);
        let mut tree = SceneTree::new(&self.scene).map_err(fail)?;
        let mut leaves = None;
        for (path, value) in changes.into_iter().flatten() {
            let path: String = path.extract()?;
            if path == "leaves" {
                leaves = Some(value.extract::<u32>()?);
                continue;
            }
            let text = to_json(&value)?;
            let value =
                serde_json::from_str(&text).map_err(|error| of_text(py, &self.file, &plain(&error)))?;
            let put = tree.put(&path.replace('[', ".").replace(']', ""), &Setting { text, value });
            put.map_err(|error| of_text(py, &self.file, &error))?;
        }
        let mut scene = tree.scene().map_err(|error| of_text(py, &self.file, &plain(&error)))?;
        if let Some(leaves) = leaves {
            scene = scene.with_leaf_count(&self.file, leaves).map_err(|error| fail(error.into()))?;
        }
        Self::valid(py, scene, self.file.clone())
    }

    /// The text of a scene file that says the same.
    fn to_ron(&self) -> String {
        self.scene.to_ron()
    }

    /// The same with absolute paths, for a file in any folder.
    fn _to_ron_for_any_folder(&self) -> String {
        let mut scene = self.scene.clone();
        let of_species =
            scene.species.iter_mut().flat_map(|species| [&mut species.tables, &mut species.leaves]);
        of_species.flatten().for_each(make_absolute);
        scene.tree_kinds.iter_mut().filter_map(|kind| kind.form.file_mut()).for_each(make_absolute);
        for object in &mut scene.objects {
            if let ObjectShape::Mesh { file, .. } = &mut object.shape {
                make_absolute(file);
            }
        }
        if let Sky::Map(map) = &mut scene.view.sky {
            make_absolute(&mut map.path);
        }
        scene.to_ron()
    }

    /// All fields, as the constructor takes them.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = serde_json::to_string(&self.scene).map_err(|error| of_text(py, &self.file, &error))?;
        py.import("json")?.call_method1("loads", (text,))
    }

    /// Writes a stretch of the scene for other programs, as `windfall export` does: USD, glTF, a table or point clouds, by the ending
    /// of `path`. Frame 0 shows the scene as it begins.
    #[pyo3(signature = (path, frames, fps=60.0, backend=None))]
    fn export<'py>(
        slf: &Bound<'py, Self>,
        path: &Bound<'py, PyAny>,
        frames: &Bound<'py, PyAny>,
        fps: f64,
        backend: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._command")?.call_method1("export", (slf, path, frames, fps, backend))
    }

    /// Name of the scene.
    #[getter]
    fn name(&self) -> &str {
        &self.scene.name
    }

    /// Preset, path or <…> that it comes from: what errors name.
    #[getter]
    fn file(&self) -> &str {
        &self.file
    }

    /// Seed of everything random.
    #[getter]
    fn seed(&self) -> u64 {
        self.scene.seed
    }

    /// Length of a step in seconds.
    #[getter]
    fn dt_s(&self) -> f32 {
        self.scene.dt_s
    }

    /// Number of leaves, those on trees and in litter included.
    #[getter]
    fn leaf_count(&self) -> u32 {
        self.scene.leaf_count()
    }

    /// Number of slots for particles.
    #[getter]
    fn particle_count(&self) -> u32 {
        self.scene.particle_count()
    }

    fn __repr__(&self) -> String {
        let Scene { name, seed, .. } = &self.scene;
        format!("<windfall.Scene '{name}', seed {seed}, {} leaves>", self.scene.leaf_count())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let this = slf.get();
        let text = (this.scene.to_ron(), this.file.clone());
        Ok((slf.get_type().getattr("from_ron")?, text.into_pyobject(slf.py())?))
    }
}

/// Makes a path absolute, seen from the folder of this process; one that cannot be stays as it is.
fn make_absolute(path: &mut String) {
    if let Ok(absolute) = std::path::absolute(&*path) {
        *path = absolute.to_string_lossy().into_owned();
    }
}

/// A value as JSON; numbers of numpy are numbers.
fn to_json(value: &Bound<'_, PyAny>) -> PyResult<String> {
    let py = value.py();
    let keywords = PyDict::new(py);
    keywords.set_item("default", py.import("operator")?.call_method1("methodcaller", ("tolist",))?)?;
    keywords.set_item("allow_nan", false)?;
    py.import("json")?.call_method("dumps", (value,), Some(&keywords))?.extract()
}

/// The message without the line of a text that nobody wrote.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.clone(), |(message, _)| message.to_owned())
}
