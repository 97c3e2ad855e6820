use super::super::raw::MAX_TRIANGLES;
use super::buffers::Bytes;
use super::document::{Document, part};
use crate::ReadFault;

/// A document with the bytes that it refers to.
pub(super) struct Source<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: Vec<Bytes<'a>>,
}

impl Source<'_> {
    /// Positions of a primitive [m].
    pub(super) fn positions(
        &self,
        accessor: usize,
    ) -> Result<impl Iterator<Item = [f64; 3]>, ReadFault> {
        let found = part(&self.document.accessors, accessor, "accessor")?;
        if (found.shape.as_str(), found.component_type) != ("VEC3", 5126) {
            return Err(ReadFault::Unsupported {
                what: "a glTF position that is not three single-precision numbers",
            });
        }
        let single = |four: &[u8]| f64::from(f32::from_bits(little_endian(four)));
        let decode = move |twelve: &[u8]| [0, 4, 8].map(|at| single(&twelve[at..at + 4]));
        Ok(self.elements(accessor, 12)?.map(decode))
    }

    /// Vertex numbers of a primitive, from zero.
    pub(super) fn indices(&self, accessor: usize) -> Result<Vec<u32>, ReadFault> {
        let found = part(&self.document.accessors, accessor, "accessor")?;
        let size = match (found.shape.as_str(), found.component_type) {
            ("SCALAR", 5121) => 1,
            ("SCALAR", 5123) => 2,
            ("SCALAR", 5125) => 4,
            _ => {
                return Err(ReadFault::Unsupported {
                    what: "a glTF vertex number that is not an unsigned whole number",
                });
            }
        };
        Ok(self.elements(accessor, size)?.map(little_endian).collect())
    }

    /// The bytes of each element, after a check that all lie within their buffer.
    fn elements(
        &self,
        accessor: usize,
        size: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, ReadFault> {
        let accessor = part(&self.document.accessors, accessor, "accessor")?;
        let (Some(view), None) = (accessor.buffer_view, accessor.sparse) else {
            return Err(ReadFault::Unsupported {
                what: "a sparse glTF accessor",
            });
        };
        let view = part(&self.document.buffer_views, view, "buffer view")?;
        let bytes = part(&self.buffers, view.buffer, "buffer")?;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            let cause = format!("a stride of {stride} bytes for elements of {size}");
            return Err(ReadFault::invalid_gltf(cause));
        }
        let count = accessor.count;
        let start = view.byte_offset.saturating_add(accessor.byte_offset);
        let end = stride
            .saturating_mul(count.saturating_sub(1))
            .saturating_add(size)
            .saturating_add(start);
        let room = view.byte_offset.saturating_add(view.byte_length);
        let room = room.min(bytes.len());
        if end > room && count > 0 {
            return Err(ReadFault::Truncated {
                what: "a buffer of the glTF document",
                expected: end as u64,
                found: room as u64,
            });
        }
        let most = 3 * MAX_TRIANGLES;
        if count as u64 > most {
            return Err(ReadFault::TooLarge {
                what: "vertex numbers",
                found: count as u64,
                most,
            });
        }
        Ok((0..count).map(move |k| &bytes[start + k * stride..][..size]))
    }
}

/// A whole number of up to four bytes.
fn little_endian(bytes: &[u8]) -> u32 {
    let mut four = [0; 4];
    four[..bytes.len()].copy_from_slice(bytes);
    u32::from_le_bytes(four)
}
