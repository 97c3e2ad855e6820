//! A writer of JPK files, independent of their reader: archives after [PKWARE 2022], keys as in real files.

/// CRC-32 bit by bit [ITU-T V.42].
fn checksum(bytes: &[u8]) -> u32 {
    let turn = |sum: u32, byte: &u8| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ (0xEDB8_8320 * (sum & 1))
        })
    };
    !bytes.iter().fold(!0, turn)
}

/// How the numbers of an archive are written.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Numbers {
    /// Of 16 and 32 bits.
    Short,
    /// Of 64 bits, all of them [PKWARE 2022, sections 4.3.14, 4.3.15 and 4.5.3].
    Long,
}

/// A ZIP archive; every second part is deflated, in blocks that are stored [RFC 1951, section 3.2.4].
pub(crate) fn archive(parts: &[(String, Vec<u8>)]) -> Vec<u8> {
    archive_of(parts, Numbers::Short)
}

pub(crate) fn archive_of(parts: &[(String, Vec<u8>)], written: Numbers) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (place, (name, content)) in parts.iter().enumerate() {
        let mut packed = content.clone();
        if place % 2 == 1 {
            let length = content.len() as u16;
            packed = [
                &[1],
                &length.to_le_bytes()[..],
                &(!length).to_le_bytes(),
                content,
            ]
            .concat();
        }
        let method = if place % 2 == 1 { 8u16 } else { 0 };
        let (packed_size, size) = (packed.len() as u64, content.len() as u64);
        let mut common = [20u16, 0, method, 0, 0].map(u16::to_le_bytes).concat();
        common.extend(checksum(content).to_le_bytes());
        let at = file.len() as u64;
        let sizes = [packed_size as u32, size as u32]
            .map(u32::to_le_bytes)
            .concat();
        let length = (name.len() as u16).to_le_bytes();
        let local = [&common, &sizes, &length[..], &[0, 0]].concat();
        file.extend([&b"PK\x03\x04"[..], &local, name.as_bytes(), &packed].concat());
        let mut entry = [&b"PK\x01\x02\x14\x00"[..], &common].concat();
        match written {
            Numbers::Short => {
                entry.extend([&sizes, &length[..], &[0; 12]].concat());
                entry.extend((at as u32).to_le_bytes());
                entry.extend(name.as_bytes());
            }
            Numbers::Long => {
                // An extra field of another kind comes first.
                let other = [0x55, 0x54, 1, 0, 0];
                let own = [size, packed_size, at].map(u64::to_le_bytes).concat();
                let extra = [&other[..], &[1, 0, 24, 0], &own].concat();
                let extra_length = (extra.len() as u16).to_le_bytes();
                entry.extend([&[0xff; 8][..], &length, &extra_length, &[0; 10]].concat());
                entry.extend([0xff; 4]);
                entry.extend([name.as_bytes(), &extra].concat());
            }
        }
        directory.extend(entry);
    }
    let (at, size) = (file.len() as u64, directory.len() as u64);
    let count = parts.len() as u64;
    file.extend(directory);
    let mut end = [0u64; 4].map(|_| 0xffff_ffff_ffff_ffffu64);
    if written == Numbers::Long {
        let record_at = file.len() as u64;
        file.extend(
            [
                &b"PK\x06\x06"[..],
                &44u64.to_le_bytes(),
                &[45, 0, 45, 0],
                &[0; 8],
            ]
            .concat(),
        );
        file.extend([count, count, size, at].map(u64::to_le_bytes).concat());
        file.extend(
            [
                &b"PK\x06\x07\0\0\0\0"[..],
                &record_at.to_le_bytes(),
                &[1, 0, 0, 0],
            ]
            .concat(),
        );
    } else {
        end = [count, count, size, at];
    }
    file.extend(b"PK\x05\x06\0\0\0\0");
    file.extend(
        [end[0] as u16, end[1] as u16]
            .map(u16::to_le_bytes)
            .concat(),
    );
    file.extend(
        [end[2] as u32, end[3] as u32]
            .map(u32::to_le_bytes)
            .concat(),
    );
    file.extend([0, 0]);
    file
}

pub(crate) const SENSITIVITY: f64 = 2e-8;
pub(crate) const SPRING_CONSTANT: f64 = 0.05;
/// Raw numbers: a height that falls by 1 µm a step, and a deflection that rises at the end.
pub(crate) const HEIGHTS: [i16; 6] = [500, 400, 300, 200, 100, 0];
pub(crate) const DEFLECTIONS: [i16; 6] = [0, 0, 0, 0, 100, 300];

/// The parts of a segment of two samples or more, in a folder.
pub(crate) fn segment(
    folder: &str,
    style: &str,
    samples: std::ops::Range<usize>,
) -> Vec<(String, Vec<u8>)> {
    let header = format!(
        "#a comment\nforce-segment-header.force-segment-header-info.*=0\nforce-segment-header.duration={}\n\
         force-segment-header.settings.style={style}\n\
         force-segment-header.environment.xy-scanner-position-map.xy-scanner.stage.position.x=1.5E-5\n\
         force-segment-header.environment.xy-scanner-position-map.xy-scanner.stage.position.y=-2E-6\n\
         channel.height.lcd-info.*=0\nchannel.height.data.file.name=channels/height.dat\n\
         channel.vDeflection.lcd-info.*=1\nchannel.vDeflection.data.file.name=channels/vDeflection.dat\n",
        0.5 * samples.len() as f64
    );
    let shorts = |own: &[i16]| {
        own[samples.clone()]
            .iter()
            .flat_map(|n| n.to_be_bytes())
            .collect()
    };
    vec![
        (format!("{folder}segment-header.properties"), header.into()),
        (format!("{folder}channels/height.dat"), shorts(&HEIGHTS)),
        (
            format!("{folder}channels/vDeflection.dat"),
            shorts(&DEFLECTIONS),
        ),
    ]
}

/// What segments share. Volts are a hundredth of the raw height and a tenth, less one, of the raw deflection.
pub(crate) fn shared(conversions: bool) -> (String, Vec<u8>) {
    let mut text = "force-segment-header-info.0.environment.xy-scanner-position-map.xy-scanners.active-xy-scanner.name=stage\n\
        lcd-info.0.encoder.type=signedshort\nlcd-info.0.encoder.scaling.offset=0\nlcd-info.0.encoder.scaling.multiplier=0.01\n\
        lcd-info.0.conversion-set.conversions.base=volts\nlcd-info.0.conversion-set.conversions.default=calibrated\n\
        lcd-info.0.conversion-set.conversion.calibrated.base-calibration-slot=nominal\n\
        lcd-info.0.conversion-set.conversion.calibrated.scaling.offset=1E-4\n\
        lcd-info.0.conversion-set.conversion.calibrated.scaling.multiplier=0.5\n\
        lcd-info.0.conversion-set.conversion.calibrated.scaling.unit.unit=m\n\
        lcd-info.0.conversion-set.conversion.nominal.base-calibration-slot=volts\n\
        lcd-info.0.conversion-set.conversion.nominal.scaling.offset=0\n\
        lcd-info.0.conversion-set.conversion.nominal.scaling.multiplier=2E-6\n\
        lcd-info.1.encoder.type=signedshort\nlcd-info.1.encoder.scaling.offset=-1\nlcd-info.1.encoder.scaling.multiplier=0.1\n\
        lcd-info.1.conversion-set.conversions.base=volts\nlcd-info.1.conversion-set.conversions.default=force\n"
        .to_owned();
    if conversions {
        for (own, base, size) in [
            ("distance", "volts", SENSITIVITY),
            ("force", "distance", SPRING_CONSTANT),
        ] {
            let key = format!("lcd-info.1.conversion-set.conversion.{own}");
            text += &format!(
                "{key}.base-calibration-slot={base}\n{key}.scaling.offset=0\n{key}.scaling.multiplier={size:E}\n"
            );
        }
    }
    ("shared-data/header.properties".to_owned(), text.into())
}

pub(crate) fn general() -> (String, Vec<u8>) {
    let text = "force-scan-series.description.instrument=JPK\\:1\nforce-scan-series.description.source-software=6.1\n";
    ("header.properties".to_owned(), text.into())
}

pub(crate) fn single(conversions: bool) -> Vec<u8> {
    archive(&single_parts(conversions))
}

pub(crate) fn single_parts(conversions: bool) -> Vec<(String, Vec<u8>)> {
    let mut parts = vec![general(), shared(conversions)];
    parts.extend(segment("segments/0/", "extend", 0..4));
    parts.extend(segment("segments/1/", "retract", 4..6));
    parts
}

/// The same curve in floating-point numbers: the height in single, the deflection in double precision, as the
/// values of `base`.
pub(crate) fn floating(base: &str, spring_constant: bool) -> Vec<u8> {
    let (_, shorts) = shared(true);
    let shorts = String::from_utf8(shorts).unwrap();
    let kept = |line: &&str| {
        let is_slot = |slot: &str| line.contains(&format!("conversion.{slot}."));
        let is_force = is_slot("force");
        !line.contains("encoder")
            && !line.starts_with("lcd-info.0")
            && !line.contains("conversions.base")
            && (spring_constant || !is_force)
    };
    let kept: Vec<&str> = shorts.lines().filter(kept).collect();
    let mut text = kept.join("\n");
    text += &format!(
        "\nlcd-info.0.type=float-data\nlcd-info.0.unit.unit=m\nlcd-info.0.conversion-set.conversions.base=absolute\n\
         lcd-info.0.conversion-set.conversions.default=nominal\n\
         lcd-info.0.conversion-set.conversion.nominal.base-calibration-slot=absolute\n\
         lcd-info.0.conversion-set.conversion.nominal.scaling.offset=5.0E-6\n\
         lcd-info.0.conversion-set.conversion.nominal.scaling.multiplier=1.0\n\
         lcd-info.0.conversion-set.conversion.nominal.scaling.unit.unit=m\n\
         lcd-info.1.type=double-data\nlcd-info.1.conversion-set.conversions.base={base}\n"
    );
    let scale = match base {
        "volts" => 1.0,
        "distance" => SENSITIVITY,
        _ => SENSITIVITY * SPRING_CONSTANT,
    };
    let mut parts = vec![
        general(),
        ("shared-data/header.properties".to_owned(), text.into()),
    ];
    for (folder, style, samples) in [
        ("segments/0/", "extend", 0..4),
        ("segments/1/", "retract", 4..6),
    ] {
        for (name, mut content) in segment(folder, style, samples.clone()) {
            if name.ends_with("height.dat") {
                let heights = HEIGHTS[samples.clone()]
                    .iter()
                    .map(|n| f32::from(*n) * 1e-8);
                content = heights.flat_map(f32::to_be_bytes).collect();
            } else if name.ends_with("vDeflection.dat") {
                let own = DEFLECTIONS[samples.clone()].iter();
                let own = own.map(|n| scale * (0.1 * f64::from(*n) - 1.0));
                content = own.flat_map(f64::to_be_bytes).collect();
            }
            parts.push((name, content));
        }
    }
    archive(&parts)
}
