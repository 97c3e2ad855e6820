//! Drivers of force sensors against stand-ins: a server of packets on the loopback, a library, a pseudo-terminal.
//! Judges: what the stand-in was told to feel, and a named fault for each thing that can go wrong.

use std::time::{Duration, Instant};

use palpate_device_stand_ins::{DaqStandIn, NetFtFault, NetFtStandIn};
use palpate_devices::OpenError;
use palpate_devices::force_sensor::{
    Counts, Gauges, NetFtAddress, SensorFormat, SensorLimits, SensorPlaces, open_force_sensor,
};
use palpate_servo::{ForceSensor, ForceTorque, SensorFault};

const COUNTS: Counts = Counts {
    per_newton: 1e6,
    per_newton_metre: 1e6,
};

/// A stand-in that shares two cores with others.
const PATIENT: f64 = 0.5;

fn limits() -> SensorLimits {
    SensorLimits {
        timeout: PATIENT,
        ..SensorLimits::default()
    }
}

/// Reads until `is_it`, for some seconds.
fn until<T>(
    sensor: &mut dyn ForceSensor,
    is_it: impl Fn(Result<ForceTorque, SensorFault>) -> Option<T>,
) -> T {
    let end = Instant::now() + Duration::from_secs(10);
    loop {
        if let Some(found) = is_it(sensor.read()) {
            return found;
        }
        assert!(Instant::now() < end, "it did not come");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn fault(sensor: &mut dyn ForceSensor) -> SensorFault {
    until(sensor, Result::err)
}

fn reads(sensor: &mut dyn ForceSensor, wanted: [f64; 6], step: f64) {
    until(sensor, |read| {
        let found = read.ok()?.components();
        let near = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= step);
        near.then_some(())
    });
}

const FELT: [f64; 6] = [0.1, -0.2, 1.5, 1e-3, -2e-3, 5e-4];

fn net_ft(stand_in: &NetFtStandIn) -> Box<dyn ForceSensor> {
    let places = SensorPlaces {
        net_ft: Some(stand_in.address()),
        ..SensorPlaces::default()
    };
    open_force_sensor(&SensorFormat::NetFt(COUNTS), limits(), &places).unwrap()
}

/// To a count.
#[test]
fn packets_of_a_net_ft_are_newtons() {
    let stand_in = NetFtStandIn::start(COUNTS).unwrap();
    let mut sensor = net_ft(&stand_in);
    stand_in.force_setter()(ForceTorque::from_components(FELT));
    reads(&mut *sensor, FELT, 0.6e-6);
    assert!(sensor.spec().has_six_axes);
}

/// Each thing that a Net F/T can do wrong is a fault with its name, and is over when it is.
#[test]
fn faults_of_a_net_ft_have_names() {
    let stand_in = NetFtStandIn::start(COUNTS).unwrap();
    let mut sensor = net_ft(&stand_in);
    stand_in.force_setter()(ForceTorque::from_components(FELT));
    let mut found = Vec::new();
    for wrong in [
        NetFtFault::Silent,
        NetFtFault::Short,
        NetFtFault::Loses(40),
        NetFtFault::Status(0x8000_0001),
        NetFtFault::Status(0xC000_0000),
    ] {
        reads(&mut *sensor, FELT, 0.6e-6);
        stand_in.misbehave(wrong);
        found.push(fault(&mut *sensor));
        stand_in.misbehave(NetFtFault::None);
    }
    reads(&mut *sensor, FELT, 0.6e-6);
    assert!(matches!(found[0], SensorFault::Silent { age, .. } if age > PATIENT && age < 2.0));
    assert!(matches!(found[1], SensorFault::BadReading { .. }));
    assert!(
        matches!(found[2], SensorFault::Lost { lost: 40.. }),
        "{:?}",
        found[2]
    );
    assert_eq!(found[3], SensorFault::Status { code: 0x8000_0001 });
    assert!(matches!(found[4], SensorFault::Saturated { .. }));
}

#[test]
fn a_missing_sensor_is_one_sentence() {
    let open = |format: &SensorFormat, places: &SensorPlaces| {
        let error = open_force_sensor(format, limits(), places).err().unwrap();
        let said = error.to_string();
        assert!(said.contains("; ") && !said.contains('\n'), "{said}");
        (error, said)
    };
    let net_ft = SensorFormat::NetFt(COUNTS);
    let (error, said) = open(&net_ft, &SensorPlaces::default());
    assert!(matches!(error, OpenError::NoSensorPlace { .. }) && said.contains("PALPATE_NET_FT"));
    let nobody = SensorPlaces {
        net_ft: Some("127.0.0.1:9".parse().unwrap()),
        nidaqmx: Some("/nowhere/libnidaqmx.so".into()),
        ..SensorPlaces::default()
    };
    assert!(matches!(
        open(&net_ft, &nobody).0,
        OpenError::NoSensor { .. }
    ));
    let (error, said) = open(&gauges("Dev1/ai0:5"), &nobody);
    assert!(matches!(error, OpenError::NoSensorLibrary { .. }) && said.contains("PALPATE_NIDAQMX"));
    for wrong in ["", "host:port", "a b", "host:70000"] {
        assert!(wrong.parse::<NetFtAddress>().is_err(), "{wrong}");
    }
    let usual: NetFtAddress = "192.168.1.1".parse().unwrap();
    assert_eq!(usual.port, 49_152);
}

/// Two newtons, or a millinewton metre, per volt; and a gauge that pulls at two axes.
fn gauges(channels: &str) -> SensorFormat {
    let mut matrix = [[0.0; 6]; 6];
    for (axis, row) in matrix.iter_mut().enumerate() {
        row[axis] = if axis < 3 { 2.0 } else { 1e-3 };
    }
    matrix[0][5] = 0.5;
    SensorFormat::NiDaq(Box::new(Gauges {
        channels: channels.to_owned(),
        rate: 10_000.0,
        range: 10.0,
        matrix,
    }))
}

fn daq() -> (DaqStandIn, SensorPlaces, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let library = DaqStandIn::build(folder.path()).unwrap();
    let places = SensorPlaces {
        nidaqmx: Some(library.path().to_owned()),
        ..SensorPlaces::default()
    };
    (library, places, folder)
}

/// Judge: the product of the matrix by hand.
#[test]
fn voltages_of_ni_daqmx_are_newtons() {
    let (library, places, _folder) = daq();
    let mut sensor = open_force_sensor(&gauges("Dev1/ai0:5"), limits(), &places).unwrap();
    library.set_volts(&[0.1, -0.2, 1.5, 1.0, -2.0, 0.5]);
    let wanted = [0.2 + 0.25, -0.4, 3.0, 1e-3, -2e-3, 5e-4];
    reads(&mut *sensor, wanted, 1e-9);
    drop(sensor);
    assert_eq!(library.tasks(), 0);
}

#[test]
fn faults_of_ni_daqmx_have_names() {
    let (library, places, _folder) = daq();
    let mut sensor = open_force_sensor(&gauges("Dev1/ai0:5"), limits(), &places).unwrap();
    library.set_volts(&[0.0, 0.0, 9.99, 0.0, 0.0, 0.0]);
    assert!(matches!(fault(&mut *sensor), SensorFault::Saturated { .. }));
    library.set_volts(&[0.0; 6]);
    reads(&mut *sensor, [0.0; 6], 1e-9);
    library.hang(true);
    assert!(matches!(fault(&mut *sensor), SensorFault::Silent { .. }));
    library.hang(false);
    reads(&mut *sensor, [0.0; 6], 1e-9);
    library.fail(-200_279);
    assert_eq!(fault(&mut *sensor), SensorFault::Library { code: -200_279 });
    library.fail(0);
    let refused = open_force_sensor(&gauges("Dev2/ai0:5"), limits(), &places);
    let said = refused.err().unwrap().to_string();
    assert!(
        said.contains("Device identifier is invalid (-200220)"),
        "{said}"
    );
}

#[cfg(unix)]
mod serial {
    use std::io::Write;
    use std::path::PathBuf;

    use palpate_devices::force_sensor::{Field, LineFormat, Separator};
    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

    use super::*;

    /// The end of the sensor, and the name of the line.
    fn line() -> (std::fs::File, PathBuf) {
        let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY;
        let sensor = openpt(flags).unwrap();
        grantpt(&sensor).unwrap();
        unlockpt(&sensor).unwrap();
        let name = ptsname(&sensor, Vec::new()).unwrap();
        let path = PathBuf::from(name.into_string().unwrap());
        (std::fs::File::from(sensor), path)
    }

    fn open(path: PathBuf, axes: &[Field]) -> Box<dyn ForceSensor> {
        let format = LineFormat {
            baud: 115_200,
            fields: axes.to_vec(),
            separator: Separator::Character(','),
            per_newton: 1000.0,
            per_newton_metre: (axes.len() > 2).then_some(1e6),
        };
        let places = SensorPlaces {
            serial: Some(path),
            ..SensorPlaces::default()
        };
        open_force_sensor(&SensorFormat::Serial(format), limits(), &places).unwrap()
    }

    #[test]
    fn lines_are_newtons_and_their_faults_have_names() {
        let (mut wire, path) = line();
        let fields: Vec<Field> = std::iter::once(Field::Sequence)
            .chain((0..6).map(Field::Axis))
            .collect();
        let mut sensor = open(path, &fields);
        let send = |wire: &mut std::fs::File, text: &str| wire.write_all(text.as_bytes()).unwrap();
        // The half of a line, a remark, and a line in two parts.
        send(&mut wire, "00,0,7\r\n# gain 2\r\n1,100,-200,15");
        assert_eq!(sensor.read().unwrap(), ForceTorque::zero());
        send(&mut wire, "00,1000,-2000,500\r\n");
        reads(&mut *sensor, FELT, 1e-12);
        send(&mut wire, "2,1,2,3\n");
        assert!(matches!(
            fault(&mut *sensor),
            SensorFault::BadReading { .. }
        ));
        send(&mut wire, "3,1,x,3,4,5,6\n4,100,-200,1500,1000,-2000,500\n");
        assert!(matches!(
            fault(&mut *sensor),
            SensorFault::BadReading { .. }
        ));
        reads(&mut *sensor, FELT, 1e-12);
        send(&mut wire, "60,100,-200,1500,1000,-2000,500\n");
        assert!(matches!(fault(&mut *sensor), SensorFault::Lost { .. }));
        send(&mut wire, &"9".repeat(300));
        send(&mut wire, "\n");
        assert!(matches!(
            fault(&mut *sensor),
            SensorFault::BadReading { .. }
        ));
        assert!(matches!(fault(&mut *sensor), SensorFault::Silent { .. }));
        send(&mut wire, "7,100,-200,1500,1000,-2000,500\n");
        reads(&mut *sensor, FELT, 1e-12);
        drop(wire);
        let gone = fault(&mut *sensor);
        assert!(
            matches!(gone, SensorFault::Disconnected | SensorFault::Silent { .. }),
            "{gone:?}"
        );
    }

    #[test]
    fn a_load_cell_has_one_axis() {
        let (mut wire, path) = line();
        let mut sensor = open(path, &[Field::Axis(2)]);
        assert!(!sensor.spec().has_six_axes);
        wire.write_all(b"1\n250\n").unwrap();
        reads(&mut *sensor, [0.0, 0.0, 0.25, 0.0, 0.0, 0.0], 1e-12);
    }

    #[test]
    fn a_file_is_no_serial_line() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let places = SensorPlaces {
            serial: Some(file.path().to_owned()),
            ..SensorPlaces::default()
        };
        let format = LineFormat {
            baud: 115_200,
            fields: vec![Field::Axis(2)],
            separator: Separator::Space,
            per_newton: 1.0,
            per_newton_metre: None,
        };
        let refused = open_force_sensor(&SensorFormat::Serial(format), limits(), &places);
        assert!(matches!(refused, Err(OpenError::NoSensor { .. })));
    }
}
