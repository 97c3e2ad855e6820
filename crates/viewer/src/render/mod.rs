//! Pictures of an organ and its tools, drawn by a graphics adapter into a texture of their own, which a
//! window shows or a file receives.
//!
//! Tissue is lit by a key light and by light from all sides, less in hollows and under tools, which cast soft
//! shadows of the key light. Light that enters tissue leaves it nearby: each colour has its own normal between that of
//! the relief and that of the surface, red the smoothest [Ma et al. 2007]. With a map of the surroundings (section
//! 7.5) tissue is wet: a film of water fills its relief, darkens it [Lekner and Dorf 1988], mirrors the map by Fresnel's
//! law and shows the lamp as a microfacet surface of the film's roughness. Without one it is dull. An endoscope's light
//! falls with the squared distance and towards the edge of its cone. Everything is bent to the display's gamma in the
//! shader. Numbers and costs: `docs/theory/pictures.md`.
//!
//! *How we know*: `golden::…` compare pictures; `agreement::the_picture_is_where_the_camera_says`;
//! `film_tests::…` integrate what the shader computes; `wet::…` measure light in pictures.
//!
//! *Limits*: no shadows but those of tools, as capsules; the film mirrors no organ.

pub(crate) mod ambient_light;
mod body;
mod crease;
pub(crate) mod environment;
#[cfg(test)]
mod film_tests;
pub(crate) mod labels;
mod light;
mod maps;
mod noise;
pub(crate) mod openings;
mod pipelines;
mod target;
mod tint;
mod tissue_map;
mod tool;
mod uniforms;
pub(crate) mod user_map;

use palpate_files::scene::Shading;
use wgpu::util::DeviceExt;

pub use body::{Body, single_precision};
pub(crate) use body::{FibreRun, Fibres};
pub use labels::{Label, LabelTarget, Labels};
pub(crate) use target::DEPTH_AND_LABEL;
pub use target::Target;
pub use tint::Tint;
pub use tool::ToolPicture;

use crate::{Camera, Gpu, TissuePicture};
use maps::Maps;
use pipelines::{Pipelines, Subject, number};
use tool::{PARTS, Part, ToolShape};
use uniforms::{BodyUniform, Globals, InstrumentUniform, TOOLS, columns, vector};

/// How a picture is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// How the organ is drawn.
    pub shading: Shading,
    /// Details of tissue.
    pub looks: Looks,
    /// Distance from the camera's target within which bodies are drawn [m].
    pub reach: f64,
}

/// Details of tissue beyond its shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Looks {
    /// Its fine relief, patches and vessels.
    pub relief: bool,
    /// Light that goes round the edges of relief and shadows, red farthest.
    pub scattering: bool,
    /// The shadows of tools.
    pub shadows: bool,
}

impl Looks {
    /// Everything.
    pub const ALL: Self = Self {
        relief: true,
        scattering: true,
        shadows: true,
    };
    /// The shape alone.
    pub const NONE: Self = Self {
        relief: false,
        scattering: false,
        shadows: false,
    };
}

/// The renderer.
pub struct Renderer {
    pipelines: Pipelines,
    maps: Maps,
    globals: Bound,
    bodies: Vec<Bound>,
    instruments: Vec<Bound>,
    shapes: Vec<Option<(ToolShape, Vec<UploadedPart>)>>,
}

/// A part of a tool with the buffer of its triangles.
struct UploadedPart {
    part: Part,
    buffer: wgpu::Buffer,
}

/// A uniform buffer and its group.
struct Bound {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Renderer {
    /// With the procedural tissue and the inside of an abdomen around it.
    pub fn new(gpu: &Gpu) -> Self {
        let pipelines = Pipelines::new(gpu);
        let instrument = size_of::<InstrumentUniform>();
        Self {
            maps: Maps::new(gpu, &pipelines.maps, None),
            globals: Bound::new(gpu, &pipelines.globals, size_of::<Globals>()),
            bodies: Vec::new(),
            instruments: (0..TOOLS * PARTS)
                .map(|_| Bound::new(gpu, &pipelines.own, instrument))
                .collect(),
            shapes: (0..TOOLS).map(|_| None).collect(),
            pipelines,
        }
    }

    /// Lays `picture` around the organ as sphere map and cube map, which take the tissue's colours from
    /// it; none is the inside of an abdomen.
    pub fn surround(&mut self, gpu: &Gpu, picture: Option<&TissuePicture>) {
        self.maps = Maps::new(gpu, &self.pipelines.maps, picture);
    }

    /// Draws `bodies` and `tools` into `target`; it is handed in, not waited for.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        view: &View,
        bodies: &[&Body],
        tools: &[ToolPicture],
        target: &Target,
    ) {
        self.write(gpu, view, bodies, tools, target.size());
        self.pass(gpu, &target.attachments(), |pass| {
            let pipeline = |subject| self.pipelines.of(gpu, subject, target.samples());
            self.draw_bodies(pass, bodies, |body| {
                pipeline(Subject::Tissue {
                    shading: number(view.shading),
                    looks: view.looks,
                    tools: tools.len().min(TOOLS) as u8,
                    endoscope: view.camera.lamp.is_some(),
                    fibres: body.fibres.is_some(),
                })
            });
            pass.set_pipeline(&pipeline(Subject::Instrument));
            self.draw_tools(pass, tools.len());
            // Last, where nothing is: a slow machine does not draw it twice.
            pass.set_pipeline(&pipeline(Subject::Backdrop));
            pass.draw(0..3, 0..1);
        });
    }

    /// Draws how far ahead of the eye `bodies` and `tools` are, and what they are, into `target`; it is handed in, not
    /// waited for.
    pub fn measure(
        &mut self,
        gpu: &Gpu,
        view: &View,
        bodies: &[&Body],
        tools: &[ToolPicture],
        target: &LabelTarget,
    ) {
        self.write(gpu, view, bodies, tools, target.size());
        self.pass(gpu, &target.attachments(), |pass| {
            let tissue = self.pipelines.of(gpu, Subject::TissueLabel, 1);
            self.draw_bodies(pass, bodies, |_| tissue.clone());
            pass.set_pipeline(&self.pipelines.of(gpu, Subject::InstrumentLabel, 1));
            self.draw_tools(pass, tools.len());
        });
    }

    /// Submits what `draw` puts into one pass over `attachments`.
    fn pass(
        &self,
        gpu: &Gpu,
        attachments: &Attachments<'_>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = begin(&mut encoder, attachments);
            pass.set_bind_group(0, &self.globals.group, &[]);
            draw(&mut pass);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    fn draw_bodies(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        bodies: &[&Body],
        pipeline: impl Fn(&Body) -> wgpu::RenderPipeline,
    ) {
        let bodies = bodies.iter().zip(&self.bodies);
        for (body, bound) in bodies.filter(|(body, _)| body.triangles() > 0) {
            pass.set_pipeline(&pipeline(body));
            pass.set_bind_group(1, self.maps.of(body.tint.has_vessels), &[]);
            pass.set_bind_group(2, &bound.group, &[]);
            pass.set_vertex_buffer(0, body.moving_buffer.slice(..));
            pass.set_vertex_buffer(1, body.resting_buffer.slice(..));
            pass.set_index_buffer(body.index_buffer.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..3 * body.triangles() as u32, 0, 0..1);
        }
    }

    fn draw_tools(&self, pass: &mut wgpu::RenderPass<'_>, count: usize) {
        let shapes = self.shapes.iter().zip(self.instruments.chunks(PARTS));
        for (shape, bounds) in shapes.take(count) {
            let parts = shape.iter().flat_map(|(_, parts)| parts);
            for (uploaded, bound) in parts.zip(bounds) {
                pass.set_bind_group(1, &bound.group, &[]);
                pass.set_vertex_buffer(0, uploaded.buffer.slice(..));
                pass.draw(0..uploaded.part.corners.len() as u32, 0..1);
            }
        }
    }

    fn write(
        &mut self,
        gpu: &Gpu,
        view: &View,
        bodies: &[&Body],
        tools: &[ToolPicture],
        size: (u32, u32),
    ) {
        let globals = Globals::new(&view.camera, tools, size, view.reach);
        self.globals.write(gpu, bytemuck::bytes_of(&globals));
        while self.bodies.len() < bodies.len() {
            let bound = Bound::new(gpu, &self.pipelines.own, size_of::<BodyUniform>());
            self.bodies.push(bound);
        }
        for (body, bound) in bodies.iter().zip(&self.bodies) {
            let mut uniform = body.tint.uniform(self.maps.map_as_color);
            if let Some(fibres) = &body.fibres {
                uniform.fibres = vector(&fibres.axis, 0.0);
                uniform.fibre_center = vector(&fibres.center, fibres.run as u8 as f32);
            }
            uniform.open(&body.openings);
            uniform.label(body.label);
            bound.write(gpu, bytemuck::bytes_of(&uniform));
        }
        for (number, tool) in tools.iter().take(TOOLS).enumerate() {
            self.shape(gpu, number, &tool.shape);
            let parts = self.shapes[number].iter().flat_map(|(_, parts)| parts);
            for (uploaded, bound) in parts.zip(&self.instruments[PARTS * number..]) {
                let uniform = InstrumentUniform {
                    placed: columns(&tool.placed(&uploaded.part)),
                    color: uploaded.part.look(),
                    label: [f32::from(tool.label.number()), 0.0, 0.0, 0.0],
                };
                bound.write(gpu, bytemuck::bytes_of(&uniform));
            }
        }
    }

    /// Makes the meshes of a tool anew when its shape is another one.
    fn shape(&mut self, gpu: &Gpu, number: usize, shape: &ToolShape) {
        let uploaded = &mut self.shapes[number];
        if uploaded.as_ref().is_some_and(|(last, _)| last == shape) {
            return;
        }
        let parts = shape
            .parts()
            .into_iter()
            .take(PARTS)
            .map(|part| UploadedPart {
                buffer: gpu
                    .device
                    .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some("tool"),
                        contents: bytemuck::cast_slice(&part.corners),
                        usage: wgpu::BufferUsages::VERTEX,
                    }),
                part,
            });
        *uploaded = Some((shape.clone(), parts.collect()));
    }
}

impl Bound {
    fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, bytes: usize) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("uniforms"),
            size: bytes as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("uniforms"),
            layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            }],
        });
        Self { buffer, group }
    }

    fn write(&self, gpu: &Gpu, bytes: &[u8]) {
        gpu.queue.write_buffer(&self.buffer, 0, bytes);
    }
}

/// Where a pass draws.
struct Attachments<'t> {
    drawn: &'t wgpu::TextureView,
    /// Where several samples per pixel become one.
    resolved: Option<&'t wgpu::TextureView>,
    depth: &'t wgpu::TextureView,
}

fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    attachments: &Attachments<'_>,
) -> wgpu::RenderPass<'e> {
    let store = match attachments.resolved {
        Some(_) => wgpu::StoreOp::Discard,
        None => wgpu::StoreOp::Store,
    };
    encoder
        .begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: attachments.drawn,
                depth_slice: None,
                resolve_target: attachments.resolved,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: attachments.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
        .forget_lifetime()
}
