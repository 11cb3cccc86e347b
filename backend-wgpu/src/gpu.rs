// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The device a simulator runs on: chosen by name or by kind, or brought by the host program.

use std::sync::{Arc, Mutex, PoisonError};

use windfall_core::{Contract, SimError};

use crate::pipelines::{CompiledKernels, shader_module};
use crate::readback::read_buffer;

/// The first report of trouble with the device: its loss, or an error.
type Health = Arc<Mutex<Option<SimError>>>;

/// A device with its queue, shared by simulator and renderer.
#[derive(Clone, Debug)]
pub struct Gpu {
    info: wgpu::AdapterInfo,
    device: wgpu::Device,
    queue: wgpu::Queue,
    health: Health,
    compiled: Arc<CompiledKernels>,
    /// True if the device is of our making, and its callbacks are ours.
    is_own: bool,
}

/// Descriptor of instances: the platform's first-class APIs (Vulkan, Metal, DX12), or what `WGPU_BACKEND` names.
pub fn instance_descriptor() -> wgpu::InstanceDescriptor {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY);
    descriptor.flags = wgpu::InstanceFlags::empty();
    descriptor
}

/// All adapters, the best first: discrete, integrated, virtual, software.
pub fn list_adapters(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    });
    adapters
}

/// The best adapter, or the best whose name or driver contains `name` (in any case), that can draw to `surface`.
///
/// # Errors
/// [`SimError::NoAdapter`] with what is there.
pub fn select_adapter(
    instance: &wgpu::Instance,
    name: Option<&str>,
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<wgpu::Adapter, SimError> {
    let adapters = list_adapters(instance);
    let found: Vec<_> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let fits = |adapter: &wgpu::Adapter| {
        let info = adapter.get_info();
        let named = name.is_none_or(|name| {
            let name = name.to_lowercase();
            info.name.to_lowercase().contains(&name) || info.driver.to_lowercase().contains(&name)
        });
        named && surface.is_none_or(|surface| adapter.is_surface_supported(surface))
    };
    adapters.into_iter().find(fits).ok_or_else(|| SimError::NoAdapter {
        reason: match (name, found.is_empty()) {
            (_, true) => {
                "none found; install a graphics driver, or software Vulkan (mesa-vulkan-drivers)".into()
            }
            (Some(name), false) => format!("none named '{name}'; found: {}", found.join(", ")),
            (None, false) => format!("none can draw to this window; found: {}", found.join(", ")),
        },
    })
}

/// Adapter, driver and kind in one line.
pub fn describe_adapter(info: &wgpu::AdapterInfo) -> String {
    let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ");
    format!("{} ({:?}, {:?}, {})", info.name, info.backend, info.device_type, driver.trim())
}

impl Gpu {
    /// A device of the best adapter, or of one whose name contains `name`; needs no window.
    ///
    /// # Errors
    /// [`SimError::NoAdapter`] if there is none or it gives no device.
    pub fn request(name: Option<&str>) -> Result<Self, SimError> {
        let instance = wgpu::Instance::new(instance_descriptor());
        Self::from_adapter(&select_adapter(&instance, name, None)?)
    }

    /// A device of this adapter, with all its limits and what the exact contract needs.
    ///
    /// # Errors
    /// [`SimError::NoAdapter`] if it gives no device.
    pub fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self, SimError> {
        let info = adapter.get_info();
        let mut wanted = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
        if info.backend == wgpu::Backend::Vulkan {
            wanted |= wgpu::Features::PASSTHROUGH_SHADERS;
        }
        // SAFETY: the experimental feature used is passthrough shaders; the modules passed through are naga's own
        // output with decorations added, checked in `pipelines`.
        #[expect(unsafe_code, reason = "the only way to enable passthrough shaders")]
        let experimental_features = unsafe { wgpu::ExperimentalFeatures::enabled() };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("windfall"),
            required_features: wanted & adapter.features(),
            required_limits: adapter.limits(),
            experimental_features,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| SimError::NoAdapter { reason: format!("{}: {error}", info.name) })?;
        let gpu = Self { is_own: true, ..Self::from_parts(info, device, queue) };
        let lost = Arc::clone(&gpu.health);
        gpu.device.set_device_lost_callback(move |reason, message| {
            let reason = format!("{reason:?} {message}").trim().to_owned();
            report(&lost, SimError::DeviceLost { reason });
        });
        let uncaught = Arc::clone(&gpu.health);
        gpu.device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            report(&uncaught, SimError::Device { reason: error.to_string() });
        }));
        Ok(gpu)
    }

    /// A device that the host program made. For the exact contract it needs `PASSTHROUGH_SHADERS` on Vulkan.
    ///
    /// Its callbacks for loss and for uncaptured errors stay the host's: errors of our calls are caught in error scopes, and
    /// its loss shows in the next of our calls that fails or waits.
    pub fn from_parts(info: wgpu::AdapterInfo, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let (health, compiled) = (Health::default(), Arc::default());
        Self { info, device, queue, health, compiled, is_own: false }
    }

    /// The adapter.
    pub fn info(&self) -> &wgpu::AdapterInfo {
        &self.info
    }

    /// The device.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// Its queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// The kernels that simulators on it have needed so far.
    pub(crate) fn compiled(&self) -> &CompiledKernels {
        &self.compiled
    }

    /// The closest contract this device can keep.
    pub fn contract(&self) -> Contract {
        let exact = self.info.backend == wgpu::Backend::Vulkan
            && self.device.features().contains(wgpu::Features::PASSTHROUGH_SHADERS);
        if exact { Contract::Exact } else { Contract::Tolerant }
    }

    /// A compute shader module from WGSL under a contract: plain, or as SPIR-V whose every float operation keeps its
    /// own rounding. Workgroups have [`WORKGROUP_SIZE`](crate::WORKGROUP_SIZE) invocations.
    ///
    /// # Errors
    /// WGSL that does not compile; [`Contract::Exact`] on a device that cannot keep it.
    pub fn compute_module(
        &self,
        source: &str,
        entry_point: &'static str,
        contract: Contract,
    ) -> Result<wgpu::ShaderModule, SimError> {
        shader_module(self, source, entry_point, contract)
    }

    /// Copies the start of a buffer with `COPY_SRC` usage into `out`, after everything submitted before.
    ///
    /// # Errors
    /// A lost device.
    pub fn read(&self, buffer: &wgpu::Buffer, out: &mut [u8]) -> Result<(), SimError> {
        read_buffer(self, buffer, 0, out)
    }

    /// Makes calls to the device and catches its errors.
    ///
    /// # Errors
    /// The first error of these or earlier calls; it stays. A lost device.
    pub fn scoped<T>(&self, calls: impl FnOnce() -> T) -> Result<T, SimError> {
        self.check()?;
        let (result, error) = self.caught(calls);
        if let Some(error) = error {
            let reason = error.to_string();
            let is_lost = self.is_lost();
            let error = if is_lost { SimError::DeviceLost { reason } } else { SimError::Device { reason } };
            report(&self.health, error);
        }
        self.check().map(|()| result)
    }

    /// Makes calls inside error scopes of our own.
    fn caught<T>(&self, calls: impl FnOnce() -> T) -> (T, Option<wgpu::Error>) {
        // Browsers answer later, and nothing can wait there: errors come to the host's callback.
        if cfg!(target_family = "wasm") {
            return (calls(), None);
        }
        let filters =
            [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Internal];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let result = calls();
        // Scopes end in the order opposite to their beginning. Away from browsers each has its answer at once.
        let errors = scopes.into_iter().rev().map(|scope| pollster::block_on(scope.pop()));
        let first = errors.fold(None, Option::or);
        (result, first)
    }

    /// Returns true if the device is lost, whatever was reported first: then it maps no buffer.
    pub fn is_lost(&self) -> bool {
        let (sender, receiver) = std::sync::mpsc::channel();
        let _ = self.caught(|| {
            let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("probe"),
                size: 4,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            buffer.map_async(wgpu::MapMode::Read, .., move |result| {
                // Nobody waits for an answer that comes late: a device that still works on it is not lost.
                let _ = sender.send(result);
            });
            let _ = self.device.poll(wgpu::PollType::Poll);
        });
        matches!(receiver.try_recv(), Ok(Err(_)))
    }

    /// Keeps a report that the device is lost, and returns it.
    pub(crate) fn lost(&self, reason: String) -> SimError {
        report(&self.health, SimError::DeviceLost { reason: reason.clone() });
        self.check().err().unwrap_or(SimError::DeviceLost { reason })
    }

    /// Fails once the device is known to be lost or has reported an error.
    ///
    /// # Errors
    /// The first such report; it stays.
    pub fn check(&self) -> Result<(), SimError> {
        match &*self.health.lock().unwrap_or_else(PoisonError::into_inner) {
            None => Ok(()),
            Some(SimError::DeviceLost { reason }) => Err(SimError::DeviceLost { reason: reason.clone() }),
            Some(SimError::Device { reason }) => Err(SimError::Device { reason: reason.clone() }),
            Some(other) => Err(SimError::Device { reason: other.to_string() }),
        }
    }

    /// Waits for all submitted work.
    ///
    /// # Errors
    /// A lost device.
    pub fn wait(&self) -> Result<(), SimError> {
        self.check()?;
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| SimError::Device { reason: error.to_string() })?;
        if !self.is_own && self.is_lost() {
            return Err(self.lost("it no longer maps buffers".into()));
        }
        self.check()
    }
}

/// Keeps the first report, as later ones follow from it; but the loss of the device is the reason for whatever was reported before.
fn report(health: &Health, error: SimError) {
    let mut health = health.lock().unwrap_or_else(PoisonError::into_inner);
    let is_loss = |error: &SimError| matches!(error, SimError::DeviceLost { .. });
    if health.as_ref().is_none_or(|known| is_loss(&error) && !is_loss(known)) {
        *health = Some(error);
    }
}
