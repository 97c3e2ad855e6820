//! Pictures of depths and labels. One sample per pixel: no mean of two distances or of two
//! labels stands at an edge.
//!
//! *How we know*: `labels::…`.
//!
//! *Limits*: the whole rectangle, also outside of an endoscope's disc; the skin of a cut's walls is the organ's.

use super::Attachments;
use super::target::{DEPTH, DEPTH_AND_LABEL, allowed, attachment, read_texture, view};
use crate::{Error, Gpu};

/// Label of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Label {
    /// Nothing of the scene.
    Background,
    /// The organ that is touched, with its openings.
    Organ,
    /// Another body.
    Neighbour,
    /// The tool of this number in the scene.
    Tool(u8),
}

impl Label {
    /// As in a picture: 0 background, 1 organ, 2 neighbour, 3 the first tool, and so on.
    pub const fn number(self) -> u8 {
        match self {
            Self::Background => 0,
            Self::Organ => 1,
            Self::Neighbour => 2,
            Self::Tool(number) => number.saturating_add(3),
        }
    }
}

/// How far everything is and what it is, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Labels {
    /// Width and height [pixels].
    pub size: (u32, u32),
    /// Distance ahead of the eye, along the line of sight to the middle of the picture [m]; 0 where nothing is.
    pub depths: Vec<f32>,
    /// [`Label::number`]s.
    pub labels: Vec<u8>,
}

/// The target of [`Labels`].
pub struct LabelTarget {
    size: (u32, u32),
    measured: wgpu::Texture,
    drawn: wgpu::TextureView,
    depth: wgpu::TextureView,
}

impl LabelTarget {
    /// Of `size` [pixels]. No side is shorter than one pixel or longer than the adapter allows.
    ///
    /// # Errors
    /// When the adapter draws no two floats per pixel, as some of OpenGL do not.
    pub fn new(gpu: &Gpu, size: (u32, u32)) -> Result<Self, Error> {
        if !gpu.has_labels {
            return Err(Error::NoLabels {
                adapter: gpu.adapter().to_owned(),
            });
        }
        let size = allowed(gpu, size);
        let texture = |format, usage| attachment(gpu, size, 1, format, usage);
        let measured = texture(DEPTH_AND_LABEL, wgpu::TextureUsages::COPY_SRC);
        Ok(Self {
            size,
            drawn: view(&measured),
            measured,
            depth: view(&texture(DEPTH, wgpu::TextureUsages::empty())),
        })
    }

    /// Width and height [pixels].
    pub fn size(&self) -> (u32, u32) {
        self.size
    }

    pub(super) fn attachments(&self) -> Attachments<'_> {
        Attachments {
            drawn: &self.drawn,
            resolved: None,
            depth: &self.depth,
        }
    }

    /// The measures, brought back from the adapter once everything handed in is drawn.
    ///
    /// # Errors
    /// When the adapter was lost.
    pub fn read(&self, gpu: &Gpu) -> Result<Labels, Error> {
        let bytes = read_texture(gpu, &self.measured, self.size, 8)?;
        // By bytes, for a vector of them need not lie as floats do.
        let float = |bytes: &[u8]| {
            bytes
                .first_chunk()
                .map_or(0.0, |own| f32::from_le_bytes(*own))
        };
        Ok(Labels {
            size: self.size,
            depths: bytes.chunks_exact(8).map(float).collect(),
            labels: bytes
                .chunks_exact(8)
                .map(|pixel| float(&pixel[4..]) as u8)
                .collect(),
        })
    }
}
