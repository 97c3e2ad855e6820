use crate::Error;
use crate::render::DEPTH_AND_LABEL;

/// A graphics adapter with its device and queue. Clones share the device.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// The device.
    pub(crate) device: wgpu::Device,
    /// Its queue.
    pub(crate) queue: wgpu::Queue,
    adapter: String,
    software: bool,
    /// Whether it draws depths and labels.
    pub(crate) has_labels: bool,
}

impl Gpu {
    /// Opens an adapter without a display. The environment may choose: `WGPU_ADAPTER_NAME`, `WGPU_BACKEND`.
    ///
    /// # Errors
    /// When there is no adapter, or it cannot be used.
    pub fn open() -> Result<Self, Error> {
        let adapter = pollster::block_on(named_or_best(&instance(wgpu::Backends::PRIMARY)))
            .or_else(|_| pollster::block_on(named_or_best(&instance(wgpu::Backends::all()))))
            .map_err(|cause| Error::NoAdapter { cause })?;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("palpate"),
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|cause| {
                Error::NoDevice {
                    adapter: adapter.get_info().name,
                    cause,
                }
            })?;
        Ok(Self::of(&adapter, device, queue))
    }

    /// A device that somebody else has opened, such as a window.
    pub fn of(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let info = adapter.get_info();
        let features = adapter.get_texture_format_features(DEPTH_AND_LABEL);
        Self {
            has_labels: features
                .allowed_usages
                .contains(wgpu::TextureUsages::RENDER_ATTACHMENT),
            device,
            queue,
            adapter: format!("{} ({})", info.name, info.backend),
            software: info.device_type == wgpu::DeviceType::Cpu,
        }
    }

    /// Submits the written data.
    pub fn submit(&self) {
        self.queue.submit([]);
    }

    /// Waits until all submitted work is done.
    ///
    /// # Errors
    /// When the adapter was lost.
    pub fn wait(&self) -> Result<(), Error> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        waited.map(drop).map_err(|cause| Error::Lost {
            cause: cause.to_string(),
        })
    }

    /// Name of the adapter and of its graphics interface.
    pub fn adapter(&self) -> &str {
        &self.adapter
    }

    /// Whether the processor does the drawing.
    pub fn is_software(&self) -> bool {
        self.software
    }
}

/// Backends that the environment asks for, else `backends`: OpenGL, which looks for a display and complains when
/// there is none, comes last.
fn instance(backends: wgpu::Backends) -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    wgpu::Instance::new(descriptor.with_env())
}

async fn named_or_best(
    instance: &wgpu::Instance,
) -> Result<wgpu::Adapter, wgpu::RequestAdapterError> {
    let wanted = std::env::var("WGPU_ADAPTER_NAME").map(|name| name.to_lowercase());
    if let Ok(wanted) = wanted {
        let adapters = instance.enumerate_adapters(wgpu::Backends::all()).await;
        let named = |adapter: &wgpu::Adapter| adapter.get_info().name.to_lowercase();
        if let Some(found) = adapters.into_iter().find(|a| named(a).contains(&wanted)) {
            return Ok(found);
        }
    }
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        ..wgpu::RequestAdapterOptions::default()
    };
    instance.request_adapter(&options).await
}
