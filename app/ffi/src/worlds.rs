// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Worlds by number. A number is never used again, so that one that has been freed is known as such.

use std::collections::BTreeMap;
use std::ffi::CString;
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};

use windfall_core::scene::FlightModel;
use windfall_core::{Clock, Scene, SceneError, SimError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator};

use crate::error::Failure;

/// Names of backends.
const BACKENDS: &str = "'auto', 'cpu' or 'wgpu'";

/// The state where it is on this side of the device, and the simulator that moves it.
enum Device {
    Cpu(Box<CpuSimulator>),
    /// The copy is read back when it is asked for.
    Wgpu {
        simulator: Box<WgpuSimulator>,
        copy: Box<World>,
        is_current: bool,
    },
}

/// The world of a scene. Folders of leaves, after which the command builds bodies, are not read here.
pub(crate) fn built(scene: &Scene, file: &str) -> Result<World, Failure> {
    for (number, species) in scene.species.iter().enumerate() {
        if let (FlightModel::Aerodynamic(body), Some(folder)) = (species.flight, &species.leaves)
            && body.planform.is_none()
        {
            return Err(Failure::Scene(SceneError::Field {
                file: file.into(),
                field: format!("species[{number}].leaves"),
                value: format!("\"{folder}\""),
                allowed: "None, or flight with a planform: folders of leaves are read by the command".into(),
            }));
        }
    }
    Ok(World::build_named(scene, file)?)
}

/// A world that goes on.
pub(crate) struct Held {
    device: Device,
    /// Columns that are lent.
    lent: u32,
}

impl Held {
    /// A world on a backend by name.
    pub(crate) fn new(world: World, backend: &str) -> Result<Self, Failure> {
        let gpu = match backend {
            "cpu" => None,
            "wgpu" => Some(Gpu::request(None)?),
            "auto" => Gpu::request(None).ok().filter(|gpu| gpu.info().device_type != wgpu::DeviceType::Cpu),
            other => {
                return Err(Failure::Argument(format!("backend is '{other}'; allowed: {BACKENDS}")));
            }
        };
        let device = match gpu {
            None => Device::Cpu(Box::new(CpuSimulator::new(&world, CpuOptions::default())?)),
            Some(gpu) => Device::Wgpu {
                simulator: Box::new(WgpuSimulator::new(&gpu, &world, &WgpuOptions::default())?),
                copy: Box::new(world),
                is_current: true,
            },
        };
        Ok(Self { device, lent: 0 })
    }

    /// Steps so many times. Not while columns are lent, for they would change.
    pub(crate) fn step(&mut self, count: u32) -> Result<(), Failure> {
        self.unlent()?;
        match &mut self.device {
            Device::Cpu(simulator) => simulator.step(count)?,
            Device::Wgpu { simulator, is_current, .. } => {
                *is_current = false;
                simulator.step(count)?;
                simulator.sync()?;
            }
        }
        Ok(())
    }

    /// Steps and seconds since the scene began.
    pub(crate) fn clock(&self) -> Clock {
        match &self.device {
            Device::Cpu(simulator) => simulator.clock(),
            Device::Wgpu { simulator, .. } => simulator.clock(),
        }
    }

    /// The state as it is now. It stays where it is until the next step.
    pub(crate) fn world(&mut self) -> Result<&World, SimError> {
        match &mut self.device {
            Device::Cpu(simulator) => Ok(simulator.world()),
            Device::Wgpu { simulator, copy, is_current } => {
                if !*is_current {
                    simulator.read_state(copy)?;
                    *is_current = true;
                }
                Ok(copy)
            }
        }
    }

    /// Bytes of a column by name, and those of a row of it, lent.
    pub(crate) fn lend(&mut self, name: &str) -> Result<(&[u8], usize), Failure> {
        let known = column_names();
        let Some(at) = known.iter().position(|known| known.to_bytes() == name.as_bytes()) else {
            let known: Vec<_> = known.iter().map(|name| name.to_string_lossy()).collect();
            return Err(Failure::Argument(format!("no column '{name}'; allowed: {}", known.join(", "))));
        };
        // Nothing is lent where reading back fails.
        self.world()?;
        self.lent += 1;
        let mut columns = self.world()?.stores().into_iter().flat_map(|store| {
            let sizes = store.description().iter().map(|column| column.record_bytes);
            store.columns().into_iter().zip(sizes)
        });
        columns.nth(at).ok_or_else(|| Failure::Fault(format!("column {at} of {}", known.len())))
    }

    /// Takes a column back.
    pub(crate) fn take_back(&mut self) -> Result<(), Failure> {
        let left = self.lent.checked_sub(1);
        self.lent = left.ok_or_else(|| Failure::Argument("no column of the world is lent".into()))?;
        Ok(())
    }

    fn unlent(&self) -> Result<(), Failure> {
        if self.lent == 0 { Ok(()) } else { Err(Failure::Lent(self.lent)) }
    }
}

/// Names of the columns of every world: `place` of leaves, `particles.place` of other stores.
pub(crate) fn column_names() -> &'static [CString] {
    static NAMES: LazyLock<Vec<CString>> = LazyLock::new(|| {
        let world = World::build(&Scene::default()).expect("the default scene is valid");
        let names = world.column_names().into_iter().flatten();
        names.map(|name| CString::new(name).expect("names have no zeros")).collect()
    });
    &NAMES
}

/// Worlds that are there, and the number of the latest.
#[derive(Default)]
struct Worlds {
    held: BTreeMap<u64, Arc<Mutex<Held>>>,
    latest: u64,
}

static WORLDS: Mutex<Worlds> = Mutex::new(Worlds { held: BTreeMap::new(), latest: 0 });

fn worlds() -> MutexGuard<'static, Worlds> {
    WORLDS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps a world, and returns its number.
pub(crate) fn keep(held: Held) -> u64 {
    let mut worlds = worlds();
    worlds.latest += 1;
    let number = worlds.latest;
    worlds.held.insert(number, Arc::new(Mutex::new(held)));
    number
}

/// Works with a world. Calls for one world wait for each other, those for several do not.
pub(crate) fn with<T>(number: u64, work: impl FnOnce(&mut Held) -> Result<T, Failure>) -> Result<T, Failure> {
    let held = worlds().held.get(&number).cloned().ok_or(Failure::Freed(number))?;
    let mut held = held.lock().unwrap_or_else(PoisonError::into_inner);
    work(&mut held)
}

/// Frees a world, unless columns of it are lent.
pub(crate) fn free(number: u64) -> Result<(), Failure> {
    with(number, |held| held.unlent())?;
    worlds().held.remove(&number);
    Ok(())
}
