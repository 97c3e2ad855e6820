use gif::{DisposalMethod, Encoder, Frame, Repeat};
use image::RgbaImage;

use crate::Error;

/// Pictures one after the other in one GIF file, over and over.
pub struct Animation {
    encoder: Encoder<Vec<u8>>,
    before: Option<RgbaImage>,
}

impl Animation {
    /// Time between two pictures [s]. The format counts in hundredths of a second, and browsers are slow to show less than
    /// two of them.
    pub const DELAY: f64 = 0.08;

    /// How coarsely the 256 colours of a picture are chosen, from 1 to 30: the crate's default.
    const COARSENESS: i32 = 10;

    /// Without a picture yet, for pictures of `size` [pixels].
    ///
    /// # Errors
    /// When a side is longer than 65,535 pixels.
    pub fn new(size: (u32, u32)) -> Result<Self, Error> {
        let [width, height] = sides(size)?;
        let mut encoder = Encoder::new(Vec::new(), width, height, &[]).map_err(unencodable)?;
        encoder.set_repeat(Repeat::Infinite).map_err(unencodable)?;
        Ok(Self {
            encoder,
            before: None,
        })
    }

    /// Adds a picture.
    ///
    /// # Errors
    /// When it is larger than the format allows.
    pub fn add(&mut self, picture: &RgbaImage) -> Result<(), Error> {
        let [width, height] = sides(picture.dimensions())?;
        let mut changed = picture.clone();
        if let Some(before) = &self.before {
            // What stays needs no room in the file.
            for (own, before) in changed.pixels_mut().zip(before.pixels()) {
                if own == before {
                    own.0 = [0; 4];
                }
            }
        }
        self.before = Some(picture.clone());
        let mut frame = Frame::from_rgba_speed(width, height, &mut changed, Self::COARSENESS);
        frame.dispose = DisposalMethod::Keep;
        frame.delay = (100.0 * Self::DELAY) as u16;
        self.encoder.write_frame(&frame).map_err(unencodable)
    }

    /// All of it, as a file has it.
    ///
    /// # Errors
    /// When it is larger than memory.
    pub fn finish(self) -> Result<Vec<u8>, Error> {
        self.encoder.into_inner().map_err(unencodable)
    }
}

fn sides((width, height): (u32, u32)) -> Result<[u16; 2], Error> {
    match (u16::try_from(width), u16::try_from(height)) {
        (Ok(width), Ok(height)) => Ok([width, height]),
        _ => Err(Error::Unencodable {
            cause: format!("{width} x {height} pixels are more than a GIF file can have"),
        }),
    }
}

fn unencodable(cause: impl ToString) -> Error {
    Error::Unencodable {
        cause: cause.to_string(),
    }
}
