//! One error of each class, and that it keeps what it was made of.

use std::io;
use std::path::Path;

use palpate_geometry::{MeshError, ReadError, ReadFault, SimplifyError};
use palpate_jobs::Error;
use palpate_mechanics::Error as Mechanics;
use palpate_mechanics::finite_elements::Failure;

fn read(fault: ReadFault) -> Error {
    let path = "liver.stl".into();
    ReadError { path, fault }.into()
}

fn file(kind: io::ErrorKind) -> Error {
    let (path, source) = ("liver.csv".into(), kind.into());
    palpate_files::Error::Write { path, source }.into()
}

fn scene(error: Mechanics) -> Error {
    palpate_simulate::Error::from(error).into()
}

/// What no change of the input helps against: memory, a disk, a solver, a device, who cancels.
#[test]
fn failures_end_with_status_1() {
    let failure = Failure::NotConverged;
    let (asked, reached, law) = (1e-3, 0.0, palpate_files::tissue::LawName::NeoHookean);
    let failures = [
        Mechanics::NoMemory { bytes: 1 << 40 }.into(),
        Mechanics::NoEquilibrium {
            depth: 1e-3,
            failure,
        }
        .into(),
        palpate_characterize::Error::NotSolved {
            law,
            asked,
            reached,
            failure,
        }
        .into(),
        scene(Mechanics::Cancelled),
        SimplifyError::Cancelled.into(),
        read(ReadFault::NoMemory { bytes: 1 << 40 }),
        file(io::ErrorKind::StorageFull),
        palpate_servo::Fault::Vanished.into(),
        palpate_measure::Error::NoContact { way_mm: 30.0 }.into(),
    ];
    for error in failures {
        assert_eq!(error.exit_status(), 1, "{error}");
        assert_eq!(error.about(Path::new("one.toml")).exit_status(), 1);
    }
}

#[test]
fn invalid_input_ends_with_status_2() {
    let outside = Mechanics::PoissonsRatioOutOfRange {
        poissons_ratio: 0.6,
    };
    let invalid = [
        outside.clone().into(),
        palpate_characterize::Error::Mechanics(outside.clone()).into(),
        scene(outside),
        MeshError::Empty.into(),
        read(ReadFault::Missing),
        file(io::ErrorKind::NotFound),
        SimplifyError::TooFew { asked: 3 }.into(),
        palpate_measure::Error::TooDeep {
            depth_mm: 9.0,
            limit_mm: 8.0,
        }
        .into(),
    ];
    for error in invalid {
        assert_eq!(error.exit_status(), 2, "{error}");
        assert_eq!(error.about(Path::new("one.toml")).exit_status(), 2);
    }
}

/// A program matches what went wrong, also behind the name of a file.
#[test]
fn the_source_of_an_error_can_be_matched() {
    let error = Error::from(Mechanics::NoElements).about(Path::new("one.toml"));
    assert_eq!(
        error.to_string(),
        format!("one.toml: {}", Mechanics::NoElements)
    );
    let Error::About { error, .. } = error else {
        panic!("{error} names no file");
    };
    assert!(matches!(*error, Error::Mechanics(Mechanics::NoElements)));
}
