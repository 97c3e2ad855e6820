//! Uniforms of the shaders, byte for byte as in `shader/*.wgsl`.

use bytemuck::{Pod, Zeroable};
use nalgebra::Matrix4;
use palpate_geometry::Vec3;

use super::labels::Label;
use super::light::Light;
use super::openings::{MOST, Opening};
use super::tool::ToolPicture;
use crate::Camera;

/// Tools that are drawn, as many as a scene may have.
pub(super) const TOOLS: usize = 2;

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Globals {
    view_projection: [[f32; 4]; 4],
    to_eye: [[f32; 4]; 4],
    eye: [f32; 4],
    key: [f32; 4],
    key_color: [f32; 4],
    up: [f32; 4],
    sky: [f32; 4],
    ground: [f32; 4],
    backdrop: [f32; 4],
    backdrop_edge: [f32; 4],
    picture: [f32; 4],
    levels: [f32; 4],
    tools: [[[f32; 4]; 2]; TOOLS],
    marks: [[f32; 4]; TOOLS],
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct BodyUniform {
    pub(super) dark: [f32; 4],
    pub(super) light: [f32; 4],
    pub(super) vessel: [f32; 4],
    pub(super) detail: [f32; 4],
    pub(super) fibres: [f32; 4],
    pub(super) fibre_center: [f32; 4],
    /// How many openings there are, and the label.
    opened: [f32; 4],
    openings: [Opening; MOST],
}

impl BodyUniform {
    /// Without openings.
    pub(super) fn new(colors: [[f32; 4]; 3], detail: [f32; 4]) -> Self {
        let [dark, light, vessel] = colors;
        Self {
            dark,
            light,
            vessel,
            detail,
            fibres: [0.0; 4],
            fibre_center: [0.0; 4],
            opened: [0.0; 4],
            openings: [Opening::default(); MOST],
        }
    }

    /// Has this label.
    pub(super) fn label(&mut self, label: Label) {
        self.opened[1] = f32::from(label.number());
    }

    /// Has `openings`, of which there are at most as many as fit.
    pub(super) fn open(&mut self, openings: &[Opening]) {
        let count = openings.len().min(MOST);
        self.opened[0] = count as f32;
        self.openings[..count].copy_from_slice(&openings[..count]);
    }
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct InstrumentUniform {
    pub(super) placed: [[f32; 4]; 4],
    pub(super) color: [f32; 4],
    /// The label in the first.
    pub(super) label: [f32; 4],
}

impl Globals {
    /// Of a picture of `size` [pixels] of what lies within `reach` [m] of the camera's target.
    pub(super) fn new(
        camera: &Camera,
        tools: &[ToolPicture],
        (width, height): (u32, u32),
        reach: f64,
    ) -> Self {
        let aspect = f64::from(width) / f64::from(height);
        let distance = camera.distance();
        let near = (distance - 2.0 * reach).max(0.01 * distance).max(1e-4);
        let projection = camera.view_projection(aspect, near, distance + 6.0 * reach);
        let light = Light::of(camera);
        let empty = [[0.0; 4]; 2];
        let mut capsules = [empty; TOOLS];
        let mut marks = [[0.0; 4]; TOOLS];
        for ((capsule, mark), tool) in capsules.iter_mut().zip(&mut marks).zip(tools) {
            let (start, end) = tool.capsule();
            *capsule = [vector(&start, tool.shape.shaft as f32), vector(&end, 0.0)];
            if let Some((point, radius)) = tool.mark {
                *mark = vector(&point, radius as f32);
            }
        }
        let pixel = 2.0 * distance * (0.5 * camera.field_of_view).tan() / f64::from(height);
        let level = (pixel / super::tissue_map::texel_length())
            .log2()
            .clamp(0.0, 4.0);
        Self {
            view_projection: columns(&projection),
            to_eye: columns(&camera.eye_frame().to_homogeneous()),
            eye: vector(&camera.eye, f32::from(u8::from(camera.lamp.is_some()))),
            key: vector(&light.key, light.is_place),
            key_color: light.color,
            up: vector(&light.up, 0.0),
            sky: light.sky,
            ground: light.ground,
            backdrop: light.backdrop,
            backdrop_edge: light.backdrop_edge,
            picture: [width as f32, height as f32, light.exposure, light.vignette],
            levels: [level as f32, 0.0, 0.0, 0.0],
            tools: capsules,
            marks,
        }
    }
}

pub(super) fn vector(v: &Vec3, w: f32) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w]
}

pub(super) fn columns(matrix: &Matrix4<f64>) -> [[f32; 4]; 4] {
    matrix.map(|c| c as f32).into()
}
