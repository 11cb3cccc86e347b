// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Worlds: stepped, counted, lent, drawn, saved.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::exceptions::{PyBufferError, PyKeyError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use windfall::backend::{BackendArguments, BackendKind};
use windfall::frame_steps::FrameSteps;
use windfall::scenes::check_memory;
use windfall_core::{Scene, SceneError, World};

use crate::buffers::{Column, Memory};
use crate::counts::Counts;
use crate::decode;
use crate::errors::raise;
use crate::scene::PyScene;
use crate::simulation::Simulation;

/// Name of checkpoints that are no file's, in errors.
const OF_BYTES: &str = "<bytes>";

/// Most threads of the cpu backend.
const MOST_THREADS: usize = 1024;

/// Holders of the state at the moment.
#[derive(Default)]
struct Holders {
    /// Buffers of columns that live.
    lent: usize,
    /// Set while a call steps.
    is_stepping: bool,
}

/// A world that goes on: its state, and the simulator that moves it. A scene, or a preset's name or a file's path; `backend` is "auto",
/// "cpu" or "wgpu". On the GPU columns are read back when they are asked for.
#[pyclass(name = "World", module = "windfall", frozen)]
pub(crate) struct PyWorld {
    simulation: Mutex<Simulation>,
    holders: Mutex<Holders>,
    arguments: BackendArguments,
    reason: Option<String>,
    scene: Py<PyScene>,
}

/// A call that steps; it ends with this, however it ends.
struct Stepping<'a>(&'a PyWorld);

impl Drop for Stepping<'_> {
    fn drop(&mut self) {
        self.0.holders().is_stepping = false;
    }
}

impl PyWorld {
    fn make(
        py: Python<'_>,
        world: impl FnOnce() -> anyhow::Result<World> + Send,
        file: String,
        arguments: BackendArguments,
    ) -> PyResult<Self> {
        let made = py.detach(|| {
            // The device first: it is missing at once, and a world takes time.
            arguments.kind()?;
            let world = world()?;
            let scene = world.compiled.scene().clone();
            Simulation::new(world, &arguments).map(|(simulation, reason)| (simulation, reason, scene))
        });
        let (simulation, reason, scene) = made.map_err(|error| raise(py, &error))?;
        let scene = Py::new(py, PyScene { scene, file })?;
        let (simulation, holders) = (Mutex::new(simulation), Mutex::default());
        Ok(Self { simulation, holders, arguments, reason, scene })
    }

    /// Works with the simulation while Python goes on.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Simulation) -> anyhow::Result<T> + Send,
    ) -> PyResult<T> {
        let done = py.detach(|| work(&mut self.simulation.lock().unwrap_or_else(PoisonError::into_inner)));
        done.map_err(|error| raise(py, &error))
    }

    fn with_world<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&World) -> T + Send) -> PyResult<T> {
        self.with(py, |simulation| Ok(work(simulation.world()?)))
    }

    fn holders(&self) -> MutexGuard<'_, Holders> {
        self.holders.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Place and length of a column, which stay until [`PyWorld::take_back`].
    pub(crate) fn lend(&self, py: Python<'_>, store: usize, column: usize) -> PyResult<(*const u8, usize)> {
        {
            let mut holders = self.holders();
            if holders.is_stepping {
                return Err(PyBufferError::new_err("the world is stepping; wait until it has"));
            }
            holders.lent += 1;
        }
        let found = self.with_world(py, |world| {
            let bytes = world.stores()[store].columns()[column];
            // An address, since pointers do not go from thread to thread.
            (bytes.as_ptr().expose_provenance(), bytes.len())
        });
        match found {
            Ok((address, length)) => Ok((std::ptr::with_exposed_provenance(address), length)),
            Err(error) => {
                self.take_back();
                Err(error)
            }
        }
    }

    /// Ends a loan of [`PyWorld::lend`].
    pub(crate) fn take_back(&self) {
        self.holders().lent -= 1;
    }

    /// Steps in portions, between which the interpreter has its say.
    fn step_on(&self, py: Python<'_>, mut count: u32) -> PyResult<()> {
        while count > 0 {
            py.check_signals()?;
            count -= self.with(py, |simulation| Ok(simulation.step(count)?))?;
        }
        Ok(())
    }
}

#[pymethods]
impl PyWorld {
    #[new]
    #[pyo3(signature = (scene, backend="auto", *, threads=None, adapter=None))]
    fn new(
        scene: &Bound<'_, PyAny>,
        backend: &str,
        threads: Option<usize>,
        adapter: Option<String>,
    ) -> PyResult<Self> {
        let arguments = choice(backend, threads, adapter)?;
        let (of, file) = PyScene::of(scene)?;
        let name = file.clone();
        let build = move || {
            check_memory(&name, &of)?;
            Ok(World::build_named(&of, &name)?)
        };
        Self::make(scene.py(), build, file, arguments)
    }

    /// Goes on from a checkpoint: a file that `save` or `windfall simulate --checkpoint` wrote. Files that its scene names must lie in its
    /// folder or below, unless `allow_outside`.
    #[staticmethod]
    #[pyo3(signature = (path, backend="auto", *, threads=None, adapter=None, allow_outside=false))]
    fn open(
        py: Python<'_>,
        path: PathBuf,
        backend: &str,
        threads: Option<usize>,
        adapter: Option<String>,
        allow_outside: bool,
    ) -> PyResult<Self> {
        let file = path.display().to_string();
        let name = file.clone();
        let read = move || {
            let bytes =
                std::fs::read(&path).map_err(|source| SceneError::Read { path: path.clone(), source })?;
            let check = |scene: &Scene| match path.parent() {
                Some(folder) if !allow_outside => scene.check_files_below(folder, &name),
                _ => Ok(()),
            };
            Ok(World::from_checked_checkpoint(&bytes, &name, check)?)
        };
        Self::make(py, read, file, choice(backend, threads, adapter)?)
    }

    /// Goes on from the bytes of a checkpoint.
    #[staticmethod]
    #[pyo3(signature = (data, backend="auto", *, threads=None, adapter=None))]
    fn from_bytes(
        data: &Bound<'_, PyBytes>,
        backend: &str,
        threads: Option<usize>,
        adapter: Option<String>,
    ) -> PyResult<Self> {
        let bytes = data.as_bytes();
        let read = move || Ok(World::from_checkpoint(bytes, OF_BYTES)?);
        Self::make(data.py(), read, OF_BYTES.into(), choice(backend, threads, adapter)?)
    }

    /// Steps so many times and returns the world itself. Ctrl-C ends it between two steps, in a world as it is then.
    #[pyo3(signature = (count=1))]
    fn step(slf: Py<Self>, py: Python<'_>, count: u32) -> PyResult<Py<Self>> {
        let this = slf.get();
        {
            let mut holders = this.holders();
            if holders.is_stepping {
                return Err(PyRuntimeError::new_err(
                    "another thread is stepping this world; wait until it has",
                ));
            }
            if holders.lent > 0 {
                let lent = holders.lent;
                let message = format!(
                    "columns of the world are viewed ({lent} views); copy what is needed, and del them"
                );
                return Err(PyBufferError::new_err(message));
            }
            holders.is_stepping = true;
        }
        let stepping = Stepping(this);
        this.step_on(py, count)?;
        drop(stepping);
        Ok(slf)
    }

    /// Counts: of leaves by what they do, of the litter (None without any) and of every population of particles, as in the JSON of
    /// `windfall simulate`.
    fn stats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let counts = self.with_world(py, Counts::of)?;
        counts.to_dict(py)
    }

    /// Hash of the whole state, sixteen hexadecimal digits: equal on every backend that keeps the exact contract.
    fn state_hash(&self, py: Python<'_>) -> PyResult<String> {
        self.with_world(py, |world| format!("{:016x}", world.state_hash()))
    }

    /// Steps since the scene began.
    #[getter]
    fn step_index(&self, py: Python<'_>) -> PyResult<u32> {
        self.with(py, |simulation| Ok(simulation.clock().step()))
    }

    /// Simulated seconds since the scene began.
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |simulation| Ok(simulation.clock().seconds()))
    }

    /// The scene that the world was built of.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<PyScene> {
        self.scene.clone_ref(py)
    }

    /// Backend, adapter and driver or threads, contract, and the reason for the backend if it was chosen by itself (else None).
    #[getter]
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let info = self.with(py, |simulation| Ok(simulation.info()))?;
        let dict = PyDict::new(py);
        dict.set_item("backend", info.backend)?;
        dict.set_item("adapter", info.adapter)?;
        dict.set_item("contract", info.contract.to_string())?;
        dict.set_item("reason", self.reason.as_deref())?;
        Ok(dict)
    }

    /// Names of all columns: `place` of leaves, `particles.place` of other stores.
    #[getter]
    fn column_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with_world(py, |world| decode::named(world).into_iter().map(|(name, ..)| name).collect())
    }

    /// A column as bytes, which `numpy.frombuffer` reads without a copy; `view` does so.
    fn column(slf: Py<Self>, py: Python<'_>, name: &str) -> PyResult<Column> {
        let named = slf.get().with_world(py, decode::named)?;
        match named.iter().find(|(known, ..)| known == name) {
            Some(&(_, store, column, description)) => Ok(Column::new(slf, store, column, description)),
            None => {
                let known: Vec<_> = named.into_iter().map(|(name, ..)| name).collect();
                Err(PyKeyError::new_err(format!("no column '{name}'; there: {}", known.join(", "))))
            }
        }
    }

    /// A column as a structured array without a copy, not to be written. While it lives the world does not step (BufferError).
    fn view<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._arrays")?.call_method1("view", (slf, name))
    }

    /// Copies of the columns by name, as structured arrays: a mapping, which copies what is asked of it.
    #[getter]
    fn columns<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._arrays")?.call_method1("Columns", (slf,))
    }

    /// All leaves decoded, a row for each slot: id, state (a number of LEAF_STATES), motion (of MOTIONS), species, position and velocity
    /// in m and m/s, quaternion x, y, z, w, size in m, time of release in s.
    fn leaves<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._arrays")?.call_method1("leaves", (slf,))
    }

    /// The same with a column for every number, as tables of polars, pandas and pyarrow take them.
    fn leaves_flat<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._arrays")?.call_method1("leaves_flat", (slf,))
    }

    fn _decoded(&self, py: Python<'_>) -> PyResult<Vec<(&'static str, &'static str, usize, Memory)>> {
        let decoded = self.with_world(py, decode::leaves)?;
        Ok(decoded.into_iter().map(|(name, kind, words, bytes)| (name, kind, words, bytes.into())).collect())
    }

    /// A picture of the world as it is, without motion blur and trails. Leaves are made first where no picture has shown such before, which takes up
    /// to a minute; a draft has the small ones then that come with the package.
    #[pyo3(signature = (size=(1280, 720), draft=false), text_signature = "($self, size=(1280, 720), draft=False)")]
    fn render<'py>(slf: &Bound<'py, Self>, size: (u32, u32), draft: bool) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._pictures")?.call_method1("render", (slf, size, draft))
    }

    /// Pictures of the world as it goes on, which it does as they are taken: an iterable with a length. Drafts are those of `render`.
    #[pyo3(
        signature = (seconds, fps=24.0, size=(1280, 720), draft=false),
        text_signature = "($self, seconds, fps=24.0, size=(1280, 720), draft=False)"
    )]
    fn frames<'py>(
        slf: &Bound<'py, Self>,
        seconds: f64,
        fps: f64,
        size: (u32, u32),
        draft: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._pictures")?.call_method1("Frames", (slf, seconds, fps, size, draft))
    }

    fn _draw(&self, py: Python<'_>, size: (u32, u32), since_s: f64, draft: bool) -> PyResult<Memory> {
        self.with(py, |simulation| simulation.draw(size, since_s, draft)).map(Memory::from)
    }

    /// Numbers of steps before frames, as the command takes them.
    fn _steps_before(&self, py: Python<'_>, fps: f64, count: u32) -> PyResult<Vec<u64>> {
        if !(fps > 0.0 && fps.is_finite()) {
            return Err(PyValueError::new_err(format!("fps is {fps}; allowed: above 0")));
        }
        let dt_s = self.with(py, |simulation| Ok(simulation.clock().dt_s()))?;
        let steps = FrameSteps::new(fps, 1.0, dt_s);
        Ok((0..count).map(|number| steps.before(number)).collect())
    }

    /// A small picture, for notebooks; none where there is nothing to draw with.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("windfall._pictures")?.call_method1("small_png", (slf,))
    }

    /// The state as a checkpoint, with its scene.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let written = self.with(py, |simulation| {
            let mut bytes = Vec::new();
            simulation.world()?.write_checkpoint(&mut bytes)?;
            Ok(bytes)
        });
        Ok(PyBytes::new(py, &written?))
    }

    /// Writes the state as a checkpoint, which `open` and `windfall simulate --resume` go on from. The file appears when it is whole.
    fn save(slf: &Bound<'_, Self>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        slf.py().import("windfall._command")?.call_method1("save", (slf, path)).map(|_| ())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (this, py) = (slf.get(), slf.py());
        let backend = match this.arguments.backend {
            None => "auto",
            Some(BackendKind::Cpu) => "cpu",
            Some(BackendKind::Wgpu) => "wgpu",
        };
        let keywords = PyDict::new(py);
        keywords.set_item("threads", this.arguments.threads)?;
        keywords.set_item("adapter", this.arguments.adapter.as_deref())?;
        let restore = py.import("functools")?.getattr("partial")?;
        let restore = restore.call((slf.get_type().getattr("from_bytes")?,), Some(&keywords))?;
        Ok((restore, (this.to_bytes(py)?, backend).into_pyobject(py)?))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (info, clock) = self.with(py, |simulation| Ok((simulation.info(), simulation.clock())))?;
        let (seconds, backend) = (clock.seconds(), info.backend);
        Ok(format!("<windfall.World '{}' at {seconds:.3} s on {backend}>", self.scene.get().scene.name))
    }
}

/// The arguments of a backend by name.
fn choice(backend: &str, threads: Option<usize>, adapter: Option<String>) -> PyResult<BackendArguments> {
    let backend = match backend {
        "auto" => None,
        "cpu" => Some(BackendKind::Cpu),
        "wgpu" => Some(BackendKind::Wgpu),
        other => {
            let message = format!("backend is '{other}'; allowed: 'auto', 'cpu', 'wgpu'");
            return Err(PyValueError::new_err(message));
        }
    };
    if let Some(threads) = threads.filter(|threads| !(1..=MOST_THREADS).contains(threads)) {
        return Err(PyValueError::new_err(format!("threads is {threads}; allowed: 1 to {MOST_THREADS}")));
    }
    Ok(BackendArguments { backend, adapter, threads })
}
