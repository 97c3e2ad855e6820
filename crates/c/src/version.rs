//! Versions of the header and of the loaded library.

use std::ffi::c_char;

/// The version of this header.
pub const PALPATE_VERSION_MAJOR: u32 = 0;
/// The version of this header.
pub const PALPATE_VERSION_MINOR: u32 = 2;
/// The version of this header.
pub const PALPATE_VERSION_PATCH: u32 = 0;

/// The layout of structures and the signatures of functions in this header. It changes whenever programs have to be
/// recompiled; a program that loads the library at run time compares it with palpate_abi() first.
pub const PALPATE_ABI: u32 = 2;

/// The PALPATE_ABI of the library.
#[unsafe(no_mangle)]
pub extern "C" fn palpate_abi() -> u32 {
    PALPATE_ABI
}

/// The version of the library, as "0.2.0".
#[unsafe(no_mangle)]
pub extern "C" fn palpate_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Preparation, SurfaceView, ToolPose, ToolTouch};

    #[test]
    fn the_header_has_the_version_of_the_library() {
        let header = [
            PALPATE_VERSION_MAJOR,
            PALPATE_VERSION_MINOR,
            PALPATE_VERSION_PATCH,
        ]
        .map(|n| n.to_string());
        assert_eq!(header.join("."), env!("CARGO_PKG_VERSION"));
    }

    /// Judge: the sizes of PALPATE_ABI 2 where pointers have eight bytes. Others need another PALPATE_ABI.
    #[test]
    #[cfg(target_pointer_width = "64")]
    fn structures_have_the_sizes_of_this_abi() {
        let sizes = (
            size_of::<Preparation>(),
            size_of::<ToolPose>(),
            size_of::<ToolTouch>(),
            size_of::<SurfaceView>(),
        );
        assert_eq!((PALPATE_ABI, sizes), (2, (32, 72, 248, 40)));
    }
}
