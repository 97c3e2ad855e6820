//! What an eye tells of two pictures, in numbers.

use palpate_viewer::RgbaImage;

/// Levels of 255 that an eye tells apart beside one another.
const UNLIKE: u8 = 10;

/// Levels of 255 above which all channels are white to the eye.
const WHITE: u8 = 200;

/// The part of the pixels in which two pictures of one size differ [-].
pub(super) fn unlike(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let differs = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > UNLIKE);
    let (a, b) = (a.as_raw().chunks_exact(4), b.as_raw().chunks_exact(4));
    let count = a.len();
    a.zip(b).filter(|pair| differs(*pair)).count() as f64 / count as f64
}

/// The part of the pixels that are highlights [-].
pub(super) fn highlights(picture: &RgbaImage) -> f64 {
    let pixels = picture.as_raw().chunks_exact(4);
    let count = pixels.len();
    let white = pixels.filter(|pixel| pixel[..3].iter().all(|level| *level > WHITE));
    white.count() as f64 / count as f64
}
