use palpate_files::recording::RecordingHeader;
use palpate_files::{Key, ValueType};

use super::{holds, kinds, meaning, omitted};

/// All keys of all kinds of documents, as a page of Markdown.
pub fn reference() -> String {
    let mut page = String::from(
        "# The documents\n\n\
         Every key that a document may have. A key that ends in a unit is also read in another unit of the same \
         quantity: `radius_mm` for `radius_m`. `palpate scene --template KIND` writes a document to begin from, \
         `palpate scene --schema KIND` a JSON Schema for editors, and `palpate validate FILE` checks a file. Every TOML \
         document has `format = 1`. This page is written by `palpate scene --reference`.\n",
    );
    for kind in kinds() {
        page += &format!("\n## {}\n\n{}\n", kind.word, kind.meaning);
        let mut described = Vec::new();
        table(&mut page, kind.keys, "", &mut described);
    }
    page += "\n## recording\n\nThe comments above a recording's table, each `# key = value`; all may be left out.\n\n";
    page += "| key | holds | meaning |\n|---|---|---|\n";
    for key in RecordingHeader::KEYS {
        page += &format!(
            "| `{}` | {} | {} |\n",
            key.name,
            words_or(key),
            cell(&meaning(key))
        );
    }
    page
}

/// The keys of a table and of the tables in it; `described` lists the tables that the page already has, with their
/// names.
fn table(
    page: &mut String,
    keys: &'static [Key],
    name: &str,
    described: &mut Vec<(&'static [Key], String)>,
) {
    if !name.is_empty() {
        *page += &format!("\n### {name}\n");
    }
    if let Some((_, before)) = described.iter().find(|(own, _)| *own == keys) {
        *page += &format!("\nAs `{before}`.\n");
        return;
    }
    described.push((keys, name.to_owned()));
    *page += "\n| key | holds | where it is left out | meaning |\n|---|---|---|---|\n";
    for key in keys {
        *page += &format!(
            "| `{}` | {} | {} | {} |\n",
            key.name,
            words_or(key),
            cell(&omitted(key)),
            cell(&meaning(key))
        );
    }
    for key in keys.iter().filter(|key| !key.keys().is_empty()) {
        let inner = match key.value_type {
            ValueType::Named(_) => format!("{}.NAME", key.name),
            _ => key.name.to_owned(),
        };
        let inner = match name {
            "" => inner,
            name => format!("{name}.{inner}"),
        };
        table(page, key.keys(), &inner, described);
    }
}

fn words_or(key: &Key) -> String {
    match key.value_type {
        ValueType::Word(words) | ValueType::WordOrTable(words, _) => {
            let each = words.iter();
            let each = each.map(|(word, means)| format!("`{word:?}`: {}", means.trim()));
            let table =
                matches!(key.value_type, ValueType::WordOrTable(..)).then(|| "a table".to_owned());
            cell(&each.chain(table).collect::<Vec<_>>().join("<br>"))
        }
        _ => cell(&holds(key)),
    }
}

/// Text for a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
