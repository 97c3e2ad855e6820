use std::path::PathBuf;

/// Why nothing can be shown.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Nothing that draws was found.
    #[error(
        "there is no graphics adapter that could draw a picture ({cause}); install the driver of the \
         graphics card, or `mesa-vulkan-drivers`, which draws on the processor"
    )]
    NoAdapter {
        /// In the words of the graphics interface.
        cause: wgpu::RequestAdapterError,
    },
    /// The adapter gives no device.
    #[error(
        "the graphics adapter {adapter} cannot be used ({cause}); update its driver, or install \
         `mesa-vulkan-drivers` and set WGPU_ADAPTER_NAME=llvmpipe"
    )]
    NoDevice {
        /// Its name.
        adapter: String,
        /// In the words of the graphics interface.
        cause: wgpu::RequestDeviceError,
    },
    /// The adapter draws pictures, and no depths and labels.
    #[error(
        "the graphics adapter {adapter} cannot draw depths and labels; install the Vulkan driver of the graphics card, or \
         `mesa-vulkan-drivers`, which draws on the processor"
    )]
    NoLabels {
        /// Its name.
        adapter: String,
    },
    /// There is nowhere to open a window.
    #[error(
        "there is no display to open a window on; set DISPLAY or WAYLAND_DISPLAY, or use `xvfb-run -a` \
         of the package `xvfb`"
    )]
    NoDisplay,
    /// A library is missing that a window needs.
    #[error("a window needs libraries that are not there; install `{packages}`")]
    NoWindowLibrary {
        /// Debian's names of the packages that have them.
        packages: String,
    },
    /// The window does not open, or broke down.
    #[error("the window cannot be shown ({cause}); check the display and the graphics driver")]
    Window {
        /// In the words of the library that opens it.
        cause: String,
    },
    /// A picture does not come back from the adapter.
    #[error("a picture was lost on its way from the graphics adapter ({cause}); start again")]
    Lost {
        /// In the words of the graphics interface.
        cause: String,
    },
    /// A picture does not become a file.
    #[error("a picture cannot be encoded ({cause}); take a smaller one")]
    Unencodable {
        /// In the words of what encodes it.
        cause: String,
    },
    /// The user's picture cannot be read.
    #[error("{path}: the picture cannot be read ({cause}); a PNG file is expected", path = path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// In the words of its reader.
        cause: Box<image::ImageError>,
    },
    /// A picture has no pixels to make a map of.
    #[error("the picture has {width} x {height} pixels; at least 2 x 2 make a map")]
    TooSmall {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A file cannot be written.
    #[error(transparent)]
    File(Box<palpate_files::Error>),
    /// The scene cannot be simulated.
    #[error(transparent)]
    Scene(Box<palpate_simulate::Error>),
}

impl Error {
    /// Whether the user's input is wrong, rather than the machine.
    pub fn is_input(&self) -> bool {
        match self {
            Self::File(error) => error.is_input(),
            Self::Scene(error) => error.is_input(),
            Self::NoAdapter { .. }
            | Self::NoDevice { .. }
            | Self::NoDisplay
            | Self::NoLabels { .. }
            | Self::NoWindowLibrary { .. }
            | Self::Window { .. }
            | Self::Lost { .. }
            | Self::Unencodable { .. } => false,
            Self::Picture { .. } | Self::TooSmall { .. } => true,
        }
    }
}

impl From<palpate_files::Error> for Error {
    fn from(error: palpate_files::Error) -> Self {
        Self::File(Box::new(error))
    }
}

impl From<palpate_simulate::Error> for Error {
    fn from(error: palpate_simulate::Error) -> Self {
        Self::Scene(Box::new(error))
    }
}
