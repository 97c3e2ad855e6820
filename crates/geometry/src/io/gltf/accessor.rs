use ::gltf::Accessor;
use ::gltf::accessor::{DataType, Dimensions};

use super::buffers::Buffers;
use crate::ReadFault;

/// Positions [m] of a primitive.
pub(super) fn positions(
    accessor: &Accessor<'_>,
    buffers: &Buffers,
) -> Result<Vec<[f64; 3]>, ReadFault> {
    if (accessor.dimensions(), accessor.data_type()) != (Dimensions::Vec3, DataType::F32) {
        return Err(ReadFault::Unsupported {
            what: "a glTF position that is not three single-precision numbers",
        });
    }
    let decode = |element: &[u8]| {
        std::array::from_fn(|axis| {
            let at = 4 * axis;
            let four = [
                element[at],
                element[at + 1],
                element[at + 2],
                element[at + 3],
            ];
            f64::from(f32::from_le_bytes(four))
        })
    };
    Ok(elements(accessor, buffers)?.map(decode).collect())
}

/// Vertex numbers of a primitive, from zero.
pub(super) fn indices(accessor: &Accessor<'_>, buffers: &Buffers) -> Result<Vec<u32>, ReadFault> {
    let whole = matches!(
        accessor.data_type(),
        DataType::U8 | DataType::U16 | DataType::U32
    );
    if accessor.dimensions() != Dimensions::Scalar || !whole {
        return Err(ReadFault::Unsupported {
            what: "a glTF vertex number that is not an unsigned whole number",
        });
    }
    let decode = |element: &[u8]| {
        let mut four = [0; 4];
        four[..element.len()].copy_from_slice(element);
        u32::from_le_bytes(four)
    };
    Ok(elements(accessor, buffers)?.map(decode).collect())
}

/// The bytes of each element, after a check that all lie within their buffer.
fn elements<'a>(
    accessor: &Accessor<'_>,
    buffers: &'a Buffers,
) -> Result<impl Iterator<Item = &'a [u8]>, ReadFault> {
    let (Some(view), None) = (accessor.view(), accessor.sparse()) else {
        return Err(ReadFault::Unsupported {
            what: "a sparse glTF accessor",
        });
    };
    let size = accessor.size();
    let stride = view.stride().unwrap_or(size);
    if stride < size {
        return Err(ReadFault::Gltf {
            cause: format!("a stride of {stride} bytes for elements of {size}"),
        });
    }
    let bytes = buffers.bytes(view.buffer().index());
    let count = accessor.count();
    let start = view.offset().saturating_add(accessor.offset());
    let end = stride
        .saturating_mul(count.saturating_sub(1))
        .saturating_add(size)
        .saturating_add(start);
    let room = view.offset().saturating_add(view.length()).min(bytes.len());
    if end > room && count > 0 {
        return Err(ReadFault::Truncated {
            what: "a buffer of the glTF document",
            expected: end as u64,
            found: room as u64,
        });
    }
    Ok((0..count).map(move |k| &bytes[start + k * stride..][..size]))
}
