//! Libraries that stand for `libHD` and `libdhd`: small C files, compiled when they are asked for.

#![allow(
    unsafe_code,
    reason = "functions of a library that is loaded at run time"
)]

use std::ffi::{c_int, c_void};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use palpate_devices::Kind;
use palpate_servo::Vec3;
use tempfile::TempDir;

use super::robot::Robot;
use super::{Mechanics, StandInClock};

const HD: &str = include_str!("../libraries/hd.c");
const DHD: &str = include_str!("../libraries/dhd.c");

/// Force in; position, axes and buttons out; the robot.
type Moves = unsafe extern "C" fn(*const f64, *mut f64, *mut f64, *mut u32, *mut c_void);

/// A library with a state of its own, and its switches. It stays loaded to the end of the program.
pub struct StandInLibrary {
    kind: Kind,
    path: PathBuf,
    library: &'static libloading::Library,
    _folder: TempDir,
}

/// What was compiled already, for all.
static COMPILED: Mutex<Vec<(Kind, PathBuf)>> = Mutex::new(Vec::new());

impl StandInLibrary {
    /// The one for `kind`.
    ///
    /// # Errors
    /// When there is no C compiler (`cc`), or nothing stands for that kind.
    pub fn build(kind: Kind) -> io::Result<Self> {
        let compiled = compiled(kind)?;
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("library.so");
        // Another file, so that it is another library to the system.
        std::fs::copy(compiled, &path)?;
        // SAFETY: its initialisation is that of a C library without any of its own.
        let library = unsafe { libloading::Library::new(&path) }.map_err(io::Error::other)?;
        Ok(Self {
            kind,
            path,
            library: Box::leak(Box::new(library)),
            _folder: folder,
        })
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Puts `mechanics` under the handle of number `number`.
    pub fn carry(&self, mechanics: Box<dyn Mechanics>, clock: StandInClock, number: i32) {
        // It stays for as long as the library, to the end of the program.
        let robot: &'static Mutex<Robot> =
            Box::leak(Box::new(Mutex::new(Robot::new(mechanics, clock))));
        let with: Moves = match self.kind {
            Kind::ForceDimension => move_force_dimension,
            _ => move_open_haptics,
        };
        let data = std::ptr::from_ref(robot).cast_mut().cast::<c_void>();
        type Carry = unsafe extern "C" fn(Moves, *mut c_void, c_int);
        // SAFETY: the type is that of the C file. `with` takes a robot that is never freed, from any thread.
        unsafe { self.symbol::<Carry>("stand_in_mechanics")(with, data, number) };
    }

    /// Sets the switch `stand_in_…` of the C file.
    ///
    /// # Panics
    /// When it has no such switch.
    pub fn set(&self, switch: &'static str, value: i32) {
        // SAFETY: every switch of the C files takes an int and returns nothing.
        unsafe { self.symbol::<unsafe extern "C" fn(c_int)>(switch)(value) };
    }

    /// What the function `stand_in_…` of the C file answers.
    ///
    /// # Panics
    /// When it has no such function.
    pub fn read(&self, function: &'static str) -> i32 {
        self.function(function)()
    }

    /// The function `stand_in_…` of the C file, looked up once.
    ///
    /// # Panics
    /// When it has no such function.
    pub fn function(&self, name: &'static str) -> impl Fn() -> i32 + Send + Sync + use<> {
        // SAFETY: every function of the C files that is read so takes nothing and returns an int.
        let function = unsafe { self.symbol::<unsafe extern "C" fn() -> c_int>(name) };
        // SAFETY: the same; the library is never unloaded, and its functions may be called from any thread.
        move || unsafe { function() }
    }

    /// The force that device `number` displays [N], in our axes.
    pub fn force(&self, number: i32) -> Vec3 {
        type Displayed = unsafe extern "C" fn(*mut f64, c_int);
        let mut force = [0.0; 3];
        // SAFETY: the type is that of the C file, which writes three numbers.
        unsafe { self.symbol::<Displayed>("stand_in_displayed")(force.as_mut_ptr(), number) };
        let [x, y, z] = force;
        match self.kind {
            Kind::ForceDimension => Vec3::new(y, z, x),
            _ => Vec3::new(x, y, z),
        }
    }

    /// How many devices are open.
    pub fn open_devices(&self) -> i32 {
        self.read("stand_in_open_devices")
    }

    /// Function `name` of the C file.
    ///
    /// # Safety
    /// `F` has to be its type.
    unsafe fn symbol<F: Copy>(&self, name: &'static str) -> F {
        // SAFETY: the caller vouches for the type; the library is never unloaded.
        match unsafe { self.library.get::<F>(name.as_bytes()) } {
            Ok(function) => *function,
            Err(missing) => panic!("{missing}"),
        }
    }
}

/// The file of the library for `kind`, compiled once.
fn compiled(kind: Kind) -> io::Result<PathBuf> {
    let mut all = COMPILED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, path)) = all.iter().find(|(other, _)| *other == kind) {
        return Ok(path.clone());
    }
    let (name, source) = match kind {
        Kind::OpenHaptics => ("hd", HD),
        Kind::ForceDimension => ("dhd", DHD),
        Kind::Haply => return Err(io::ErrorKind::Unsupported.into()),
    };
    // Left to the system's cleaning, for others are copied from it to the end of the program.
    let folder = tempfile::tempdir()?.keep();
    let (file, path) = (
        folder.join(format!("{name}.c")),
        folder.join(format!("{name}.so")),
    );
    std::fs::write(&file, source)?;
    let flags = std::env::var("PALPATE_STAND_IN_CFLAGS").unwrap_or_default();
    let output = Command::new("cc")
        .args(["-O1", "-shared", "-fPIC"])
        .args(flags.split_whitespace())
        .arg("-o")
        .args([&path, &file])
        .args(["-lm", "-lpthread"])
        .output()?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(io::Error::other(said));
    }
    all.push((kind, path.clone()));
    Ok(path)
}

/// Has the robot take a force and says where it is: place [m], columns of its turn, buttons.
///
/// # Safety
/// `data` has to be a robot that is never freed.
unsafe fn exchanged(data: *mut c_void, force: Vec3) -> (Vec3, [Vec3; 3], u32) {
    // SAFETY: the caller vouches for it.
    let robot = unsafe { &*data.cast::<Mutex<Robot>>() };
    let mut robot = robot.lock().unwrap_or_else(PoisonError::into_inner);
    robot.command(force);
    let turned = robot.state.orientation.unwrap_or_default();
    let columns = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| turned * axis);
    (robot.state.position, columns, robot.state.buttons)
}

/// The same axes, millimetres, and a matrix column by column with the place in its last.
///
/// # Safety
/// Three numbers at `force` and at `position`, sixteen at `transform`, one at `buttons`; `data` as for [`exchanged`].
unsafe extern "C" fn move_open_haptics(
    force: *const f64,
    position: *mut f64,
    transform: *mut f64,
    buttons: *mut u32,
    data: *mut c_void,
) {
    // SAFETY: the caller vouches for it.
    let (place, columns, pressed) = unsafe {
        let force = force.cast::<[f64; 3]>().read();
        exchanged(data, force.into())
    };
    let place = 1e3 * place;
    let mut matrix = [0.0; 16];
    for (column, axis) in columns.iter().chain([&place]).enumerate() {
        matrix[4 * column..4 * column + 3].copy_from_slice(axis.as_slice());
    }
    matrix[15] = 1.0;
    // SAFETY: the caller vouches for it.
    unsafe {
        position.cast::<[f64; 3]>().write(place.into());
        transform.cast::<[f64; 16]>().write(matrix);
        buttons.write(pressed);
    }
}

/// x toward the user, y right, z up; a matrix row by row.
///
/// # Safety
/// Three numbers at `force` and at `position`, nine at `frame`, one at `buttons`; `data` as for [`exchanged`].
unsafe extern "C" fn move_force_dimension(
    force: *const f64,
    position: *mut f64,
    frame: *mut f64,
    buttons: *mut u32,
    data: *mut c_void,
) {
    let theirs = |ours: &Vec3| Vec3::new(ours.z, ours.x, ours.y);
    // SAFETY: the caller vouches for it.
    let (place, [right, up, toward], pressed) = unsafe {
        let [x, y, z] = force.cast::<[f64; 3]>().read();
        exchanged(data, Vec3::new(y, z, x))
    };
    let columns = [toward, right, up].map(|axis| theirs(&axis));
    let matrix: [f64; 9] = std::array::from_fn(|entry| columns[entry % 3][entry / 3]);
    // SAFETY: the caller vouches for it.
    unsafe {
        position.cast::<[f64; 3]>().write(theirs(&place).into());
        frame.cast::<[f64; 9]>().write(matrix);
        buttons.write(pressed);
    }
}
