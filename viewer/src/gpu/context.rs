//! The device that draws: any adapter that wgpu finds.

use std::sync::Arc;
use std::sync::Mutex;

use super::made::Counts;

/// Which adapter to use.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Part of the adapter's name, in any case; `None` takes `WGPU_ADAPTER_NAME`, or else the fastest kind.
    pub adapter: Option<String>,
}

/// An adapter, for people to choose from.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct AdapterSummary {
    /// As the driver calls it.
    pub name: String,
    /// `discrete-gpu`, `integrated-gpu`, `virtual-gpu`, `cpu` (a software adapter) or `other`.
    pub kind: &'static str,
    /// `vulkan`, `gl`, `metal`, `dx12`.
    pub backend: String,
    /// The driver and its version.
    pub driver: String,
}

impl AdapterSummary {
    fn of(info: &wgpu::AdapterInfo) -> Self {
        let kind = match info.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete-gpu",
            wgpu::DeviceType::IntegratedGpu => "integrated-gpu",
            wgpu::DeviceType::VirtualGpu => "virtual-gpu",
            wgpu::DeviceType::Cpu => "cpu",
            wgpu::DeviceType::Other => "other",
        };
        Self {
            name: info.name.clone(),
            kind,
            backend: info.backend.to_string(),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        }
    }

    /// Whether it computes on the processor.
    pub fn is_software(&self) -> bool {
        self.kind == "cpu"
    }
}

impl std::fmt::Display for AdapterSummary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}, {})", self.name, self.kind, self.backend)
    }
}

/// Why there is no device, or what happened to it.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter at all.
    #[error("no graphics adapter was found; on Debian and Ubuntu, mesa-vulkan-drivers brings one that needs no GPU")]
    NoAdapter,
    /// None of that name.
    #[error("no adapter is called `{wanted}`; there are: {}", .found.join(", "))]
    NoSuchAdapter {
        /// The name asked for.
        wanted: String,
        /// The names there are.
        found: Vec<String>,
    },
    /// The adapter gives no device.
    #[error("{adapter} gives no device: {cause}")]
    Device {
        /// The adapter.
        adapter: String,
        /// What it says.
        cause: String,
    },
    /// The adapter lacks something that drawing needs.
    #[error("{adapter} cannot draw this: {cause}")]
    Unfit {
        /// The adapter.
        adapter: String,
        /// What is missing.
        cause: String,
    },
    /// A picture or buffer is larger than the adapter takes.
    #[error("{what}: {wanted} are needed, and {adapter} takes {limit} at most")]
    TooLarge {
        /// What does not fit.
        what: String,
        /// Its size.
        wanted: u64,
        /// The limit.
        limit: u64,
        /// The adapter.
        adapter: String,
    },
    /// The device went away: driver reset, suspended, unplugged, out of memory.
    #[error("the graphics device was lost: {0}")]
    Lost(String),
    /// The device reported an error.
    #[error("the graphics device failed: {0}")]
    Failed(String),
}

/// A device and its queue; copies are of one and the same.
#[derive(Clone)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Which adapter it is.
    pub adapter: AdapterSummary,
    /// Whether passes can be timed on the device.
    pub has_timestamps: bool,
    /// Whether a texture can be seen in another format than its own.
    pub(crate) has_view_formats: bool,
    pub(super) counts: Arc<Counts>,
    failure: Arc<Mutex<Option<Failure>>>,
}

enum Failure {
    Lost(String),
    Error(String),
}

impl Gpu {
    /// Opens an adapter.
    ///
    /// # Errors
    /// [`GpuError`] if there is none, none of that name, or it gives no device.
    pub fn open(options: &GpuOptions) -> Result<Self, GpuError> {
        let adapters = all_adapters();
        Self::from_adapter(Self::choose(&adapters, options)?)
    }

    /// The adapter that [`Gpu::open`] takes of several.
    ///
    /// # Errors
    /// [`GpuError`] if there is none, or none of that name.
    pub fn choose<'a>(adapters: &'a [wgpu::Adapter], options: &GpuOptions) -> Result<&'a wgpu::Adapter, GpuError> {
        let wanted = options.adapter.clone().or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
        let is_wanted = |adapter: &&wgpu::Adapter| {
            let name = adapter.get_info().name.to_lowercase();
            wanted.as_ref().is_none_or(|wanted| name.contains(&wanted.to_lowercase()))
        };
        // The first of the best kind.
        let chosen = adapters.iter().filter(is_wanted).min_by_key(|adapter| rank(&adapter.get_info()));
        chosen.ok_or_else(|| match &wanted {
            Some(wanted) if !adapters.is_empty() => GpuError::NoSuchAdapter {
                wanted: wanted.clone(),
                found: adapters.iter().map(|adapter| adapter.get_info().name).collect(),
            },
            _ => GpuError::NoAdapter,
        })
    }

    /// Opens this adapter; a window's surface decides which.
    ///
    /// # Errors
    /// [`GpuError::Device`] if it gives no device.
    pub fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self, GpuError> {
        let summary = AdapterSummary::of(&adapter.get_info());
        let (device, queue) = pollster::block_on(adapter.request_device(&Self::descriptor(adapter)))
            .map_err(|error| GpuError::Device { adapter: summary.to_string(), cause: error.to_string() })?;
        Ok(Self::watched(&device, &queue, adapter))
    }

    /// What a device of this adapter is opened with: what drawing makes use of, as far as the adapter has it.
    pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        let useful = wgpu::Features::TIMESTAMP_QUERY;
        // What every WebGPU adapter has is enough, and less on older ones is tried with; only sizes may be larger.
        let own = adapter.limits();
        let required_limits = wgpu::Limits {
            max_buffer_size: own.max_buffer_size,
            max_storage_buffer_binding_size: own.max_storage_buffer_binding_size,
            max_texture_dimension_2d: own.max_texture_dimension_2d,
            max_texture_array_layers: own.max_texture_array_layers,
            ..wgpu::Limits::default().or_worse_values_from(&own)
        };
        wgpu::DeviceDescriptor {
            label: Some("tam-viewer"),
            required_features: adapter.features() & useful,
            required_limits,
            ..wgpu::DeviceDescriptor::default()
        }
    }

    /// A device that was opened elsewhere, whose callbacks become this one's: [`Gpu::check`] tells what goes wrong on it,
    /// whoever uses it.
    pub fn watched(device: &wgpu::Device, queue: &wgpu::Queue, adapter: &wgpu::Adapter) -> Self {
        let mut gpu = Self::shared(device, queue, &adapter.get_info());
        let flags = adapter.get_downlevel_capabilities().flags;
        gpu.has_view_formats = flags.contains(wgpu::DownlevelFlags::VIEW_FORMATS);
        let lost = Arc::clone(&gpu.failure);
        device.set_device_lost_callback(move |_, message| note(&lost, Failure::Lost(message)));
        let failed = Arc::clone(&gpu.failure);
        device.on_uncaptured_error(Arc::new(move |error| note(&failed, Failure::Error(error.to_string()))));
        gpu
    }

    /// Somebody else's device, whatever it was opened with: WebGPU's default limits are enough. Its callbacks stay as
    /// they are, so that what goes wrong on it is told to its owner, and [`Gpu::check`] knows nothing of it.
    pub fn shared(device: &wgpu::Device, queue: &wgpu::Queue, adapter: &wgpu::AdapterInfo) -> Self {
        Self {
            has_timestamps: device.features().contains(wgpu::Features::TIMESTAMP_QUERY),
            device: device.clone(),
            queue: queue.clone(),
            adapter: AdapterSummary::of(adapter),
            has_view_formats: false,
            counts: Arc::default(),
            failure: Arc::default(),
        }
    }

    /// Whether the device has storage buffers and compute passes, as WebGPU has and WebGL 2 has not: without them there are no
    /// lines, no frames of faces and no views of them.
    pub fn has_storage(&self) -> bool {
        let limits = self.device.limits();
        limits.max_storage_buffers_per_shader_stage >= 5 && limits.max_compute_invocations_per_workgroup > 0
    }

    /// All adapters, the one that [`Gpu::open`] would take first.
    pub fn adapters() -> Vec<AdapterSummary> {
        let mut adapters = all_adapters();
        adapters.sort_by_key(|adapter| rank(&adapter.get_info()));
        adapters.iter().map(|adapter| AdapterSummary::of(&adapter.get_info())).collect()
    }

    /// What went wrong on the device since this was last asked. A device that is lost stays so; other errors are told
    /// once, as what is drawn next may well succeed.
    ///
    /// # Errors
    /// [`GpuError::Lost`] or [`GpuError::Failed`], if anything did.
    pub fn check(&self) -> Result<(), GpuError> {
        let mut failure = self.failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        match failure.take() {
            None => Ok(()),
            Some(Failure::Lost(cause)) => {
                *failure = Some(Failure::Lost(cause.clone()));
                Err(GpuError::Lost(cause))
            }
            Some(Failure::Error(cause)) => Err(GpuError::Failed(cause)),
        }
    }

    /// Whether the device went away; then nothing succeeds on it any more.
    pub fn is_lost(&self) -> bool {
        // A loss that is known is told when somebody asks for news.
        let _ = self.device.poll(wgpu::PollType::Poll);
        let failure = self.failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        matches!(*failure, Some(Failure::Lost(_)))
    }

    /// Waits until all submitted work is done.
    ///
    /// # Errors
    /// [`GpuError::Lost`] or [`GpuError::Failed`].
    pub fn wait(&self) -> Result<(), GpuError> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| GpuError::Lost(error.to_string()))?;
        self.check()
    }

    /// Copies texels, once the work before is done.
    #[cfg(feature = "app")]
    pub(crate) fn copy(
        &self,
        from: wgpu::TexelCopyTextureInfo<'_>,
        to: wgpu::TexelCopyTextureInfo<'_>,
        extent: wgpu::Extent3d,
    ) {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_texture(from, to, extent);
        self.queue.submit([encoder.finish()]);
    }

    /// Whether a buffer of this many bytes can be bound.
    pub(crate) fn fits(&self, what: &str, bytes: u64) -> Result<(), GpuError> {
        let limits = self.device.limits();
        // Without storage buffers nothing of it is bound.
        let bound = if self.has_storage() { limits.max_storage_buffer_binding_size } else { u64::MAX };
        let limit = bound.min(limits.max_buffer_size);
        if bytes <= limit {
            return Ok(());
        }
        Err(GpuError::TooLarge {
            what: format!("bytes for {what}"),
            wanted: bytes,
            limit,
            adapter: self.adapter.to_string(),
        })
    }
}

/// The first failure is the cause; those after it follow from it. A device that is lost is lost, whatever came before.
fn note(place: &Mutex<Option<Failure>>, failure: Failure) {
    let mut place = place.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if place.is_none() || matches!(failure, Failure::Lost(_)) {
        *place = Some(failure);
    }
}

/// OpenGL only where nothing better is found: its drivers print to the terminal where there is no display.
fn all_adapters() -> Vec<wgpu::Adapter> {
    let adapters = |backends| {
        let descriptor =
            wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle() };
        let instance = wgpu::Instance::new(descriptor.with_env());
        pollster::block_on(instance.enumerate_adapters(backends))
    };
    if let Some(backends) = wgpu::Backends::from_env() {
        return adapters(backends);
    }
    let found = adapters(wgpu::Backends::PRIMARY);
    if found.is_empty() { adapters(wgpu::Backends::SECONDARY) } else { found }
}

fn rank(info: &wgpu::AdapterInfo) -> (u8, u8) {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    (kind, u8::from(info.backend == wgpu::Backend::Gl))
}
