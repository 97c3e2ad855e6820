use std::path::Path;

use crate::Error;

/// Libraries that an X11 window loads when it opens, each with its package on Debian. The library that
/// opens windows panics when the last one is missing, so they are asked for before.
const LIBRARIES: [(&str, &str); 5] = [
    ("libX11.so.6", "libx11-6"),
    ("libX11-xcb.so.1", "libx11-xcb1"),
    ("libXcursor.so.1", "libxcursor1"),
    ("libXi.so.6", "libxi6"),
    ("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"),
];

/// Whether a window could be opened here.
///
/// # Errors
/// When there is no display, or a library is missing that a window needs.
pub fn check_display() -> Result<(), Error> {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let named = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let wayland = named("WAYLAND_DISPLAY") || named("WAYLAND_SOCKET");
    if !wayland && !named("DISPLAY") {
        return Err(Error::NoDisplay);
    }
    if wayland {
        return Ok(());
    }
    let missing: Vec<_> = LIBRARIES
        .into_iter()
        .filter(|(library, _)| !is_there(library))
        .map(|(_, package)| package)
        .collect();
    match missing.is_empty() {
        true => Ok(()),
        false => Err(Error::NoWindowLibrary {
            packages: missing.join(" "),
        }),
    }
}

/// Whether the loader would find `library`: in the folders of its search path, and in those of the system.
fn is_there(library: &str) -> bool {
    let search_path = std::env::var("LD_LIBRARY_PATH").unwrap_or_default();
    let system = ["/lib", "/usr/lib", "/lib64", "/usr/lib64", "/usr/local/lib"];
    let folders = search_path
        .split(':')
        .chain(system)
        .filter(|f| !f.is_empty());
    let mut folders = folders.map(Path::new);
    folders.any(|folder| holds(folder, library)) || is_cached(library)
}

/// Whether `folder`, or the folder of an architecture in it, holds `library`.
fn holds(folder: &Path, library: &str) -> bool {
    let triplet = format!("{}-linux-gnu", std::env::consts::ARCH);
    folder.join(library).exists() || folder.join(triplet).join(library).exists()
}

/// Whether the loader's list of libraries names `library`, as on systems with folders of their own.
fn is_cached(library: &str) -> bool {
    let cache = std::fs::read("/etc/ld.so.cache").unwrap_or_default();
    let name = library.as_bytes();
    cache
        .windows(name.len() + 1)
        .any(|bytes| bytes.starts_with(name) && bytes[name.len()] == 0)
}
