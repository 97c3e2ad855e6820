use nalgebra::Vector3;
use palpate_geometry::{Surface, TriangleMesh, Vec3};
use wgpu::util::DeviceExt;

use super::Tint;
use super::crease::crease;
use super::openness::openness;
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
}

impl Body {
    /// `surface` at rest, in the colours of `tint`.
    pub fn new(gpu: &Gpu, surface: &Surface, tint: Tint) -> Self {
        Self::with_openness(gpu, surface.mesh(), &openness(surface), tint)
    }

    /// `mesh` at rest, each vertex as open to light from all sides as `open` says [-].
    pub(crate) fn with_openness(gpu: &Gpu, mesh: &TriangleMesh, open: &[f32], tint: Tint) -> Self {
        let vertices = mesh.vertices();
        let drawn = crease(vertices, mesh.triangles());
        let resting: Vec<[f32; 4]> = drawn
            .nodes
            .iter()
            .map(|&node| {
                let [x, y, z] = single(&vertices[node as usize]);
                [x, y, z, open[node as usize]]
            })
            .collect();
        let buffer = |label, contents: &[u8], usage| {
            gpu.device
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(label),
                    contents,
                    usage,
                })
        };
        let count = drawn.nodes.len();
        let moving = vec![[0.0; 6]; count];
        let copied = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST;
        let mut body = Self {
            moving_buffer: buffer("moving", bytemuck::cast_slice(&moving), copied),
            resting_buffer: buffer(
                "resting",
                bytemuck::cast_slice(&resting),
                wgpu::BufferUsages::VERTEX,
            ),
            index_buffer: buffer(
                "triangles",
                bytemuck::cast_slice(&drawn.triangles),
                wgpu::BufferUsages::INDEX,
            ),
            nodes: drawn.nodes,
            triangles: drawn.triangles,
            moving,
            normals: vec![Vec3f::zeros(); count],
            tint,
        };
        body.deform(gpu, &single_precision(vertices));
        body
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

/// Places [m] as an adapter takes them.
pub fn single_precision(places: &[Vec3]) -> Vec<[f32; 3]> {
    places.iter().map(single).collect()
}

fn single(place: &Vec3) -> [f32; 3] {
    place.map(|c| c as f32).into()
}
