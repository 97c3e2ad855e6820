//! Declares a header once: its fields, its keys, their reader and their writer come from one list.

use crate::scene::Region;
use crate::toml_document::{quoted, toml_number};
use crate::words::Worded;
use crate::{Error, Keys, ValueType};

/// A value of a header's key.
pub(super) trait HeaderValue: Sized {
    /// The value of a declared key; none where the key is not there.
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error>;

    /// The value as TOML writes it.
    fn written(&self) -> String;
}

impl HeaderValue for String {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        match keys.declared(key).value_type {
            ValueType::Label => keys.text_or_integer(key),
            _ => keys.text(key),
        }
    }

    fn written(&self) -> String {
        quoted(self)
    }
}

impl HeaderValue for f64 {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        keys.number(key)
    }

    fn written(&self) -> String {
        toml_number(*self)
    }
}

impl HeaderValue for u64 {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        keys.integer(key)
    }

    fn written(&self) -> String {
        self.to_string()
    }
}

impl HeaderValue for bool {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        keys.boolean(key)
    }

    fn written(&self) -> String {
        self.to_string()
    }
}

impl HeaderValue for [f64; 3] {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        match keys.declared(key).value_type {
            ValueType::Vector(_) => keys.vector(key),
            _ => keys.direction(key),
        }
    }

    fn written(&self) -> String {
        format!("[{}]", self.map(toml_number).join(", "))
    }
}

impl HeaderValue for Region {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        let table = keys.table(key)?;
        table.map(|table| Self::from_keys(&table)).transpose()
    }

    fn written(&self) -> String {
        let planes = self.planes.iter().map(|plane| {
            let (point, normal) = (plane.point_m.written(), plane.normal.written());
            format!("{{ point_m = {point}, normal = {normal} }}")
        });
        let boxes = self.boxes.iter().map(|own| {
            let (least, most) = (own.min_m.written(), own.max_m.written());
            format!("{{ min_m = {least}, max_m = {most} }}")
        });
        let spheres = self.spheres.iter().map(|sphere| {
            let (center, radius) = (sphere.center_m.written(), toml_number(sphere.radius_m));
            format!("{{ center_m = {center}, radius_m = {radius} }}")
        });
        let lists: [(&str, Vec<String>); 3] = [
            ("planes", planes.collect()),
            ("boxes", boxes.collect()),
            ("spheres", spheres.collect()),
        ];
        let lists = lists.iter().filter(|(_, own)| !own.is_empty());
        let lists = lists.map(|(name, own)| format!("{name} = [{}]", own.join(", ")));
        format!("{{ {} }}", lists.collect::<Vec<_>>().join(", "))
    }
}

impl<W: Worded> HeaderValue for W {
    fn read(keys: &Keys<'_>, key: &'static str) -> Result<Option<Self>, Error> {
        keys.word(key, W::WORDS)
    }

    fn written(&self) -> String {
        quoted(W::word(*self))
    }
}

/// A header whose fields are its keys, each of which is optional.
macro_rules! header_keys {
    ($(#[$meta:meta])* pub struct $name:ident {
        $($(#[doc = $meaning:literal])+ $key:ident: $type:ty = $holds:expr,)+
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct $name {
            $($(#[doc = $meaning])+ pub $key: Option<$type>,)+
            /// Unknown keys, which are preserved.
            pub extra: Vec<ExtraKey>,
        }

        impl $name {
            /// The known keys.
            pub const KEYS: &'static [Key] = &[$(Key {
                name: stringify!($key),
                value_type: $holds,
                meaning: concat!($($meaning),+),
                omitted: $crate::Omitted::Means("not said"),
                example: "",
                in_template: false,
            },)+];

            fn read(keys: &Keys<'_>) -> Result<Self, Error> {
                use super::header_keys::HeaderValue;
                Ok(Self {
                    $($key: HeaderValue::read(keys, stringify!($key))?,)+
                    extra: Vec::new(),
                })
            }

            /// Its entries, by key, each value as TOML writes it.
            pub fn entries(&self) -> Vec<(&'static str, String)> {
                use super::header_keys::HeaderValue;
                let values = [$((stringify!($key), self.$key.as_ref().map(HeaderValue::written)),)+];
                values.into_iter().filter_map(|(key, value)| Some((key, value?))).collect()
            }
        }
    };
}

pub(super) use header_keys;
