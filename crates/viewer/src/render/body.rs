use nalgebra::{Matrix3, Vector3};
use palpate_geometry::{NodeId, Surface, TriangleMesh, Vec3};

use super::Tint;
use super::ambient_light::ambient_light;
use super::crease::crease;
use super::labels::Label;
use super::openings::Opening;
use crate::Gpu;

type Vec3f = Vector3<f32>;

/// An organ on the adapter. Its vertices move; what is seen of them sticks to the places at rest.
pub struct Body {
    /// The surface's vertex behind each drawn one.
    nodes: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    /// Position and normal, by turns.
    moving: Vec<[f32; 6]>,
    normals: Vec<Vec3f>,
    pub(super) moving_buffer: wgpu::Buffer,
    pub(super) resting_buffer: wgpu::Buffer,
    pub(super) index_buffer: wgpu::Buffer,
    pub(super) tint: Tint,
    pub(super) fibres: Option<Fibres>,
    pub(super) openings: Vec<Opening>,
    /// Its label in a picture of labels.
    pub(super) label: Label,
}

/// Which way the fibres of a muscular tube run: along an axis outside, around it inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fibres {
    /// Unit vector along the tube [-].
    pub(super) axis: Vec3,
    /// A point of its axis [m].
    pub(super) center: Vec3,
    /// Where they run.
    pub(super) run: FibreRun,
}

/// Which way fibres run, as a number in `shader/tissue.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FibreRun {
    /// Along the axis in the outer half of a wall, around it in the inner one.
    ByDepth = 0,
    /// Along the axis.
    Along = 1,
    /// Around the axis.
    Around = 2,
}

impl Fibres {
    /// Along the longest axis of `mesh`.
    pub(crate) fn along(mesh: &TriangleMesh) -> Self {
        let vertices = mesh.vertices();
        let center = vertices.iter().sum::<Vec3>() / vertices.len() as f64;
        let spread = vertices
            .iter()
            .map(|v| (v - center) * (v - center).transpose());
        let eigen = spread.sum::<Matrix3<f64>>().symmetric_eigen();
        let longest = eigen.eigenvalues.imax();
        Self {
            axis: eigen.eigenvectors.column(longest).into_owned(),
            center,
            run: FibreRun::ByDepth,
        }
    }

    /// The same tube with fibres that run so.
    pub(crate) fn running(self, run: FibreRun) -> Self {
        Self { run, ..self }
    }
}

impl Body {
    /// `surface` at rest, in the colours of `tint`.
    pub fn new(gpu: &Gpu, surface: &Surface, tint: Tint) -> Self {
        Self::with_ambient_light(gpu, surface.mesh(), &ambient_light(surface), tint)
    }

    /// Triangles that bound no solid, such as those of a wire frame, in the colours of `tint`.
    pub fn of_mesh(gpu: &Gpu, mesh: &TriangleMesh, tint: Tint) -> Self {
        Self::with_ambient_light(gpu, mesh, &vec![1.0; mesh.vertices().len()], tint)
    }

    /// `mesh` at rest, each vertex as open to light from all sides as `open` says [-].
    pub(crate) fn with_ambient_light(
        gpu: &Gpu,
        mesh: &TriangleMesh,
        open: &[f32],
        tint: Tint,
    ) -> Self {
        let mut body = Self::empty(gpu, tint);
        body.replace(gpu, mesh.vertices(), mesh.triangles(), open);
        body
    }

    /// Nothing yet.
    pub(crate) fn empty(gpu: &Gpu, tint: Tint) -> Self {
        Self {
            nodes: Vec::new(),
            triangles: Vec::new(),
            moving: Vec::new(),
            normals: Vec::new(),
            moving_buffer: buffer(gpu, "moving", 0, wgpu::BufferUsages::VERTEX),
            resting_buffer: buffer(gpu, "resting", 0, wgpu::BufferUsages::VERTEX),
            index_buffer: buffer(gpu, "triangles", 0, wgpu::BufferUsages::INDEX),
            tint,
            fibres: None,
            openings: Vec::new(),
            label: Label::Organ,
        }
    }

    /// The same as another label.
    #[must_use]
    pub fn labelled(mut self, label: Label) -> Self {
        self.label = label;
        self
    }

    /// The same with fibres that run so.
    pub(crate) fn with_fibres(mut self, fibres: Fibres) -> Self {
        self.fibres = Some(fibres);
        self
    }

    /// Has these openings from now on.
    pub(crate) fn open(&mut self, openings: Vec<Opening>) {
        self.openings = openings;
    }

    /// Other `vertices` at rest [m] and triangles in place of those that are there, each vertex as open to
    /// light from all sides as `open` says [-].
    pub(crate) fn replace(
        &mut self,
        gpu: &Gpu,
        vertices: &[Vec3],
        triangles: &[[NodeId; 3]],
        open: &[f32],
    ) {
        let drawn = crease(vertices, triangles);
        let rest = drawn.nodes.iter().map(|&node| {
            let [x, y, z] = single(&vertices[node as usize]);
            [x, y, z, open[node as usize]]
        });
        let resting: Vec<[f32; 4]> = rest.collect();
        let count = drawn.nodes.len();
        self.moving = vec![[0.0; 6]; count];
        self.normals = vec![Vec3f::zeros(); count];
        self.nodes = drawn.nodes;
        self.triangles = drawn.triangles;
        let bytes = size_of::<[f32; 6]>() * count;
        if (self.moving_buffer.size() as usize) < bytes {
            self.moving_buffer = buffer(gpu, "moving", bytes, wgpu::BufferUsages::VERTEX);
        }
        let resting: &[u8] = bytemuck::cast_slice(&resting);
        upload(
            gpu,
            &mut self.resting_buffer,
            resting,
            wgpu::BufferUsages::VERTEX,
        );
        let corners: &[u8] = bytemuck::cast_slice(&self.triangles);
        upload(
            gpu,
            &mut self.index_buffer,
            corners,
            wgpu::BufferUsages::INDEX,
        );
        self.deform(gpu, &single_precision(vertices));
    }

    /// Moves the vertices to `positions` [m], in the order of the surface, with the normals that follow.
    pub fn deform(&mut self, gpu: &Gpu, positions: &[[f32; 3]]) {
        self.place(positions);
        gpu.queue
            .write_buffer(&self.moving_buffer, 0, bytemuck::cast_slice(&self.moving));
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    fn place(&mut self, positions: &[[f32; 3]]) {
        for (vertex, &node) in self.moving.iter_mut().zip(&self.nodes) {
            [vertex[0], vertex[1], vertex[2]] = positions[node as usize];
        }
        self.normals.fill(Vec3f::zeros());
        for &corners in &self.triangles {
            let [a, b, c] = corners.map(|k| {
                let vertex = &self.moving[k as usize];
                Vec3f::new(vertex[0], vertex[1], vertex[2])
            });
            let normal = (b - a).cross(&(c - a));
            for corner in corners {
                self.normals[corner as usize] += normal;
            }
        }
        for (vertex, normal) in self.moving.iter_mut().zip(&self.normals) {
            // Triangles of a millionth of a square millimetre still have a direction.
            let length = normal.norm().max(1e-24);
            [vertex[3], vertex[4], vertex[5]] = (normal / length).into();
        }
    }
}

/// Room for `bytes`, and a half more: what is cut becomes more while it is cut.
fn buffer(gpu: &Gpu, label: &'static str, bytes: usize, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        // Adapters take no empty buffer, and whole words only.
        size: (bytes + bytes / 2).max(16).next_multiple_of(16) as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Writes `contents` into `target`, or into a larger buffer in its place.
fn upload(gpu: &Gpu, target: &mut wgpu::Buffer, contents: &[u8], usage: wgpu::BufferUsages) {
    if (target.size() as usize) < contents.len() {
        *target = buffer(gpu, "body", contents.len(), usage);
    }
    gpu.queue.write_buffer(target, 0, contents);
}

/// Places [m] as an adapter takes them.
pub fn single_precision(places: &[Vec3]) -> Vec<[f32; 3]> {
    places.iter().map(single).collect()
}

fn single(place: &Vec3) -> [f32; 3] {
    place.map(|c| c as f32).into()
}
