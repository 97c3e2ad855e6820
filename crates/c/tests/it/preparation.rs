//! A long preparation reports its progress, can be cancelled, and its result is stored.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

use palpate_c::*;

use crate::calling::{KIDNEY, Model, message};

#[derive(Default)]
struct Heard {
    works: Vec<String>,
    parts: Vec<f64>,
    /// After so many times it is cancelled.
    patience: Option<usize>,
}

unsafe extern "C" fn listen(work: *const c_char, part: f64, data: *mut c_void) -> c_int {
    // SAFETY: what was handed over, and a text that ends with a zero.
    let (heard, work) = unsafe { (&mut *data.cast::<Heard>(), CStr::from_ptr(work)) };
    let work = work.to_str().unwrap().to_owned();
    if heard.works.last() != Some(&work) {
        heard.works.push(work);
    }
    heard.parts.push(part);
    heard
        .patience
        .is_some_and(|most| heard.parts.len() > most)
        .into()
}

fn prepare(heard: &mut Heard, folder: Option<&CStr>) -> Result<Model, Status> {
    let how = Preparation {
        watch: Some(listen),
        data: ptr::from_mut(heard).cast(),
        responses: folder.map_or(ptr::null(), CStr::as_ptr),
        memory: 0,
    };
    Model::open(KIDNEY, &how)
}

#[test]
fn it_is_heard_of_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let responses = CString::new(folder.path().to_str().unwrap()).unwrap();
    let mut heard = Heard::default();
    prepare(&mut heard, Some(&responses)).unwrap();
    println!("{:?}, {} times", heard.works, heard.parts.len());
    assert!(heard.works.iter().any(|work| work.contains("response")));
    assert!(heard.parts.iter().all(|part| (0.0..=1.0).contains(part)));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let mut again = Heard::default();
    prepare(&mut again, Some(&responses)).unwrap();
    assert!(
        again.works.iter().any(|work| work.contains("stored")),
        "{:?}",
        again.works
    );
}

#[test]
fn it_is_cancelled() {
    let mut heard = Heard {
        patience: Some(1),
        ..Heard::default()
    };
    let status = prepare(&mut heard, None).unwrap_err();
    assert_eq!(status, Status::PalpateFailed, "{}", message());
    println!("{}", message());
    assert_eq!(message(), palpate_mechanics::Error::Cancelled.to_string());
}

#[test]
fn too_little_memory_is_refused() {
    let how = Preparation {
        watch: None,
        data: ptr::null_mut(),
        responses: ptr::null(),
        memory: 1000,
    };
    let status = Model::open(KIDNEY, &how).unwrap_err();
    assert_eq!(status, Status::PalpateFailed, "{}", message());
}
