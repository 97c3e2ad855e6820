use std::cell::RefCell;
use std::collections::BTreeMap;

use palpate_files::scene::Shading;

use super::Looks;
use super::maps::Maps;
use super::target::{COLOR, DEPTH, DEPTH_AND_LABEL};
use crate::Gpu;

/// Subject of a pipeline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Subject {
    Backdrop,
    Tissue {
        /// As `SHADING` in `tissue.wgsl`.
        shading: u8,
        looks: Looks,
        /// How many tools there are.
        tools: u8,
        /// Whether the light is an endoscope's.
        endoscope: bool,
        /// Whether muscle is cut through.
        fibres: bool,
    },
    Instrument,
    /// Depth and label of tissue.
    TissueLabel,
    /// Depth and label of a tool.
    InstrumentLabel,
}

impl Subject {
    fn is_tissue(self) -> bool {
        matches!(self, Self::Tissue { .. } | Self::TissueLabel)
    }
}

/// The pipelines; each is made when it is first needed, for that costs a slow machine a moment.
pub(super) struct Pipelines {
    pub(super) globals: wgpu::BindGroupLayout,
    pub(super) maps: wgpu::BindGroupLayout,
    pub(super) own: wgpu::BindGroupLayout,
    shaders: [wgpu::ShaderModule; 3],
    made: RefCell<BTreeMap<(Subject, u32), wgpu::RenderPipeline>>,
}

impl Pipelines {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let shared = include_str!("shader/picture.wgsl");
        let shaders = [
            include_str!("shader/backdrop.wgsl"),
            concat!(
                include_str!("shader/film.wgsl"),
                include_str!("shader/tissue.wgsl")
            ),
            include_str!("shader/instrument.wgsl"),
        ];
        Self {
            globals: uniform_layout(gpu, "globals"),
            maps: Maps::layout(gpu),
            own: uniform_layout(gpu, "own"),
            shaders: shaders.map(|own| {
                let source = format!("{shared}\n{own}");
                gpu.device
                    .create_shader_module(wgpu::ShaderModuleDescriptor {
                        label: Some("picture"),
                        source: wgpu::ShaderSource::Wgsl(source.into()),
                    })
            }),
            made: RefCell::default(),
        }
    }

    /// The pipeline of `subject` for pictures of so many samples per pixel.
    pub(super) fn of(&self, gpu: &Gpu, subject: Subject, samples: u32) -> wgpu::RenderPipeline {
        let mut made = self.made.borrow_mut();
        let pipeline = made
            .entry((subject, samples))
            .or_insert_with(|| self.make(gpu, subject, samples));
        pipeline.clone()
    }

    fn make(&self, gpu: &Gpu, subject: Subject, samples: u32) -> wgpu::RenderPipeline {
        let (shader, entries) = match subject {
            Subject::Backdrop => (0, ["backdrop_vertex", "backdrop_fragment"]),
            Subject::Tissue { .. } => (1, ["tissue_vertex", "tissue_fragment"]),
            Subject::Instrument => (2, ["instrument_vertex", "instrument_fragment"]),
            Subject::TissueLabel => (1, ["tissue_vertex", "tissue_label"]),
            Subject::InstrumentLabel => (2, ["instrument_vertex", "instrument_label"]),
        };
        let groups = match subject {
            Subject::Backdrop => vec![Some(&self.globals)],
            Subject::Tissue { .. } | Subject::TissueLabel => {
                vec![Some(&self.globals), Some(&self.maps), Some(&self.own)]
            }
            Subject::Instrument | Subject::InstrumentLabel => {
                vec![Some(&self.globals), Some(&self.own)]
            }
        };
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &groups,
                immediate_size: 0,
            });
        let constants = match subject {
            Subject::Tissue {
                shading,
                looks,
                tools,
                endoscope,
                fibres,
            } => vec![
                ("SHADING", f64::from(shading)),
                ("RELIEF", f64::from(u8::from(looks.relief))),
                ("SCATTERING", f64::from(u8::from(looks.scattering))),
                ("SHADOWS", f64::from(tools * u8::from(looks.shadows))),
                ("ENDOSCOPE", f64::from(u8::from(endoscope))),
                ("FIBRES", f64::from(u8::from(fibres))),
            ],
            _ => Vec::new(),
        };
        let options = wgpu::PipelineCompilationOptions {
            constants: &constants,
            ..wgpu::PipelineCompilationOptions::default()
        };
        let target = Some(wgpu::ColorTargetState::from(match subject {
            Subject::TissueLabel | Subject::InstrumentLabel => DEPTH_AND_LABEL,
            _ => COLOR,
        }));
        let descriptor = wgpu::RenderPipelineDescriptor {
            label: Some(entries[0]),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &self.shaders[shader],
                entry_point: Some(entries[0]),
                compilation_options: options.clone(),
                buffers: buffers(subject),
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: subject.is_tissue().then_some(wgpu::Face::Back),
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(depth(subject)),
            multisample: wgpu::MultisampleState {
                count: samples,
                ..wgpu::MultisampleState::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &self.shaders[shader],
                entry_point: Some(entries[1]),
                compilation_options: options,
                targets: &[target],
            }),
            multiview_mask: None,
            cache: None,
        };
        gpu.device.create_render_pipeline(&descriptor)
    }
}

/// As `SHADING` in `tissue.wgsl`.
pub(super) fn number(shading: Shading) -> u8 {
    match shading {
        Shading::Plain => 0,
        Shading::Texture => 1,
        Shading::SphereMap => 2,
        Shading::CubeMap => 3,
    }
}

const TURNS: &[wgpu::VertexAttribute] = &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
const REST: &[wgpu::VertexAttribute] = &wgpu::vertex_attr_array![2 => Float32x4];

const fn layout(
    floats: u64,
    attributes: &'static [wgpu::VertexAttribute],
) -> Option<wgpu::VertexBufferLayout<'static>> {
    Some(wgpu::VertexBufferLayout {
        array_stride: 4 * floats,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes,
    })
}

fn buffers(subject: Subject) -> &'static [Option<wgpu::VertexBufferLayout<'static>>] {
    const BOTH: &[Option<wgpu::VertexBufferLayout<'static>>] = &[layout(6, TURNS), layout(4, REST)];
    match subject {
        Subject::Backdrop => &[],
        Subject::Tissue { .. } | Subject::TissueLabel => BOTH,
        Subject::Instrument | Subject::InstrumentLabel => BOTH.split_at(1).0,
    }
}

fn depth(subject: Subject) -> wgpu::DepthStencilState {
    let behind = subject == Subject::Backdrop;
    wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(!behind),
        depth_compare: Some(match behind {
            true => wgpu::CompareFunction::LessEqual,
            false => wgpu::CompareFunction::Less,
        }),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

fn uniform_layout(gpu: &Gpu, label: &str) -> wgpu::BindGroupLayout {
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        })
}
