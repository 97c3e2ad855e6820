//! Sensor, place and normal of a protocol, and the six columns of a recording. Judges: what was written, and one
//! sentence that names the key for what is refused.

use palpate_files::protocol::{SensorSource, SerialField};
use palpate_files::recording::{RecordingHeader, RecordingRow, RecordingWriter};
use palpate_files::{Protocol, Recording};

const STIMULUS: &str = "[[stimulus]]\nkind = \"ramp_and_hold\"\ndepth_m = 0.002\n";

fn protocol(rig: &str, sensor: &str, specimen: &str) -> Result<Protocol, String> {
    let text = format!(
        "format = 1\n[rig]\n{rig}\n[sensor]\n{sensor}\n[[specimen]]\n{specimen}\n{STIMULUS}"
    );
    Protocol::parse(&text, "p").map_err(|error| error.to_string())
}

const HAPLY: &str = "device = \"haply\"";
const LIVER: &str = "published = \"liver\"";

#[test]
fn every_kind_of_sensor_is_read() {
    let usual = protocol("", "", LIVER).unwrap();
    assert_eq!(usual.sensor.source, SensorSource::Virtual);
    assert_eq!(usual.specimens[0].place.normal, [0.0, 0.0, 1.0]);
    let net_ft = "kind = \"net_ft\"\ncounts_per_newton = 1e6\ncounts_per_newton_metre = 2e6\n\
                  axes = [\"x\", \"-y\", \"-z\"]\nrange_n = [12, 12, 17]\nrange_n_mm = [120, 120, 120]";
    let read = protocol(HAPLY, net_ft, "organ = \"liver\"").unwrap().sensor;
    assert!(matches!(read.source, SensorSource::NetFt(counts) if counts.per_newton_metre == 2e6));
    assert_eq!(read.axes[2], [0.0, 0.0, -1.0]);
    let matrix = ["0.5"; 36].join(", ");
    let daq = format!("kind = \"ni_daq\"\nchannels = \"Dev1/ai0:5\"\nmatrix = [{matrix}]");
    let read = protocol(HAPLY, &daq, "").unwrap().sensor;
    assert!(matches!(read.source, SensorSource::NiDaq(own) if own.matrix[5][5] == 0.5));
    let serial = "kind = \"serial\"\ncolumns = [\"sequence\", \"fz\", \"skip\"]\nseparator = \"tab\"\n\
                  counts_per_newton = 1";
    let read = protocol(HAPLY, serial, "").unwrap().sensor;
    let SensorSource::Serial(line) = read.source else {
        panic!("{read:?}");
    };
    assert_eq!(line.fields[1], SerialField::Fz);
    assert_eq!(line.per_newton_metre, None);
}

#[test]
fn what_makes_no_sense_is_one_sentence_with_its_key() {
    let counts = "counts_per_newton = 1\ncounts_per_newton_metre = 1\n";
    let net_ft = |more: &str| format!("kind = \"net_ft\"\n{counts}{more}");
    let serial =
        |columns: &str| format!("kind = \"serial\"\ncounts_per_newton = 1\ncolumns = {columns}");
    let refused: [(&str, String, &str, &str); 19] = [
        ("", net_ft(""), "", "sensor.kind"),
        (HAPLY, "kind = \"net_ft\"".into(), "", "counts_per_newton"),
        (HAPLY, net_ft("channels = \"a\""), "", "channels"),
        (HAPLY, net_ft("axes = [\"x\", \"y\"]"), "", "axes"),
        (HAPLY, net_ft("axes = []"), "", "axes"),
        (HAPLY, net_ft("axes = [\"x\", \"y\", \"-z\"]"), "", "axes"),
        (HAPLY, net_ft("timeout_s = 0"), "", "timeout_s"),
        (HAPLY, net_ft("range_n = [0, 1, 1]"), "", "range_n"),
        (HAPLY, net_ft(""), LIVER, "published"),
        (
            HAPLY,
            net_ft(""),
            "surface_radius_m = 0.1",
            "surface_radius_m",
        ),
        (
            HAPLY,
            "kind = \"ni_daq\"\nchannels = \"a\"\nmatrix = [1]".into(),
            "",
            "matrix",
        ),
        (HAPLY, serial("[\"fx\", \"fz\"]"), "", "columns"),
        (HAPLY, serial("[\"fz\", \"fz\"]"), "", "columns"),
        (HAPLY, serial("[\"force\"]"), "", "columns"),
        (HAPLY, serial("[\"fz\"]\nbaud = 10"), "", "baud"),
        ("", "timeout_s = 0.1".into(), LIVER, "timeout_s"),
        (
            "indenter_axis = [0, 0, 0]",
            String::new(),
            LIVER,
            "indenter_axis",
        ),
        (
            "",
            String::new(),
            "published = \"liver\"\nnormal = [0, 0, -1]",
            "normal",
        ),
        (
            "",
            String::new(),
            "published = \"liver\"\nplace_m = [0, 0]",
            "place_m",
        ),
    ];
    for (rig, sensor, specimen, key) in refused {
        let said = protocol(rig, &sensor, specimen).unwrap_err();
        assert!(
            said.contains(key) && said.lines().count() == 1,
            "{key}: {said}"
        );
    }
}

/// With the axes and without: each comes back, and a row of the other kind is refused.
#[test]
fn a_recording_with_six_axes_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("six.csv");
    let header = RecordingHeader {
        force_sensor: Some("ATI Net F/T".to_owned()),
        approach_normal: Some([0.1, 0.0, 0.9]),
        ..RecordingHeader::default()
    };
    let mut writer = RecordingWriter::create_with_axes(&file, &header).unwrap();
    let row = RecordingRow {
        time_s: 0.0,
        depth_m: 0.0,
        force_n: 0.3,
        axes: Some([0.1, 0.2, 0.3, 1e-3, 2e-3, 3e-3]),
    };
    writer.write(row).unwrap();
    let later = RecordingRow { time_s: 0.1, ..row };
    writer.write(later).unwrap();
    assert!(writer.write([0.2, 0.0, 0.0]).is_err());
    writer.finish(RecordingHeader::COMPLETE).unwrap();
    let read = Recording::read(&file).unwrap();
    assert_eq!(read.incomplete(), None);
    assert_eq!(read.header.approach_normal, Some([0.1, 0.0, 0.9]));
    let axes = read.axes().unwrap();
    assert_eq!(
        axes.columns.each_ref().map(|values| values[1]),
        row.axes.unwrap()
    );
    assert!((axes.largest_lateral_n() - 0.1_f64.hypot(0.2)).abs() < 1e-12);
    let text = "# format = 1\ntime_s,depth_m,force_n,fx_mn,fy_n,fz_n,tx_n_mm,ty_n_m,tz_n_m\n0,0,0,1,2,3,4,5,6\n";
    let read = Recording::parse(text, "t").unwrap();
    let first = read
        .axes()
        .unwrap()
        .columns
        .each_ref()
        .map(|values| values[0]);
    assert_eq!(first, [0.001, 2.0, 3.0, 0.004, 5.0, 6.0]);
    let one = "# format = 1\ntime_s,depth_m,force_n,fx_n\n0,0,0,7\n";
    let read = Recording::parse(one, "t").unwrap();
    assert!(read.axes().is_none());
    assert_eq!(read.extra_columns()[0].name, "fx_n");
}
