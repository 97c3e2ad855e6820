use image::RgbaImage;

use super::Attachments;
use crate::{Error, Gpu};

/// Bytes of light that the shader has already bent to the display's gamma; windows take them as they are.
pub(super) const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
pub(crate) const DEPTH_AND_LABEL: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Row alignment of copies between textures and buffers.
const ROW_ALIGNMENT: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// The target of a picture.
pub struct Target {
    size: (u32, u32),
    samples: u32,
    picture: wgpu::Texture,
    shown: wgpu::TextureView,
    /// Where several samples per pixel are drawn; none when one is.
    sampled: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
}

impl Target {
    /// Of `size` [pixels] with 1 or 4 `samples` per pixel. No side is shorter than one pixel or longer than
    /// the adapter allows.
    pub fn new(gpu: &Gpu, size: (u32, u32), samples: u32) -> Self {
        let size = allowed(gpu, size);
        let samples = if samples > 1 { 4 } else { 1 };
        let texture = |format, samples, usage| attachment(gpu, size, samples, format, usage);
        let none = wgpu::TextureUsages::empty();
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let picture = texture(COLOR, 1, read);
        Self {
            size,
            samples,
            shown: view(&picture),
            sampled: (samples > 1).then(|| view(&texture(COLOR, samples, none))),
            depth: view(&texture(DEPTH, samples, none)),
            picture,
        }
    }

    /// Width and height [pixels].
    pub fn size(&self) -> (u32, u32) {
        self.size
    }

    /// Samples per pixel.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// The picture, to show it.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.shown
    }

    pub(super) fn attachments(&self) -> Attachments<'_> {
        match &self.sampled {
            Some(sampled) => Attachments {
                drawn: sampled,
                resolved: Some(&self.shown),
                depth: &self.depth,
            },
            None => Attachments {
                drawn: &self.shown,
                resolved: None,
                depth: &self.depth,
            },
        }
    }

    /// The picture, brought back from the adapter once everything handed in is drawn.
    ///
    /// # Errors
    /// When the adapter was lost.
    pub fn read(&self, gpu: &Gpu) -> Result<RgbaImage, Error> {
        let (width, height) = self.size;
        let bytes = read_texture(gpu, &self.picture, self.size, 4)?;
        RgbaImage::from_raw(width, height, bytes).ok_or_else(|| lost("it came back too short"))
    }
}

/// The bytes of a texture of `size` [pixels] with so many bytes for each, once everything handed in is drawn.
pub(super) fn read_texture(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    size: (u32, u32),
    each: u32,
) -> Result<Vec<u8>, Error> {
    let (width, height) = size;
    let row = (each * width).next_multiple_of(ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let into = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout: wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        },
    };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), into, extent(size));
    gpu.queue.submit([encoder.finish()]);
    let (sender, answer) = std::sync::mpsc::channel();
    let on_mapped = move |outcome| {
        // The receiver lives until the answer is there.
        let _ = sender.send(outcome);
    };
    buffer.slice(..).map_async(wgpu::MapMode::Read, on_mapped);
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(lost)?;
    answer.recv().map_err(lost)?.map_err(lost)?;
    let mapped = buffer.slice(..).get_mapped_range().map_err(lost)?;
    let rows = mapped.chunks_exact(row as usize);
    let used = (each * width) as usize;
    Ok(rows.flat_map(|r| &r[..used]).copied().collect())
}

fn lost(cause: impl std::fmt::Display) -> Error {
    Error::Lost {
        cause: cause.to_string(),
    }
}

/// The nearest size [pixels] that the adapter allows.
pub(super) fn allowed(gpu: &Gpu, (width, height): (u32, u32)) -> (u32, u32) {
    let most = gpu.device.limits().max_texture_dimension_2d;
    (width.clamp(1, most), height.clamp(1, most))
}

/// A texture that is drawn into, for a `usage` besides.
pub(super) fn attachment(
    gpu: &Gpu,
    size: (u32, u32),
    samples: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("attachment"),
        size: extent(size),
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
        view_formats: &[],
    })
}

/// The whole of a texture.
pub(super) fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

pub(super) fn extent((width, height): (u32, u32)) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    }
}
