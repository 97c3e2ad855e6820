use hayro_jpeg2000::{DecodeSettings, DecoderContext, Image};

use super::FrameFormat;

/// Most pixels of a frame: a stream of few bytes may announce any number, and the decoder takes about 20 bytes for each.
const MAX_PIXELS: usize = 1 << 24;

/// Decompresses one frame, of one component of whole numbers.
pub(super) fn decode(data: &[u8], format: FrameFormat, pixels: &mut Vec<u8>) -> Result<(), String> {
    let settings = DecodeSettings {
        resolve_palette_indices: false,
        // A stream that is cut short is an error.
        strict: true,
        target_resolution: None,
    };
    let image = Image::new(data, &settings).map_err(|error| error.to_string())?;
    // The decoder asks for memory by these.
    let size = [image.width(), image.height()].map(|side| side as usize);
    if size != [format.columns, format.rows] {
        return Err(format!("{} × {} pixels", size[0], size[1]));
    }
    if format.pixels() > MAX_PIXELS {
        return Err(format!("more than {MAX_PIXELS} pixels"));
    }
    let mut context = DecoderContext::default();
    let decoded = image.decode(&mut context);
    let decoded = decoded.map_err(|error| error.to_string())?;
    let [component] = decoded.components() else {
        return Err("several components".to_owned());
    };
    let largest = f32::from(match format.width() {
        1 => u16::from(u8::MAX),
        _ => u16::MAX,
    });
    let samples = component.samples();
    if samples.len() != format.pixels() {
        return Err(format!("{} pixels", samples.len()));
    }
    for sample in samples.iter().map(|sample| sample.round()) {
        if !(0.0..=largest).contains(&sample) {
            return Err(format!("a pixel of {sample}"));
        }
        pixels.extend_from_slice(&(sample as u16).to_le_bytes()[..format.width()]);
    }
    Ok(())
}
