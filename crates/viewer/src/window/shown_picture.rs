use eframe::egui::{PaintCallback, PaintCallbackInfo, Rect};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait};

use crate::Gpu;
use crate::render::Target;

/// Puts finished pictures into a window. The shader of the window's own elements does much more for each pixel, which
/// takes as long as an organ where the processor draws.
pub(super) struct PicturePainter {
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    exact: wgpu::RenderPipeline,
    filtered: wgpu::RenderPipeline,
}

/// A picture that a window shows.
#[derive(Clone)]
pub(super) struct ShownPicture {
    size: (u32, u32),
    group: wgpu::BindGroup,
    exact: wgpu::RenderPipeline,
    filtered: wgpu::RenderPipeline,
}

impl PicturePainter {
    /// For a window that takes pixels of this format.
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let texture = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("shown picture"),
                entries: &[entry(0, texture), entry(1, sampler)],
            });
        let shader = gpu
            .device
            .create_shader_module(wgpu::include_wgsl!("shown_picture.wgsl"));
        let pipeline = |is_filtered| pipeline(gpu, &layout, &shader, format, is_filtered);
        Self {
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            }),
            exact: pipeline(false),
            filtered: pipeline(true),
            layout,
        }
    }

    /// The picture of `target`.
    pub(super) fn shown(&self, gpu: &Gpu, target: &Target) -> ShownPicture {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let texture = wgpu::BindingResource::TextureView(target.view());
        let sampler = wgpu::BindingResource::Sampler(&self.sampler);
        ShownPicture {
            size: target.size(),
            group: gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("shown picture"),
                layout: &self.layout,
                entries: &[entry(0, texture), entry(1, sampler)],
            }),
            exact: self.exact.clone(),
            filtered: self.filtered.clone(),
        }
    }
}

impl ShownPicture {
    /// The picture in this place of the window.
    pub(super) fn at(&self, rect: Rect) -> PaintCallback {
        Callback::new_paint_callback(rect, self.clone())
    }
}

impl CallbackTrait for ShownPicture {
    fn paint(
        &self,
        info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &CallbackResources,
    ) {
        let place = info.viewport_in_pixels();
        let (width, height) = self.size;
        let is_exact = (place.width_px, place.height_px) == (width as i32, height as i32);
        pass.set_pipeline(if is_exact {
            &self.exact
        } else {
            &self.filtered
        });
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Width and height [pixels] of a place in the window, as it is drawn.
pub(super) fn pixels(rect: Rect, pixels_per_point: f32) -> (u32, u32) {
    let place = PaintCallbackInfo {
        viewport: rect,
        clip_rect: rect,
        pixels_per_point,
        screen_size_px: [i32::MAX as u32; 2],
    };
    let place = place.viewport_in_pixels();
    (place.width_px.max(1) as u32, place.height_px.max(1) as u32)
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    module: &wgpu::ShaderModule,
    format: wgpu::TextureFormat,
    is_filtered: bool,
) -> wgpu::RenderPipeline {
    let constants = [
        ("FILTERED", f64::from(u8::from(is_filtered))),
        ("LINEAR", f64::from(u8::from(format.is_srgb()))),
    ];
    let options = wgpu::PipelineCompilationOptions {
        constants: &constants,
        ..wgpu::PipelineCompilationOptions::default()
    };
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shown picture"),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shown picture"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("shown_vertex"),
                compilation_options: options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("shown_fragment"),
                compilation_options: options,
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
}
