use std::ops::Bound::{Excluded, Included, Unbounded};

use palpate_files::units::{self, Unit};
use palpate_files::{Domain, Key, Omitted, ValueType, Word};
use serde_json::{Map, Value, json};

use super::{Kind, is_table, meaning, omitted};

/// The JSON Schema (draft 2020-12) of a kind of document, with which editors complete and check it. Only the reader
/// checks rules that involve several keys.
pub fn schema(kind: &Kind) -> String {
    let mut writer = Writer {
        can_draw: kind.can_draw,
        tables: Vec::new(),
    };
    let mut schema = writer.table(kind.keys);
    let root = schema
        .as_object_mut()
        .expect("a table's schema is an object");
    root["properties"]["format"] =
        json!({ "const": 1, "description": "The version of the format." });
    let required = root.entry("required").or_insert_with(|| json!([]));
    let required = required.as_array_mut().expect("it is a list");
    required.push(json!("format"));
    root.insert("title".to_owned(), json!(format!("palpate {}", kind.word)));
    root.insert("description".to_owned(), json!(kind.meaning));
    root.insert(
        "$schema".to_owned(),
        json!("https://json-schema.org/draft/2020-12/schema"),
    );
    let tables = writer.tables.into_iter().enumerate();
    let tables = tables.map(|(number, (_, table))| (format!("table{number}"), table));
    let mut definitions: Map<String, Value> = tables.collect();
    if kind.can_draw {
        let drawn = json!({
            "type": "object",
            "properties": { "draw": { "type": "string", "minLength": 1 } },
            "required": ["draw"],
            "additionalProperties": false,
        });
        definitions.insert("drawn".to_owned(), drawn);
    }
    root.insert("$defs".to_owned(), Value::Object(definitions));
    let mut text = serde_json::to_string_pretty(&schema).expect("JSON is printed");
    text.push('\n');
    text
}

/// A schema being written.
struct Writer {
    can_draw: bool,
    /// The tables so far, each once. Compared by value: a constant may have several addresses.
    tables: Vec<(&'static [Key], Value)>,
}

impl Writer {
    /// A reference to the schema of a table, which is written at its first use.
    fn reference(&mut self, keys: &'static [Key]) -> Value {
        let number = self.tables.iter().position(|(other, _)| *other == keys);
        let number = number.unwrap_or_else(|| {
            let number = self.tables.len();
            self.tables.push((keys, Value::Null));
            self.tables[number].1 = self.table(keys);
            number
        });
        json!({ "$ref": format!("#/$defs/table{number}") })
    }

    fn table(&mut self, keys: &'static [Key]) -> Value {
        let mut properties = Map::new();
        let mut required = Vec::new();
        let mut conditions = Vec::new();
        for key in keys {
            let names = names_of(key);
            for (name, factor) in &names {
                properties.insert(name.clone(), self.property(key, *factor));
            }
            let any_of = |names: Vec<(String, f64)>| -> Vec<Value> {
                let each = names.into_iter();
                each.map(|(name, _)| json!({ "required": [name] }))
                    .collect()
            };
            match key.omitted {
                Omitted::Refused if names.len() == 1 => required.push(json!(key.name)),
                Omitted::Refused => conditions.push(json!({ "anyOf": any_of(names) })),
                Omitted::RefusedWithout(other) => {
                    let mut names = names;
                    let other = keys.iter().find(|key| key.name == other);
                    names.extend(other.into_iter().flat_map(names_of));
                    conditions.push(json!({ "anyOf": any_of(names) }));
                }
                Omitted::Example | Omitted::Means(_) => {}
            }
        }
        let mut schema = json!({
            "type": "object",
            "properties": properties,
            "additionalProperties": false,
        });
        if !required.is_empty() {
            schema["required"] = json!(required);
        }
        if !conditions.is_empty() {
            schema["allOf"] = json!(conditions);
        }
        schema
    }

    fn property(&mut self, key: &Key, factor: f64) -> Value {
        let list = |item: Value| json!({ "type": "array", "items": item });
        let vector =
            |item: Value| json!({ "type": "array", "items": item, "minItems": 3, "maxItems": 3 });
        let text = || json!({ "type": "string", "minLength": 1 });
        let mut schema = match key.value_type {
            ValueType::Number(domain) => number(domain, factor),
            ValueType::Estimate(domain) => json!({ "anyOf": [number(domain, factor), {
            "type": "object",
            "properties": {
                "value": number(domain, factor),
                "standard_error": { "type": "number", "minimum": 0 },
            },
            "required": ["value"],
            "additionalProperties": false,
        }] }),
            ValueType::NumberOrDraw(domain) => json!({ "anyOf": [number(domain, factor), text()] }),
            ValueType::Vector(domain) => vector(number(domain, factor)),
            ValueType::Numbers(domain) => list(number(domain, factor)),
            ValueType::Vectors(domain) => list(vector(number(domain, factor))),
            ValueType::Direction => vector(json!({ "type": "number" })),
            ValueType::Integer(least, u64::MAX) => json!({ "type": "integer", "minimum": least }),
            ValueType::Integer(least, most) => {
                json!({ "type": "integer", "minimum": least, "maximum": most })
            }
            ValueType::Boolean => json!({ "type": "boolean" }),
            ValueType::Text | ValueType::Path => text(),
            ValueType::Label => json!({ "type": ["string", "integer"] }),
            ValueType::Texts => list(json!({ "type": "string" })),
            ValueType::Word(words) => one_of(words),
            ValueType::WordOrTable(words, keys) => {
                json!({ "anyOf": [one_of(words), self.reference(keys)] })
            }
            ValueType::Table(keys) => self.reference(keys),
            ValueType::TableOrTables(keys) => {
                let table = self.reference(keys);
                json!({ "anyOf": [table, { "type": "array", "items": table, "minItems": 1 }] })
            }
            ValueType::PathOrTable(keys) => json!({ "anyOf": [text(), self.reference(keys)] }),
            ValueType::Tables(keys) => list(self.reference(keys)),
            ValueType::Named([]) => json!({ "type": "object" }),
            ValueType::Named(keys) => {
                json!({ "type": "object", "additionalProperties": self.reference(keys) })
            }
            ValueType::Other(_) => json!({}),
        };
        // A value that is drawn anew for each attempt.
        if self.can_draw && !is_table(key) {
            let drawn = json!({ "$ref": "#/$defs/drawn" });
            schema = json!({ "anyOf": [schema, drawn] });
        }
        schema["description"] = json!(format!("{} ({})", meaning(key), omitted(key)));
        if key.omitted == Omitted::Example
            && factor == 1.0
            && let Ok(value) = toml::from_str::<Map<String, Value>>(&format!("x = {}", key.example))
        {
            schema["default"] = value["x"].clone();
        }
        schema
    }
}

fn one_of(words: &[Word]) -> Value {
    let names: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    let docs: Vec<&str> = words.iter().map(|(_, means)| means.trim()).collect();
    json!({ "enum": names, "x-taplo": { "docs": { "enumValues": docs } } })
}

/// The names of a key, one for each unit, and what one of that unit is in the key's own [unit of the key].
fn names_of(key: &Key) -> Vec<(String, f64)> {
    let has_unit = matches!(
        key.value_type,
        ValueType::Number(_)
            | ValueType::Estimate(_)
            | ValueType::Vector(_)
            | ValueType::Vectors(_)
            | ValueType::Numbers(_)
            | ValueType::NumberOrDraw(_)
    );
    match units::split(key.name).filter(|_| has_unit) {
        None => vec![(key.name.to_owned(), 1.0)],
        Some((base, own)) => {
            let mut names = vec![(key.name.to_owned(), 1.0)];
            let others = own.alternatives().filter(|unit| *unit != own);
            names
                .extend(others.map(|unit: &Unit| {
                    (format!("{base}_{}", unit.suffix), unit.convert(1.0, own))
                }));
            names
        }
    }
}

/// Numbers of a domain, divided by a factor of units; those that a reader would take are never refused for their
/// rounding.
fn number(domain: Domain, factor: f64) -> Value {
    let mut schema = json!({ "type": "number" });
    let [least, most] = domain.bounds();
    let outwards = 4.0 * f64::EPSILON;
    let scaled = |bound: f64, sign: f64| match factor == 1.0 {
        true => bound,
        false => bound / factor + sign * outwards * (bound / factor).abs(),
    };
    match least {
        Included(bound) => schema["minimum"] = json!(scaled(bound, -1.0)),
        Excluded(bound) if factor == 1.0 || bound == 0.0 => {
            schema["exclusiveMinimum"] = json!(bound);
        }
        Excluded(bound) => schema["minimum"] = json!(scaled(bound, -1.0)),
        Unbounded => {}
    }
    match most {
        Included(bound) => schema["maximum"] = json!(scaled(bound, 1.0)),
        Excluded(bound) if factor == 1.0 || bound == 0.0 => {
            schema["exclusiveMaximum"] = json!(bound);
        }
        Excluded(bound) => schema["maximum"] = json!(scaled(bound, 1.0)),
        Unbounded => {}
    }
    schema
}
