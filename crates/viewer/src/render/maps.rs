use super::environment::{CUBE_EDGE, SPHERE_EDGE, abdomen, cube_map, sphere_map};
use super::tissue_map;
use crate::{Gpu, TissuePicture};

/// The textures of organs, bound together: for those without vessels on their surface, and with them.
pub(super) struct Maps {
    bound: [wgpu::BindGroup; 2],
    /// 1 when the surroundings are a picture of the tissue, whose colours it then takes [-].
    pub(super) map_as_color: f32,
}

impl Maps {
    /// Of the procedural tissue, with the user's picture or the inside of an abdomen around it.
    pub(super) fn new(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        picture: Option<&TissuePicture>,
    ) -> Self {
        let (sphere, cube) = match picture {
            None => {
                let abdomen = abdomen();
                (sphere_map(&abdomen), cube_map(&abdomen))
            }
            Some(picture) => {
                let light = |direction| picture.light(direction);
                (sphere_map(&light), cube_map(&light))
            }
        };
        let sphere = flat_texture(gpu, &sphere, SPHERE_EDGE, 1);
        let cube = flat_texture(gpu, &cube, CUBE_EDGE, 6);
        let sphere = sphere.create_view(&wgpu::TextureViewDescriptor::default());
        let cube = cube.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::Cube),
            ..wgpu::TextureViewDescriptor::default()
        });
        let samplers = [wgpu::AddressMode::Repeat, wgpu::AddressMode::ClampToEdge]
            .map(|mode| sampler(gpu, mode));
        let bound = tissue_map::levels().map(|levels| {
            let tissue = tissue_texture(gpu, &levels);
            let tissue = tissue.create_view(&wgpu::TextureViewDescriptor::default());
            let entries = [
                wgpu::BindingResource::TextureView(&tissue),
                wgpu::BindingResource::Sampler(&samplers[0]),
                wgpu::BindingResource::TextureView(&sphere),
                wgpu::BindingResource::TextureView(&cube),
                wgpu::BindingResource::Sampler(&samplers[1]),
            ];
            let entries: Vec<_> = (0..).zip(entries).map(entry).collect();
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("maps"),
                layout,
                entries: &entries,
            })
        });
        Self {
            bound,
            map_as_color: if picture.is_some() { 0.9 } else { 0.0 },
        }
    }

    /// The textures of tissue with vessels on its surface, or without.
    pub(super) fn of(&self, has_vessels: bool) -> &wgpu::BindGroup {
        &self.bound[usize::from(has_vessels)]
    }

    /// Layout of group 1 of the shader `tissue.wgsl`.
    pub(super) fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
        let texture = |view_dimension| wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let types = [
            texture(wgpu::TextureViewDimension::D3),
            sampler,
            texture(wgpu::TextureViewDimension::D2),
            texture(wgpu::TextureViewDimension::Cube),
            sampler,
        ];
        let entries: Vec<_> = (0..)
            .zip(types)
            .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty,
                count: None,
            })
            .collect();
        gpu.device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("maps"),
                entries: &entries,
            })
    }
}

fn entry<'a>((binding, resource): (u32, wgpu::BindingResource<'a>)) -> wgpu::BindGroupEntry<'a> {
    wgpu::BindGroupEntry { binding, resource }
}

fn sampler(gpu: &Gpu, mode: wgpu::AddressMode) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: mode,
        address_mode_v: mode,
        address_mode_w: mode,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..wgpu::SamplerDescriptor::default()
    })
}

/// Square layers one after the other.
fn flat_texture(gpu: &Gpu, bytes: &[u8], edge: usize, layers: u32) -> wgpu::Texture {
    let size = wgpu::Extent3d {
        width: edge as u32,
        height: edge as u32,
        depth_or_array_layers: layers,
    };
    let texture = texture(gpu, size, wgpu::TextureDimension::D2, 1);
    write(gpu, &texture, 0, size, bytes);
    texture
}

fn tissue_texture(gpu: &Gpu, levels: &[Vec<u8>]) -> wgpu::Texture {
    let cube = |edge: usize| wgpu::Extent3d {
        width: edge as u32,
        height: edge as u32,
        depth_or_array_layers: edge as u32,
    };
    let edge = tissue_map::EDGE;
    let texture = texture(
        gpu,
        cube(edge),
        wgpu::TextureDimension::D3,
        levels.len() as u32,
    );
    for (level, bytes) in levels.iter().enumerate() {
        write(gpu, &texture, level as u32, cube(edge >> level), bytes);
    }
    texture
}

fn texture(
    gpu: &Gpu,
    size: wgpu::Extent3d,
    dimension: wgpu::TextureDimension,
    levels: u32,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("map"),
        size,
        mip_level_count: levels,
        sample_count: 1,
        dimension,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn write(gpu: &Gpu, texture: &wgpu::Texture, level: u32, size: wgpu::Extent3d, bytes: &[u8]) {
    let into = wgpu::TexelCopyTextureInfo {
        texture,
        mip_level: level,
        origin: wgpu::Origin3d::ZERO,
        aspect: wgpu::TextureAspect::All,
    };
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(4 * size.width),
        rows_per_image: Some(size.height),
    };
    gpu.queue.write_texture(into, bytes, layout, size);
}
