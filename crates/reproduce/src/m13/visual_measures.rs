//! Visual measures of pictures of one size. All count the pixels of tissue alone.

use palpate_viewer::RgbaImage;

/// Levels of 255 that an eye distinguishes side by side.
const UNLIKE: u8 = 10;

/// Levels of 255 above which all channels are white to the eye.
const WHITE: u8 = 200;

/// Levels of 255 by which red is above blue on tissue, and on nothing else that is drawn.
const RED: u8 = 12;

/// Which pixels show tissue, by a picture of it without light that a film mirrors.
pub(super) fn tissue(dull: &RgbaImage) -> Vec<bool> {
    let pixels = dull.pixels();
    pixels
        .map(|pixel| pixel[0] > pixel[2].saturating_add(RED))
        .collect()
}

/// The part of the pixels in which two pictures differ [-].
pub(super) fn different_part(tissue: &[bool], a: &RgbaImage, b: &RgbaImage) -> f64 {
    let pairs = a.pixels().zip(b.pixels());
    let differs = pairs.map(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > UNLIKE));
    part(tissue, differs)
}

/// The part of the pixels that are highlights [-].
pub(super) fn highlights(tissue: &[bool], picture: &RgbaImage) -> f64 {
    part(tissue, picture.pixels().map(|pixel| is_white(pixel.0)))
}

/// The part of the pixels, without highlights, in which red is the strongest channel [-].
pub(super) fn red(tissue: &[bool], picture: &RgbaImage) -> f64 {
    let dull = without_highlights(tissue, picture);
    let pixels = picture.pixels();
    part(&dull, pixels.map(|pixel| pixel[0] > pixel[1].max(pixel[2])))
}

/// Circular standard deviation of the hue, without highlights [deg].
pub(super) fn hue_spread(tissue: &[bool], picture: &RgbaImage) -> f64 {
    let dull = without_highlights(tissue, picture);
    let (mut sin, mut cos, mut count) = (0.0, 0.0, 0.0);
    for (pixel, _) in picture.pixels().zip(&dull).filter(|(_, dull)| **dull) {
        let [red, green, blue, _] = pixel.0.map(f64::from);
        // The angle about the axis of greys.
        let hue = (3.0_f64.sqrt() * (green - blue)).atan2(2.0 * red - green - blue);
        sin += hue.sin();
        cos += hue.cos();
        count += 1.0;
    }
    let length = f64::hypot(sin, cos) / f64::max(count, 1.0);
    (-2.0 * length.ln()).max(0.0).sqrt().to_degrees()
}

fn is_white(pixel: [u8; 4]) -> bool {
    pixel[..3].iter().all(|level| *level > WHITE)
}

fn without_highlights(tissue: &[bool], picture: &RgbaImage) -> Vec<bool> {
    let pixels = picture.pixels().zip(tissue);
    pixels
        .map(|(pixel, tissue)| *tissue && !is_white(pixel.0))
        .collect()
}

fn part(counted: &[bool], marked: impl Iterator<Item = bool>) -> f64 {
    let both = marked.zip(counted).filter(|(mark, own)| *mark && **own);
    let all = counted.iter().filter(|own| **own).count();
    both.count() as f64 / all.max(1) as f64
}
