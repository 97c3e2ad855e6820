//! A user's picture as surroundings, as the source used a frame of a laparoscopic video (section 7.5).

use std::path::Path;

use image::RgbImage;
use nalgebra::Vector3;

use crate::Error;

/// A picture that an organ is to look like.
#[derive(Debug, Clone, PartialEq)]
pub struct TissuePicture(RgbImage);

impl TissuePicture {
    /// Reads a PNG file.
    ///
    /// # Errors
    /// When it cannot be read or is too small.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let opened = image::ImageReader::open(path).map_err(image::ImageError::from);
        let picture = opened
            .and_then(|reader| reader.with_guessed_format().map_err(Into::into))
            .and_then(image::ImageReader::decode)
            .map_err(|cause| Error::Picture {
                path: path.to_owned(),
                cause: Box::new(cause),
            })?;
        Self::new(picture.into_rgb8())
    }

    /// A picture of a tissue.
    ///
    /// # Errors
    /// When it is too small.
    pub fn new(picture: RgbImage) -> Result<Self, Error> {
        let (width, height) = picture.dimensions();
        match width.min(height) < 2 {
            true => Err(Error::TooSmall { width, height }),
            false => Ok(Self(picture)),
        }
    }

    /// The picture laid around everything: its middle in front, each half mirrored behind, so that there
    /// is no seam; [linear red, green, blue].
    pub(crate) fn light(&self, direction: Vector3<f32>) -> [f32; 3] {
        // From the front (-y), half a turn to either side, and half a turn from below to above.
        let around = direction.x.atan2(-direction.y) / std::f32::consts::PI;
        let height = direction.z.clamp(-1.0, 1.0).asin() / std::f32::consts::PI;
        // The square in the middle goes half-way around; behind, it comes back.
        let folded = if around.abs() > 0.5 {
            around.signum() - around
        } else {
            around
        };
        self.at(0.5 + folded, 0.5 - height)
    }

    /// Between four pixels, at a part of the width and the height.
    fn at(&self, across: f32, down: f32) -> [f32; 3] {
        let (width, height) = self.0.dimensions();
        let x = across.clamp(0.0, 1.0) * (width - 1) as f32;
        let y = down.clamp(0.0, 1.0) * (height - 1) as f32;
        let (left, top) = ((x as u32).min(width - 2), (y as u32).min(height - 2));
        let (fx, fy) = (x - left as f32, y - top as f32);
        let pixel = |dx, dy| self.0.get_pixel(left + dx, top + dy).0.map(linear);
        std::array::from_fn(|c| {
            let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
            let upper = mix(pixel(0, 0)[c], pixel(1, 0)[c], fx);
            mix(upper, mix(pixel(0, 1)[c], pixel(1, 1)[c], fx), fy)
        })
    }
}

/// Light of a display's byte [-].
fn linear(byte: u8) -> f32 {
    (f32::from(byte) / 255.0).powf(2.2)
}
