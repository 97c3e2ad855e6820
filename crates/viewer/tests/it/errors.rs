use std::path::PathBuf;

use palpate_viewer::{Error, TissuePicture};

/// Every message is one sentence: cause, then remedy.
#[test]
fn messages_say_the_mend() {
    let folder = tempfile::tempdir().unwrap();
    let broken = folder.path().join("broken.png");
    std::fs::write(&broken, b"no picture").unwrap();
    let missing = TissuePicture::read(&PathBuf::from("no/such.png")).unwrap_err();
    let broken = TissuePicture::read(&broken).unwrap_err();
    let small = TissuePicture::new(image::RgbImage::new(1, 5)).unwrap_err();
    let cases: [(Error, &[&str]); 8] = [
        (missing, &["no/such.png", "PNG"]),
        (broken, &["broken.png", "PNG"]),
        (small, &["1 x 5", "2 x 2"]),
        (Error::NoDisplay, &["DISPLAY", "xvfb"]),
        (
            Error::NoWindowLibrary {
                packages: "libxi6".to_owned(),
            },
            &["install `libxi6`"],
        ),
        (
            Error::NoAdapter {
                cause: wgpu::RequestAdapterError::EnvNotSet,
            },
            &["mesa-vulkan-drivers"],
        ),
        (
            Error::Window {
                cause: "torn".to_owned(),
            },
            &["torn", "display"],
        ),
        (
            Error::Lost {
                cause: "gone".to_owned(),
            },
            &["gone", "start again"],
        ),
    ];
    for (error, words) in cases {
        let message = error.to_string();
        assert!(
            !message.ends_with('.') && !message.contains('\n'),
            "{message}"
        );
        for word in words {
            assert!(message.contains(word), "{message} lacks {word}");
        }
    }
}
