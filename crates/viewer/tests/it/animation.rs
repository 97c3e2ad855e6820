//! Animations. Judge: the decoder of the crate that wrote them.

use palpate_viewer::{Animation, RgbaImage};

/// A red square of 8 pixels on grey, at `x`.
fn picture(x: u32) -> RgbaImage {
    RgbaImage::from_fn(64, 32, |column, row| {
        let inside = (x..x + 8).contains(&column) && (12..20).contains(&row);
        image::Rgba(if inside {
            [200, 30, 20, 255]
        } else {
            [90, 90, 90, 255]
        })
    })
}

#[test]
fn pictures_come_back_in_their_order() {
    let pictures = [4, 20, 20, 50].map(picture);
    let mut animation = Animation::new((64, 32)).unwrap();
    for picture in &pictures {
        animation.add(picture).unwrap();
    }
    let bytes = animation.finish().unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    let mut canvas = RgbaImage::new(64, 32);
    for picture in &pictures {
        let frame = decoder.read_next_frame().unwrap().unwrap();
        assert_eq!(f64::from(frame.delay) / 100.0, Animation::DELAY);
        for (number, pixel) in frame.buffer.chunks_exact(4).enumerate() {
            // What is transparent stays as it was.
            if pixel[3] != 0 {
                let number = number as u32;
                let width = u32::from(frame.width);
                let place = (
                    u32::from(frame.left) + number % width,
                    u32::from(frame.top) + number / width,
                );
                canvas.get_pixel_mut(place.0, place.1).0 = pixel.try_into().unwrap();
            }
        }
        // Two colours fit into 256.
        assert!(canvas == *picture);
    }
    assert!(decoder.read_next_frame().unwrap().is_none());
}

#[test]
fn a_picture_that_the_format_cannot_hold_is_refused() {
    let Err(error) = Animation::new((65_536, 32)) else {
        panic!("taken");
    };
    assert!(error.to_string().contains("65536"), "{error}");
}
