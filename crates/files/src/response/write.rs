use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::checked::Checked;
use super::{FIRST_LINE, StoredResponse};
use crate::Error;
use crate::atomic_write::write_atomically_with;

impl StoredResponse<'_> {
    /// Writes the file, whole or not at all.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        write_atomically_with(path, |file| self.put(file))
    }

    fn put(&self, file: &mut dyn Write) -> io::Result<()> {
        let mut checked = Checked::new(BufWriter::new(file));
        checked.put(self.header().as_bytes())?;
        let touchable = self.touchable.iter();
        checked.put_numbers(touchable.map(|triangle| triangle.to_le_bytes()))?;
        let displacements = self.displacements.iter();
        checked.put_numbers(displacements.map(|value| value.to_le_bytes()))?;
        let (digest, mut file) = checked.finish();
        file.write_all(&digest)?;
        file.flush()
    }

    fn header(&self) -> String {
        let one_line = self.made_by.replace(['\n', '\r'], " ");
        format!(
            "{FIRST_LINE}\nkey = {}\ntouchable = {}\ntriangles = {}\nmade_by = {one_line}\n\n",
            self.key,
            self.touchable.len(),
            self.triangles,
        )
    }
}
