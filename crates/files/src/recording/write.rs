use std::fmt::{self, Write};
use std::path::Path;

use super::{Recording, RecordingHeader, SensorAxes};
use crate::table::{TableText, end_mark, field, header_line};
use crate::{Error, write_atomically};

/// The columns that every recording has.
pub(super) const COLUMNS: &str = "time_s,depth_m,force_n";

/// The columns of a sensor of six axes, behind the others.
pub(super) fn axes_names() -> String {
    format!(",{}", SensorAxes::COLUMNS.join(","))
}

impl Recording {
    /// The text of a recording file, which [`Recording::parse`] reads back to the same recording. One that was read
    /// [incomplete](Recording::incomplete) gets no end mark.
    pub fn to_csv(&self) -> String {
        let mut text = self.header.print();
        self.print(&mut text).expect("a string takes every text");
        if self.incomplete().is_none() {
            text += &end_mark(&text, self.time_s().len());
        }
        text
    }

    /// Writes a recording file, whole or not at all.
    ///
    /// # Errors
    /// When the header holds a value that [`Recording::read`] refuses, or the operating system
    /// refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        self.header.check(path.as_ref())?;
        write_atomically(path, self.to_csv().as_bytes())
    }

    fn print(&self, text: &mut String) -> fmt::Result {
        text.push_str(COLUMNS);
        if self.axes().is_some() {
            text.push_str(&axes_names());
        }
        for column in self.extra_columns() {
            write!(text, ",{}", field(&column.name))?;
        }
        text.push('\n');
        let (depth, force) = (self.depth_m(), self.force_n());
        for (sample, time) in self.time_s().iter().enumerate() {
            write!(text, "{time:?},{:?},{:?}", depth[sample], force[sample])?;
            for value in self.axes().iter().flat_map(|axes| axes.of_sample(sample)) {
                write!(text, ",{value:?}")?;
            }
            for column in self.extra_columns() {
                write!(text, ",{}", field(&column.values[sample]))?;
            }
            text.push('\n');
        }
        Ok(())
    }
}

impl RecordingHeader {
    pub(super) fn print(&self) -> String {
        let mut text = header_line("format", 1);
        for (key, value) in self.entries() {
            text += &header_line(key, value);
        }
        for extra in &self.extra {
            text += &header_line(&extra.key, &extra.value);
        }
        text
    }

    /// The fields are public; the reader checks them.
    pub(super) fn check(&self, path: &Path) -> Result<(), Error> {
        let text = self.print() + "time_s\n";
        let table = TableText::parse(&text, path, Self::KEYS).map_err(Error::of_content)?;
        let keys = table.header.keys(path, Self::KEYS);
        let read = Self::from_keys(&keys).map_err(Error::of_content)?;
        if table.header.extra == self.extra && read.entries() == self.entries() {
            return Ok(());
        }
        Err(Error::BadContent {
            what: "an extra key of the recording".to_owned(),
            found: "one that reads back as something else".to_owned(),
            expected: "a name of letters, digits and underscores, and a value on one line".into(),
        })
    }
}
