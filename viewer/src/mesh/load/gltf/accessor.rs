//! Numbers in buffers, with every range checked.

use std::borrow::Cow;

use base64::Engine;
use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::validation::Checked;
use gltf::json::{Accessor, Index, Root, buffer};

use crate::mesh::{BYTES_MAX, MeshError};

use super::super::Resolve;
use super::item;

/// Items that any file may unfold to.
const ITEMS_BASE: u64 = 1 << 20;

/// Items that a file may unfold to per byte: instances and sparse accessors make many of few.
const ITEMS_PER_BYTE: u64 = 64;

/// The bytes that accessors lead to.
pub(super) struct Buffers<'a> {
    root: &'a Root,
    data: Vec<Cow<'a, [u8]>>,
    /// Most vertices or triangles that a file of this size is let unfold to.
    pub(super) most_items: u64,
}

/// Where the elements of an accessor lie.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

impl<'a> Elements<'a> {
    fn get(&self, at: usize) -> &'a [u8] {
        &self.bytes[at * self.stride..at * self.stride + self.size]
    }
}

impl<'a> Buffers<'a> {
    /// Gathers the buffers: the GLB's chunk, data in the JSON, files beside it.
    pub(super) fn new(
        root: &'a Root,
        file_bytes: usize,
        blob: Option<&'a [u8]>,
        resolve: Resolve,
    ) -> Result<Self, MeshError> {
        let mut data: Vec<Cow<'a, [u8]>> = Vec::with_capacity(root.buffers.len());
        let mut total = file_bytes as u64;
        for (at, buffer) in root.buffers.iter().enumerate() {
            let bytes = match (&buffer.uri, blob) {
                (Some(uri), _) => Cow::Owned(resolved(uri, resolve)?),
                (None, Some(blob)) if at == 0 => Cow::Borrowed(blob),
                // A compressed file's place holder: an error only if something is read from it.
                (None, _) => Cow::Borrowed(&[][..]),
            };
            let given = bytes.len() as u64;
            if given < buffer.byte_length.0 && !bytes.is_empty() {
                return Err(MeshError::Truncated { what: format!("buffer {at}"), needed: buffer.byte_length.0, given });
            }
            total += if matches!(bytes, Cow::Owned(_)) { given } else { 0 };
            if total > BYTES_MAX {
                return Err(MeshError::Large { bytes: total });
            }
            data.push(bytes);
        }
        Ok(Self { root, data, most_items: ITEMS_BASE + ITEMS_PER_BYTE * total })
    }

    /// Number of elements of an accessor.
    pub(super) fn count(&self, index: Index<Accessor>) -> Result<u64, MeshError> {
        Ok(item(&self.root.accessors, index.value(), "accessor")?.count.0)
    }

    /// The elements as numbers, one after the other; integers become what they stand for if they are normalised.
    pub(super) fn floats(&self, index: Index<Accessor>, kind: Type) -> Result<Vec<f32>, MeshError> {
        self.read(index, kind, |component, normalized, bytes| match component {
            ComponentType::F32 => bytes.first_chunk().map_or(0.0, |bytes| f32::from_le_bytes(*bytes)),
            _ => {
                let (value, most) = match component {
                    ComponentType::I8 => (bytes[0] as i8 as f32, 127.0),
                    ComponentType::U8 => (f32::from(bytes[0]), 255.0),
                    ComponentType::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
                    ComponentType::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65535.0),
                    _ => (integer(component, bytes) as f32, u32::MAX as f32),
                };
                if normalized { (value / most).max(-1.0) } else { value }
            }
        })
    }

    /// The elements as vectors.
    pub(super) fn vectors<const N: usize>(
        &self,
        index: Index<Accessor>,
        kind: Type,
    ) -> Result<Vec<[f32; N]>, MeshError> {
        Ok(self.floats(index, kind)?.as_chunks::<N>().0.to_vec())
    }

    /// The elements as whole numbers.
    pub(super) fn integers(&self, index: Index<Accessor>, kind: Type) -> Result<Vec<u32>, MeshError> {
        let component = component(item(&self.root.accessors, index.value(), "accessor")?, index.value())?;
        if !matches!(component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
            return Err(MeshError::damaged(format!("accessor {} should be of unsigned integers", index.value())));
        }
        self.read(index, kind, |component, _, bytes| integer(component, bytes))
    }

    fn read<T: Copy + Default>(
        &self,
        index: Index<Accessor>,
        kind: Type,
        decode: impl Fn(ComponentType, bool, &[u8]) -> T,
    ) -> Result<Vec<T>, MeshError> {
        let at = index.value();
        let accessor = item(&self.root.accessors, at, "accessor")?;
        if accessor.type_ != Checked::Valid(kind) {
            return Err(MeshError::damaged(format!("accessor {at} should be of type {kind:?}")));
        }
        let component = component(accessor, at)?;
        let (size, width) = (component.size(), kind.multiplicity());
        if accessor.count.0 > self.most_items {
            return Err(MeshError::TooMany { what: "elements", given: accessor.count.0, most: self.most_items });
        }
        let count = accessor.count.0 as usize;
        let decode_into = |bytes: &[u8], out: &mut [T]| {
            for (out, bytes) in out.iter_mut().zip(bytes.chunks_exact(size)) {
                *out = decode(component, accessor.normalized, bytes);
            }
        };
        // Without a view all is zero, but for what the sparse part says.
        let mut values = vec![T::default(); count * width];
        if let Some(view) = accessor.buffer_view {
            let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
            let elements = self.elements(view, offset, count, size * width)?;
            for (element, out) in values.chunks_exact_mut(width).enumerate() {
                decode_into(elements.get(element), out);
            }
        }
        if let Some(sparse) = &accessor.sparse {
            let many = sparse.count.0.min(u32::MAX.into()) as usize;
            let index_type = match sparse.indices.component_type {
                Checked::Valid(kind) => kind.0,
                Checked::Invalid => return Err(MeshError::damaged(format!("accessor {at} has odd sparse indices"))),
            };
            let indices =
                self.elements(sparse.indices.buffer_view, sparse.indices.byte_offset.0, many, index_type.size())?;
            let replaced = self.elements(sparse.values.buffer_view, sparse.values.byte_offset.0, many, size * width)?;
            for entry in 0..many {
                let element = integer(index_type, indices.get(entry)) as usize;
                let Some(out) = values.get_mut(element.saturating_mul(width)..).and_then(|rest| rest.get_mut(..width))
                else {
                    let what = format!("accessor {at} replaces element {element} of {count}");
                    return Err(MeshError::damaged(what));
                };
                decode_into(replaced.get(entry), out);
            }
        }
        Ok(values)
    }

    /// `count` elements of `size` bytes each, in a view from an offset. Alignment is not asked for: numbers are put
    /// together from bytes, and exporters get it wrong.
    fn elements(
        &self,
        view: Index<buffer::View>,
        offset: u64,
        count: usize,
        size: usize,
    ) -> Result<Elements<'_>, MeshError> {
        let at = view.value();
        let view = item(&self.root.buffer_views, at, "buffer view")?;
        let data = item(&self.data, view.buffer.value(), "buffer")?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            let what = format!("buffer view {at} has a stride of {stride} bytes for elements of {size}");
            return Err(MeshError::damaged(what));
        }
        let range = |start: u64, length: u64| {
            Some(usize::try_from(start).ok()?..usize::try_from(start.checked_add(length)?).ok()?)
        };
        let cut_short = |needed: u64, given: usize| MeshError::Truncated {
            what: format!("buffer view {at} and its elements"),
            needed,
            given: given as u64,
        };
        let viewed = range(start, view.byte_length.0)
            .and_then(|range| data.get(range))
            .ok_or_else(|| cut_short(start.saturating_add(view.byte_length.0), data.len()))?;
        let needed = match count {
            0 => 0,
            _ => (count as u64 - 1).saturating_mul(stride as u64).saturating_add(size as u64),
        };
        let bytes = range(offset, needed)
            .and_then(|range| viewed.get(range))
            .ok_or_else(|| cut_short(offset.saturating_add(needed), viewed.len()))?;
        Ok(Elements { bytes, stride, size })
    }
}

fn component(accessor: &Accessor, at: usize) -> Result<ComponentType, MeshError> {
    match accessor.component_type {
        Checked::Valid(GenericComponentType(component)) => Ok(component),
        Checked::Invalid => Err(MeshError::damaged(format!("accessor {at} has an unknown type of numbers"))),
    }
}

/// An unsigned number of as many bytes as there are, at most four.
fn integer(component: ComponentType, bytes: &[u8]) -> u32 {
    bytes.iter().take(component.size()).rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

/// The bytes that a buffer's reference stands for.
fn resolved(uri: &str, resolve: Resolve) -> Result<Vec<u8>, MeshError> {
    let Some(data) = uri.strip_prefix("data:") else {
        return resolve(uri).map_err(|source| MeshError::Resolve { uri: uri.into(), source });
    };
    let coded = data.split_once(',').filter(|(kind, _)| kind.ends_with(";base64"));
    let coded = coded.ok_or_else(|| MeshError::Unsupported("a data URI that is not in base64".into()))?.1;
    let engine = base64::engine::general_purpose::GeneralPurpose::new(
        &base64::alphabet::STANDARD,
        base64::engine::GeneralPurposeConfig::new()
            .with_decode_padding_mode(base64::engine::DecodePaddingMode::Indifferent),
    );
    engine.decode(coded).map_err(|error| MeshError::damaged(format!("a data URI: {error}")))
}
