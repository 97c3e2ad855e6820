use palpate_files::Recording;
use palpate_files::recording::ForeignColumns;

fn columns(time: &str, depth: &str, force: &str) -> ForeignColumns {
    ForeignColumns {
        time: Some(time.to_owned()),
        depth: Some(depth.to_owned()),
        force: Some(force.to_owned()),
        depth_unit: None,
        force_unit: None,
    }
}

#[test]
fn a_testing_machine_with_lines_above_the_names() {
    let text = "sample_2\nCompression test;\nSpeed (mm/min): 10;\nTime (s),Compression (mm),Load (N),Strain [-]\n\
                0.0,0.0,-0.01821,0\n0.1,0.00728,0.02945,1\n";
    let wanted = columns("Time (s)", "Compression (mm)", "Load (N)");
    let recording = Recording::parse_foreign(text, "a.csv", &wanted).unwrap();
    assert_eq!(recording.time_s(), [0.0, 0.1]);
    assert_eq!(recording.depth_m()[1], 7.28e-6);
    assert_eq!(recording.force_n(), [-0.01821, 0.02945]);
    assert_eq!(recording.extra_columns()[0].name, "Strain [-]");
}

#[test]
fn semicolons_decimal_commas_and_a_row_of_units() {
    let text = "Prüfung;7\r\nZeit;Weg;Kraft;\r\ns;mm;mN;\r\n0;0;0;\r\n0,5;1,25;-3,5;\r\n";
    let wanted = columns("Zeit", "Weg", "Kraft");
    let recording = Recording::parse_foreign(text, "a.csv", &wanted).unwrap();
    assert_eq!(recording.time_s(), [0.0, 0.5]);
    assert_eq!(recording.depth_m(), [0.0, 0.00125]);
    assert_eq!(recording.force_n(), [0.0, -0.0035]);
    assert!(recording.extra_columns().is_empty());
}

#[test]
fn tabs_and_stated_units() {
    let text = "# organ = \"liver\"\n# segment: 0 pause = 1\n# t\td\tf\n0\t1\t2\n1\t2\t3\n";
    let stated = ForeignColumns {
        depth_unit: Some("um".to_owned()),
        force_unit: Some("mN".to_owned()),
        ..columns("t", "d", "f")
    };
    let recording = Recording::parse_foreign(text, "a.csv", &stated).unwrap();
    assert_eq!(recording.depth_m(), [1e-6, 2e-6]);
    assert_eq!(recording.force_n(), [0.002, 0.003]);
    assert_eq!(recording.header.organ.as_deref(), Some("liver"));
}

#[test]
fn bytes_that_are_not_utf_8_are_latin_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(&path, b"t_s,d (\xb5m),f_N\n0,1,2\n").unwrap();
    let wanted = columns("t_s", "d (µm)", "f_N");
    let recording = Recording::read_foreign(&path, &wanted).unwrap();
    assert_eq!(recording.depth_m(), [1e-6]);
}

#[test]
fn what_is_wrong_with_a_foreign_table_is_named() {
    let refused = |text: &str, wanted: &ForeignColumns| {
        let error = Recording::parse_foreign(text, "a.csv", wanted).unwrap_err();
        assert!(error.is_input());
        error.to_string()
    };
    let wanted = columns("t_s", "d", "f_N");
    assert_eq!(
        refused("above\nt_s,d,f_N\n0,1,2\n", &wanted),
        "a.csv line 2: the unit of `d` is not known here; use m, cm, mm, um or nm, \
         in brackets behind the name or next to it"
    );
    assert_eq!(
        refused("t_s,d,force\n0,1,2\n", &wanted),
        "a.csv line 1: the column `f_N` is missing among `t_s`, `d`, `force`; \
         add it or correct its name"
    );
    let stated = |unit: &str| ForeignColumns {
        depth_unit: Some(unit.to_owned()),
        ..columns("t_s", "d_mm", "f_N")
    };
    assert_eq!(
        refused("t_s,d_mm,f_N\n0,1,2\n", &stated("m")),
        "a.csv line 1: `d_mm in m` is given although `d_mm in mm` is given too; keep one of them"
    );
    let furlong = refused("t_s,d_mm,f_N\n0,1,2\n", &stated("furlong"));
    assert!(furlong.contains("`d_mm [furlong]`"), "{furlong}");
    assert_eq!(
        refused("t_s,d_mm,f_N\n0,1,2\n\n0.1,x,2\n", &stated("mm")),
        "a.csv line 4: `d_mm` is \"x\"; give a coordinate of at most 10000 m in size"
    );
    assert!(refused("", &wanted).contains("no rows"));
}

#[test]
fn columns_are_recognised_by_their_names() {
    let text =
        "Prüfung;7\nPrüfzeit;Zeit;Standardweg;Standardkraft\n;s;mm;mN\n1;0;0;0\n1;0,5;1,25;-3,5\n";
    let columns = ForeignColumns::default();
    let recording = Recording::parse_foreign(text, "a.csv", &columns).unwrap();
    assert_eq!(recording.time_s(), [0.0, 0.5]);
    assert_eq!(recording.depth_m(), [0.0, 0.00125]);
    assert_eq!(recording.force_n(), [0.0, -0.0035]);
    assert!(recording.is_foreign());
    assert_eq!(
        recording.remarks(),
        [
            "the time was taken from `Zeit` in s, the depth from `Standardweg` in mm, \
          the force from `Standardkraft` in mN; name the columns if that is wrong"
        ]
    );
    // A depth is meant before a height, a whole name before a part of one.
    let text = "t [sec],height_mm,tip depth (mm),peak force (N),Force (N)\n0,1,2,3,4\n";
    let recording = Recording::parse_foreign(text, "a.csv", &columns).unwrap();
    assert_eq!(
        (recording.depth_m()[0], recording.force_n()[0]),
        (0.001, 4.0)
    );
}

#[test]
fn columns_that_are_not_recognised_are_asked_for() {
    let refused = |text: &str| {
        let columns = ForeignColumns::default();
        let error = Recording::parse_foreign(text, "a.csv", &columns).unwrap_err();
        error.to_string()
    };
    assert_eq!(
        refused("# made by hand\ntime_s,force_N,height_measured_m,height_piezo_m\n0,1,2,3\n"),
        "a.csv line 2: the depth may be `height_measured_m` or `height_piezo_m`; \
         say which it is, as in --depth \"height_measured_m\""
    );
    assert_eq!(
        refused("time_s,strain,force_N\n0,1,2\n"),
        "a.csv line 1: no column looks like the depth among `time_s`, `strain`, `force_N`; \
         say which it is with --depth NAME"
    );
}

#[test]
fn repeated_rows_are_left_out_and_other_times_that_stand_still_refused() {
    let columns = ForeignColumns::default();
    let text = "time_s,depth_mm,force_N\n0,1,2\n0,1,2\n1,1,2\n";
    let recording = Recording::parse_foreign(text, "a.csv", &columns).unwrap();
    assert_eq!(recording.time_s(), [0.0, 1.0]);
    let remark = recording.remarks().last().unwrap();
    assert!(remark.starts_with("1 rows that repeat"), "{remark}");
    for (second, third) in [("0,1,2.5", "1,1,2"), ("1,1,2", "0.5,1,2")] {
        let text = format!("time_s,depth_mm,force_N\n0,1,2\n{second}\n{third}\n");
        let error = Recording::parse_foreign(&text, "a.csv", &columns).unwrap_err();
        assert!(error.to_string().contains("sort the rows"), "{error}");
    }
}

#[test]
fn stretches_and_stresses_are_a_cube_of_one_metre() {
    let text =
        "# Rubber, simple tension, 20 C; by hand\nstretch,nominal_stress_MPa\n1.0,0\n1.5,0.25\n";
    let mut columns = ForeignColumns::default();
    let recording = Recording::parse_foreign(text, "a.csv", &columns).unwrap();
    assert_eq!(recording.depth_m(), [0.0, -0.5]);
    assert_eq!(recording.force_n(), [0.0, -0.25e6]);
    assert_eq!(
        (recording.header.area_m2, recording.header.height_m),
        (Some(1.0), Some(1.0))
    );
    assert!(!recording.is_foreign() && recording.remarks().len() == 1);
    let text = "Stretch,Stress\n1.0,0\n1.5,0.25\n";
    let error = Recording::parse_foreign(text, "a.csv", &columns).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("the unit of `Stress` is not known here"),
        "{error}"
    );
    columns.force_unit = Some("MPa".to_owned());
    let recording = Recording::parse_foreign(text, "a.csv", &columns).unwrap();
    assert_eq!(recording.force_n()[1], -0.25e6);
}

/// Judge: the numbers, converted by hand. The nominal strain and stress are taken, and not the true ones; with tables that have
/// neither nothing is recognised.
#[test]
fn nominal_strains_and_stresses_are_a_cube_of_one_metre() {
    let read = |text: &str| Recording::parse_foreign(text, "a.csv", &ForeignColumns::default());
    let machine = "PARAMETER;INFO;URL;;\nSpeed (mm/min);450;;;\n;;;;\n\
        Time (s);True Strain;True Stress (MPa);Engineering Strain;Engineering Stress (MPa)\n\
        0.3;0.0487902;0.0015645;0.05;0.00149\n0.4;0.0953102;0.003773;0.1;0.00343\n";
    let recording = read(machine).unwrap();
    assert_eq!(recording.depth_m(), [-0.05, -0.1]);
    assert_eq!(recording.force_n(), [-1490.0, -3430.0]);
    let german = "Dehnung;Spannung\n%;kPa\n0,0;0,0\n12,5;4,5\n";
    let recording = read(german).unwrap();
    assert_eq!(recording.depth_m(), [0.0, -0.125]);
    assert_eq!(recording.force_n(), [0.0, -4500.0]);
    let percent = read("Strain (%),Stress (MPa)\n0,0\n50,0.25\n").unwrap();
    assert_eq!(percent.depth_m(), [0.0, -0.5]);
    assert!(read("True Strain,True Stress (MPa)\n0,0\n0.5,0.25\n").is_err());
    let torn = read("Strain,Stress (MPa)\n0,0\n-1.5,0.25\n")
        .unwrap_err()
        .to_string();
    assert!(torn.contains("a nominal strain"), "{torn}");
}

/// Tables as testing machines export them. Judge: their numbers, converted by hand; a gram weighs 9.80665 mN.
#[test]
fn tables_of_testing_machines_are_recognised() {
    let read =
        |text: &str| Recording::parse_foreign(text, "a.csv", &ForeignColumns::default()).unwrap();
    // A texture analyser.
    let texture = "Test ID\tgel\nTest Speed\t1.00\tmm/s\nForce\tDistance\tTime\ng\tmm\tsec\n0.0\t0.0\t0.0\n5.0\t0.5\t0.5\n";
    let recording = read(texture);
    assert_eq!(recording.time_s(), [0.0, 0.5]);
    assert_eq!(recording.depth_m(), [0.0, 5e-4]);
    assert!((recording.force_n()[1] - 5.0 * 9.80665e-3).abs() < 1e-15);
    // Bluehill.
    let bluehill = "\"Specimen label\",\"7\"\n\n\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n\"0.0\",\"0.0\",\"0.1\"\n\"0.1\",\"0.2\",\"0.3\"\n";
    assert_eq!(read(bluehill).depth_m(), [0.0, 2e-4]);
    // A machine in German, with decimal commas.
    let german = "Prüfgeschwindigkeit;10;mm/min\nPrüfzeit;Standardweg;Standardkraft\ns;mm;N\n0,0;0,0;0,5\n0,1;0,25;1,5\n";
    assert_eq!(read(german).force_n(), [0.5, 1.5]);
    // Crosshead and kilograms.
    let crosshead = "Crosshead (mm),Load (kgf),Time (s)\n0,0,0\n1,2,3\n";
    assert!((read(crosshead).force_n()[1] - 19.6133).abs() < 1e-12);
}

/// Judge: 0.5 mm at 2 mm/s.
#[test]
fn times_follow_from_a_stated_speed_alone() {
    let table = "Distance (mm)\tForce (N)\n0\t0\n0.5\t1\n0.5\t1.1\n1.5\t2\n1\t1\n";
    let read = |text: &str| Recording::parse_foreign(text, "a.csv", &ForeignColumns::default());
    let text = format!("Pre-Test Speed\t5\tmm/s\nTest Speed\t2\tmm/s\n{table}");
    let recording = read(&text).unwrap();
    assert_eq!(recording.time_s(), [0.0, 0.25, 0.75, 1.0]);
    assert_eq!(recording.force_n(), [0.0, 1.0, 2.0, 1.0]);
    assert!(recording.remarks()[0].contains("stated speed of 2 mm/s"));
    assert!(recording.remarks()[1].contains("1 rows"));
    let error = read(table).unwrap_err().to_string();
    assert!(error.contains("time"), "{error}");
}
