//! Libraries that stand for `libHD` and `libdhd`: small C files, compiled when they are asked for.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::{c_int, c_void};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use palpate_servo::{Device, Vec3};

use super::StandInClock;
use super::robot::Robot;
use crate::Kind;
use crate::library::Library;

const HD: &str = include_str!("../../stand_ins/hd.c");
const DHD: &str = include_str!("../../stand_ins/dhd.c");

/// Force in; position, axes and buttons out; the robot.
type Mechanics = extern "C" fn(*const f64, *mut f64, *mut f64, *mut u32, *mut c_void);

/// A library that was made, and its switches.
pub struct StandInLibrary {
    kind: Kind,
    path: PathBuf,
    library: Library,
}

impl StandInLibrary {
    /// Compiles the one for `kind` into `folder`. Each folder's has a state of its own.
    ///
    /// # Errors
    /// When there is no C compiler (`cc`), or nothing stands for that kind.
    pub fn build(kind: Kind, folder: &Path) -> io::Result<Self> {
        let (name, source) = match kind {
            Kind::OpenHaptics => ("hd", HD),
            Kind::ForceDimension => ("dhd", DHD),
            Kind::Haply => return Err(io::ErrorKind::Unsupported.into()),
        };
        let file = folder.join(format!("{name}.c"));
        let path = folder.join(format!("lib{name}-stand-in.so"));
        std::fs::write(&file, source)?;
        let compiled = Command::new("cc")
            .args(["-O1", "-shared", "-fPIC", "-o"])
            .args([&path, &file])
            .args(["-lm", "-lpthread"])
            .output()?;
        if !compiled.status.success() {
            return Err(io::Error::other(
                String::from_utf8_lossy(&compiled.stderr).into_owned(),
            ));
        }
        let library = Library::load(kind, &[], Some(&path)).map_err(io::Error::other)?;
        Ok(Self {
            kind,
            path,
            library,
        })
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Puts `device` under the handle of number `number`.
    pub fn carry(&self, device: Box<dyn Device>, clock: StandInClock, number: i32) {
        // It stays for as long as the library, to the end of the program.
        let robot: &'static Mutex<Robot> =
            Box::leak(Box::new(Mutex::new(Robot::new(device, clock))));
        let with: Mechanics = match self.kind {
            Kind::ForceDimension => of_force_dimension,
            _ => of_open_haptics,
        };
        let data = std::ptr::from_ref(robot).cast_mut().cast::<c_void>();
        type Carry = extern "C" fn(Mechanics, *mut c_void, c_int);
        // SAFETY: as it stands in the C file.
        let carry: Carry = self.of(unsafe { self.library.function("stand_in_mechanics") });
        carry(with, data, number);
    }

    /// Sets the switch `stand_in_…` of the C file.
    ///
    /// # Panics
    /// When it has no such switch.
    pub fn set(&self, switch: &'static str, value: i32) {
        // SAFETY: every switch of the C files takes an int and returns nothing.
        let set: extern "C" fn(c_int) = self.of(unsafe { self.library.function(switch) });
        set(value);
    }

    /// The force that device `number` displays [N], in our axes.
    pub fn force(&self, number: i32) -> Vec3 {
        type Displayed = extern "C" fn(*mut f64, c_int);
        // SAFETY: as it stands in the C file.
        let read: Displayed = self.of(unsafe { self.library.function("stand_in_displayed") });
        let mut force = [0.0; 3];
        read(force.as_mut_ptr(), number);
        let [x, y, z] = force;
        match self.kind {
            Kind::ForceDimension => Vec3::new(y, z, x),
            _ => Vec3::new(x, y, z),
        }
    }

    /// How many devices are open.
    pub fn open_devices(&self) -> i32 {
        // SAFETY: as it stands in the C file.
        let read: extern "C" fn() -> c_int =
            self.of(unsafe { self.library.function("stand_in_open_devices") });
        read()
    }

    fn of<F>(&self, found: Result<F, crate::OpenError>) -> F {
        match found {
            Ok(function) => function,
            Err(missing) => panic!("{missing}"),
        }
    }
}

/// Has the robot take a force and says where it is: place [m], columns of its turn, buttons.
fn exchanged(data: *mut c_void, force: Vec3) -> (Vec3, [Vec3; 3], u32) {
    // SAFETY: it is what was given with the function, which is never freed.
    let robot = unsafe { &*data.cast::<Mutex<Robot>>() };
    let mut robot = robot
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    robot.command(force);
    let turned = robot.state.orientation.unwrap_or_default();
    let columns = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| turned * axis);
    (robot.state.position, columns, robot.state.buttons)
}

/// The same axes, millimetres, and a matrix column by column with the place in its last.
extern "C" fn of_open_haptics(
    force: *const f64,
    position: *mut f64,
    transform: *mut f64,
    buttons: *mut u32,
    data: *mut c_void,
) {
    // SAFETY: three numbers, as the C file has them.
    let force = unsafe { force.cast::<[f64; 3]>().read() };
    let (place, columns, pressed) = exchanged(data, force.into());
    let place = 1e3 * place;
    let mut matrix = [0.0; 16];
    for (column, axis) in columns.iter().chain([&place]).enumerate() {
        matrix[4 * column..4 * column + 3].copy_from_slice(axis.as_slice());
    }
    matrix[15] = 1.0;
    // SAFETY: three numbers, sixteen and one, as the C file has them.
    unsafe {
        position.cast::<[f64; 3]>().write(place.into());
        transform.cast::<[f64; 16]>().write(matrix);
        buttons.write(pressed);
    }
}

/// x toward the user, y right, z up; a matrix row by row.
extern "C" fn of_force_dimension(
    force: *const f64,
    position: *mut f64,
    frame: *mut f64,
    buttons: *mut u32,
    data: *mut c_void,
) {
    let theirs = |ours: &Vec3| Vec3::new(ours.z, ours.x, ours.y);
    // SAFETY: three numbers, as the C file has them.
    let [x, y, z] = unsafe { force.cast::<[f64; 3]>().read() };
    let (place, [right, up, toward], pressed) = exchanged(data, Vec3::new(y, z, x));
    let columns = [toward, right, up].map(|axis| theirs(&axis));
    let matrix: [f64; 9] = std::array::from_fn(|entry| columns[entry % 3][entry / 3]);
    // SAFETY: three numbers, nine and one, as the C file has them.
    unsafe {
        position.cast::<[f64; 3]>().write(theirs(&place).into());
        frame.cast::<[f64; 9]>().write(matrix);
        buttons.write(pressed);
    }
}
