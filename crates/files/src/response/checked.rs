use std::io::{self, Read, Write};

use sha2::{Digest, Sha256};

/// Bytes that are handled at a time.
const CHUNK: usize = 1 << 16;

/// A reader or writer that computes the digest of its data.
pub(super) struct Checked<S> {
    stream: S,
    digest: Sha256,
}

impl<S> Checked<S> {
    pub(super) fn new(stream: S) -> Self {
        Self {
            stream,
            digest: Sha256::new(),
        }
    }

    /// The digest of the data, and the stream.
    pub(super) fn finish(self) -> ([u8; super::DIGEST], S) {
        (self.digest.finalize().into(), self.stream)
    }
}

impl<R: Read> Checked<R> {
    pub(super) fn bytes(&mut self, bytes: &mut [u8]) -> io::Result<()> {
        self.stream.read_exact(bytes)?;
        self.digest.update(bytes);
        Ok(())
    }

    /// `count` numbers of four bytes.
    ///
    /// # Errors
    /// When they cannot be read, or there is no memory for them.
    pub(super) fn numbers<T>(
        &mut self,
        count: usize,
        number: impl Fn([u8; 4]) -> T,
    ) -> io::Result<Vec<T>> {
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(count)?;
        let mut chunk = vec![0; CHUNK];
        while numbers.len() < count {
            let bytes = &mut chunk[..(4 * (count - numbers.len())).min(CHUNK)];
            self.bytes(bytes)?;
            let (quads, _) = bytes.as_chunks::<4>();
            numbers.extend(quads.iter().map(|quad| number(*quad)));
        }
        Ok(numbers)
    }
}

impl<W: Write> Checked<W> {
    pub(super) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.digest.update(bytes);
        self.stream.write_all(bytes)
    }

    /// Numbers of four bytes each.
    pub(super) fn put_numbers(&mut self, numbers: impl Iterator<Item = [u8; 4]>) -> io::Result<()> {
        let mut chunk = Vec::with_capacity(CHUNK);
        for quad in numbers {
            chunk.extend_from_slice(&quad);
            if chunk.len() == CHUNK {
                self.put(&chunk)?;
                chunk.clear();
            }
        }
        self.put(&chunk)
    }
}
