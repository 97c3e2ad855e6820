use palpate_files::{Key, Omitted, ValueType};

use super::{Kind, holds, is_table, meaning, omitted};

/// Characters of a line of prose at most.
const WIDTH: usize = 100;

/// A document of a kind with every key: required keys with an example, the others in comments that begin without a
/// space. `schema` is the path of its JSON Schema, if any.
pub fn template(kind: &Kind, schema: Option<&str>) -> String {
    Writer::of(kind, schema, false)
}

/// A template being written.
struct Writer {
    text: String,
    /// Whether keys and tables that change nothing are written rather than commented out.
    with_defaults: bool,
}

impl Writer {
    fn of(kind: &Kind, schema: Option<&str>, with_defaults: bool) -> String {
        let mut writer = Self {
            text: String::new(),
            with_defaults,
        };
        if let Some(schema) = schema {
            writer.text += &format!("#:schema {schema}\n");
        }
        writer.prose(kind.meaning);
        writer.prose(
            "A line that begins with # and no space is a key that may be left out: remove the # to say it.",
        );
        writer.text += "format = 1\n";
        writer.keys(kind.keys, "", true);
        writer.text
    }

    fn prose(&mut self, words: &str) {
        let mut line = String::from("#");
        for word in words.split_whitespace() {
            if line.len() + 1 + word.len() > WIDTH {
                self.text += &format!("{line}\n");
                line = String::from("#");
            }
            line += " ";
            line += word;
        }
        self.text += &format!("{line}\n");
    }

    /// The keys of the table `name`, which is there or is commented out.
    fn keys(&mut self, keys: &[Key], name: &str, is_there: bool) {
        let (tables, values): (Vec<&Key>, Vec<&Key>) = keys.iter().partition(|key| is_table(key));
        for key in values {
            self.value(key, is_there);
        }
        for key in tables {
            self.table(key, name, is_there);
        }
    }

    fn value(&mut self, key: &Key, is_there: bool) {
        self.text += "\n";
        self.prose(&meaning(key));
        self.prose(&format!("{}; {}.", first_upper(&holds(key)), omitted(key)));
        if let ValueType::Word(words) | ValueType::WordOrTable(words, _) = key.value_type {
            for (word, means) in words {
                self.prose(&format!("- {word:?}: {}", means.trim()));
            }
        }
        let is_default = key.omitted == Omitted::Example;
        let is_written = is_there && (key.in_template || self.with_defaults && is_default);
        let mark = if is_written { "" } else { "#" };
        self.text += &format!("{mark}{} = {}\n", key.name, key.example);
    }

    fn table(&mut self, key: &Key, name: &str, is_there: bool) {
        let name = match name {
            "" => key.name.to_owned(),
            name => format!("{name}.{}", key.name),
        };
        let (header, name) = match key.value_type {
            ValueType::Tables(_) => (format!("[[{name}]]"), name),
            ValueType::Named(_) => (format!("[{name}.place]"), format!("{name}.place")),
            _ => (format!("[{name}]"), name),
        };
        let is_default = |key: &Key| key.omitted == Omitted::Example;
        let changes_nothing = matches!(key.value_type, ValueType::Table(_))
            && key.keys().iter().any(is_default)
            && key.keys().iter().all(|key| !key.in_template);
        let is_there = is_there && (key.in_template || self.with_defaults && changes_nothing);
        self.text += "\n";
        self.prose(&meaning(key));
        self.prose(&format!("{}; {}.", first_upper(&holds(key)), omitted(key)));
        let mark = if is_there { "" } else { "#" };
        self.text += &format!("{mark}{header}\n");
        self.keys(key.keys(), &name, is_there);
    }
}

fn first_upper(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use palpate_files::{Protocol, Scene, Tissue};

    use super::super::{kind, kinds};
    use super::*;
    use crate::solve::Problem;

    fn texts(word: &str) -> [String; 2] {
        let kind = kind(word).unwrap();
        [false, true].map(|with_defaults| Writer::of(&kind, None, with_defaults))
    }

    /// Judge: the readers, which define the defaults in their own code.
    #[test]
    fn a_template_is_read_and_its_defaults_change_nothing() {
        let [plain, full] = texts("scene");
        let read = |text: &str| Scene {
            written: None,
            ..Scene::parse(text, "scene.toml").unwrap()
        };
        assert_ne!(plain, full);
        assert_eq!(read(&plain), read(&full));
        let [plain, full] = texts("tissue").map(|text| Tissue::parse(&text, "t.toml").unwrap());
        assert_eq!(plain, full);
        let [plain, full] = texts("protocol").map(|text| Protocol::parse(&text, "p.toml").unwrap());
        assert_eq!(plain, full);
        for kind in kinds().iter().skip(3) {
            let [plain, full] =
                texts(kind.word).map(|text| Problem::parse(&text, Path::new("p.toml")).unwrap());
            assert_eq!(format!("{plain:?}"), format!("{full:?}"));
        }
    }

    /// The keys of the optional tables of a document: each of their examples is read, too.
    #[test]
    fn every_example_is_what_its_key_holds() {
        fn check(keys: &[Key]) {
            for key in keys.iter().filter(|key| !key.example.is_empty()) {
                let value: toml::Table =
                    toml::from_str(&format!("x = {}", key.example)).expect(key.name);
                let value = &value["x"];
                let number =
                    |value: &toml::Value| value.as_float().or(value.as_integer().map(|n| n as f64));
                let is_right = match key.value_type {
                    ValueType::Number(domain)
                    | ValueType::Estimate(domain)
                    | ValueType::NumberOrDraw(domain) => {
                        number(value).is_some_and(|value| domain.contains(value))
                    }
                    ValueType::Vector(domain) => value.as_array().is_some_and(|all| {
                        all.len() == 3
                            && all
                                .iter()
                                .all(|one| number(one).is_some_and(|one| domain.contains(one)))
                    }),
                    ValueType::Numbers(domain) => value.as_array().is_some_and(|all| {
                        all.iter()
                            .all(|one| number(one).is_some_and(|one| domain.contains(one)))
                    }),
                    ValueType::Vectors(domain) => value.as_array().is_some_and(|all| {
                        let each = all.iter().filter_map(|one| one.as_array());
                        let good = each.filter(|one| {
                            let numbers = one.iter().filter_map(number);
                            numbers.filter(|one| domain.contains(*one)).count() == 3
                                && one.len() == 3
                        });
                        good.count() == all.len()
                    }),
                    ValueType::Direction => value.as_array().is_some_and(|all| all.len() == 3),
                    ValueType::Integer(least, most) => value
                        .as_integer()
                        .and_then(|value| u64::try_from(value).ok())
                        .is_some_and(|value| (least..=most).contains(&value)),
                    ValueType::Boolean => value.as_bool().is_some(),
                    ValueType::Word(words) | ValueType::WordOrTable(words, _) => {
                        words.iter().any(|(word, _)| value.as_str() == Some(word))
                    }
                    ValueType::Text
                    | ValueType::Label
                    | ValueType::Path
                    | ValueType::PathOrTable(_) => {
                        value.as_str().is_some_and(|text| !text.is_empty())
                    }
                    ValueType::Texts | ValueType::Other(_) => value.as_array().is_some(),
                    ValueType::Table(_)
                    | ValueType::TableOrTables(_)
                    | ValueType::Tables(_)
                    | ValueType::Named(_) => false,
                };
                assert!(is_right, "{} = {}", key.name, key.example);
            }
            keys.iter().for_each(|key| check(key.keys()));
        }
        kinds().iter().for_each(|kind| check(kind.keys));
    }
}
