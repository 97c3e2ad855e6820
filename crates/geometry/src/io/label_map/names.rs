use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The longest list of names that is read [bytes].
const MAX_BYTES: u64 = 1 << 20;

/// Names in a JSON file next to the map: `{"labels": {"1": "liver"}}`. None when there is no such
/// file, or it is about something else.
pub(super) fn in_sidecar_file(map: &Path) -> Vec<(u16, String)> {
    let name = map.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.trim_end_matches(".gz");
    let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
    let path = map.with_file_name(format!("{stem}.json"));
    let is_small = fs::metadata(&path).is_ok_and(|m| m.is_file() && m.len() <= MAX_BYTES);
    let text = if is_small {
        fs::read(&path)
    } else {
        return Vec::new();
    };
    let text = text.unwrap_or_default();
    #[derive(serde::Deserialize)]
    struct Sidecar {
        labels: BTreeMap<u16, String>,
    }
    let in_sidecar_file = serde_json::from_slice::<Sidecar>(&text);
    in_sidecar_file.map_or(Vec::new(), |in_sidecar_file| {
        in_sidecar_file.labels.into_iter().collect()
    })
}

/// Names in the extension of a NIfTI header: `<Label Key="5" …>liver</Label>`, as TotalSegmentator
/// and Connectome Workbench write them.
pub(super) fn in_extension(text: &str) -> Vec<(u16, String)> {
    let mut names = Vec::new();
    for part in text.split("<Label ").skip(1) {
        let key = part
            .split_once("Key=\"")
            .and_then(|(_, rest)| rest.split_once('"'));
        let name = part
            .split_once('>')
            .and_then(|(_, rest)| rest.split_once("</Label>"));
        if let (Some((key, _)), Some((name, _))) = (key, name)
            && let Ok(number) = key.parse()
        {
            let name = name
                .trim()
                .trim_start_matches("<![CDATA[")
                .trim_end_matches("]]>");
            names.push((number, name.to_owned()));
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_extension_names_its_labels() {
        let text = "<LabelTable>\n<Label Key=\"1\" Red=\"0\">spleen</Label>\
                    <Label Red=\"1\" Key=\"52\"><![CDATA[aorta]]></Label><Label Key=\"x\">no</Label>";
        let expected = [(1, "spleen".to_owned()), (52, "aorta".to_owned())];
        assert_eq!(in_extension(text), expected);
    }
}
